"""Every input has a defined answer: late, early, twice, too many, not allowed, unreadable, foreign."""

from __future__ import annotations

import struct
from collections import Counter

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kuglice import World
from kuglice.inputs import Attract, Input, Join, Kick, Leave, Remove, Spawn, Thrust, pack
from kuglice.protocol import PROTOCOL_VERSION, Ack, ClientInputs, Keys, SentInput, encode
from kuglice.protocol.compact import RecordWriter
from kuglice.protocol.varint import write_signed, write_varint
from kuglice_server.counters import Counters
from kuglice_server.intake import MESSAGES_PER_TICK, PROMISES, Intake
from kuglice_server.players import Players
from server.small_arena import small_arena

EPOCH = 77
HORIZON = 50
REPEAT = 6
KEYS = Keys("small")
SESSION = "s1"


class Desk:
    """An intake with one client, `ana`, and the world that it is for."""

    def __init__(self, per_tick: int = 4) -> None:
        scene = small_arena(per_tick=per_tick)
        self.world = World(scene)
        self.counters = Counters()
        self.players = players = Players(scene, grace=300, counters=self.counters)
        self.told: list[Ack] = []
        self.intake = Intake(scene, players, epoch=EPOCH, horizon=HORIZON, counters=self.counters)
        players.arrive("ana", SESSION)
        self.world.step(players.authored(self.world))
        self.player = players.find("ana", SESSION)

    def send(
        self, *wanted: tuple[int, int, Input], name: str = "ana", epoch: int = EPOCH, heard: int | None = None
    ) -> list:
        """(sequence, tick, input) each, in one message; the outcomes that are news."""
        sent = [
            SentInput(tick, one.model_copy(update={"sequence": sequence})) for sequence, tick, one in wanted
        ]
        heard = self.world.tick if heard is None else heard
        return self.raw(encode(ClientInputs(epoch=epoch, heard=heard, inputs=sent)), name=name)

    def raw(self, payload: bytes, name: str = "ana", session: str = SESSION) -> list:
        """What is news afterwards: outcomes that are told, and those that will be when their tick comes."""
        known = [*self.told, *self.player.outcomes.values()]
        self.intake.receive(KEYS.input(name, session), payload, world=self.world)
        news = [ack for ack in self.tell() if ack not in known]
        return news + [ack for ack in self.player.outcomes.values() if ack not in (*known, *news)]

    def tell(self) -> list[Ack]:
        """The outcomes that go with the next tick."""
        acks = self.intake.acks(self.world.tick, repeat=REPEAT)
        self.told += acks
        return acks

    def step(self) -> list[Input]:
        inputs = self.intake.due(self.world.tick)
        self.tell()
        self.world.step(inputs)
        return inputs


@pytest.fixture
def desk():
    return Desk()


def test_in_time_it_acts_in_the_tick_it_asks_for(desk):
    (ack,) = desk.send((1, desk.world.tick + 3, Thrust(x=5, y=0)))
    assert (ack.client, ack.sequence, ack.tick, ack.early, ack.refused) == (1, 1, 4, 3, None)
    assert [desk.step() for _ in range(3)] == [[], [], []]
    assert desk.step() == [Thrust(client=1, sequence=1, x=5, y=0)]
    assert desk.world.held == [(1, "thrust", 5.0, 0.0, 0.0)]


def test_late_it_acts_in_the_next_tick_and_hears_how_late_it_was(desk):
    for _ in range(9):
        desk.step()
    (ack,) = desk.send((1, 4, Thrust(x=5, y=0)))
    assert (ack.tick, ack.early) == (10, -6)
    assert len(desk.step()) == 1
    assert desk.counters["late"] == 1


def test_too_early_is_refused(desk):
    (ack,) = desk.send((1, desk.world.tick + HORIZON + 1, Thrust(x=5, y=0)))
    assert ack.tick is None
    assert f"at most {HORIZON} ticks after" in ack.refused


