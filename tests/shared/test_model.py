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


def test_what_a_scene_does_not_use_costs_nothing():
    assert kg.plan(scene()).integrator == "euler"
    assert kg.plan(scene()).broadphase == "brute"
    assert kg.plan(scene()).substeps == 1


def test_forces_choose_the_integrator():
    assert kg.plan(scene(forces=[kg.Gravity(0, -10)])).integrator == "verlet"
    assert kg.plan(scene(forces=[kg.Spring(0, 0, 1)])).integrator == "verlet"
    assert kg.plan(scene(forces=[kg.Drag(1)])).integrator == "symplectic_euler"


def test_many_balls_or_balls_to_come_get_a_tree():
    assert kg.plan(kg.scenes.gas(n=100)).broadphase == "loose_quadtree"
    spawning = scene(limits=kg.InputLimits(spawn=kg.SpawnLimits()))
    assert kg.plan(spawning).broadphase == "loose_quadtree"


def test_fast_balls_get_substeps_so_that_none_passes_through_another():
    fast = kg.Balls(position=[(5, 5), (15, 5)], velocity=[(200, 0), (0, 0)], radius=0.5)
    planned = kg.plan(scene(balls=fast))
    assert planned.substeps > 1
    stepped = kg.World(scene(balls=fast, walls=False), planned)
    stepped.run(30)
    assert stepped.collisions == 1


def test_a_fall_through_the_box_counts_as_speed():
    small = kg.Balls(position=[(5, 999)], radius=0.1)
    assert kg.plan(scene(balls=small, box=(0, 0, 20, 1000), forces=[kg.Gravity(0, -10)])).substeps > 10


def test_what_players_may_do_counts_as_speed():
    slow = scene(players=kg.PlayerRules(radius=1, mass=1, spawn_points=[(3, 8)]), forces=[kg.ThrustForce()])
    fast = slow.model_copy(update={"limits": kg.InputLimits(thrust=5000.0)})
    assert kg.plan(slow).substeps == 1
    assert kg.plan(fast).substeps > 1
    kicked = scene(limits=kg.InputLimits(kick=300.0))
    assert kg.plan(kicked).substeps > 1


def test_pins_win_and_are_said():
    pinned = scene(model=kg.ModelPins(integrator="rk4", broadphase="quadtree", substeps=4, smallest_node=0.5))
    model = kg.plan(pinned)
    assert (model.integrator, model.broadphase, model.substeps) == ("rk4", "quadtree", 4)
    assert model.smallest_node == 0.5
    assert sum("pinned by the scene" in reason for reason in model.reasons) == 4


def test_a_pin_that_is_not_registered_is_refused():
    with pytest.raises(kg.errors.ModelError, match="integrator = 'euclid'"):
        kg.plan(scene(model=kg.ModelPins(integrator="euclid")))


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


def test_an_exact_plan_pairs_with_what_exact_contacts_need():
    if "event" not in _core.CONTACTS:
        pytest.skip("event contacts are not registered")
    for forces in ([], [kg.Gravity(0, -10)], [kg.Attractor(0, 0, 1, 1)], [kg.Drag(1)]):
        world = kg.World(scene(accuracy="exact", forces=forces))
        world.run(10)
        assert world.model.substeps == 1


def test_a_pinned_treatment_of_contacts_ends_the_demand():
    assert kg.plan(scene(accuracy="exact", model=kg.ModelPins(contacts="overlap"))).contacts == "overlap"


def test_a_budget_is_not_said_to_be_met():
    assert any("not checked" in reason for reason in kg.plan(scene(budget_ms=1.0)).reasons)
