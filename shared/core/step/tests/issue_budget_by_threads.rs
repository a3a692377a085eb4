//! Whether a tick keeps its budget is a function of the state.
//!
//! A budget bounded what `event` had really looked at. Strips of the plane, as many as threads have use for, each counted
//! the pairs that they shared; and whether collisions ran in groups or in one sequence hung on the tick before, which a
//! restored world has not made. So the same tick was made in one process and refused in another.

use kuglice_step::{Error, Model, NewBall, Rules, Team, Vec2, World, random};

const TICKS: u32 = 12;

/// What makes a scene run in groups, in a sequence, or now so, now so.
#[derive(Clone, Copy, Debug)]
struct Scene {
    balls: u32,
    /// Distance of neighbours in diameters of the largest.
    pitch: f64,
    least_radius: f64,
    speed: f64,
    gravity: bool,
    restitution: f64,
    substeps: u32,
}

/// Few and slow enough for groups, with several strips of them.
const GAS: Scene = Scene {
    balls: 9000,
    pitch: 1.6,
    least_radius: 0.5,
    speed: 12.0,
    gravity: false,
    restitution: 1.0,
    substeps: 1,
};
const SCENES: [Scene; 5] = [
    GAS,
    // Some balls get far faster than they began, and beyond all slack.
    Scene {
        least_radius: 0.05,
        gravity: true,
        substeps: 2,
        ..GAS
    },
    // On the verge of being a crowd.
    Scene {
        balls: 800,
        pitch: 1.3,
        speed: 18.0,
        ..GAS
    },
    Scene {
        balls: 600,
        pitch: 1.05,
        ..GAS
    },
    Scene {
        balls: 300,
        gravity: true,
        restitution: 0.7,
        ..GAS
    },
];

impl Scene {
    fn world(&self, broadphase: &str) -> World {
        let columns = f64::from(self.balls).sqrt().ceil();
        let balls: Vec<_> = (0..self.balls)
            .map(|i| {
                let number = |stream| random::uniform(3, stream, u64::from(i));
                let (column, row) = (f64::from(i) % columns, (f64::from(i) / columns).floor());
                let radius = self.least_radius + (0.5 - self.least_radius) * number(2);
                NewBall {
                    position: Vec2::new(column + 0.5, row + 0.5) * self.pitch,
                    velocity: Vec2::new(number(0) - 0.5, number(1) - 0.5) * self.speed,
                    radius,
                    mass: radius * radius,
                }
            })
            .collect();
        let forces: &[(&str, &[f64])] = if self.gravity {
            &[("gravity", &[0.0, -10.0])]
        } else {
            &[]
        };
        let side = columns * self.pitch;
        let rules = Rules::new([0.0, 0.0, side, side], true, self.restitution, 60.0, forces);
        let model = Model::new("verlet", "event", broadphase, self.substeps, None);
        World::new(rules.unwrap(), model.unwrap(), &balls).unwrap()
    }

    /// A world that has made some ticks.
    fn continued(&self, broadphase: &str, threads: usize) -> World {
        let mut world = self.world(broadphase);
        world.employ(Team::new(threads).unwrap());
        for _ in 0..TICKS {
            world.step(&[], None).unwrap();
        }
        world
    }
}

fn restored(world: &World) -> World {
    World::restore(world.rules().clone(), world.model().clone(), &world.snapshot()).unwrap()
}

/// The least budget within which the next tick is made.
fn least_budget(world: &World) -> u64 {
    let (mut refused, mut enough) = (0, u64::from(u32::MAX));
    while enough - refused > 1 {
        let budget = refused.midpoint(enough);
        match world.clone().step_within(&[], None, budget) {
            Ok(()) => enough = budget,
            Err(Error::Budget { .. }) => refused = budget,
            Err(error) => panic!("{error}"),
        }
    }
    enough
}

#[test]
fn the_same_budget_is_enough_for_all() {
    for scene in SCENES {
        let judge = scene.continued("loose_quadtree", 1);
        let least = least_budget(&judge);
        assert!(
            least > u64::from(scene.balls) / 8,
            "{scene:?}: a tick with work to do"
        );
        let mut after = restored(&judge);
        after.step(&[], None).unwrap();
        let check = |mut world: World, who: &str| {
            let done = world.step_within(&[], None, least - 1);
            assert!(
                matches!(done, Err(Error::Budget { .. })),
                "{scene:?}, {who}: less than {least} pairs"
            );
            let done = world.step_within(&[], None, least);
            assert!(done.is_ok(), "{scene:?}, {who}: {least} pairs: {done:?}");
            assert_eq!(world.state_hash(), after.state_hash());
        };
        for threads in [1, 2, 3, 8] {
            let world = scene.continued("loose_quadtree", threads);
            let mut another = restored(&world);
            another.employ(world.team().clone());
            check(another, &format!("restored, {threads} threads"));
            check(world, &format!("{threads} threads"));
        }
        for broadphase in ["quadtree", "brute"] {
            if scene.balls < 1000 {
                check(scene.continued(broadphase, 1), broadphase);
            }
        }
    }
}
