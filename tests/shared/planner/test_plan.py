"""What steers the planner, and what it says."""

from __future__ import annotations

import itertools
import re

import pytest

import kuglice as kg
from kuglice.errors import ModelError, PlanError, SceneError
from kuglice.planner import expect


def gas(**changes) -> kg.Scene:
    return kg.scenes.gas(n=200).model_copy(update=changes)


def pinned(scene: kg.Scene, **pins) -> kg.Scene:
    return scene.model_copy(update={"model": kg.ModelPins(**pins)})


class TestAccuracy:
    def test_more_accuracy_is_never_cheaper(self):
        costs = [
            expect(gas(), kg.plan(gas(accuracy=accuracy))).cost_ms
            for accuracy in ("visual", "faithful", "exact")
        ]
        assert costs == sorted(costs)

    def test_exact_takes_collisions_at_their_times(self):
        assert kg.plan(gas(accuracy="exact")).contacts == "event"

    def test_a_number_is_an_error_in_radii(self):
        scene = gas(accuracy=0.02)
        assert expect(scene, kg.plan(scene)).error <= 0.02

    def test_forces_that_vary_are_cut_finer_the_more_is_demanded(self):
        orbits = [kg.scenes.orbit().model_copy(update={"accuracy": each}) for each in (1e-2, 1e-4, 1e-6)]
        substeps = [kg.plan(scene).substeps for scene in orbits]
        assert substeps == sorted(substeps)
        assert substeps[-1] > substeps[0]

    def test_uniform_gravity_needs_no_more_than_verlet(self):
        scene = gas(forces=(kg.Gravity(0.0, -10.0),), accuracy="exact")
        model = kg.plan(scene)
        assert (model.integrator, model.substeps) == ("verlet", 1)

    def test_what_nothing_meets_is_an_error_that_says_what_comes_closest(self):
        scene = kg.scenes.orbit().model_copy(update={"accuracy": 1e-15})
        with pytest.raises(
            PlanError, match=r"accuracy of 1e-15 radii: no registered model meets it; .* closest"
        ):
            kg.plan(scene)


class TestCrowds:
    def test_elastic_balls_that_weigh_on_each_other_get_event_contacts_if_faithful(self):
        assert kg.plan(kg.scenes.rain().model_copy(update={"accuracy": "faithful"})).contacts == "event"

    def test_what_a_visual_crowd_does_is_said(self):
        reasons = " ".join(kg.plan(kg.scenes.rain()).reasons)
        assert "sink" in reasons
        assert '"faithful"' in reasons

    def test_what_a_pile_costs_is_said_beside_what_the_start_does(self):
        scene = kg.scenes.pegs()
        least, most = expect(scene, kg.plan(scene)).pile_ms
        assert 0 < least < most
        assert any(f"{most:.2g} ms two deep" in reason for reason in kg.plan(scene).reasons)


class TestBudget:
    def test_is_kept(self):
        scene = gas(budget_ms=1000.0)
        assert expect(scene, kg.plan(scene)).cost_ms <= 1000.0

    def test_too_small_a_one_is_an_error_that_says_what_comes_closest(self):
        scene = gas(accuracy="exact")
        visual, exact = (expect(scene, kg.plan(gas(accuracy=each))).cost_ms for each in ("visual", "exact"))
        between = (visual * exact) ** 0.5
        with pytest.raises(
            PlanError, match=r"within a budget of .* ms .* cheapest .* keeps the budget with an error"
        ):
            kg.plan(gas(accuracy="exact", budget_ms=between))

    def test_one_that_nothing_keeps_is_said_to_be_so(self):
        with pytest.raises(PlanError, match="nothing keeps the budget"):
            kg.plan(gas(budget_ms=1e-9))


