//! Model: how a world is computed. Integrator, contacts and substeps decide the bits; the broadphase only the cost.

use crate::broadphase::{self, Broadphase, Settings};
use crate::contacts::{self, Contacts};
use crate::error::Shown;
use crate::integrator::{self, Integrator};
use crate::{Error, Rules};

const MOST_SUBSTEPS: u32 = 1024;

/// A choice of registered methods.
#[derive(Clone)]
pub struct Model {
    integrator: &'static Integrator,
    contacts: &'static contacts::Kind,
    broadphase: &'static broadphase::Kind,
    substeps: u32,
    smallest_node: Option<f64>,
}

fn find<T>(
    what: &str,
    name: &str,
    table: &'static [T],
    of: fn(&T) -> &'static str,
) -> Result<&'static T, Error> {
    table.iter().find(|entry| of(entry) == name).ok_or_else(|| {
        let known: Vec<_> = table.iter().map(of).collect();
        Error::Model(format!(
            "{what} {name:?} is unknown; there are {}",
            known.join(", ")
        ))
    })
}

impl Model {
    /// Looks the methods up by name.
    ///
    /// # Errors
    /// [`Error::Model`] for a name that is not registered, a pairing that makes no sense, or a number out of bounds.
    pub fn new(
        integrator: &str,
        contacts: &str,
        broadphase: &str,
        substeps: u32,
        smallest_node: Option<f64>,
    ) -> Result<Model, Error> {
        let integrator = find("integrator", integrator, &integrator::TABLE, |entry| entry.name)?;
        let contacts = find("contacts", contacts, &contacts::TABLE, |entry| entry.name)?;
        let broadphase = find("broadphase", broadphase, &broadphase::TABLE, |entry| entry.name)?;
        if let Some(allowed) = contacts.integrators
            && !allowed.contains(&integrator.name)
        {
            return Err(Error::Model(format!(
                "contacts {:?} cannot be paired with integrator {:?}, only with {}: {}",
                contacts.name,
                integrator.name,
                allowed.join(", "),
                contacts.reason
            )));
        }
        if !(1..=MOST_SUBSTEPS).contains(&substeps) {
            return Err(Error::Model(format!(
                "substeps is {substeps}, it must be from 1 to {MOST_SUBSTEPS}"
            )));
        }
        if let Some(size) = smallest_node.filter(|size| !(size.is_finite() && *size > 0.0)) {
            return Err(Error::Model(format!(
                "smallest_node is {}, it must be above 0 and finite",
                Shown(size)
            )));
        }
        Ok(Model {
            integrator,
            contacts,
            broadphase,
            substeps,
            smallest_node,
        })
    }

    /// The integrator.
    #[must_use]
    pub fn integrator(&self) -> &'static Integrator {
        self.integrator
    }

    /// The contact treatment's name.
    #[must_use]
    pub fn contacts(&self) -> &'static str {
        self.contacts.name
    }

    /// The broadphase's name.
    #[must_use]
    pub fn broadphase(&self) -> &'static str {
        self.broadphase.name
    }

    /// Steps that a tick is cut into.
    #[must_use]
    pub fn substeps(&self) -> u32 {
        self.substeps
    }

    /// The smallest node of the classical quadtree, if chosen.
    #[must_use]
    pub fn smallest_node(&self) -> Option<f64> {
        self.smallest_node
    }

    pub(crate) fn make_contacts(&self) -> Box<dyn Contacts> {
        (self.contacts.make)()
    }

    pub(crate) fn make_broadphase(&self, rules: &Rules) -> Box<dyn Broadphase> {
        (self.broadphase.make)(&Settings {
            root: rules.bounds(),
            smallest_node: self.smallest_node,
        })
    }
}
