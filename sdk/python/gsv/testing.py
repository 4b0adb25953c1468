"""A simulator of one's own for tests: `gsv serve` with a private broker, on ports that the system
chooses. With pytest, name this module in conftest.py and take the fixture `simulate`:

    pytest_plugins = ["gsv.testing"]                        # conftest.py

    def test_gets_somewhere(simulate):                      # test_circle.py
        simulation = simulate("playground", seed=1)
        simulation.add("pebble", behaviour=Circle)
        simulation.run_until(10)
        assert simulation.state().robots["pebble"].distance > 1

A behaviour that is a program, in whatever language, is started with `simulator.start("gsv-wander")`
and named: `behaviour="wander"`.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any, Callable, Iterator

from gsv.applications import Application, Simulation
from gsv.errors import NotFound, Unavailable

_PACKAGE = Path(__file__).absolute().parent


def find_program(name: str) -> str:
    """A program of gsv: beside the `gsv` that $GSV_PROGRAM names, in the installation that this package
    is of, or on the PATH; a path is taken as it is."""
    if os.sep in name:
        return name
    folders = [str(Path(os.environ["GSV_PROGRAM"]).parent)] if "GSV_PROGRAM" in os.environ else []
    folders += [str(folder / "bin") for folder in _PACKAGE.parents]
    for path in [os.pathsep.join(folders), os.environ.get("PATH", os.defpath)]:
        found = shutil.which(name, path=path)
        if found:
            return found
    raise NotFound(f"there is no program {name} here; put GSV's programs on the PATH, or have "
                   "GSV_PROGRAM say where gsv is")


class PrivateSimulator:
    """`gsv serve` with a broker of its own, for as long as the `with` lasts. `options` are further
    ones of `gsv serve`, such as "--model-path"."""

    def __init__(self, *options: str) -> None:
        self._children: list[subprocess.Popen[str]] = []
        self._complaints: list[Any] = []
        try:
            line = self._run("broker: ", find_program("gsv"), "serve", "--headless", *options)
            self.broker = line.removeprefix("broker: ")
            self.application = Application(self.broker)
        except BaseException:
            self.close()
            raise

    def create(self, world: str = "", **request: Any) -> Simulation:
        """As Application.create()."""
        return self.application.create(world, **request)

    def start(self, program: str, *options: str) -> None:
        """Starts a program that offers a behaviour, and waits until it does."""
        path = find_program(program)
        command = [sys.executable, path] if path.endswith(".py") else [path]
        self._run("offered at", *command, *options)

    def close(self) -> None:
        for child in reversed(self._children):  # the server last
            child.terminate()
            child.wait()
            assert child.stdout
            child.stdout.close()
        for complaints in self._complaints:
            complaints.close()
        self._children, self._complaints = [], []

    def __enter__(self) -> PrivateSimulator:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def _run(self, awaited: str, *command: str) -> str:
        """Starts a program that ends with this one, and gives its first line that holds `awaited`."""
        environment = dict(os.environ)
        if self._children:
            environment["GSV_BROKER"] = self.broker
        complaints = tempfile.TemporaryFile("w+")
        self._complaints.append(complaints)
        child = subprocess.Popen(["setpriv", "--pdeathsig", "TERM", *command], text=True,
                                 stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                 stderr=complaints, env=environment)
        self._children.append(child)
        assert child.stdout
        for line in child.stdout:
            if awaited in line:
                return line.strip()
        complaints.seek(0)
        raise Unavailable(f"{' '.join(command)} ended with exit code {child.wait()}: "
                          f"{complaints.read().strip()}")


try:
    import pytest
except ImportError:  # PrivateSimulator serves without
    pass
else:

    @pytest.fixture(scope="session")
    def simulator() -> Iterator[PrivateSimulator]:
        """One for all tests of the session."""
        with PrivateSimulator() as private:
            yield private

    @pytest.fixture
    def simulate(simulator: PrivateSimulator) -> Iterator[Callable[..., Simulation]]:
        """Creates simulations, as Application.create(), that are destroyed with the test."""
        created: list[Simulation] = []

        def create(world: str = "", **request: Any) -> Simulation:
            created.append(simulator.create(world, **request))
            return created[-1]

        yield create
        for simulation in created:
            simulation.destroy()
