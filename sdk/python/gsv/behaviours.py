"""Behaviours: what moves a robot, and how a program offers one."""

from __future__ import annotations

import argparse
import os
import signal
import socket
import sys
from typing import Any, Callable, Optional, Tuple

from gsv import _native
from gsv._ending import end_at_exit
from gsv.errors import Error, Refused

_USAGE, _INFRASTRUCTURE = 2, 5  # exit codes, those of programs in C++


class Behaviour:
    """Write one of these, and it runs anywhere on the network: one instance drives one robot.

    `init`, `paused` and `resumed` are called on other threads than `run`, never at once with `init`.
    """

    def init(self, robot: _native.Robot) -> None:
        """The robot is there, time does not run yet: open sensors here. What is raised here refuses
        the robot."""

    def run(self, robot: _native.Robot) -> None:
        """Runs until robot.sleep_for() and the like return False, or until the work is done."""
        raise NotImplementedError("a behaviour needs a method run(self, robot)")

    def paused(self) -> None:
        """Told, not asked: who sleeps on the robot's clock need not do anything."""

    def resumed(self) -> None:
        """The end of a pause."""


class Controller(Behaviour):
    """A behaviour that never blocks: readings in, command out, once a period (simulated seconds)."""

    period = 0.05

    def control(self, readings: dict[str, _native.Reading]) -> Tuple[float, ...]:
        """The command for the next period, from the readings of all open sensors: m/s forward and
        rad/s, and for a base that can move sideways a third number, m/s to the left."""
        raise NotImplementedError("a controller needs a method control(self, readings)")

    def run(self, robot: _native.Robot) -> None:
        start, cycle = robot.now(), 0
        command: Tuple[float, ...] = (0.0, 0.0)
        while True:
            cycle += 1  # instants are multiples of the period: sums would drift
            linear, angular, *sideways = command
            readings = robot.exchange(linear, angular, until=start + cycle * self.period,
                                      lateral=sideways[0] if sideways else 0.0)
            if readings is None:
                return
            command = self.control(readings)


class Offer(_native.Offer):
    """A behaviour that this program offers at a broker, until it is withdrawn or the `with` ends.

    `make` is a class of behaviours, or what makes one when it is called: once for each robot.
    `time_managed` says that it tells the time by the robot's clock only, so that a simulation may
    wait for it.
    """

    def __init__(self, broker: str, name: str, make: Callable[[], Any], description: str = "",
                 time_managed: bool = True) -> None:
        super().__init__(broker, name, make, description, time_managed)
        end_at_exit(self, _native.Offer.withdraw)

    def __enter__(self) -> Offer:
        return self

    def __exit__(self, *_: Any) -> None:
        self.withdraw()


def serve(name: str, make: Callable[..., Any], parser: Optional[argparse.ArgumentParser] = None, *,
          time_managed: bool = True) -> None:
    """What a program that offers a behaviour ends with. Reads the command line (--broker, --name,
    --help), offers the behaviour, serves until SIGINT, SIGTERM or SIGHUP (a second one ends the
    program at once, where a behaviour does not return) and exits: with 0, with 2 for a
    usage error, with 5 when the broker cannot be reached.

    A behaviour with options of its own hands over a `parser` that has them; `make` is then called
    with the namespace of their values.
    """
    doc = (make.__doc__ or name).strip().splitlines()[0]
    wants_options = parser is not None
    parser = parser or argparse.ArgumentParser(description=doc)
    broker = os.environ.get("GSV_BROKER", "")
    parser.add_argument("--broker", default=broker, required=not broker, metavar="REFERENCE",
                        help="broker to which the behaviour is offered (or GSV_BROKER)")
    parser.add_argument("--name", default=name, help="name of the offer")
    parser.add_argument("--exit-with-parent", action="store_true",
                        help="end when the program that started this one ends")
    options = parser.parse_args()
    if options.exit_with_parent:
        _native.end_with_parent()

    def make_one() -> Any:
        return make(options) if wants_options else make()

    try:
        with _Signals() as signals, Offer(options.broker, options.name, make_one,
                                          parser.description or doc, time_managed) as offer:
            print(f"{options.name}: offered at {offer.broker}", flush=True)
            if options.exit_with_parent:
                # A gsv that captures the output reads on. Other parents do not: then prints go
                # where errors go.
                if "GSV_OUTPUT_CAPTURED" not in os.environ:
                    os.dup2(2, 1)
                sys.stdout.reconfigure(line_buffering=True)  # type: ignore[attr-defined]
            signals.wait()
    except Error as error:
        print(error, file=sys.stderr)
        sys.exit(_USAGE if isinstance(error, Refused) else _INFRASTRUCTURE)
    sys.exit(0)


class _Signals:
    """SIGINT, SIGTERM and SIGHUP, whichever thread of the process they come to."""

    def __init__(self) -> None:
        self._wanted = [signal.SIGINT, signal.SIGTERM]
        if signal.getsignal(signal.SIGHUP) != signal.SIG_IGN:  # nohup ignores it
            self._wanted.append(signal.SIGHUP)

    def __enter__(self) -> _Signals:
        self._received, written = socket.socketpair()
        written.setblocking(False)
        self._written = written  # the interpreter writes the number of a signal here
        self._fd = signal.set_wakeup_fd(written.fileno())
        self._handlers = [signal.signal(each, lambda *_: None) for each in self._wanted]
        return self

    def wait(self) -> None:
        while self._received.recv(1)[0] not in self._wanted:
            pass
        # From here on Python's threads may be stuck, and a second signal ends the process itself.
        for each in self._wanted:
            signal.signal(each, signal.SIG_DFL)

    def __exit__(self, *_: Any) -> None:
        for each, handler in zip(self._wanted, self._handlers):
            signal.signal(each, handler)
        signal.set_wakeup_fd(self._fd)
        self._received.close()
        self._written.close()
