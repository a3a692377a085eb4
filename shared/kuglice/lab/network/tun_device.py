"""A TUN device in a network namespace of its own: made by the kernel's calls, gone with the process."""

from __future__ import annotations

import ctypes
import fcntl
import os
import socket
import struct
from pathlib import Path

from kuglice.errors import NetworkError

__all__ = ["MTU", "PREFIX", "open_in_new_namespace", "why_impossible"]

MTU = 1500
PREFIX = 24
DEVICE = Path("/dev/net/tun")

CLONE_NEWNET = 0x40000000
TUNSETIFF = 0x400454CA
IFF_TUN, IFF_NO_PI = 0x0001, 0x1000
SIOCGIFFLAGS, SIOCSIFFLAGS = 0x8913, 0x8914
SIOCSIFADDR, SIOCSIFNETMASK, SIOCSIFMTU = 0x8916, 0x891C, 0x8922
IFF_UP = 0x1


def why_impossible() -> str | None:
    """Why this process can make no TUN device, in words; None if nothing is known to stand against it."""
    if not hasattr(os, "geteuid") or not DEVICE.exists():
        return f"{DEVICE} is missing: this kernel or container has no TUN devices"
    if os.geteuid() != 0:
        return "network namespaces and TUN devices need root"
    return None


def open_in_new_namespace(name: str, address: str) -> tuple[int, int]:
    """(device, namespace) file descriptors: this process is then in the new namespace, with `address` on it.

    The device can be read from any namespace. Raises NetworkError.
    """
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.unshare(CLONE_NEWNET) != 0:
        raise NetworkError(f"no new network namespace: {os.strerror(ctypes.get_errno())}")
    try:
        device = os.open(DEVICE, os.O_RDWR | os.O_NONBLOCK)
        fcntl.ioctl(device, TUNSETIFF, struct.pack("16sH22x", name.encode(), IFF_TUN | IFF_NO_PI))
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as control:
            mask = (0xFFFFFFFF << (32 - PREFIX)) & 0xFFFFFFFF
            _request(control, SIOCSIFADDR, name, _address(socket.inet_aton(address)))
            _request(control, SIOCSIFNETMASK, name, _address(mask.to_bytes(4, "big")))
            _request(control, SIOCSIFMTU, name, struct.pack("i12x", MTU))
            for device_name in ("lo", name):
                _bring_up(control, device_name)
        return device, os.open("/proc/self/ns/net", os.O_RDONLY)
    except OSError as error:
        raise NetworkError(f"TUN device {name}: {error}") from error


def _address(host: bytes) -> bytes:
    return struct.pack("HH4s8x", socket.AF_INET, 0, host)


def _request(control: socket.socket, number: int, name: str, value: bytes) -> bytes:
    return fcntl.ioctl(control, number, struct.pack("16s16s8x", name.encode(), value))


def _bring_up(control: socket.socket, name: str) -> None:
    (flags,) = struct.unpack_from("H", _request(control, SIOCGIFFLAGS, name, bytes(16)), 16)
    _request(control, SIOCSIFFLAGS, name, struct.pack("H14x", flags | IFF_UP))
