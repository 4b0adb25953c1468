"""Robotic applications: programs that create, run and observe simulations on a server."""

from __future__ import annotations

import os
from typing import Any, Callable, Mapping, Optional

from gsv import _native
from gsv._ending import end_at_exit
from gsv.errors import Refused


class Simulation(_native.Simulation):
    """A simulation on a server. It is destroyed at the end of the `with`, or when Python deletes
    the last reference to this object."""

    def __enter__(self) -> Simulation:
        return self

    def __exit__(self, *_: Any) -> None:
        self.destroy()

    def run_for(self, duration: float, *, patience: float = 600.0) -> None:
        """Runs for `duration` simulated seconds, and pauses."""
        self.run_until(self.state().time + duration, patience=patience)

    def run_until_true(self, condition: Callable[[_native.SimulationState], bool], *,
                       at_most: float, every: float = 0.1) -> Optional[_native.SimulationState]:
        """Runs until `condition(state)` is true, and returns this state. The condition is checked
        after each `every` simulated seconds. Returns None if it stays false for `at_most` simulated
        seconds. In lockstep, equal runs stop at the same instant."""
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
    """A connection to a broker. It creates simulations on the servers that the broker knows."""

    def create(self, world: str = "", *, constraint: str = "", preference: str = "first",
               lockstep: bool = True, factor: float = 1.0, step: float = 0.0, seed: int = 0,
               name: str = "", options: Mapping[str, str] = {}) -> Simulation:
        """Creates a simulation of `world` on a server whose offer matches `constraint` (with the
        properties in docs/services.md). If several match, `preference` ("first", "min load",
        "random") decides. In lockstep, the simulation is reproducible and as fast as possible;
        otherwise it runs with the target real-time factor `factor`; 0 means that of the world. `step`
        is in seconds; 0 means the step of the world. `options` are those of sba::SimulationSpecification: "on_failure", "deadline_s",
        "abandoned_after_s"."""
        simulation = Simulation(self, world, constraint, preference, lockstep, factor, step, seed,
                                name, dict(options))
        end_at_exit(simulation, _native.Simulation.destroy)
        return simulation


def connect(broker: str = "") -> Application:
    """Connects to `broker` (corbaloc::1.2@HOST:PORT/TradingService); if it is empty, to the broker
    that the variable GSV_BROKER names."""
    broker = broker or os.environ.get("GSV_BROKER", "")
    if not broker:
        raise Refused("no broker was named: pass its reference, or set GSV_BROKER; "
                      "gsv broker prints one")
    return Application(broker)
