"""Chooses ROS 2 domains that no other test on this machine uses."""
import fcntl
import pathlib
import tempfile

# Linux chooses the ports of outgoing sockets from 32768 on. Those are also ports of the domains from 102 on, so an
# announcement may reach a node of another domain there. tests/browser/ros2_test.mjs uses the domains from 81 on.
DOMAINS = range(1, 81)
_locks = []


def take_domain():
    """Returns a domain. It belongs to this process until the process ends."""
    for domain in DOMAINS:
        lock = open(pathlib.Path(tempfile.gettempdir(), f"gsv-ros2-domain-{domain}.lock"), "a", encoding="utf-8")
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            lock.close()
            continue
        _locks.append(lock)  # the lock ends when the file is closed
        return domain
    raise RuntimeError("all ROS 2 domains are in use")
