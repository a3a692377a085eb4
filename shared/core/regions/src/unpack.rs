//! Bytes to balls, whatever the bytes are: bounded first, checked before anybody uses them.

use kuglice_step::{NO_BALL, NewBall, Vec2};

use crate::bits::{MOST_BITS, Reader};
use crate::columns::read_column;
use crate::{Error, Grid, Quanta, Shapes};

/// Balls with their ids, which ascend.
pub type Unpacked = Vec<(u64, NewBall)>;

/// Reads what `pack` wrote, of at most `most` balls.
///
/// # Errors
/// [`Error`] for anything else.
pub fn unpack(
    grid: &Grid,
    quanta: Quanta,
    shapes: &Shapes,
    bytes: &[u8],
    most: usize,
) -> Result<Unpacked, Error> {
    let mut reader = Reader::new(bytes);
    let count = usize::try_from(reader.varint()?).unwrap_or(usize::MAX);
    if count > most {
        return Err(Error(format!("{count} balls, at most {most}")));
    }
    if count == 0 {
        return reader.end().map(|()| Vec::new());
    }
    let ids = read_ids(&mut reader, count)?;
    let mut column = || read_column(&mut reader, count);
    let (x, y, vx, vy) = (column()?, column()?, column()?, column()?);
    let shapes = shapes.read(&mut reader, count)?;
    reader.end()?;
    let origin = grid.origin();
    (0..count)
        .map(|at| {
            let ball = NewBall {
                position: origin + Vec2::new(x[at], y[at]) * quanta.position,
                velocity: Vec2::new(vx[at], vy[at]) * quanta.velocity,
                radius: shapes[at].0,
                mass: shapes[at].1,
            };
            match ball.check() {
                Ok(()) => Ok((ids[at], ball)),
                Err(error) => Err(Error(format!("ball {}: {error}", ids[at]))),
            }
        })
        .collect()
}

fn read_ids(reader: &mut Reader<'_>, count: usize) -> Result<Vec<u64>, Error> {
    let first = reader.varint()?;
    let wide = reader.width(MOST_BITS)?;
    let gaps = reader.bits(count - 1, wide)?;
    let mut ids = Vec::with_capacity(count);
    ids.push(first);
    let mut last = first;
    for gap in gaps {
        let next = last.checked_add(gap).and_then(|next| next.checked_add(1));
        last = next.ok_or_else(|| Error(format!("an id after {last} by {gap} more than one")))?;
        ids.push(last);
    }
    match last {
        NO_BALL => Err(Error(format!("id {NO_BALL}: stands for no ball"))),
        _ => Ok(ids),
    }
}
