"""Views of real servers: the balls of a rectangle, as exactly as was told; moved, restarted, attacked, on a budget."""

from __future__ import annotations

import re
import time
from collections.abc import Callable

import numpy as np
import pytest
import zenoh

import kuglice as kg
from e2e.processes import Command, free_endpoint, until
from e2e.raw_client import RawClient
from kuglice.protocol import Keys, Region, encode
from kuglice_client.view import View, ViewSettings

WORLD = "crowd"
VIEW = (10.0, 10.0, 22.0, 18.0)
BUDGET = 6000


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / f"{WORLD}.toml"
    kg.scenes.gas(n=1500).save(path)
    return path


@pytest.fixture
def look(endpoint) -> Callable[..., View]:
    opened: list[View] = []

    def make(rectangle=VIEW, at=endpoint, **given) -> View:
        opened.append(View(ViewSettings(rectangle, connect=(at,), wait=30.0, **given)))
        return opened[-1]

    yield make
    for view in opened:
        view.close()


def whole_tick(view: View, after: int = 0) -> int:
    """A tick later than `after` of which all that is followed was told, waited for."""

    def complete() -> int | None:
        view.turn(time.monotonic())
        followed = set(view.replica.interest.paces)
        newest = view.replica.known.world.tick // 6 * 6
        return next((t for t in range(newest, after, -6) if view.replica.known.told_of(t) >= followed), None)

    return until(complete, what="news of all regions")


def assert_is_a_part(view: View, tick: int, record) -> None:
    """The view's world of that tick is the part of the recorded one that it follows, within what was promised."""
    state = view.replica.known.at(tick)
    truth = next(world for world in kg.replay.Replay.load(record).worlds() if world.tick == tick)
    terms = view.replica.about.regions
    here = np.isin(terms.packer(truth.scene.box).node(truth.position), list(view.replica.interest.paces))
    assert state.id.tolist() == truth.id[here].tolist()
    assert np.abs(state.position - truth.position[here]).max(initial=0) <= terms.position_quantum / 2
    assert np.abs(state.velocity - truth.velocity[here]).max(initial=0) <= terms.velocity_quantum / 2
    left, bottom, right, top = view.rectangle
    x, y = truth.position.T
    inside = truth.id[(x >= left) & (x < right) & (y >= bottom) & (y < top)]
    assert set(inside.tolist()) <= set(state.id.tolist())


def test_a_view_has_just_the_balls_of_its_regions_and_moves_and_the_rest_is_not_sent(
    server: Command, endpoint, look, tmp_path
):
    with RawClient(endpoint, WORLD, None) as other:
        view = look()
        first = whole_tick(view)
        at_first = (first, view.replica.known.at(first))
        followed = len(view.replica.interest.paces)
        assert followed < view.replica.nodes.count == 16
        before, ticks = other.status(), view.replica.known.world.tick
        until(
            lambda: view.turn(time.monotonic()) and view.replica.known.world.tick > ticks + 60,
            what="a second",
        )
        after = other.status()
        rounds = (after.tick - before.tick) / 6
        told = after.counters["regions_out"] - before.counters["regions_out"]
        assert told <= (rounds + 2) * followed, "only what is looked at is told"
        view.move((30.0, 30.0, 38.0, 36.0))
        second = whole_tick(view, view.replica.known.world.tick)
        at_second = (second, view.replica.known.at(second))
        assert set(at_first[1].id.tolist()) != set(at_second[1].id.tolist())
        view.close()
        until(lambda: _silent(other), what="silence when nobody looks")
    server.signal(2)
    server.figures()
    assert_is_a_part(view, second, tmp_path / "run.kuglice")
    assert view.malformed == 0
    assert view.accuracy.compared > 100
    assert view.accuracy.quantile(0.99) < 1.0


def _silent(other: RawClient) -> bool:
    before = other.status().counters["regions_out"]
    time.sleep(0.5)
    return other.status().counters["regions_out"] == before


def test_a_server_that_starts_anew_is_looked_at_again(start, scene, endpoint, look, server):
    view = look()
    whole_tick(view)
    epoch, before = view.replica.about.epoch, view.summary()
    assert before["updates"] > 0
    server.kill()
    start("server", scene, "--listen", endpoint)

    def anew() -> bool:
        view.turn(time.monotonic())
        return view.replica.about.epoch != epoch

    until(anew, what="the new server is found")
    whole_tick(view)
    summary = view.summary()
    assert summary["rejoins"] == 1
    assert summary["updates"] >= before["updates"] + len(view.replica.interest.paces), "of both runs"
    for figure in ("balls_told", "rewinds", "ticks_rerun", "updates_too_old"):
        assert summary[figure] >= before[figure], f"{figure} of both runs"
    assert view.in_sight.sum() > 10