def test_twice_is_applied_once_and_told_again_only_to_who_has_heard_of_its_tick(desk):
    (first,) = desk.send((1, 2, Kick(vx=1, vy=0)))
    assert desk.send((1, 2, Kick(vx=1, vy=0))) == []
    assert desk.send((1, 9, Kick(vx=1, vy=0))) == []
    assert desk.told == [], "it has not acted yet"
    applied = [desk.step() for _ in range(3)]
    assert desk.told == [first], "the tick in which it acts says so"
    for heard in (0, 1, 2):
        desk.send((1, 2, Kick(vx=1, vy=0)), heard=heard)
        applied += [desk.step() for _ in range(9)]
        assert desk.told == [first], "that tick is on its way to the client, or in the history"
    desk.send((1, 2, Kick(vx=1, vy=0)), heard=3)
    assert desk.told == [first, first]
    applied += [desk.step() for _ in range(9)]
    assert sum(len(inputs) for inputs in applied) == 1
    assert desk.counters["duplicate"] == 6


def test_what_acts_much_later_is_told_at_once_too(desk):
    (ack,) = desk.send((1, desk.world.tick + 40, Thrust(x=5, y=0)))
    assert desk.told == [ack]
    assert ack.tick == 41


def test_a_promise_is_told_less_often_than_a_refusal_which_nothing_else_tells(desk):
    desk.send((1, desk.world.tick + 40, Thrust(x=5, y=0)), (2, 3, Thrust(x=51, y=0)))
    for _ in range(REPEAT + 2):
        desk.step()
    told = Counter(ack.sequence for ack in desk.told)
    # The message that brought them was answered once before the first of these steps, in the same tick.
    assert (told[1], told[2]) == (PROMISES + 1, REPEAT + 1)


def test_a_sequence_number_that_was_skipped_comes_too_late(desk):
    desk.send((5, 2, Thrust(x=1, y=0)))
    (ack,) = desk.send((4, 2, Thrust(x=2, y=0)))
    assert ack.tick is None
    assert "sequence 4: 5 came before" in ack.refused


@pytest.mark.parametrize(
    ("given", "reason"),
    [
        (Thrust(x=51, y=0), "at most 50"),
        (Attract(x=1, y=1, strength=21), "at most 20"),
        (Kick(vx=0, vy=6), "at most 5"),
        (Kick(ball=999, vx=0, vy=1), "no ball 999"),
        (Remove(ball=999), "no ball 999"),
        (Spawn(x=10, y=3.5, radius=0.6, mass=1), "at most 0.5"),
        (Spawn(x=-10, y=3.5, radius=0.4, mass=1), "outside the box"),
        (Join(x=1, y=1, radius=1, mass=1), "only the server decides on that"),
        (Leave(), "only the server decides on that"),
    ],
)
def test_what_the_scene_does_not_allow_is_refused_with_value_and_bound(desk, given, reason):
    (ack,) = desk.send((1, 2, given))
    assert ack.tick is None
    assert reason in ack.refused
    assert all(desk.step() == [] for _ in range(5))


@pytest.mark.parametrize(("number", "reason"), [("nan", "NaN is none"), ("inf", "finite")])
def test_an_input_that_is_none_is_refused_with_its_message(desk, number, reason):
    thrust = SentInput(2, Thrust(sequence=1, x=0.1, y=0.2))
    good = encode(ClientInputs(epoch=EPOCH, heard=1, inputs=[thrust]))
    assert good.endswith(struct.pack("<2d", 0.1, 0.2))
    (ack,) = desk.raw(good[:-8] + struct.pack("<d", float(number)))
    assert (ack.client, ack.sequence, ack.tick) == (1, None, None)
    assert reason in ack.refused
    assert all(desk.step() == [] for _ in range(5))


def test_who_it_is_comes_from_the_key_not_from_what_it_says(desk):
    out = bytearray((*b"i", PROTOCOL_VERSION))
    write_varint(out, EPOCH)
    write_varint(out, 1)
    write_signed(out, 1)
    RecordWriter(out).write(pack([Thrust(client=7, sequence=1, x=1.0, y=0.0)]))
    (ack,) = desk.raw(bytes(out))
    assert ack.client == 1
    desk.step()
    assert [one.client for one in desk.step()] == [1]


