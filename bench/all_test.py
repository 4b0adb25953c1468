#!/usr/bin/env python3
"""Tests of bench/all: its table, its checks, its options, and the comparison of two versions.

usage: all_test.py [GSV]

GSV is the program gsv of a build. Without it, the tests that run its benches are skipped.
"""

import contextlib
import importlib.machinery
import importlib.util
import io
import json
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

sys.dont_write_bytecode = True
HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
loader = importlib.machinery.SourceFileLoader("bench_all", str(HERE / "all"))
bench = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
loader.exec_module(bench)
from bench_rows import Measured, Row, rows  # noqa: E402

GSV = sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else None
# A source tree whose targets leave a file in the folder `built`. As in GSV, another target depends on them.
SIMPLE_SOURCE = """cmake_minimum_required(VERSION 3.20)
project(simple NONE)
foreach(NAME {0})
  add_custom_target(${{NAME}} COMMAND ${{CMAKE_COMMAND}} -E touch ${{CMAKE_SOURCE_DIR}}/built/${{NAME}})
endforeach()
add_custom_target(installed)
add_dependencies(installed {0})
"""


def simple_gsv(speed, state_hash, factor="real_time_factor_after_start", rest="exit 0"):
    """Returns a shell script that prints fixed values for two benches, and runs `rest` for other commands."""
    return f"""#!/bin/sh
case "$1 $2" in
--version*) echo gsv 0.0.1 ;;
"bench crowd") echo '{{"rows":[{{"real_time_factor":{speed},"state_hash":"{state_hash}"}}]}}' ;;
"bench typical") echo '{{"rows":[{{"{factor}":1,"cycles_per_robot_s":20}}]}}' ;;
*) {rest} ;;
esac
"""


def run_rows(row, beside=None, times=3, other=None):
    measured = {}
    with contextlib.redirect_stderr(io.StringIO()):
        for _ in range(times):
            bench.run_once(row, measured, beside, other)
    return measured


