"""Regions: told to those who look at them, as exactly as promised, and not even packed for nobody."""

from __future__ import annotations

from concurrent.futures import Executor, Future

import numpy as np
import pytest
import zenoh

import kuglice as kg
from e2e.processes import free_endpoint, until
from kuglice.protocol import (
    PACES,
    Holding,
    Keys,
    Nodes,
    Region,
    client_configuration,
    close_session,
    decode,
    open_session,
    server_configuration,
)
from kuglice_server import Server, ServerSettings
from kuglice_server.counters import Counters
from kuglice_server.regions import RegionPublisher, choose_terms

KEYS = Keys("test")


class AtOnce(Executor):
    """Does at once what it is given."""

    def submit(self, call, /, *given):
        done = Future()
        done.set_result(call(*given))
        return done


class Busy(Executor):
    """Has something else to do until `free`."""

    def __init__(self) -> None:
        self._waiting = []

    def submit(self, call, /, *given):
        self._waiting.append((future := Future(), call, given))
        return future

    def free(self) -> None:
        for future, call, given in self._waiting:
            future.set_result(call(*given))
        self._waiting.clear()


class Wire:
    """A publisher of a world's regions, and a session that looks at them."""

    def __init__(self, world: kg.World, every: int = 1, teller: Executor | None = None) -> None:
        endpoint = free_endpoint()
        self.world = world
        self.counters = Counters()
        self.terms = choose_terms(world, rate=10.0)
        self.nodes = Nodes(world.scene.box, self.terms.depth)
        self.packer = self.terms.packer(world.scene.box)
        self.session = open_session(server_configuration(listen=[endpoint], connect=[]))
        self.viewer = open_session(client_configuration([endpoint], timeout=5.0))
        self.publisher = RegionPublisher(
            self.session,
            KEYS,
            self.terms,
            epoch=9,
            world=world,
            every=every,
            counters=self.counters,
            teller=teller or AtOnce(),
        )
        self._declared = []

    def look(self, key: str):
        """What comes under that key from now on."""
        subscriber = self.viewer.declare_subscriber(key, zenoh.handlers.FifoChannel(5000))
        self._declared.append(subscriber)
        # Subscribed here is not yet subscribed there, and what is there is told to the publisher a moment later.
        until(lambda: self._known(key) and self._told(key), what=f"the server knows of {key}")

        def heard(kind=Region) -> list:
            found = []
            while (sample := subscriber.try_recv()) is not None:
                message = decode(sample.payload.to_bytes(), kind)
                if kind is Region:
                    assert Keys.node_of(str(sample.key_expr)) == self.nodes.path(message.node)
                found.append(message)
            return found

        heard.end = lambda: (
            subscriber.undeclare(),
            until(lambda: not self._known(key) and not self._told(key), what="gone"),
        )
        return heard

    def _known(self, key: str) -> bool:
        probe = self.session.declare_publisher(key)
        try:
            return probe.matching_status.matching
        finally:
            probe.undeclare()

    def _told(self, key: str) -> bool:
        if key == KEYS.holding:
            return self.publisher.hearing.present()
        looked_at = {(one.pace, one.node) for one in self.publisher.watch.looked_at()}
        wanted = {
            (pace, node)
            for pace in range(PACES)
            for node in range(self.nodes.count)
            if zenoh.KeyExpr(key).intersects(zenoh.KeyExpr(KEYS.region(pace, self.nodes.path(node))))
        }
        return looked_at >= wanted

    def turn(self) -> None:
        self.world.step()
        self.publisher.turn(self.world)

    def close(self) -> None:
        close_session(self.viewer, [])
        close_session(self.session, self.publisher.declared)


@pytest.fixture
def wired():
    wires: list[Wire] = []

    def make(*given, **more) -> Wire:
        wires.append(Wire(*given, **more))
        return wires[-1]

    yield make
    for wire in wires:
        wire.close()


def gas(n: int = 1000) -> kg.World:
    return kg.World(kg.scenes.gas(n=n))


def collect(wire: Wire, heard, nodes: set[int]) -> dict[int, Region]:
    """The last message of each node, once all have come for the state that the world is in."""
    found: dict[int, Region] = {}

    def complete() -> bool:
        found.update({message.node: message for message in heard()})
        return {node for node, one in found.items() if one.tick == wire.world.tick} >= nodes

    until(complete, what=f"regions {nodes}")
    return found


def test_all_regions_together_are_the_world_within_the_bound_that_was_told(wired):
    wire = wired(gas())
    every = set(range(wire.nodes.count))
    heard = wire.look(KEYS.regions(0, ()))
    for _ in range(3):
        wire.turn()
        told = collect(wire, heard, every)
    parts = [wire.packer.unpack(told[node].balls, 1000) for node in sorted(every)]
    order = np.argsort(np.concatenate([part[0] for part in parts]))
    ids, position, velocity, radius, mass = (
        np.concatenate(column)[order] for column in zip(*parts, strict=True)
    )
    assert (ids == wire.world.id).all()
    assert np.abs(position - wire.world.position).max() <= wire.terms.position_quantum / 2
    assert np.abs(velocity - wire.world.velocity).max() <= wire.terms.velocity_quantum / 2
    assert (radius == wire.world.radius).all()
    assert (mass == wire.world.mass).all()
    assert wire.terms.position_quantum / 2 <= wire.world.radius.min() / 512


def test_only_what_somebody_looks_at_is_told(wired):
    wire = wired(gas())
    for _ in range(5):
        wire.turn()
    assert wire.counters["regions_out"] == 0
    heard = wire.look(KEYS.region(0, wire.nodes.path(6)))
    for _ in range(10):
        wire.turn()
    collect(wire, heard, {6})
    assert wire.counters["regions_out"] == 10
    heard.end()
    for _ in range(5):
        wire.turn()
    assert wire.counters["regions_out"] == 10


