"""One tree of errors, as its docstring draws it, and the core raises from it."""

import re

import numpy as np
import pytest

import kuglice as kg
from kuglice import _core, errors


def tree() -> set[type]:
    return {value for value in vars(errors).values() if isinstance(value, type)}


def test_every_error_descends_from_one_root():
    assert all(issubclass(error, kg.KugliceError) for error in tree())


def test_the_docstring_draws_exactly_the_errors_there_are():
    drawn = re.findall(r"[├└]── (\w+)", errors.__doc__)
    assert sorted(["KugliceError", *drawn]) == sorted(error.__name__ for error in tree())
    assert sorted(errors.__all__) == sorted(error.__name__ for error in tree())


def test_the_drawn_depth_is_the_depth_in_the_tree():
    for line in errors.__doc__.splitlines():
        found = re.match(r"([ │]*)[├└]── (\w+)", line)
        if found:
            ours = [base for base in getattr(errors, found[2]).__mro__ if base in tree()]
            assert len(ours) - 2 == len(found[1]) // 4, line


def test_errors_of_values_are_value_errors():
    assert issubclass(errors.SceneError, ValueError)
    assert issubclass(errors.ModelError, ValueError)
    assert issubclass(errors.InputError, ValueError)


def test_the_core_raises_errors_of_the_tree():
    with pytest.raises(errors.ModelError, match="euclid"):
        _core.Model(integrator="euclid", contacts="overlap", broadphase="brute")
    scene = kg.scenes.cradle()
    with pytest.raises(errors.SnapshotError):
        kg.World.restore(scene, b"no snapshot")
    world = kg.World(scene)
    with world.view(), pytest.raises(errors.LentError):
        world.step()
    with pytest.raises(errors.SceneError):
        _core.Rules(box=(0, 0, np.nan, 1), walls=True, restitution=1.0, tick_rate=60.0, forces=[])
