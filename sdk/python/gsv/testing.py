"""A private simulator for tests: `gsv serve` with its own broker, on ports that the system chooses.
With pytest, name this module in conftest.py and use the fixture `simulate`:

    pytest_plugins = ["gsv.testing"]                        # conftest.py

    def test_gets_somewhere(simulate):                      # test_circle.py
        simulation = simulate("playground", seed=1)
        simulation.add("pebble", behaviour=Circle)
        simulation.run_until(10)
        assert simulation.state().robots["pebble"].distance > 1

A scenario can also be a test (docs/testing.md):

    def test_keeps_off_the_walls(expect_passes):
        expect_passes("scenarios/wander.yaml")

If a behaviour is a program, in any language, start it with `simulator.start("gsv-wander")`. Then pass
its name: `behaviour="wander"`.
"""

from __future__ import annotations

import dataclasses
import json
import os
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Iterator, Union

from gsv.applications import Application, Simulation
from gsv.errors import BadModel, NotFound, Unavailable

_PACKAGE = Path(__file__).absolute().parent
_BAD_SCENARIO = 3  # exit code


def find_program(name: str) -> str:
    """Returns the path of the GSV program `name`. Searches beside $GSV_PROGRAM, in the installation of
    this package, and on the PATH. A `name` with a slash is returned unchanged."""
    if os.sep in name:
        return name
    folders = [str(Path(os.environ["GSV_PROGRAM"]).parent)] if "GSV_PROGRAM" in os.environ else []
    folders += [str(folder / "bin") for folder in _PACKAGE.parents]
    for path in [os.pathsep.join(folders), os.environ.get("PATH", os.defpath)]:
        found = shutil.which(name, path=path)
        if found:
            return found
    raise NotFound(f"there is no program {name} here; put GSV's programs on the PATH, or set "
                   "GSV_PROGRAM to the path of gsv")


class PrivateSimulator:
    """Runs `gsv serve` with its own broker until the `with` ends. `options` are additional options of
    `gsv serve`, such as "--model-path"."""

    def __init__(self, *options: str) -> None:
        self._children: list[subprocess.Popen[str]] = []
        self._error_files: list[Any] = []
        try:
            line = self._run("broker: ", find_program("gsv"), "serve", "--headless", *options)
            self.broker = line.removeprefix("broker: ")
            self.application = Application(self.broker)
        except BaseException:
            self.close()
            raise

    def create(self, world: str = "", **request: Any) -> Simulation:
        """Creates a simulation, see Application.create()."""
        return self.application.create(world, **request)

    def start(self, program: str, *options: str) -> None:
        """Starts a program that offers a behaviour, and waits for the offer."""
        path = find_program(program)
        command = [sys.executable, path] if path.endswith(".py") else [path]
        self._run("offered at", *command, *options)

    def close(self) -> None:
        for child in reversed(self._children):  # ends the server last
            child.terminate()
            child.wait()
            assert child.stdout
            child.stdout.close()
        for errors in self._error_files:
            errors.close()
        self._children, self._error_files = [], []

    def __enter__(self) -> PrivateSimulator:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def _run(self, awaited: str, *command: str) -> str:
        """Starts a program, which is terminated when this process ends. Returns the first line of
        its stdout that contains `awaited`."""
        environment = dict(os.environ)
        if self._children:
            environment["GSV_BROKER"] = self.broker
        errors = tempfile.TemporaryFile("w+")
        self._error_files.append(errors)
        child = subprocess.Popen(["setpriv", "--pdeathsig", "TERM", *command], text=True,
                                 stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                 stderr=errors, env=environment)
        self._children.append(child)
        assert child.stdout
        for line in child.stdout:
            if awaited in line:
                return line.strip()
        errors.seek(0)
        raise Unavailable(f"{' '.join(command)} ended with exit code {child.wait()}: "
                          f"{errors.read().strip()}")


@dataclass(frozen=True)
class ScenarioResult:
    """The result of `gsv test` for one scenario."""

    scenario: str
    status: str  # "passed", "failed", "error" or "interrupted"
    message: str  # the reason why the scenario has not passed; empty if it has passed
    folder: str  # the folder with the files of a failure; empty if there is none
    state_hashes: list[str]  # final state hash of each repetition
    report: dict[str, Any]  # the report of `gsv run --json`; empty if the run has no report


def run_scenarios(*arguments: Union[str, os.PathLike[str]]) -> list[ScenarioResult]:
    """Runs `gsv test ARGUMENT…` and returns one result per scenario. The arguments are files, folders
    and options such as "--repeat", "3". Raises BadModel with gsv's message if a file is missing or
    is not a scenario."""
    command = [find_program("gsv"), "test", "--json", *(os.fspath(each) for each in arguments)]
    done = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    if done.stdout:
        fields = [field.name for field in dataclasses.fields(ScenarioResult)]
        return [ScenarioResult(**{field: result[field] for field in fields})
                for result in json.loads(done.stdout)["results"]]
    error = BadModel if done.returncode == _BAD_SCENARIO else Unavailable
    raise error(done.stderr.strip() or f"gsv test ended with exit code {done.returncode}")


try:
    import pytest
except ImportError:  # PrivateSimulator does not need pytest
    pass
else:

    @pytest.fixture(scope="session")
    def simulator() -> Iterator[PrivateSimulator]:
        """Provides one simulator for all tests of the session."""
        with PrivateSimulator() as private:
            yield private

    @pytest.fixture
    def simulate(simulator: PrivateSimulator) -> Iterator[Callable[..., Simulation]]:
        """Creates simulations, like Application.create(), and destroys them at the end of the test."""
        created: list[Simulation] = []

        def create(world: str = "", **request: Any) -> Simulation:
            created.append(simulator.create(world, **request))
            return created[-1]

        yield create
        for simulation in created:
            simulation.destroy()

    @pytest.fixture
    def expect_passes(tmp_path: Path) -> Callable[..., list[ScenarioResult]]:
        """Runs scenarios like run_scenarios(), and fails the test if a scenario does not pass. The
        failure lists the messages of these scenarios. Their recordings are in the test's tmp_path."""

        def expect(*arguments: Union[str, os.PathLike[str]]) -> list[ScenarioResult]:
            results = run_scenarios("--failures", tmp_path / "gsv-failures", *arguments)
            failures = [f"{each.scenario}: {each.message}\n{each.folder}"
                        for each in results if each.status != "passed"]
            if failures:
                pytest.fail("\n".join(failures), pytrace=False)
            return results

        return expect
