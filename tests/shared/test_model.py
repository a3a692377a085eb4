"""Model and plan: registered names only, pins win, and every choice has a reason."""

import pytest

import kuglice as kg
from kuglice import _core
from kuglice.model import Model


@pytest.mark.parametrize("integrator", _core.INTEGRATORS)
@pytest.mark.parametrize("broadphase", _core.BROADPHASES)
def test_every_registered_choice_makes_a_model_that_travels(integrator, broadphase):
    model = kg.Model(integrator=integrator, broadphase=broadphase, substeps=3, reasons=("because",))
    assert Model.from_message(model.to_message()) == model
    kg.World(kg.scenes.cradle(), model).run(3)


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"integrator": "euclid"}, f"integrator = 'euclid': must be one of {', '.join(_core.INTEGRATORS)}"),
        ({"contacts": "none"}, "contacts = 'none': must be one of overlap"),
        ({"broadphase": "tree"}, "broadphase = 'tree': must be one of brute"),
        ({"substeps": 0}, "substeps = 0"),
        ({"substeps": 10**6}, "substeps"),
        ({"smallest_node": -1}, "smallest_node = -1"),
        ({"integrater": "rk4"}, "integrater = 'rk4': no such key; did you mean integrator"),
    ],
)
def test_a_wrong_model_is_refused_by_name(given, told):
    with pytest.raises(kg.errors.ModelError, match=told):
        kg.Model(**given)
    with pytest.raises(kg.errors.ModelError, match=told):
        Model.from_message(given)


@pytest.mark.parametrize("name", kg.scenes.TABLE)
def test_every_choice_of_a_plan_has_a_reason(name):
    model = kg.plan(kg.scenes.TABLE[name]())
    for part in ("integrator", "contacts", "substeps", "broadphase"):
        (reason,) = [reason for reason in model.reasons if reason.startswith(f"{part} ")]
        assert str(getattr(model, part)) in reason
        assert reason.endswith(".")


def scene(**given) -> kg.Scene:
    balls = kg.Balls(position=[(5, 5), (10, 5)], velocity=(1, 0), radius=1)
    return kg.Scene(**{"box": (0, 0, 20, 10), "balls": balls, **given})


def test_many_balls_or_balls_to_come_get_a_tree():
    assert kg.plan(kg.scenes.gas(n=100)).broadphase == "loose_quadtree"
    spawning = scene(limits=kg.InputLimits(spawn=kg.SpawnLimits()))
    assert kg.plan(spawning).broadphase == "loose_quadtree"


def test_pins_win_and_are_said():
    pinned = scene(model=kg.ModelPins(integrator="rk4", broadphase="quadtree", substeps=4, smallest_node=0.5))
    model = kg.plan(pinned)
    assert (model.integrator, model.broadphase, model.substeps) == ("rk4", "quadtree", 4)
    assert model.smallest_node == 0.5
    assert sum("pinned by the scene" in reason for reason in model.reasons) == 4


def test_a_pin_that_is_not_registered_is_refused():
    with pytest.raises(kg.errors.SceneError, match="integrator = 'euclid': must be one of euler"):
        kg.ModelPins(integrator="euclid")


@pytest.mark.parametrize(
    ("accuracy", "wanted"), [("faithful", "backtrack"), ("exact", "event"), (1e-9, "event")]
)
def test_a_demand_is_met_or_refused_never_forgotten(accuracy, wanted):
    demanding = scene(accuracy=accuracy)
    if wanted in _core.CONTACTS:
        assert kg.plan(demanding).contacts == wanted
    else:
        with pytest.raises(kg.errors.PlanError, match=f"needs contacts '{wanted}'"):
            kg.plan(demanding)


def test_a_pinned_treatment_of_contacts_ends_the_demand():
    assert kg.plan(scene(accuracy="exact", model=kg.ModelPins(contacts="overlap"))).contacts == "overlap"
