"""The rows of bench/all: the command of each row, and its target value."""

import functools
import json
import os
import re
import shutil
import subprocess
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Optional

HERE = Path(__file__).resolve().parent
EMPTY_WORLD = '<sdf version="1.9"><world name="empty"></world></sdf>\n'
SHORT_SCENARIO = {"world": "playground", "duration": 0.1,
                  "robots": [{"name": "r", "model": "pebble", "x": 0, "y": 0}],
                  "expect": [{"name": "stays", "stays_within": {"robot": "r", "x": [-0.5, 0.5]}}]}
SMALL_MODEL = """<model name="m{0}"><static>true</static><pose>{1} {2} 0 0 0 0</pose><link name="l">
<collision name="c"><geometry><box><size>0.{0} 0.2 0.3</size></box></geometry></collision>
<visual name="v"><geometry><box><size>0.{0} 0.2 0.3</size></box></geometry></visual></link></model>"""


@dataclass
class Measured:
    value: float
    beside: Optional[float] = None
    hash: str = ""


@dataclass
class Row:
    name: str
    unit: str
    wanted: float
    is_more_better: bool
    run: Callable[[], Measured]
    beside: str = ""  # the operation that is measured for comparison; empty: none
    why_not: str = ""  # reason why the row runs only if --rows names it; empty for a row that always runs