def test_publishers_grow_only_below_what_is_looked_at(wired):
    wire = wired(gas(20_000))
    assert wire.terms.depth == 4
    wire.turn()
    assert wire.publisher.publishers == PACES
    heard = wire.look(KEYS.region(1, wire.nodes.path(77)))
    wire.turn()
    wire.turn()
    assert wire.publisher.publishers == PACES + 4 * wire.terms.depth
    heard.end()


def test_each_pace_is_half_as_often_as_the_one_before(wired):
    wire = wired(gas())
    heard = [wire.look(KEYS.regions(pace, ())) for pace in range(PACES)]
    counts = [0] * PACES

    def all_came() -> bool:
        for pace, one in enumerate(heard):
            counts[pace] += len(one())
        return sum(counts) == wire.counters["regions_out"]

    for _ in range(32):
        wire.turn()
        # One turn at a time: what the stream cannot take at once is dropped, as promised.
        until(all_came, what="all messages of a turn")
    assert counts == [wire.nodes.count * 32 >> pace for pace in range(PACES)]


def test_the_rate_is_in_ticks(wired):
    wire = wired(gas(), every=6)
    heard = wire.look(KEYS.region(0, wire.nodes.path(3)))
    for _ in range(24):
        wire.turn()
    ticks: list[int] = []

    def four() -> bool:
        ticks.extend(message.tick for message in heard())
        return len(ticks) == 4

    until(four, what="four messages")
    assert ticks == [6, 12, 18, 24]


def test_a_round_is_left_out_while_the_last_one_is_not_told_yet(wired):
    teller = Busy()
    wire = wired(gas(), teller=teller)
    heard = wire.look(KEYS.region(0, wire.nodes.path(6)))
    for _ in range(3):
        wire.turn()
    teller.free()
    wire.turn()
    teller.free()
    ticks: list[int] = []

    def two() -> bool:
        ticks.extend(message.tick for message in heard())
        return len(ticks) == 2

    until(two, what="two messages")
    assert ticks == [1, 4]
    assert wire.counters["region_rounds_left_out"] == 2


def test_no_pace_is_left_out_for_good_where_every_second_round_is(wired):
    teller = Busy()
    wire = wired(gas(), teller=teller)
    heard = wire.look(KEYS.regions(1, ()))
    for _ in range(8):
        wire.turn()
        wire.turn()
        teller.free()
    told: set[int] = set()

    def all_nodes() -> bool:
        told.update(message.node for message in heard())
        return len(told) == wire.nodes.count

    until(all_nodes, what="a message about every node")


def test_a_region_that_became_empty_is_told_at_once_and_then_now_and_then(wired):
    scene = kg.Scene(
        box=(0.0, 0.0, 40.0, 40.0), balls=kg.Balls(position=[[5.0, 5.0]], velocity=[[60.0, 0.0]], radius=0.5)
    )
    wire = wired(kg.World(scene))
    heard = wire.look(KEYS.regions(0, ()))
    for _ in range(31):
        wire.turn()
    told: list[Region] = []

    def done() -> bool:
        told.extend(heard())
        return len(told) == wire.counters["regions_out"]

    until(done, what="all messages")
    first = [message.tick for message in told if message.node == 0 and message.balls == b"\0"]
    assert first == [15, 25], "when it left, and ten turns later"
    assert [message.tick for message in told if message.node == 3] == [1, 11, 21, 31]


def test_who_plays_and_what_is_held_is_told_when_it_changes_and_then_now_and_then(wired):
    wire = wired(kg.World(kg.scenes.arena()))
    heard = wire.look(KEYS.holding)
    wire.turn()
    wire.world.step([kg.Join(client=3, x=8.0, y=4.5, radius=0.4, mass=1.0)])
    wire.publisher.turn(wire.world)
    wire.world.step([kg.Thrust(client=3, x=1.0, y=-0.5)])
    for _ in range(14):
        wire.turn()
    told: list[Holding] = []

    def four() -> bool:
        told.extend(heard(Holding))
        return len(told) == 4

    until(four, what="four messages")
    assert [message.tick for message in told] == [1, 2, 4, 14]
    assert told[-1].players == wire.world.players
    assert told[-1].held == wire.world.held == [(3, "thrust", 1.0, -0.5, 0.0)]


@pytest.mark.parametrize(("n", "depth"), [(10, 1), (512, 1), (513, 2), (10_000, 4), (100_000, 5)])
def test_the_quadtree_is_as_deep_as_the_balls_ask_for(n, depth):
    assert choose_terms(gas(n), rate=10.0).depth == depth


def test_shapes_go_by_number_where_they_are_few():
    assert len(choose_terms(kg.World(kg.scenes.gas(n=50)), rate=10.0).shapes) == 1
    assert len(choose_terms(kg.World(kg.scenes.mixed(n=500)), rate=10.0).shapes) == 0
    pegs = choose_terms(kg.World(kg.scenes.pegs()), rate=10.0).shapes
    assert np.isinf([mass for _, mass in pegs]).any()
    arena = kg.scenes.arena()
    assert (arena.players.radius, arena.players.mass) in choose_terms(kg.World(arena), rate=10.0).shapes


@pytest.mark.parametrize("name", kg.scenes.TABLE)
def test_every_scene_can_be_told_without_its_balls(name):
    settings = ServerSettings(world="w", listen=[free_endpoint()])
    with Server(kg.scenes.find(name), settings) as server:
        about = server.view_about()
        assert about.balls == server.world.count
    scene = kg.Scene.from_message(about.scene)
    assert len(scene.balls) == 0
    assert scene.rules().to_bytes() == kg.scenes.find(name).rules().to_bytes()
