"""The processes that condition a link, by plain sockets: every byte arrives, or is lost, as ordered."""

from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import sys
import threading
import time

import pytest

from kuglice.errors import NetworkError
from kuglice.lab.network.conditioner import ProxyLink, TunnelLink, open_link
from kuglice.lab.network.conditions import Conditions
from kuglice.lab.network.tun_device import why_impossible

needs_tunnel = pytest.mark.skipif(why_impossible() is not None, reason=why_impossible() or "")

ECHO = """
import socket, sys
host, port, kind = sys.argv[1], int(sys.argv[2]), sys.argv[3]
if kind == "tcp":
    with socket.create_server((host, port)) as listening:
        print("ready", flush=True)
        while True:
            connection, _ = listening.accept()
            with connection:
                try:
                    while data := connection.recv(65536):
                        connection.sendall(data)
                except OSError:
                    pass
else:
    with socket.socket(type=socket.SOCK_DGRAM) as bound:
        bound.bind((host, port))
        print("ready", flush=True)
        while True:
            data, peer = bound.recvfrom(65536)
            bound.sendto(data, peer)
"""
ASK_TCP = """
import socket, sys, time, json
with socket.create_connection((sys.argv[1], int(sys.argv[2]))) as link:
    link.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    sent = bytes(range(256)) * 400
    begin = time.monotonic()
    link.sendall(sent)
    got = b""
    while len(got) < len(sent):
        got += link.recv(65536)
    print(json.dumps({"equal": got == sent, "seconds": time.monotonic() - begin}))
"""
ASK_UDP = """
import socket, sys, time, json
with socket.socket(type=socket.SOCK_DGRAM) as link:
    link.connect((sys.argv[1], int(sys.argv[2])))
    got = []
    def hear(seconds):
        link.settimeout(seconds)
        try:
            while True:
                got.append(int.from_bytes(link.recv(100), "big"))
        except TimeoutError:
            pass
    for number in range(int(sys.argv[3])):
        link.send(number.to_bytes(4, "big"))
        # Read meanwhile: what a full socket drops is no loss of the link's.
        hear(0.001)
    hear(1.0)
    print(json.dumps(got))
"""


@pytest.fixture(params=["proxy", pytest.param("tunnel", marks=needs_tunnel)])
def link(request):
    with open_link(Conditions(), request.param) as opened:
        yield opened


@pytest.fixture
def echo(link):
    started = []

    def start(protocol: str) -> None:
        host, _, port = link.server_address.rpartition(":")
        command = [*link.server_prefix, sys.executable, "-c", ECHO, host, port, protocol]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        started.append(process)
        assert process.stdout.readline() == "ready\n"

    yield start
    for process in started:
        process.kill()
        process.wait()
        process.stdout.close()


def ask(link, program: str, *arguments: object):
    host, _, port = link.client_address.rpartition(":")
    command = [*link.client_prefix, sys.executable, "-c", program, host, port, *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_every_byte_of_a_stream_arrives_in_order_however_bad_the_link(link, echo):
    link.change(Conditions(round_trip=0.06, jitter=0.5, loss=0.05, seed=3))
    echo("tcp")
    answer = ask(link, ASK_TCP)
    assert answer["equal"]
    assert answer["seconds"] >= 0.03
    counts = link.counts()
    assert counts["up tcp bytes"] >= 102_400
    assert counts["down tcp bytes"] >= 102_400


def test_datagrams_are_lost_and_come_in_order(link, echo):
    link.change(Conditions(round_trip=0.02, jitter=0.5, loss=0.1, seed=3))
    echo("udp")
    got = ask(link, ASK_UDP, 400)
    assert 250 < len(got) < 390
    assert got == sorted(set(got))
    counts = link.counts()
    assert counts["up udp lost"] + counts["down udp lost"] == 400 - len(got)


def test_datagrams_may_overtake_and_come_twice(link, echo):
    link.change(Conditions(round_trip=0.04, jitter=1.0, duplicate=0.2, reorder=True, seed=3))
    echo("udp")
    got = ask(link, ASK_UDP, 300)
    assert set(got) == set(range(300))
    assert len(got) > 330
    assert got != sorted(got)


def test_a_stall_holds_bytes_and_loses_none(link, echo):
    echo("tcp")
    begin = time.monotonic()
    link.stall(1.0)
    assert ask(link, ASK_TCP)["equal"]
    assert time.monotonic() - begin >= 1.0


def test_what_cannot_be_ordered_is_refused_in_words(link):
    with pytest.raises(NetworkError, match="cut of -1 seconds: must be 0 to 3600 seconds"):
        link.cut(-1.0)
    with pytest.raises(NetworkError, match="stall of 3601 seconds: must be 0 to 3600 seconds"):
        link.stall(3601.0)
    assert link.counts() == {}


def test_a_cut_resets_connections_of_the_proxy_and_refuses_new_ones_until_it_is_over():
    with ProxyLink(Conditions()) as link:
        host, _, port = link.server_address.rpartition(":")
        with socket.create_server((host, int(port))) as listening:
            address = ("127.0.0.1", int(link.client_address.rpartition(":")[2]))
            client = socket.create_connection(address)
            server, _ = listening.accept()
            link.cut(60.0)
            with client, server, socket.create_connection(address) as refused:
                assert not alive(client)
                assert not alive(server)
                assert not alive(refused)
            link.cut(1.0)
            with socket.create_connection(address) as refused:
                assert not alive(refused), "a longer cut stays"
            link.mend()
            with socket.create_connection(address) as again:
                threading.Timer(0.0, again.sendall, (b"x",)).start()
                accepted, _ = listening.accept()
                with accepted:
                    assert accepted.recv(1) == b"x"


def alive(connection: socket.socket) -> bool:
    connection.settimeout(5)
    try:
        return connection.recv(1) != b""
    except ConnectionError:
        return False


@needs_tunnel
def test_a_tunnel_that_is_killed_leaves_nothing_behind():
    link = TunnelLink(Conditions())
    namespace = link.told["server_namespace"]
    assert os.path.exists(namespace)
    link._process.send_signal(signal.SIGKILL)
    link._process.wait()
    assert not os.path.exists(namespace)
    with pytest.raises(NetworkError, match="tunnel"):
        link.counts()
    link.close()


def test_an_unknown_link_is_refused():
    with pytest.raises(NetworkError, match="must be one of auto, tunnel, proxy"):
        open_link(Conditions(), "string")
