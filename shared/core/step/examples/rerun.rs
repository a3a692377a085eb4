//! Runs a recording again and prints `tick hash` after each tick. Built for every platform whose bits are compared.

use kuglice_step::Recording;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).ok_or("usage: rerun RECORDING")?;
    let Recording { mut world, ticks } = Recording::from_bytes(&std::fs::read(path)?)?;
    for inputs in &ticks {
        world.step(inputs, None)?;
        println!("{} {:016x}", world.state().tick, world.state_hash());
    }
    Ok(())
}
