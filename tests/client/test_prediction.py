"""Own inputs act at once; whatever was guessed, the prediction ends in the server's bits."""

from __future__ import annotations

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from kuglice.inputs import Kick, Thrust
from kuglice_client.prediction import Prediction

ME, OTHER = 1, 2


def push(sequence: int, x: float = 20.0, client: int = ME) -> Thrust:
    return Thrust(client=client, sequence=sequence, x=x, y=3.0)


def confirm(prediction, confirmed, entry) -> bool:
    """Whether it was predicted again."""
    confirmed.step(entry.inputs)
    prediction.confirm(entry)
    again = prediction.reconcile(confirmed)
    prediction.switched(confirmed)
    return again


def test_an_own_input_acts_in_the_very_next_predicted_tick(authority):
    prediction = Prediction(authority.world, limit=30)
    without = authority.world.clone()
    prediction.act(push(1), prediction.world.tick)
    prediction.step()
    without.step()
    assert prediction.world.velocity.tolist() != without.velocity.tolist()


def test_what_was_guessed_right_is_not_computed_again(authority):
    confirmed = authority.world.clone()
    prediction = Prediction(confirmed, limit=30)
    for number in range(10):
        given = push(number, x=float(number))
        prediction.act(given, prediction.world.tick)
        prediction.step()
        entry = authority.step([given])
        assert not confirm(prediction, confirmed, entry)
        assert prediction.world.snapshot() == authority.world.snapshot()
    assert (prediction.rollbacks, prediction.ticks_rerun) == (0, 0)


def test_anothers_input_rolls_back_and_runs_forward(authority):
    confirmed = authority.world.clone()
    prediction = Prediction(confirmed, limit=30)
    for _ in range(4):
        prediction.step()
    assert confirm(prediction, confirmed, authority.step([push(1, client=OTHER)]))
    assert (prediction.rollbacks, prediction.deepest_rollback, prediction.ticks_rerun) == (1, 3, 3)
    for _ in range(3):
        # What the other holds goes on: from here on the guess is right.
        assert not confirm(prediction, confirmed, authority.step())
    assert prediction.world.snapshot() == authority.world.snapshot()
    assert prediction.previous.tick == prediction.world.tick - 1


def test_an_input_that_came_late_acts_where_the_server_says(authority):
    confirmed = authority.world.clone()
    prediction = Prediction(confirmed, limit=30)
    given, planned = Kick(client=ME, sequence=1, vx=1.0, vy=0.0), prediction.world.tick
    prediction.act(given, planned)
    for _ in range(5):
        prediction.step()
    prediction.settle(given, planned, planned + 2)
    for number in range(5):
        confirm(prediction, confirmed, authority.step([given] if number == 2 else []))
    assert prediction.rollbacks == 1
    assert prediction.world.snapshot() == authority.world.snapshot()


def test_a_refused_input_is_taken_back(authority):
    confirmed = authority.world.clone()
    prediction = Prediction(confirmed, limit=30)
    given, planned = Kick(client=ME, sequence=1, vx=1.0, vy=0.0), prediction.world.tick
    prediction.act(given, planned)
    for _ in range(3):
        prediction.step()
    prediction.settle(given, planned, None)
    for _ in range(3):
        confirm(prediction, confirmed, authority.step())
    assert prediction.world.snapshot() == authority.world.snapshot()


@pytest.mark.parametrize("later", [None, 2])
def test_what_the_server_says_counts_at_once_not_only_when_the_tick_is_confirmed(authority, later):
    confirmed = authority.world.clone()
    prediction = Prediction(confirmed, limit=30)
    given, planned = Kick(client=ME, sequence=1, vx=1.0, vy=0.0), prediction.world.tick
    prediction.act(given, planned)
    for _ in range(3):
        prediction.step()
    prediction.settle(given, planned, None if later is None else planned + later)
    assert prediction.reconcile(confirmed)
    expected = confirmed.clone()
    for number in range(3):
        expected.step([given] if number == later else [])
    assert prediction.world.snapshot() == expected.snapshot()