def run_main(build, *options):
    """Runs bench/all. Returns its exit code, what it prints on stdout and stderr, and its JSON."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder, "out.json")
        with contextlib.redirect_stdout(io.StringIO()) as output, contextlib.redirect_stderr(io.StringIO()) as errors, \
                unittest.mock.patch("sys.argv", ["bench/all", str(build), str(out), *map(str, options)]):
            try:
                code = bench.main()
            except SystemExit as stopped:
                code = stopped.code
        return code, output.getvalue(), errors.getvalue(), json.loads(out.read_text()) if out.exists() else None


def write_build(folder, gsv):
    """Writes a build folder with a program. Returns the folder."""
    program = Path(folder, "bin", "gsv")
    program.parent.mkdir(parents=True)
    program.write_text(gsv)
    program.chmod(0o755)
    return folder


class Table(unittest.TestCase):
    def test_has_median_range_and_ratio_of_the_same_repetition(self):
        pairs = iter([(10, 5), (40, 10), (30, 10)])
        row = Row("speed", "a second", 35, True, lambda: Measured(*next(pairs)), "bare")
        text = bench.line(row, run_rows(row))
        self.assertEqual(text, "| speed | 30 (10 to 40) a second | 35 | no | bare: 10 (5 to 10) | 3 |")

    def test_reaches_what_is_wanted_in_its_own_direction(self):
        for value, is_more, sign in ((2, True, "yes"), (2, False, "no"), (0.5, False, "yes"), (1, True, "yes")):
            row = Row("r", "s", 1, is_more, lambda value=value: Measured(value))
            self.assertIn(f"| 1 | {sign} |", bench.line(row, run_rows(row, times=1)))

    def test_a_bench_that_fails_is_a_row_and_a_problem(self):
        def fail():
            raise AssertionError("no such program")

        row = Row("r", "s", 1, False, fail)
        measured = {"r": run_rows(row)}
        self.assertIn("| r | failed | 1 s |", bench.table([row], measured))
        self.assertEqual(list(bench.problems(measured)), ["r: failed: no such program"])

    def test_a_row_that_did_not_run_says_why(self):
        row = Row("r", "min", 4, False, lambda: Measured(1), why_not="takes ten minutes")
        self.assertIn("| r | not run: takes ten minutes | 4 min |", bench.table([row], {}))

    def test_different_hashes_are_a_problem(self):
        hashes = iter(["a", "b", "a"])
        row = Row("r", "s", 1, False, lambda: Measured(1, hash=next(hashes)))
        self.assertEqual(list(bench.problems({"r": run_rows(row)})), ["r: different hashes: a, b"])

    def test_a_command_beside_gives_its_last_number(self):
        row = Row("r", "s", 1, False, lambda: Measured(6))
        self.assertEqual(run_rows(row, "echo took 2 steps 3 times")["beside"], [3, 3, 3])


class Options(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.build = write_build(folder.name, "#!/bin/sh\n")

    def test_an_unknown_row_is_refused_with_the_names_of_all_rows(self):
        for rows in ("foo", "start,foo", "foo,start"):
            code, _, text, _ = run_main(self.build, "--rows", rows)
            self.assertEqual(code, 2)
            self.assertEqual(text.count("\n"), 1)
            self.assertIn('there is no row "foo"; the rows are "start: gsv --version", ', text)
            self.assertIn('"build for make run"', text)

    def test_a_command_beside_a_row_that_does_not_run_is_refused(self):
        code, _, text, _ = run_main(self.build, "--rows", "start: gsv --v", "--beside", "lidar=echo 1")
        self.assertEqual(code, 2)
        self.assertIn('the row "lidar", which does not run; these rows run: "start: gsv --version".', text)

    def test_a_command_beside_without_a_row_is_refused(self):
        code, _, text, _ = run_main(self.build, "--beside", "echo 1")
        self.assertEqual(code, 2)
        self.assertIn('--beside "echo 1" has no "="', text)

    def test_no_repetitions_are_refused(self):
        code, _, text, _ = run_main(self.build, "--repetitions", "0")
        self.assertEqual(code, 2)
        self.assertIn("--repetitions: expected 1 or more, found 0", text)

    def test_a_file_that_cannot_be_written_is_refused_before_the_measurements(self):
        with self.assertRaises(SystemExit) as end, contextlib.redirect_stderr(io.StringIO()) as errors:
            with unittest.mock.patch.object(sys, "argv", ["all", str(self.build), "/nowhere/out.json"]):
                bench.main()
        self.assertEqual(end.exception.code, 2)
        self.assertEqual(errors.getvalue(), "bench/all: cannot write /nowhere/out.json: No such file or directory.\n")

    def test_a_folder_without_gsv_is_refused(self):
        for options in (("/nowhere",), (self.build, "--against", "/nowhere")):
            code, _, text, _ = run_main(*options)
            self.assertEqual(code, 2)
            self.assertIn("cannot run /nowhere/bin/gsv", text)

    def test_rows_are_selected_by_the_beginning_of_their_names_also_with_commas(self):
        names = ("crowd 100, 1 thread", "crowd 100, 2 threads", "lidar, 360")
        rows = [Row(name, "s", 1, False, None) for name in names]
        for text, found in (("lidar", [2]), ("crowd", [0, 1]), ("crowd 100, 2 threads, lidar", [1, 2]),
                            ("lidar, 360,crowd 100, 1", [0, 2]), ("", []), ("lidar,", [2])):
            self.assertEqual(bench.selected(rows, text), [rows[i] for i in found], text)


class OtherVersion(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.ours = write_build(self.folder / "ours", simple_gsv(60, "a"))
        self.theirs = write_build(self.folder / "theirs", simple_gsv(20, "b"))

    def test_runs_after_each_run_of_this_version(self):
        order = []
        row = Row("r", "s", 1, False, lambda: order.append("ours") or Measured(1))
        other = Row("r", "s", 1, False, lambda: order.append("theirs") or Measured(2))
        run_rows(row, times=2, other=other)
        self.assertEqual(order, ["ours", "theirs", "ours", "theirs"])

    def test_ratio_is_the_median_of_how_many_times_better_each_repetition_is(self):
        for is_more, ratios, median in ((True, [2, 8, 0.5], 2), (False, [0.5, 0.125, 2], 0.5)):
            ours, theirs = iter([10, 40, 30]), iter([5, 5, 60])
            row = Row("r", "s", 1, is_more, lambda: Measured(next(ours)))
            against = run_rows(row, other=Row("r", "s", 1, is_more, lambda: Measured(next(theirs))))["against"]
            self.assertEqual(against, {"values": [5, 5, 60], "ratios": ratios, "ratio": median})
            self.assertEqual(bench.other_cells(against), f" 5 (5 to 60) | {median} |")

    def test_adds_two_columns_and_names_itself(self):
        code, table, _, result = run_main(self.ours, "--against", self.theirs, "--quick", "--rows", "crowd 100,lidar")
        self.assertEqual(code, 1, "this version cannot run the row lidar")
        self.assertIn("| Beside | Ratio | Other version | Ratio |\n|---|---|---|---|---|---|---|---|\n", table)
        self.assertIn("| crowd 100, 1 thread | 60 × real time | 900 | no |  |  | 20 | 3 |\n", table)
        self.assertIn("| lidar, 360 rays of 10 m | failed | 35 million rays a second | | | | | |\n", table)
        self.assertEqual(result["against"], {"build": str(self.theirs), "gsv": "gsv 0.0.1"})
        self.assertEqual(result["rows"]["crowd 100, 1 thread"]["against"],
                         {"values": [20], "ratios": [3], "ratio": 3, "hashes": ["b"], "same_hash": False})

    def test_different_hashes_are_a_note_and_no_problem(self):
        same = write_build(self.folder / "same", simple_gsv(20, "a"))
        for other, title in ((self.theirs, "Different hashes (versions may differ)"), (same, "Equal hashes")):
            code, table, errors, _ = run_main(self.ours, "--against", other, "--quick", "--rows", "crowd 100, 1 thread")
            self.assertEqual(code, 0, errors)
            self.assertIn(f" {title}: crowd 100, 1 thread.\n", table)

    def test_that_fails_or_prints_other_json_is_a_dash_with_a_reason(self):
        older = write_build(self.folder / "older",
                            simple_gsv(20, "a", "real_time_factor", "echo no such command >&2; exit 2"))
        rows = ("start: gsv run", "typical 800")
        code, table, errors, result = run_main(self.ours, "--against", older, "--quick", "--rows", ",".join(rows))
        self.assertEqual(code, 0, errors)
        missing = "the JSON of the program has no 'real_time_factor_after_start'"
        for row, why in zip(rows, ("no such command", missing)):
            [line] = [line for line in table.splitlines() if line.startswith("| " + row)]
            self.assertTrue(line.endswith(" | – |  |"), line)
            [line] = [line for line in errors.splitlines() if line.startswith(row) and "the other version: " in line]
            self.assertTrue(line.endswith(why), line)
        for row in result["rows"].values():
            self.assertEqual(list(row["against"]), ["errors"])

    @unittest.skipUnless(GSV, "needs the program gsv as an argument")
    def test_that_is_the_same_build_has_equal_hashes_and_a_ratio(self):
        build = Path(GSV).parent.parent
        code, table, errors, result = run_main(build, "--against", build, "--quick", "--rows",
                                               "start: gsv --version,crowd 100, 1 thread")
        self.assertEqual(code, 0, errors)
        self.assertEqual(result["against"]["gsv"], result["machine"]["gsv"])
        self.assertIn(" Equal hashes: crowd 100, 1 thread.\n", table)
        for name, each in result["rows"].items():
            [ours], [theirs], [ratio] = each["values"], each["against"]["values"], each["against"]["ratios"]
            self.assertGreater(theirs, 0)
            self.assertAlmostEqual(ratio, ours / theirs if name.startswith("crowd") else theirs / ours)
            self.assertIn(f" | {bench.short(theirs)} | {bench.short(ratio)} |\n", table)

    def test_is_built_from_its_own_sources_with_the_targets_that_it_has(self):
        for build, targets in ((self.ours, "programs docs"), (self.theirs, "programs")):
            source = self.folder / f"source_{build.name}"
            (source / "built").mkdir(parents=True)
            (source / "CMakeLists.txt").write_text(SIMPLE_SOURCE.format(targets))
            (build / "CMakeCache.txt").write_text(f"CMAKE_HOME_DIRECTORY:INTERNAL={source}\n")
        code, _, errors, result = run_main(self.ours, "--against", self.theirs, "--rows", "build", "--repetitions", "1")
        self.assertEqual(code, 0, errors)
        self.assertGreater(result["rows"]["build for make run"]["against"]["ratio"], 0)
        for build, built in ((self.ours, {"programs", "docs"}), (self.theirs, {"programs"})):
            files = (self.folder / f"source_{build.name}" / "built").iterdir()
            self.assertEqual({file.name for file in files}, built)


class Rows(unittest.TestCase):
    def test_have_names_of_their_own(self):
        with tempfile.TemporaryDirectory() as folder:
            names = [row.name for row in rows("/bin/true", Path(folder), True)]
        self.assertEqual(len(names), len(set(names)))
        self.assertGreater(len(names), 20)


if __name__ == "__main__":
    unittest.main()