def test_garbage_of_someone_who_is_here_is_answered(desk):
    (ack,) = desk.raw(b"\x00garbage")
    assert (ack.client, ack.sequence, ack.tick) == (1, None, None)
    assert "not msgpack" in ack.refused
    assert desk.counters["malformed"] == 1


def test_from_nobody_who_is_here_it_is_counted(desk):
    assert desk.send((1, 2, Thrust(x=1, y=0)), name="eve") == []
    desk.intake.receive("kuglice/small/input/not a name/s1", b"x", world=desk.world)
    desk.intake.receive("kuglice/small/input/ana", b"x", world=desk.world)
    assert desk.counters["foreign"] == 3


def test_from_another_session_of_a_name_that_plays_it_is_counted(desk):
    payload = encode(ClientInputs(epoch=EPOCH, heard=0, inputs=[SentInput(2, Thrust(x=1, y=0, sequence=1))]))
    assert desk.raw(payload, session="s2") == []
    assert desk.counters.all() == {"foreign": 1}
    assert [desk.step() for _ in range(3)] == [[], [], []]


def test_of_another_epoch_it_is_counted(desk):
    assert desk.send((1, 2, Thrust(x=1, y=0)), epoch=EPOCH - 1) == []
    assert desk.counters["other_epoch"] == 1
    assert desk.player.sequence == 0


def test_more_than_the_scene_allows_in_one_tick_waits_for_the_next_in_order(desk):
    desk.send(*[(number, 1, Kick(vx=0.1, vy=0)) for number in range(1, 11)])
    assert [[one.sequence for one in desk.step()] for _ in range(4)] == [
        [1, 2, 3, 4],
        [5, 6, 7, 8],
        [9, 10],
        [],
    ]


def test_a_flood_is_cut_off_and_counted(desk):
    for _ in range(MESSAGES_PER_TICK + 5):
        desk.raw(b"x")
    assert desk.counters["flooded"] == 5
    desk.step()
    desk.raw(b"x")
    assert desk.counters["flooded"] == 5


@given(
    st.lists(st.tuples(st.integers(1, 30), st.integers(0, 40), st.integers(0, 3)), max_size=40),
)
def test_inputs_of_one_client_act_at_most_once_and_in_the_order_of_their_numbers(messages):
    desk = Desk(per_tick=3)
    applied: list[int] = []
    told: dict[int, int | None] = {}
    happened: dict[int, int] = {}
    for sequence, tick, steps in messages:
        for ack in desk.send((sequence, tick, Kick(vx=0.01, vy=0))):
            told.setdefault(ack.sequence, ack.tick)
        for _ in range(steps):
            now = desk.world.tick
            for one in desk.step():
                applied.append(one.sequence)
                happened[one.sequence] = now
    for _ in range(100):
        now = desk.world.tick
        for one in desk.step():
            applied.append(one.sequence)
            happened[one.sequence] = now
    assert applied == sorted(set(applied))
    assert happened == {sequence: tick for sequence, tick in told.items() if tick is not None}


def test_refusals_are_repeated_for_a_few_ticks(desk):
    desk.send((1, 2, Thrust(x=99, y=0)))
    tick = desk.world.tick
    assert [len(desk.intake.acks(tick + later, repeat=3)) for later in range(5)] == [1, 1, 1, 0, 0]


def test_what_a_client_has_heard_is_remembered_and_never_more_than_there_is(desk):
    for heard, remembered in ((1, 1), (0, 1), (99, desk.world.tick)):
        desk.raw(encode(ClientInputs(epoch=EPOCH, heard=heard, inputs=[])))
        assert desk.player.heard == remembered


def test_whoever_is_heard_is_waited_for_on():
    """Regression: the end of a client's old session may be told after its new one, which then was given up, playing."""
    desk = Desk()
    desk.players.depart("ana", SESSION, desk.world.tick)
    desk.world.run(299)
    desk.send()
    desk.world.run(299)
    assert desk.players.authored(desk.world) == []
    desk.world.run(1)
    assert [type(one) for one in desk.players.authored(desk.world)] == [Leave]