def test_a_hostile_region_is_refused_and_the_view_goes_on(start, endpoint, look, server):
    # The server takes no regions from anybody; a router passes on what its clients say to each other.
    behind = free_endpoint()
    start("router", "--connect", endpoint, "--listen", behind)
    view = look(at=behind)
    tick = whole_tick(view)
    node = min(view.replica.interest.paces)
    key = Keys(WORLD).region(0, view.replica.nodes.path(node))
    wrong = [
        b"",
        b"\xff" * 100,
        b"\x00" * (Region.max_bytes + 1),
        encode(Region(epoch=view.replica.about.epoch, tick=2**61, node=node, balls=b"\0")),
        encode(Region(epoch=view.replica.about.epoch, tick=tick, node=node + 1, balls=b"\0")),
        encode(Region(epoch=view.replica.about.epoch, tick=tick, node=node, balls=b"\xff" * 1000)),
    ]
    with RawClient(behind, WORLD, None) as other:
        for payload in wrong:
            other.session.put(key, payload, congestion_control=zenoh.CongestionControl.BLOCK)

        def all_refused() -> bool:
            view.turn(time.monotonic())
            return view.malformed == len(wrong)

        until(all_refused, what="all are refused")
    whole_tick(view, tick)
    assert view.totals.rejoins == 0
    assert view.replica.known.jumps == 0


def test_a_budget_is_kept_by_telling_far_regions_less_often(start, endpoint, server):
    def looked(*budget: object) -> dict:
        view = start(
            "view", "5,5,30,25", "--connect", endpoint, "--wait", 60, "--seconds", 4, *budget, "--json"
        )
        return view.figures()

    def told_at_its_rate() -> list[dict] | None:
        before = other.status().seconds_lost
        figures = [looked(), looked("--budget", BUDGET)]
        return figures if other.status().seconds_lost == before else None

    with RawClient(endpoint, WORLD, None) as other:
        free, bounded = until(told_at_its_rate, seconds=120.0, what="a server that is not held up")
    assert free["regions_by_pace"] == {"1/1": free["regions_followed"]}
    assert free["bytes_per_second_received"] > 8000
    # The first half second goes by a guess.
    assert bounded["bytes_per_second_received"] < 1.15 * BUDGET
    assert (
        bounded["balls_followed"]
        > 0.9 * free["balls_followed"] * bounded["regions_followed"] / free["regions_followed"]
    )
    assert bounded["regions_left_out"] == 0
    assert set(bounded["regions_by_pace"]) - {"1/1"}


def test_a_moving_view_is_filmed(start, endpoint, server, tmp_path):
    view = start(
        "view",
        "5,5,16,9",
        "--pan",
        "3,0",
        "--connect",
        endpoint,
        "--seconds",
        2,
        "--render",
        tmp_path / "frame-%05d.png",
        "--fps",
        10,
        "--width",
        160,
        "--json",
    )
    figures = view.figures()
    assert figures["frames"] == 20
    assert figures["rectangle"][0] == pytest.approx(5 + 3 * 2, abs=4)
    assert figures["rectangle"][2] - figures["rectangle"][0] == pytest.approx(16)
    assert len(list(tmp_path.glob("frame-*.png"))) == 20
    assert re.search("looking at world crowd", view.err)


def test_without_a_server_a_view_says_so(start, endpoint):
    view = start("view", "0,0,1,1", "--connect", endpoint, "--wait", 0.5)
    assert view.wait() == 2
    assert endpoint in view.err


@pytest.mark.parametrize("wrong", ["1,2,3", "0,0,-1,1", "0,0,inf,1"])
def test_a_rectangle_that_is_none_is_refused(start, wrong):
    view = start("view", wrong)
    assert view.wait() == 2
    assert "view" in view.err


def test_through_a_router_it_is_the_same(start, scene, endpoint, server, tmp_path):
    door = free_endpoint()
    router = start("router", "--connect", endpoint, "--listen", door)
    until(lambda: "router from" in router.err, what="the router is there")
    with RawClient(endpoint, WORLD, None) as other:
        assert other.status().counters.get("regions_out", 0) == 0
        with View(ViewSettings(VIEW, connect=(door,), wait=30.0)) as view:
            tick = whole_tick(view)
            view.run(seconds=0.5)
        until(lambda: _silent(other), what="silence when nobody looks")
    server.signal(2)
    server.figures()
    assert_is_a_part(view, tick, tmp_path / "run.kuglice")
