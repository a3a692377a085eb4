//! A tick whose scratch memory has grown to what it needs asks for no more, and neither does copying into a world that
//! has held as many balls before.
#![allow(unsafe_code)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use kuglice_step::{Model, NewBall, Rules, Vec2, World, random};

struct Counting;

thread_local! {
    // Constant and without a destructor, so that reading it allocates nothing itself.
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

// SAFETY: every call goes to the system's allocator unchanged; counting touches a plain thread-local number only.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        // SAFETY: the caller's promises are those that the system's allocator asks for.
        unsafe { System.alloc(layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        // SAFETY: `pointer` came from `alloc` above, thus from the system's allocator.
        unsafe { System.realloc(pointer, layout, size) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: `pointer` came from `alloc` above, thus from the system's allocator.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn allocations(work: impl FnOnce()) -> u64 {
    let before = ALLOCATIONS.get();
    work();
    ALLOCATIONS.get() - before
}

fn world(contacts: &str, broadphase: &str) -> World {
    let count = 1000;
    let rules = Rules::new([0.0, 0.0, 54.0, 54.0], true, 1.0, 60.0, &[]).unwrap();
    let balls: Vec<_> = (0..count)
        .map(|i| NewBall {
            position: Vec2::new(1.0 + 1.6 * (i % 32) as f64, 1.0 + 1.6 * (i / 32) as f64),
            velocity: Vec2::new(
                12.0 * random::uniform(1, 0, i) - 6.0,
                12.0 * random::uniform(1, 1, i) - 6.0,
            ),
            radius: 0.5,
            mass: 1.0,
        })
        .collect();
    World::new(
        rules,
        Model::new("verlet", contacts, broadphase, 1, None).unwrap(),
        &balls,
    )
    .unwrap()
}

const CONTACTS: [&str; 3] = ["overlap", "backtrack", "event"];
const BROADPHASES: [&str; 3] = ["brute", "quadtree", "loose_quadtree"];

fn every_pairing() -> impl Iterator<Item = (&'static str, &'static str)> {
    CONTACTS
        .into_iter()
        .flat_map(|contacts| BROADPHASES.map(|broadphase| (contacts, broadphase)))
}

#[test]
fn the_counter_counts() {
    assert_eq!(allocations(|| drop(std::hint::black_box(Box::new(1)))), 1);
    assert!(allocations(|| drop(std::hint::black_box(world("overlap", "brute").snapshot()))) > 1);
}

/// The same ticks from a copy of the same state, so that room for whatever they need has been made before. Twice, since
/// the quadtree hands the lists of its old nodes to new ones, and a short list may come to a node that needs a long one.
#[test]
fn ticks_that_ran_before_allocate_nothing() {
    for (contacts, broadphase) in every_pairing() {
        let start = world(contacts, broadphase);
        let mut again = start.clone();
        let mut run = || {
            again.copy_from(&start);
            for _ in 0..60 {
                again.step(&[], None).unwrap();
            }
        };
        run();
        run();
        assert_eq!(allocations(run), 0, "{contacts}, {broadphase}");
    }
}

#[test]
fn copying_into_an_existing_world_allocates_nothing() {
    for (contacts, broadphase) in every_pairing() {
        let mut source = world(contacts, broadphase);
        let mut target = source.clone();
        for _ in 0..20 {
            source.step(&[], None).unwrap();
        }
        assert_eq!(
            allocations(|| target.copy_from(&source)),
            0,
            "{contacts}, {broadphase}"
        );
        assert_eq!(target.state_hash(), source.state_hash());
    }
}