def timed(command, cwd=None):
    """Returns processor time and wall-clock time of a program and of its child processes, in s."""
    start = time.monotonic()
    process = subprocess.Popen(command, cwd=cwd, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    errors = process.stderr.read().decode()
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 0, f"{' '.join(map(str, command))}: {errors.strip()}"
    return used.ru_utime + used.ru_stime, time.monotonic() - start


def median_of(times, command, which, cwd=None):
    return sorted(timed(command, cwd)[which] for _ in range(times))[times // 2]


class Benches:
    def __init__(self, gsv, folder, is_quick):
        self.gsv, self.folder, self.is_quick = gsv, folder, is_quick
        self.broker_figures, self.used_figures = {}, set()
        (folder / "empty.sdf").write_text(EMPTY_WORLD)
        (folder / "s.yaml").write_text(json.dumps(SHORT_SCENARIO))
        models = "\n".join(SMALL_MODEL.format(i + 1, i % 40, i // 40) for i in range(1000))
        (folder / "models.sdf").write_text(f'<sdf version="1.9"><world name="w">{models}</world></sdf>\n')

    def bench(self, *arguments):
        command = [self.gsv, "bench", *arguments, "--json"]
        output = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout
        objects = [json.loads(line) for line in output.splitlines() if line.startswith("{")]
        assert objects, f"{' '.join(command)}: printed no JSON"
        return objects

    def seconds(self, whole):
        return str(max(1, whole // 10) if self.is_quick else whole)

    def crowd(self, robots, threads):
        row = self.bench("crowd", "--robots", str(robots), "--threads", str(threads), "--duration",
                         self.seconds(20))[-1]["rows"][0]
        return Measured(row["real_time_factor"], hash=row["state_hash"])

    def compiled(self, name, *libraries):
        """Returns the program that is built from bench/NAME.cc."""
        program = self.folder / name
        if not program.exists():
            compiler = os.environ.get("CXX") or shutil.which("c++")
            subprocess.run([compiler, "-O2", "-std=c++20", "-w", HERE / f"{name}.cc", "-o", program, *libraries],
                           check=True)
        return program

    def bare(self, operation):
        """Measures an operation of this machine without GSV, see bench/bare.cc."""
        program = self.compiled("bare", "-lembree3", "-pthread")
        return float(subprocess.run([program, operation], check=True, stdout=subprocess.PIPE, text=True).stdout)

    def lockstep(self, index, calls):
        """Returns the real-time factor, and for comparison that of a bare futex per call (5 robots, 20 Hz)."""
        row = self.bench("lockstep", "--robots", "5", "--duration", self.seconds(60))[-1]["rows"][index]
        handover = self.compiled("handover")
        bare = float(subprocess.run([handover], check=True, stdout=subprocess.PIPE, text=True).stdout)
        return Measured(row["real_time_factor"], 1e9 / (bare * 20 * 5 * calls), row["state_hash"])

    def typical(self, robots):
        """Returns the real-time factor after the start, or the fraction of executed control cycles if it is smaller.

        A cycle takes 0.05 s. Robots whose behaviours are late miss cycles, and do not slow down the steps.
        """
        row = self.bench("typical", "--exchange", "--robots", str(robots), "--duration",
                         self.seconds(30))[-1]["rows"][0]
        return Measured(min(row["real_time_factor_after_start"], row["cycles_per_robot_s"] / 20))

    def images(self, size, pixels):
        """Also measures a comparison: two threads fill images of this size with one colour and one depth."""
        images = self.bench("camera", "--cameras", "64", "--size", size, "--duration", self.seconds(10))
        return Measured(images[-1]["pictures_per_s"], self.bare("fill") * 320 * 240 / pixels)

    def lidar(self):
        rays = self.bench("lidar", "--duration", self.seconds(10))[-1]["rays_per_s"] / 1e6
        return Measured(rays, self.bare("rays"))

    def short_run(self, which):
        """Returns the processor time (0) or wall-clock time (1) of a run from its start to its verdict."""
        command = [self.gsv, "run", self.folder / "s.yaml", "--lockstep", "--headless"]
        return Measured(median_of(5, command, which))

    def campaign(self, which, runs_of_row):
        """Returns the processor time (0) or wall-clock time (1) of many runs, extrapolated from some of them."""
        runs = 20 if self.is_quick else 300
        (self.folder / "c.yaml").write_text(
            json.dumps({"scenario": "s.yaml", "parameters": {"seed": {"from": 1, "to": runs}}}))
        for file in self.folder.glob("c.sqlite*"):
            file.unlink()
        times = timed([self.gsv, "campaign", "run", "c.yaml", "--json", "--jobs", "2"], self.folder)
        return Measured(times[which] * runs_of_row / runs)

    def start(self, *arguments):
        return Measured(median_of(9, [self.gsv, *arguments], 0), median_of(9, ["/bin/true"], 0))

    def broker(self, figure):
        """Returns one figure of the broker over TCP. A run of the bench takes a minute and measures all figures."""
        if not self.broker_figures or figure in self.used_figures:
            offers = "5000" if self.is_quick else "100000"
            self.broker_figures, self.used_figures = self.bench("broker", "--offers", offers)[-1], set()
        self.used_figures.add(figure)
        bare = self.bare("columns") if figure == "query_scan_p50_ms" else None
        return Measured(self.broker_figures[figure], bare)

    def recording(self):
        """Returns the speed of a run that records all topics except images, as a fraction of its speed without recording."""
        out = self.folder / "recording.json"
        sonars = [f"/robot_{robot}/sonar_0{sonar}" for robot in range(100) for sonar in range(8)]
        topics = ["/clock", "/diagnostics", "/gsv/", "/rosout", "/tf", "/tf_static", *sonars]
        subprocess.run([HERE / "recording", Path(self.gsv).parent.parent, out, "--topics", ",".join(topics),
                        "--seconds", self.seconds(20), "--pairs", "3"],
                       check=True, stdout=subprocess.DEVNULL)
        result = json.loads(out.read_text())
        assert result["same_hash"], "a recording changes the run"
        return Measured(1 / (1 + result["median_extra_percent"] / 100), hash=result["runs"][0]["with"]["state_hash"])

    def load(self, world):
        """Returns the processor time of a run, and for comparison that of a run with an empty world."""
        command = [self.gsv, "run", "--headless", "--lockstep", "--duration", "0.01"]
        return Measured(median_of(3, [*command, world], 0), median_of(3, [*command, self.folder / "empty.sdf"], 0))

    def house(self):
        """Measures the load of a world of ROBOTIS's turtlebot3_gazebo, which is not part of GSV."""
        folder = os.environ.get("GSV_REAL_DIR", "/usr/share/gsv-real")
        world = Path(folder, "turtlebot3/worlds/turtlebot3_house.world")
        assert world.exists(), f"no {world}; GSV_REAL_DIR names the folder"
        return self.load(world)

    def build(self):
        """Returns the wall-clock time to build what `make run` builds from nothing, without a compiler cache."""
        cache = (Path(self.gsv).parent.parent / "CMakeCache.txt").read_text()
        source = re.search("^CMAKE_HOME_DIRECTORY:INTERNAL=(.*)$", cache, re.MULTILINE)[1]
        environment = {**os.environ, "CCACHE_DISABLE": "1"}

        def cmake(*arguments):
            subprocess.run(["cmake", *arguments], check=True, env=environment, stdout=subprocess.DEVNULL)

        with tempfile.TemporaryDirectory(dir=self.folder) as build:
            start = time.monotonic()
            cmake("-S", source, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release")
            # GSV's first version has no target `docs`.
            has_docs = subprocess.run(["ninja", "-C", build, "-t", "query", "docs"], capture_output=True).returncode == 0
            cmake("--build", build, "--target", "programs", *(["docs"] if has_docs else []),
                  "--parallel", str(len(os.sched_getaffinity(0))))
            return Measured((time.monotonic() - start) / 60)


def rows(gsv, folder, is_quick):
    b = Benches(gsv, folder, is_quick)
    empty = ("run", str(folder / "empty.sdf"), "--headless", "--lockstep", "--duration", "0.01")
    crowds = [Row(f"crowd {robots}, {threads} thread{'s' if threads > 1 else ''}", "× real time", wanted, True,
                  functools.partial(b.crowd, robots, threads))
              for robots, wanted in ((100, 900), (1000, 80), (5000, 12), (20000, 3)) for threads in (1, 2)]
    return [
        Row("start: gsv --version", "s of processor time", 0.01, False, lambda: b.start("--version"), "/bin/true"),
        Row("start: gsv run, empty world", "s of processor time", 0.08, False, lambda: b.start(*empty), "/bin/true"),
        Row("short scenario: gsv run", "s", 0.2, False, lambda: b.short_run(1)),
        Row("short scenario: gsv run, processor", "s of processor time", 0.2, False, lambda: b.short_run(0)),
        Row("short scenario: in a campaign", "s of processor time", 0.03, False, lambda: b.campaign(0, 1)),
        Row("campaign of 10,000 runs", "s", 250, False, lambda: b.campaign(1, 10_000)),
        *crowds,
        Row("lockstep 5, separate calls", "× real time", 250, True, lambda: b.lockstep(0, 1), "a futex a cycle"),
        Row("lockstep 5, exchange", "× real time", 900, True, lambda: b.lockstep(1, 1), "a futex a cycle"),
        Row("typical 800, exchange", "× real time", 0.99, True, lambda: b.typical(800)),
        Row("typical 1000, exchange", "× real time", 0.99, True, lambda: b.typical(1000)),
        Row("typical 2000, exchange", "× real time", 0.99, True, lambda: b.typical(2000)),
        Row("images 64 × 320×240", "a second", 900, True, lambda: b.images("320x240", 320 * 240), "filled"),
        Row("images 64 × 640×480", "a second", 300, True, lambda: b.images("640x480", 640 * 480), "filled"),
        Row("lidar, 360 rays of 10 m", "million rays a second", 35, True, b.lidar, "Embree"),
        Row("broker: scan, p50", "ms", 2, False, lambda: b.broker("query_scan_p50_ms"), "a pass over columns"),
        Row("broker: scan, processor", "ms of processor time", 2, False, lambda: b.broker("query_scan_cpu_ms")),
        Row("broker: bytes an offer", "bytes", 400, False, lambda: b.broker("bytes_per_offer")),
        Row("broker: durable exports", "a second", 15000, True, lambda: b.broker("exports_durable_per_s")),
        Row("recording 100, all but images", "of the speed without", 0.5, True, b.recording),
        Row("read a world of 1,000 models", "s of processor time", 1, False,
            lambda: b.load(folder / "models.sdf"), "an empty world"),
        Row("read the TurtleBot3 house", "s of processor time", 0.25, False, b.house, "an empty world",
            why_not="" if "GSV_REAL_DIR" in os.environ else "needs GSV_REAL_DIR"),
        Row("build for make run", "min", 4, False, b.build, why_not="takes ten minutes"),
    ]
