"""Cuts and stalls as they are written, and a real `kuglice proxy` that is told of them beforehand."""

from __future__ import annotations

import os
import re
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kuglice.errors import NetworkError
from kuglice.lab.cli.proxy import proxy
from kuglice.lab.network.interruption import KINDS, Interruption
from kuglice.processes import free_port

GOOD = ("--round-trip", "0", "--jitter", "0", "--loss", "0")
WAIT_SECONDS = 60.0
OFTEN = [word for at in range(2, 120, 2) for word in ("--cut", f"{at}:0.5")]


@given(st.sampled_from(KINDS), st.floats(0.0, 86_400.0), st.floats(0.0, 3600.0))
def test_what_is_written_is_what_is_meant(kind, at, seconds):
    assert Interruption.parse(kind, f"{at}:{seconds}") == Interruption(kind, seconds, at)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("5", "stall '5': must be AT:SECONDS, like 20:5"),
        ("1:2:3", "stall '1:2:3': must be AT:SECONDS"),
        ("soon:2", "stall 'soon:2': must be AT:SECONDS"),
        ("-1:2", "stall at -1 seconds: must be 0 to 86400 seconds after the start"),
        ("nan:2", "stall at nan seconds"),
        ("5:3601", "stall of 3601 seconds: must be 0 to 3600 seconds"),
        ("5:-1", "stall of -1 seconds"),
        ("5:nan", "stall of nan seconds"),
    ],
)
def test_what_cannot_be_is_refused_with_its_bound(text, told):
    with pytest.raises(NetworkError, match=re.escape(told)):
        proxy(stall=[text])


def test_another_kind_is_refused():
    with pytest.raises(NetworkError, match="interruption 'bend': must be one of cut, stall"):
        Interruption("bend", 1.0)


@contextmanager
def proxied(*options: str) -> Iterator[tuple[str, int]]:
    """Where a proxy process listens, with an echo behind it."""
    with ExitStack() as opened:
        listening = opened.enter_context(socket.create_server(("127.0.0.1", 0)))
        threading.Thread(target=echo, args=(listening,), daemon=True).start()
        here = ("127.0.0.1", free_port())
        there = f"127.0.0.1:{listening.getsockname()[1]}"
        command = [sys.executable, "-m", "kuglice", "proxy", "{}:{}".format(*here), there, *GOOD, *options]
        process = opened.enter_context(
            subprocess.Popen(command, stderr=subprocess.PIPE, text=True, env={**os.environ, "COLUMNS": "200"})
        )
        opened.callback(process.kill)
        assert process.stderr is not None
        assert " to " in process.stderr.readline()
        yield here


def echo(listening: socket.socket) -> None:
    while True:
        try:
            connection, _ = listening.accept()
        except OSError:
            return
        threading.Thread(target=echo_one, args=(connection,), daemon=True).start()


def echo_one(connection: socket.socket) -> None:
    try:
        with connection:
            while data := connection.recv(65_536):
                connection.sendall(data)
    except OSError:
        return


def answered(connection: socket.socket) -> bool:
    """Whether a byte comes back, and the connection has not been broken off."""
    connection.settimeout(WAIT_SECONDS)
    try:
        connection.sendall(b"?")
        return connection.recv(1) == b"?"
    except ConnectionError:
        return False


def until(condition: Callable[[], bool]) -> None:
    deadline = time.monotonic() + WAIT_SECONDS
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.01)


def reached(address: tuple[str, int]) -> bool:
    with socket.create_connection(address) as connection:
        return answered(connection)


def test_a_cut_breaks_a_connection_off_and_others_come_about_after_it():
    with proxied(*OFTEN) as address:
        until(lambda: reached(address))
        with socket.create_connection(address) as connection:
            until(lambda: not answered(connection))
        until(lambda: reached(address))


def test_a_cut_lasts_until_the_last_that_was_ordered_is_over():
    with proxied("--cut", "0:3600", "--cut", "0.01:0.01") as address:
        until(lambda: not reached(address))
        for _ in range(20):
            assert not reached(address)


def test_a_stall_holds_bytes_both_ways_and_lets_all_of_them_on():
    sent = bytes(range(256)) * 1000
    began = time.monotonic()
    with (
        proxied("--stall", "0:1", "--stall", "0.5:1.5") as address,
        socket.create_connection(address) as link,
    ):
        link.settimeout(WAIT_SECONDS)
        threading.Thread(target=link.sendall, args=(sent,), daemon=True).start()
        got = bytearray()
        while len(got) < len(sent):
            part = link.recv(65_536)
            assert part, "the connection lasts"
            got += part
        assert bytes(got) == sent
        # Not how fast it was: it cannot have been there before the later of the two was over.
        assert time.monotonic() - began >= 2.0
