//! Inputs: what a player, or the owner of the world, does at a tick; and the records in which they travel.

use std::cmp::Ordering;

use crate::Error;

/// Bytes of one record: kind u8, client u32, sequence u64, ball u64, six f64; little-endian.
pub const INPUT_BYTES: usize = 1 + 4 + 8 + 8 + 6 * 8;

/// Stands for "no ball" where a record has room for an id.
pub const NO_BALL: u64 = u64::MAX;

/// What an input does. The numbers of a record are given behind each kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum InputKind {
    /// A client joins, and gets a ball if the radius is not 0: x, y, radius, mass.
    Join,
    /// A client leaves; its ball and all it holds go with it.
    Leave,
    /// A new ball: x, y, vx, vy, radius, mass.
    Spawn,
    /// The ball goes.
    Remove,
    /// Holds a force on the client's own ball until changed: x, y.
    Thrust,
    /// Holds a point that attracts every ball; strength 0 releases it: x, y, strength.
    Attract,
    /// Adds to the velocity of a ball, by default the client's own: vx, vy.
    Kick,
}

impl InputKind {
    /// All kinds; a kind's place is its byte in a record.
    pub const ALL: [InputKind; 7] = [
        InputKind::Join,
        InputKind::Leave,
        InputKind::Spawn,
        InputKind::Remove,
        InputKind::Thrust,
        InputKind::Attract,
        InputKind::Kick,
    ];

    /// The name of this kind, the same everywhere.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            InputKind::Join => "join",
            InputKind::Leave => "leave",
            InputKind::Spawn => "spawn",
            InputKind::Remove => "remove",
            InputKind::Thrust => "thrust",
            InputKind::Attract => "attract",
            InputKind::Kick => "kick",
        }
    }

    /// Players first, then balls, then what acts on balls.
    fn group(self) -> u8 {
        match self {
            InputKind::Join | InputKind::Leave => 0,
            InputKind::Spawn | InputKind::Remove => 1,
            InputKind::Thrust | InputKind::Attract | InputKind::Kick => 2,
        }
    }
}

/// One input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Input {
    /// What it does.
    pub kind: InputKind,
    /// Who does it; 0 is the owner of the world.
    pub client: u32,
    /// The client's own count of its inputs.
    pub sequence: u64,
    /// The ball concerned, or [`NO_BALL`].
    pub ball: u64,
    /// Numbers as [`InputKind`] lists them, the rest 0.
    pub numbers: [f64; 6],
}

impl Input {
    /// The order in which the inputs of one tick are applied, whatever order they arrived in: a total order, so that
    /// even two inputs with one sequence number leave no choice.
    #[must_use]
    pub fn order(&self, other: &Input) -> Ordering {
        let key = |input: &Input| {
            (
                input.kind.group(),
                input.client,
                input.sequence,
                input.kind,
                input.ball,
            )
        };
        key(self).cmp(&key(other)).then_with(|| {
            let pairs = self.numbers.iter().zip(&other.numbers);
            pairs.fold(Ordering::Equal, |so_far, (a, b)| {
                so_far.then_with(|| a.total_cmp(b))
            })
        })
    }

    /// Whether all numbers are finite, but for a mass, which may be infinite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        let mass = match self.kind {
            InputKind::Join => 3,
            InputKind::Spawn => 5,
            _ => usize::MAX,
        };
        self.numbers
            .iter()
            .enumerate()
            .all(|(i, n)| n.is_finite() || (i == mass && *n == f64::INFINITY))
    }
}

/// Reads records.
///
/// # Errors
/// [`Error::Input`] if the length is no multiple of [`INPUT_BYTES`] or a kind is unknown.
pub fn read_inputs(bytes: &[u8]) -> Result<Vec<Input>, Error> {
    let (records, rest) = bytes.as_chunks::<INPUT_BYTES>();
    if !rest.is_empty() {
        return Err(Error::Input(format!(
            "input records take {INPUT_BYTES} bytes each; {} bytes are no whole number of them",
            bytes.len()
        )));
    }
    records.iter().map(read_input).collect()
}

fn read_input(record: &[u8; INPUT_BYTES]) -> Result<Input, Error> {
    let kind = *InputKind::ALL.get(usize::from(record[0])).ok_or_else(|| {
        Error::Input(format!(
            "input kind {} is unknown, the last one is {}",
            record[0],
            InputKind::ALL.len() - 1
        ))
    })?;
    let word = |at: usize| {
        let mut bytes = [0; 8];
        bytes.copy_from_slice(&record[at..at + 8]);
        u64::from_le_bytes(bytes)
    };
    let client = u32::from_le_bytes([record[1], record[2], record[3], record[4]]);
    let mut numbers = [0.0; 6];
    for (i, number) in numbers.iter_mut().enumerate() {
        *number = f64::from_bits(word(21 + 8 * i));
    }
    Ok(Input {
        kind,
        client,
        sequence: word(5),
        ball: word(13),
        numbers,
    })
}

/// Writes records.
#[must_use]
#[expect(clippy::missing_panics_doc, reason = "every kind is in the list of all kinds")]
pub fn write_inputs(inputs: &[Input]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(inputs.len() * INPUT_BYTES);
    for input in inputs {
        let kind = InputKind::ALL
            .iter()
            .position(|&kind| kind == input.kind)
            .expect("a kind of the list");
        bytes.push(u8::try_from(kind).expect("fewer than 256 kinds"));
        bytes.extend_from_slice(&input.client.to_le_bytes());
        bytes.extend_from_slice(&input.sequence.to_le_bytes());
        bytes.extend_from_slice(&input.ball.to_le_bytes());
        for number in input.numbers {
            bytes.extend_from_slice(&number.to_bits().to_le_bytes());
        }
    }
    bytes
}
