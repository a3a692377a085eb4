//! Little-endian writing and bounded reading, shared by snapshots, rules and recordings.

use crate::checksum::{ROW, checksum};
use crate::{Error, Vec2};

/// Of the checksum at the end.
pub(crate) const SUM_BYTES: usize = 8;

/// Appends numbers to bytes.
#[derive(Default)]
pub(crate) struct Writer {
    bytes: Vec<u8>,
}

impl Writer {
    pub(crate) fn new(magic: &[u8; 4], version: u32) -> Writer {
        let mut writer = Writer::default();
        writer.bytes.extend_from_slice(magic);
        writer.u32(version);
        writer
    }

    pub(crate) fn u8(&mut self, value: u8) {
        self.bytes.push(value);
    }

    pub(crate) fn u32(&mut self, value: u32) {
        self.bytes.extend_from_slice(&value.to_le_bytes());
    }

    pub(crate) fn u64(&mut self, value: u64) {
        self.bytes.extend_from_slice(&value.to_le_bytes());
    }

    pub(crate) fn f64(&mut self, value: f64) {
        self.u64(value.to_bits());
    }

    pub(crate) fn vec2(&mut self, value: Vec2) {
        self.f64(value.x);
        self.f64(value.y);
    }

    pub(crate) fn count(&mut self, count: usize) {
        self.u64(count as u64);
    }

    pub(crate) fn bytes(&mut self, bytes: &[u8]) {
        self.count(bytes.len());
        self.bytes.extend_from_slice(bytes);
    }

    /// What was written, filled up with zeros to whole rows of a checksum over more than that.
    pub(crate) fn unsealed(mut self) -> Vec<u8> {
        self.bytes.resize(self.bytes.len().next_multiple_of(ROW), 0);
        self.bytes
    }

    /// Ends with a checksum over everything before it.
    pub(crate) fn seal(mut self) -> Vec<u8> {
        let sum = checksum(&self.bytes);
        self.u64(sum);
        self.bytes
    }
}

/// Reads numbers from bytes; every read beyond the end is an error that names what was being read.
pub(crate) struct Reader<'a> {
    all: usize,
    rest: &'a [u8],
    what: &'static str,
}

impl<'a> Reader<'a> {
    /// Checks magic, version and checksum.
    pub(crate) fn open(
        bytes: &'a [u8],
        magic: &[u8; 4],
        version: u32,
        what: &'static str,
    ) -> Result<Reader<'a>, Error> {
        let (body, sum) = bytes
            .split_last_chunk::<SUM_BYTES>()
            .ok_or_else(|| Error::Snapshot(format!("{what} of {} bytes is cut short", bytes.len())))?;
        let mut reader = Reader {
            all: body.len(),
            rest: body,
            what,
        };
        if reader.take(4)? != magic {
            return Err(Error::Snapshot(format!(
                "these bytes are not a {what}: they do not begin with {magic:?}"
            )));
        }
        let found = reader.u32()?;
        if found != version {
            return Err(Error::Snapshot(format!(
                "{what} has version {found}, this build reads version {version}"
            )));
        }
        let sum = u64::from_le_bytes(*sum);
        let computed = checksum(body);
        if computed != sum {
            return Err(Error::Snapshot(format!(
                "{what} is damaged: its checksum is {sum:016x}, its bytes give {computed:016x}"
            )));
        }
        Ok(reader)
    }

    fn take(&mut self, count: usize) -> Result<&'a [u8], Error> {
        let (head, rest) = self.rest.split_at_checked(count).ok_or_else(|| {
            Error::Snapshot(format!(
                "{} is cut short: {count} bytes wanted, {} left",
                self.what,
                self.rest.len()
            ))
        })?;
        self.rest = rest;
        Ok(head)
    }

    pub(crate) fn u8(&mut self) -> Result<u8, Error> {
        Ok(self.take(1)?[0])
    }

    pub(crate) fn u32(&mut self) -> Result<u32, Error> {
        Ok(u32::from_le_bytes(self.array()?))
    }

    pub(crate) fn u64(&mut self) -> Result<u64, Error> {
        Ok(u64::from_le_bytes(self.array()?))
    }

    pub(crate) fn f64(&mut self) -> Result<f64, Error> {
        Ok(f64::from_bits(self.u64()?))
    }

    pub(crate) fn vec2(&mut self) -> Result<Vec2, Error> {
        Ok(Vec2::new(self.f64()?, self.f64()?))
    }

    /// A number of items of at least `size` bytes each: never more than the bytes that are left can hold.
    pub(crate) fn count(&mut self, size: usize) -> Result<usize, Error> {
        let count = self.u64()?;
        let most = self.rest.len() / size;
        usize::try_from(count)
            .ok()
            .filter(|&count| count <= most)
            .ok_or_else(|| {
                Error::Snapshot(format!(
                    "{} claims {count} items where at most {most} fit",
                    self.what
                ))
            })
    }

    /// The zeros that fill a row of the checksum up.
    pub(crate) fn filling(&mut self) -> Result<(), Error> {
        let read = self.all - self.rest.len();
        let filling = self.take(read.next_multiple_of(ROW) - read)?;
        if filling.iter().all(|&byte| byte == 0) {
            return Ok(());
        }
        Err(Error::Snapshot(format!(
            "{} has {filling:?} where zeros fill a row up",
            self.what
        )))
    }

    /// So many rows of words.
    pub(crate) fn columns<const WORDS: usize>(
        &mut self,
        count: usize,
    ) -> Result<impl Iterator<Item = [u64; WORDS]> + 'a, Error> {
        let bytes = count.saturating_mul(WORDS * 8);
        let (words, _) = self.take(bytes)?.as_chunks::<8>();
        Ok(words
            .chunks_exact(WORDS)
            .map(|row| std::array::from_fn(|column| u64::from_le_bytes(row[column]))))
    }

    pub(crate) fn bytes(&mut self) -> Result<&'a [u8], Error> {
        let count = self.count(1)?;
        self.take(count)
    }

    pub(crate) fn end(&self) -> Result<(), Error> {
        if self.rest.is_empty() {
            return Ok(());
        }
        Err(Error::Snapshot(format!(
            "{} has {} bytes too many",
            self.what,
            self.rest.len()
        )))
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], Error> {
        let (head, rest) = self.rest.split_first_chunk::<N>().ok_or_else(|| {
            Error::Snapshot(format!(
                "{} is cut short: {N} bytes wanted, {} left",
                self.what,
                self.rest.len()
            ))
        })?;
        self.rest = rest;
        Ok(*head)
    }
}

#[cfg(test)]
mod tests;
