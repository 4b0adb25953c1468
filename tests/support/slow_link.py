#!/usr/bin/env python3
"""Makes a network namespace behind a slow link, for tests. Needs root and /dev/net/tun.

usage: slow_link.py MILLISECONDS

The namespace's only connection to this host delays every round trip by MILLISECONDS. Prints
    ready NAMESPACE ADDRESS_HERE ADDRESS_THERE
on stdout, and forwards packets until SIGTERM or until stdin ends. All addresses of this host can be
reached from the namespace. The link consists of two TUN devices. Their packets pass through this
program, which applies half of the delay in each direction. If the system does not permit this, the
program prints the reason on stderr and exits with 77.
"""

import collections
import fcntl
import os
import select
import signal
import struct
import subprocess
import sys
import time

TUNSETIFF = 0x400454CA
IFF_TUN = 0x0001
IFF_NO_PI = 0x1000
NOT_PERMITTED = 77


def ip(*arguments):
    subprocess.run(["ip", *arguments], check=True, capture_output=True, text=True)


def open_tun(name):
    descriptor = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
    fcntl.ioctl(descriptor, TUNSETIFF, struct.pack("16sH", name.encode(), IFF_TUN | IFF_NO_PI))
    return descriptor


def set_up(namespace, here, there, address_here, address_there):
    ends = [open_tun(here), open_tun(there)]
    ip("netns", "add", namespace)
    ip("link", "set", there, "netns", namespace)
    ip("address", "add", address_here + "/30", "dev", here)
    ip("link", "set", here, "up")
    ip("-n", namespace, "address", "add", address_there + "/30", "dev", there)
    ip("-n", namespace, "link", "set", there, "up")
    ip("-n", namespace, "link", "set", "lo", "up")
    ip("-n", namespace, "route", "add", "default", "via", address_here)
    return ends


def carry(ends, delay):
    """Forwards packets to the other end after `delay` seconds, in their order."""
    waiting = collections.deque()  # (due, end, packet)
    while True:
        timeout = max(0.0, waiting[0][0] - time.monotonic()) if waiting else None
        readable, _, _ = select.select(ends, [], [], timeout)
        for end in readable:
            packet = os.read(end, 65536)
            other = ends[1] if end == ends[0] else ends[0]
            waiting.append((time.monotonic() + delay, other, packet))
        while waiting and waiting[0][0] <= time.monotonic():
            _, end, packet = waiting.popleft()
            try:
                os.write(end, packet)
            except OSError:
                pass  # a full queue drops packets, as any link does


def end_with_parent(*_):
    sys.exit(0)


def main():
    delay = float(sys.argv[1]) / 1000 / 2
    number = os.getpid()
    namespace, here, there = f"gsv{number}", f"gsv{number}a", f"gsv{number}b"
    network = f"10.{231 + number // 64 // 256 % 8}.{number // 64 % 256}"
    address = [f"{network}.{number % 64 * 4 + host}" for host in (1, 2)]
    signal.signal(signal.SIGTERM, end_with_parent)
    try:
        try:
            ends = set_up(namespace, here, there, *address)
        except (OSError, subprocess.CalledProcessError) as error:
            reason = getattr(error, "stderr", None) or error
            print(f"slow_link: no network namespace with TUN devices here: {reason}", file=sys.stderr)
            sys.exit(NOT_PERMITTED)
        print("ready", namespace, *address, flush=True)
        carry(ends, delay)
    finally:
        subprocess.run(["ip", "netns", "delete", namespace], check=False, capture_output=True)


if __name__ == "__main__":
    main()
