"""Behaviours, which drive robots, and functions with which a program offers them."""

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

_USAGE, _INFRASTRUCTURE = 2, 5  # exit codes, equal to those of C++ programs


class Behaviour:
    """The base class of behaviours. Each instance drives one robot, also over the network.

    `init`, `paused` and `resumed` are called one at a time, on other threads than `run`. `paused`
    and `resumed` may be called while `run` is running.
    """

    def init(self, robot: _native.Robot) -> None:
        """Called once, before run(). Open sensors here. An exception means that the
        behaviour refuses the robot."""

    def run(self, robot: _native.Robot) -> None:
        """Drives the robot. Return when robot.sleep_for() returns False, or when the work is done."""
        raise NotImplementedError("a behaviour needs a method run(self, robot)")

    def paused(self) -> None:
        """Called when the simulation pauses. A behaviour that waits by the robot's clock need not
        override this."""

    def resumed(self) -> None:
        """Called when the simulation resumes after a pause."""


class Controller(Behaviour):
    """A behaviour that computes one command from the readings in each `period` (simulated seconds)."""

    period = 0.05

    def control(self, readings: dict[str, _native.Reading]) -> Tuple[float, ...]:
        """Returns the command for the next period: m/s forward and rad/s. For a base that can move
        sideways, a third number is m/s to the left. `readings` are those of all open sensors."""
        raise NotImplementedError("a controller needs a method control(self, readings)")

    def run(self, robot: _native.Robot) -> None:
        start, cycle = robot.now(), 0
        command: Tuple[float, ...] = (0.0, 0.0)
        while True:
            cycle += 1  # multiples of the period, because a sum would accumulate rounding errors
            linear, angular, *sideways = command
            readings = robot.exchange(linear, angular, until=start + cycle * self.period,
                                      lateral=sideways[0] if sideways else 0.0)
            if readings is None:
                return
            command = self.control(readings)


class Offer(_native.Offer):
    """A behaviour that this program offers at a broker, until withdraw() or the end of the `with`.

    `make` is a class of behaviours, or a function that returns one. It is called once for each
    robot. `time_managed` means that the behaviour uses only the robot's clock, so that a simulation
    can wait for the behaviour.
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
    """Offers a behaviour until the program ends. Call this as the last function of a program.

    Reads the command line (--broker, --name, --help) and serves until SIGINT, SIGTERM or SIGHUP. If
    a behaviour does not return, a second signal ends the program at once. The exit code is 0, 2
    after a usage error, or 5 if the broker cannot be reached.

    If the behaviour has options of its own, pass a `parser` with these options. `make` is then
    called with one argument, the argparse.Namespace of the parsed options.
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
                # gsv reads stdout until the program ends if it captures the output. Other parent
                # processes stop reading after the line above. For them, the output goes to stderr.
                if "GSV_OUTPUT_CAPTURED" not in os.environ:
                    os.dup2(2, 1)
                sys.stdout.reconfigure(line_buffering=True)  # type: ignore[attr-defined]
            signals.wait()
    except Error as error:
        print(error, file=sys.stderr)
        sys.exit(_USAGE if isinstance(error, Refused) else _INFRASTRUCTURE)
    sys.exit(0)


class _Signals:
    """Waits for SIGINT, SIGTERM or SIGHUP, whichever thread of the process receives the signal."""

    def __init__(self) -> None:
        self._wanted = [signal.SIGINT, signal.SIGTERM]
        if signal.getsignal(signal.SIGHUP) != signal.SIG_IGN:  # nohup ignores this signal
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
        # Python's threads may be stuck now, so a second signal must end the process directly.
        for each in self._wanted:
            signal.signal(each, signal.SIG_DFL)

    def __exit__(self, *_: Any) -> None:
        for each, handler in zip(self._wanted, self._handlers):
            signal.signal(each, handler)
        signal.set_wakeup_fd(self._fd)
        self._received.close()
        self._written.close()
