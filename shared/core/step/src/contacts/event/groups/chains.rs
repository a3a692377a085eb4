//! Predicted events, and which of them each actor has.

use super::super::queue::Event;
use super::actors::{Actor, Actors};

/// Where a predicted event stands in the chain of one of its actors.
#[derive(Clone, Copy, Debug)]
struct Link {
    event: u32,
    next: u32,
}

/// Predicted events of actors, and for each of these a chain of its own.
#[derive(Default)]
pub(super) struct Chains {
    pub(super) events: Vec<Event>,
    links: Vec<Link>,
}

impl Chains {
    pub(super) fn clear(&mut self) {
        self.events.clear();
        self.links.clear();
    }

    /// Adds an event to the chains of its actors.
    pub(super) fn add(&mut self, event: Event, actors: &mut Actors) {
        let number = self.events.len() as u32;
        for slot in slots(&event) {
            let head = &mut actors.all[slot].links;
            let next = std::mem::replace(head, self.links.len() as u32);
            self.links.push(Link { event: number, next });
        }
        self.events.push(event);
    }

    /// The events of an actor, the last that was added first.
    pub(super) fn of(&self, actor: &Actor) -> impl Iterator<Item = &Event> {
        let mut at = actor.links;
        std::iter::from_fn(move || {
            let link = self.links.get(at as usize)?;
            at = link.next;
            Some(&self.events[link.event as usize])
        })
    }
}

/// The actors of an event.
pub(super) fn slots(event: &Event) -> impl Iterator<Item = usize> + use<> {
    std::iter::once(event.first as usize).chain(event.partner.as_ball())
}
