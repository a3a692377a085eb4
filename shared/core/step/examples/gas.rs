//! A gas at packing 0.3, run for a profiler: `gas BALLS TICKS CONTACTS BROADPHASE [VARIANT [THREADS]]`, where VARIANT
//! is `plain`, `mixed`, `gravity` or `shuffled`.
//!
//! Prints nanoseconds per ball-step and the final hash.

use std::time::Instant;

use kuglice_step::{Model, NewBall, Rules, Team, Vec2, World, random};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let argument = |at: usize, default: &str| arguments.get(at).map_or(default.to_owned(), Clone::clone);
    let count: u32 = argument(0, "10000").parse()?;
    let ticks: u32 = argument(1, "200").parse()?;
    let (contacts, broadphase) = (argument(2, "overlap"), argument(3, "loose_quadtree"));
    let variant = argument(4, "");

    let columns = f64::from(count).sqrt().ceil();
    let pitch = 0.5 * (std::f64::consts::PI / 0.3).sqrt();
    let side = columns * pitch;
    // As balls that were placed at random: their ids say nothing of where they are.
    let mut places: Vec<u32> = (0..count).collect();
    if variant == "shuffled" {
        places.sort_by_key(|&i| random::uniform(1, 3, u64::from(i)).to_bits());
    }
    let balls: Vec<NewBall> = places
        .into_iter()
        .map(|i| {
            let (row, column) = ((f64::from(i) / columns).floor(), f64::from(i) % columns);
            let number = |stream| random::uniform(1, stream, u64::from(i)) - 0.5;
            let radius = if variant == "mixed" {
                0.05 + 0.45 * random::uniform(1, 2, u64::from(i))
            } else {
                0.5
            };
            NewBall {
                position: Vec2::new((column + 0.5) * pitch, (row + 0.5) * pitch),
                velocity: Vec2::new(12.0 * number(0), 12.0 * number(1)),
                radius,
                mass: radius * radius,
            }
        })
        .collect();
    let gravity: &[(&str, &[f64])] = &[("gravity", &[0.0, -10.0])];
    let forces = if variant == "gravity" { gravity } else { &[] };
    let rules = Rules::new([0.0, 0.0, side, side], true, 1.0, 60.0, forces)?;
    let threads: usize = argument(5, "1").parse()?;
    let mut world = World::new(
        rules,
        Model::new("verlet", &contacts, &broadphase, 1, None)?,
        &balls,
    )?;
    world.employ(Team::new(threads)?);
    for _ in 0..10 {
        world.step(&[], None)?;
    }
    // The least of several batches: what a busy machine adds is none of the step's business.
    let mut least = f64::INFINITY;
    for _ in 0..8 {
        let batch = (ticks / 8).max(1);
        let start = Instant::now();
        for _ in 0..batch {
            world.step(&[], None)?;
        }
        least = least.min(start.elapsed().as_secs_f64() / f64::from(batch) / f64::from(count));
    }
    println!(
        "{:.1} ns per ball-step, hash {:016x}",
        least * 1e9,
        world.state_hash()
    );
    Ok(())
}
