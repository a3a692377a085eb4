import numpy as np
import pytest

from kuglice.errors import LimitError
from kuglice_client.correction import Correction

IDS = np.array([3, 5], np.uint64)
RADIUS = np.array([1.0, 2.0])
OLD = np.array([[0.0, 0.0], [10.0, 0.0]])
NEW = np.array([[1.0, 0.0], [10.0, 0.0]])


def test_a_moved_ball_stays_where_it_was_drawn_and_glides_within_a_tenth_of_a_second():
    correction = Correction()
    correction.frame(0.0, 2)
    correction.moved(IDS, OLD, IDS, NEW, RADIUS)
    assert correction.drawn(IDS, NEW) == pytest.approx(OLD)
    correction.frame(0.1, 2)
    assert correction.drawn(IDS, NEW)[0, 0] == pytest.approx(1 - np.exp(-1))
    correction.frame(2.0, 2)
    assert correction.drawn(IDS, NEW) == pytest.approx(NEW)


def test_a_ball_moved_beyond_the_limit_jumps_and_counts():
    correction = Correction(limit=0.5)
    correction.moved(IDS, OLD, IDS, NEW, RADIUS)
    assert correction.drawn(IDS, NEW) == pytest.approx(NEW)
    assert (correction.snaps, correction.worst) == (1, 1.0)
    correction.frame(0.0, 2)
    assert correction.mean == 0.5


def test_a_time_that_is_not_above_zero_is_an_error():
    with pytest.raises(LimitError, match="seconds"):
        Correction(seconds=0)
