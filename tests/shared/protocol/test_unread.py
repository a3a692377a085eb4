"""Datagrams that nobody reads are noticed by what waits in the socket; those that are read late are left alone."""

from __future__ import annotations

import logging
import socket
from pathlib import Path

import pytest

from kuglice.protocol import UnreadDatagrams
from kuglice.protocol.unread import LOOKS, TABLES

HEADER = "  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout inode"
linux = pytest.mark.skipif(not TABLES[0].exists(), reason="the system does not tell what waits in a socket")


@pytest.fixture
def unread_socket():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiving:
        receiving.bind(("127.0.0.1", 0))
        yield receiving


def endpoint_of(receiving: socket.socket) -> str:
    return f"tcp+udp/127.0.0.1:{receiving.getsockname()[1]}"


def send_to(receiving: socket.socket) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sending:
        sending.sendto(b"whatever", receiving.getsockname())


@linux
def test_a_socket_that_nobody_reads_is_warned_of_once(unread_socket, caplog):
    endpoint = endpoint_of(unread_socket)
    unread = UnreadDatagrams([endpoint])
    with caplog.at_level(logging.WARNING):
        for _ in range(3 * LOOKS):
            send_to(unread_socket)
            unread.look()
    assert unread.stuck == {endpoint}
    (told,) = caplog.records
    assert endpoint in told.getMessage()


@linux
def test_a_socket_that_is_read_now_and_then_is_not(unread_socket, caplog):
    unread = UnreadDatagrams([endpoint_of(unread_socket)])
    for _ in range(3 * LOOKS):
        send_to(unread_socket)
        unread.look()
        unread_socket.recv(100)
        unread.look()
    assert not unread.stuck
    assert not caplog.records


def test_more_and_more_that_waits_is_unread_and_less_is_not(tmp_path):
    table = tmp_path / "udp"
    unread = UnreadDatagrams(["tcp+udp/127.0.0.1:7447"], tables=[table])

    def look(waiting: int) -> bool:
        # 0x1D17 is 7447.
        table.write_text(
            f"{HEADER}\n 1: 0100007F:1D17 00000000:0000 07 00000000:{waiting:08X} 00:00000000 0 0 0 1\n"
        )
        unread.look()
        return bool(unread.stuck)

    assert not any(look(waiting) for waiting in (5, 4) * LOOKS)
    assert [look(waiting) for waiting in range(6, 6 + LOOKS)] == [False] * (LOOKS - 1) + [True]


def test_streams_and_systems_that_tell_nothing_are_left_alone(tmp_path):
    for listen in (["tcp/127.0.0.1:7447"], ["tcp+udp/127.0.0.1:7447"]):
        unread = UnreadDatagrams(listen, tables=[Path(tmp_path / "missing")])
        for _ in range(2 * LOOKS):
            unread.look()
        assert not unread.stuck
