use super::*;

/// Bytes whose first row is filled up with `filling`, under a checksum that is right.
fn opened(filling: u8) -> Result<(), Error> {
    let mut writer = Writer::new(b"TEST", 1);
    writer.u32(7);
    for _ in 0..4 {
        writer.u8(filling);
    }
    writer.u64(8);
    let bytes = writer.seal();
    let mut reader = Reader::open(&bytes, b"TEST", 1, "test")?;
    assert_eq!(reader.u32()?, 7);
    reader.filling()?;
    assert_eq!(reader.u64()?, 8);
    // Half a row is left, and nothing fills it up.
    reader.filling()
}

#[test]
fn what_fills_a_row_up_is_zeros() {
    let message = |filling| opened(filling).unwrap_err().to_string();
    assert_eq!(message(3), "test has [3, 3, 3, 3] where zeros fill a row up");
    assert_eq!(message(0), "test is cut short: 8 bytes wanted, 0 left");
}
