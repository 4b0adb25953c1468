"""Robotic applications: find a simulator, create, add, run until, observe, assert."""

from __future__ import annotations

import os
from typing import Any, Callable, Mapping, Optional

from gsv import _native
from gsv._ending import end_at_exit
from gsv.errors import Refused


class Simulation(_native.Simulation):
    """A simulation on some server. It is destroyed when the `with` ends, or the last who holds it
    lets go."""

    def __enter__(self) -> Simulation:
        return self

    def __exit__(self, *_: Any) -> None:
        self.destroy()

    def run_for(self, duration: float, *, patience: float = 600.0) -> None:
        """Runs that many simulated seconds further and freezes there."""
        self.run_until(self.state().time + duration, patience=patience)

    def run_until_true(self, condition: Callable[[_native.SimulationState], bool], *,
                       at_most: float, every: float = 0.1) -> Optional[_native.SimulationState]:
        """Runs until `condition` of the state holds, looking every so many simulated seconds, and
        gives that state; None when it does not within `at_most` simulated seconds. In lockstep
        it stops at the same instant each time."""
        state = self.state()
        start, looks = state.time, 0
        while not condition(state):
            if state.time >= start + at_most:
                return None
            looks += 1
            self.run_until(min(start + looks * every, start + at_most))
            state = self.state()
        return state


class Application(_native.Application):
    """The broker, as an application uses it."""

    def create(self, world: str = "", *, constraint: str = "", preference: str = "first",
               lockstep: bool = True, factor: float = 1.0, step: float = 0.0, seed: int = 0,
               name: str = "", options: Mapping[str, str] = {}) -> Simulation:
        """A simulation of `world` on the first simulator, in the order of `preference` ("first",
        "min load", "random"), whose offer matches `constraint` (over the properties of
        docs/services.md). Lockstep: as fast as possible and repeating to the bit; otherwise `factor`
        times real time. `step` in seconds; 0: the world's. `options` are those of
        sba::SimulationSpecification: "on_failure", "deadline_s",
        "abandoned_after_s"."""
        simulation = Simulation(self, world, constraint, preference, lockstep, factor, step, seed,
                                name, dict(options))
        end_at_exit(simulation, _native.Simulation.destroy)
        return simulation


def connect(broker: str = "") -> Application:
    """The broker at `broker` (corbaloc::1.2@HOST:PORT/TradingService), or at $GSV_BROKER."""
    broker = broker or os.environ.get("GSV_BROKER", "")
    if not broker:
        raise Refused("no broker was named: pass its reference, or set GSV_BROKER; "
                      "gsv broker prints one")
    return Application(broker)
