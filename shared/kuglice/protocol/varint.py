"""Whole numbers in as few bytes as they need (LEB128), and a reader that never reads past the end."""

from __future__ import annotations

from kuglice.errors import ProtocolError

__all__ = ["Reader", "write_signed", "write_varint"]

LONGEST = 10
"""Bytes of a varint: enough for 65 bits, the difference of two u64 included."""


def write_varint(out: bytearray, value: int) -> None:
    """Append `value`, 0 or above: seven bits per byte, the lowest first."""
    while value > 0x7F:
        out.append(value & 0x7F | 0x80)
        value >>= 7
    out.append(value)


def write_signed(out: bytearray, value: int) -> None:
    """Append a number of either sign; those near 0 are short (zigzag)."""
    write_varint(out, value * 2 if value >= 0 else -value * 2 - 1)


class Reader:
    """Takes bytes off the front of `data`; raises ProtocolError where there are too few."""

    def __init__(self, data: bytes) -> None:
        self._data = data
        self._at = 0

    @property
    def left(self) -> int:
        """Bytes that are not read yet."""
        return len(self._data) - self._at

    def take(self, count: int) -> bytes:
        """The next `count` bytes."""
        if count > self.left:
            raise ProtocolError(f"byte {self._at}: {count} more wanted, {self.left} left")
        self._at += count
        return self._data[self._at - count : self._at]

    def byte(self) -> int:
        """The next byte."""
        return self.take(1)[0]

    def varint(self, *, below: int = 1 << 64) -> int:
        """What write_varint wrote, which must be less than `below`."""
        value = 0
        for place in range(LONGEST):
            byte = self.byte()
            value |= (byte & 0x7F) << (7 * place)
            if byte < 0x80:
                if value >= below:
                    raise ProtocolError(f"byte {self._at}: {value}, must be less than {below}")
                return value
        raise ProtocolError(f"byte {self._at}: a number of more than {LONGEST} bytes")

    def signed(self) -> int:
        """What write_signed wrote."""
        value = self.varint(below=1 << 66)
        return value >> 1 if value % 2 == 0 else -(value + 1 >> 1)
