"""Input records of every kind, with numbers of every sort, as the step reads them."""

from __future__ import annotations

from hypothesis import strategies as st

from kuglice import _core
from kuglice.inputs.record import NUMBERS, RECORD

__all__ = ["some_records"]

numbers = (
    st.floats(allow_nan=False)
    | st.floats(width=32, allow_nan=False)
    | st.floats(width=16, allow_nan=False)
    | st.sampled_from([0.0, -0.0, 1.0, 65504.0, 65505.0, 2.0**-24, 2.0**-25, 2.0**-149, 5e-324, 2.0**1023])
)
balls = st.integers(0, _core.NO_BALL - 1)


@st.composite
def one_record(draw: st.DrawFn) -> bytes:
    kind = draw(st.sampled_from(_core.INPUT_KINDS))
    ball = {"remove": balls, "kick": st.just(_core.NO_BALL) | balls}.get(kind, st.just(_core.NO_BALL))
    used = [draw(numbers) for _ in NUMBERS[kind]]
    return RECORD.pack(
        _core.INPUT_KINDS.index(kind),
        draw(st.integers(0, 3) | st.integers(0, 2**32 - 1)),
        draw(st.integers(0, 300) | st.integers(0, 2**64 - 1)),
        draw(ball),
        *used,
        *[0.0] * (6 - len(used)),
    )


def some_records() -> st.SearchStrategy[bytes]:
    """None, a few, or more than a message counts in the head."""
    return st.just(b"") | st.lists(one_record(), max_size=9).map(b"".join)