class TestPins:
    @pytest.mark.parametrize(
        ("part", "value"),
        [("integrator", "rk4"), ("contacts", "overlap"), ("broadphase", "quadtree"), ("substeps", 3)],
    )
    def test_win(self, part, value):
        model = kg.plan(pinned(gas(accuracy="exact"), **{part: value}))
        assert getattr(model, part) == value
        assert f"{part} {value}: pinned by the scene." in model.reasons

    def test_that_miss_the_accuracy_are_told_so(self):
        model = kg.plan(pinned(gas(accuracy="exact"), contacts="overlap", substeps=1))
        assert any("miss the accuracy of 1e-06 radii" in reason for reason in model.reasons)

    def test_that_miss_the_budget_are_told_so(self):
        model = kg.plan(pinned(gas(budget_ms=1e-9), contacts="overlap"))
        assert any("miss the budget" in reason for reason in model.reasons)

    def test_that_do_not_go_together_are_an_error(self):
        with pytest.raises(ModelError, match="cannot be paired"):
            kg.plan(pinned(gas(), integrator="rk4", contacts="event"))

    def test_of_a_name_that_is_none_are_an_error(self):
        with pytest.raises(SceneError, match="one of"):
            kg.plan(pinned(gas(), contacts="sticky"))


class TestBroadphase:
    def test_few_balls_need_no_tree(self):
        assert kg.plan(kg.scenes.cradle()).broadphase == "brute"

    def test_many_do(self):
        assert kg.plan(kg.scenes.gas(n=3000)).broadphase == "loose_quadtree"

    def test_few_that_may_become_many_do(self):
        scene = kg.scenes.cradle().model_copy(
            update={"limits": kg.InputLimits(spawn=kg.SpawnLimits(max_radius=1, max_mass=1, max_speed=1))}
        )
        assert kg.plan(scene).broadphase == "loose_quadtree"


class TestReasons:
    @pytest.mark.parametrize("name", kg.scenes.TABLE)
    def test_every_built_in_scene_has_one_for_each_part(self, name):
        model = kg.plan(kg.scenes.TABLE[name]())
        for part in ("integrator", "contacts", "substeps", "broadphase", "expected error", "expected cost"):
            assert any(reason.startswith(part) and reason.endswith(".") for reason in model.reasons), part

    def test_name_the_machine_of_the_measurements(self):
        assert any(
            "cores" in reason for reason in kg.plan(gas()).reasons if reason.startswith("expected cost")
        )

    def test_an_empty_scene_has_a_model(self):
        assert kg.plan(kg.Scene(box=(0, 0, 1, 1))).substeps == 1

    def test_a_scene_of_pegs_alone_has_a_model(self):
        scene = kg.Scene(box=(0, 0, 9, 9), balls=kg.Balls(position=[(3, 3)], radius=1.0, mass=float("inf")))
        assert kg.plan(scene).substeps == 1

    @pytest.mark.parametrize("contacts", [None, "overlap", "event"])
    @pytest.mark.parametrize("balls", [0, 1, 2])
    def test_one_ball_is_one_ball(self, balls, contacts):
        """Whatever else is said of it: for a scene that steps exactly, one that cannot, one that grows."""
        here = kg.Balls(position=[(3, 3), (8, 3)], radius=1.0, velocity=[(5, 0), (5, 0)])[:balls]
        spawn = kg.SpawnLimits(max_radius=1, max_mass=1, max_speed=1)
        for accuracy, restitution, forces, limits in itertools.product(
            ("visual", "exact", 1e-9),
            (1.0, 0.5),
            ((), (kg.Gravity(0.0, -10.0),), (kg.Spring(0.0, 0.0, stiffness=1.0), kg.Drag(1.0))),
            (kg.InputLimits(), kg.InputLimits(spawn=spawn)),
        ):
            scene = kg.Scene(
                box=(0, 0, 20, 20),
                balls=here,
                restitution=restitution,
                forces=forces,
                accuracy=accuracy,
                model=kg.ModelPins(contacts=contacts),
                limits=limits,
            )
            try:
                said = " ".join(kg.plan(scene).reasons)
            except (PlanError, ModelError) as error:
                said = str(error)
            assert not re.search(r"\b1 (balls|substeps)\b", said)