def test_an_input_without_an_answer_is_expected_in_the_next_tick_again_and_again(authority):
    confirmed = authority.world.clone()
    prediction = Prediction(confirmed, limit=30)
    given, planned = Kick(client=ME, sequence=1, vx=1.0, vy=0.0), prediction.world.tick
    prediction.act(given, planned)
    for _ in range(6):
        prediction.step()
    for _ in range(3):
        confirm(prediction, confirmed, authority.step())
    kicked = authority.world.clone()
    kicked.step([given])
    kicked.run(2)
    assert prediction.world.snapshot() == kicked.snapshot()


def test_a_stream_that_overtakes_leads(authority):
    confirmed = authority.world.clone()
    prediction = Prediction(confirmed, limit=30)
    for number in range(20):
        confirm(prediction, confirmed, authority.step([push(number, client=OTHER)]))
        assert prediction.world.snapshot() == authority.world.snapshot()
    assert prediction.rollbacks == 0


def test_running_forward_again_may_take_several_turns_and_until_then_what_was_drawn_stays(authority):
    confirmed = authority.world.clone()
    prediction = Prediction(confirmed, limit=30)
    for _ in range(8):
        prediction.step()
    ids, drawn = prediction.drawn(0.3)
    confirmed.step((entry := authority.step([push(1, client=OTHER)])).inputs)
    prediction.confirm(entry)
    assert prediction.reconcile(confirmed, lambda: False)
    turns = 1
    while prediction.switched(confirmed) is None:
        assert prediction.drawn(0.3)[1].tolist() == drawn.tolist()
        assert (prediction.shown[1].tick, prediction.world.tick) == (
            confirmed.tick + 7,
            confirmed.tick + turns,
        )
        prediction.step()
        turns += 1
    assert (turns, prediction.rollbacks, prediction.ticks_rerun) == (7, 1, 7)
    assert prediction.drawn(0.3)[0].tolist() == ids.tolist()
    assert prediction.drawn(0.3)[1].tolist() != drawn.tolist()
    assert prediction.previous.tick == prediction.world.tick - 1
    for _ in range(7):
        assert not confirm(prediction, confirmed, authority.step())
    assert prediction.world.snapshot() == authority.world.snapshot()


def test_who_never_has_time_to_run_forward_again_still_draws_nothing_older_than_the_stream(authority):
    confirmed = authority.world.clone()
    prediction = Prediction(confirmed, limit=30)
    for _ in range(8):
        prediction.step()
    for number in range(40):
        entry = authority.step([push(number, client=OTHER, x=float(number))])
        confirmed.step(entry.inputs)
        prediction.confirm(entry)
        prediction.reconcile(confirmed, lambda: False)
        prediction.switched(confirmed)
        assert prediction.shown[1].tick >= confirmed.tick


def test_no_more_is_predicted_than_may_be(authority):
    prediction = Prediction(authority.world, limit=5)
    steps = 0
    while prediction.may_step(authority.world):
        prediction.step()
        steps += 1
    assert (steps, prediction.held_back) == (5, 1)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.lists(
        st.tuples(
            st.integers(0, 3),  # ticks predicted before this tick is confirmed
            st.sampled_from(["mine", "none"]),
            st.integers(0, 4),  # ticks that my input comes late
            st.booleans(),  # the other one acts
            st.booleans(),  # I hear of the outcome before the tick
        ),
        max_size=40,
    )
)
def test_however_it_went_the_prediction_ends_in_the_servers_bits(authority, story):
    confirmed = authority.world.clone()
    prediction = Prediction(confirmed, limit=12)
    due: dict[int, list] = {}
    sequence = 10
    for ahead, mine, late, other, told in story:
        for _ in range(ahead):
            if prediction.may_step(confirmed):
                prediction.step()
        if mine == "mine":
            sequence += 1
            planned = prediction.world.tick
            given = push(sequence, x=float(sequence))
            prediction.act(given, planned)
            actual = max(planned, authority.world.tick) + late
            due.setdefault(actual, []).append(given)
            if told:
                prediction.settle(given, planned, actual)
        inputs = due.pop(authority.world.tick, [])
        if other:
            sequence += 1
            inputs.append(push(sequence, client=OTHER))
        confirm(prediction, confirmed, authority.step(inputs))
        assert confirmed.snapshot() == authority.world.snapshot()
        assert prediction.world.tick >= confirmed.tick
    for _ in range(30):
        confirm(prediction, confirmed, authority.step(due.pop(authority.world.tick, [])))
    assert prediction.world.snapshot() == authority.world.snapshot()
