#!/usr/bin/env python3
"""Tests of bench/all: its table, its checks, and the options that it refuses. It runs no bench."""

import contextlib
import importlib.machinery
import importlib.util
import io
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


def run_rows(row, beside=None, times=3):
    measured = {}
    with contextlib.redirect_stderr(io.StringIO()):
        for _ in range(times):
            bench.run_once(row, measured, beside)
    return measured


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
    def run_main(self, *options):
        """Runs bench/all with a program that does nothing. Returns its exit code and what it prints on stderr."""
        with tempfile.TemporaryDirectory() as build, contextlib.redirect_stderr(io.StringIO()) as errors:
            Path(build, "bin").mkdir()
            Path(build, "bin", "gsv").symlink_to("/bin/true")
            with unittest.mock.patch("sys.argv", ["bench/all", build, build + "/out.json", *options]):
                with contextlib.redirect_stdout(io.StringIO()), self.assertRaises(SystemExit) as stopped:
                    sys.exit(bench.main())
        return stopped.exception.code, errors.getvalue()

    def test_an_unknown_row_is_refused_with_the_names_of_all_rows(self):
        for options in (("--rows", "foo"), ("--rows", "start,foo"), ("--rows", "foo,start")):
            code, text = self.run_main(*options)
            self.assertEqual(code, 2)
            self.assertEqual(text.count("\n"), 1)
            self.assertIn('there is no row "foo"; the rows are "start: gsv --version", ', text)
            self.assertIn('"build for make run"', text)

    def test_a_command_beside_a_row_that_does_not_run_is_refused(self):
        code, text = self.run_main("--rows", "start: gsv --v", "--beside", "lidar=echo 1")
        self.assertEqual(code, 2)
        self.assertIn('the row "lidar", which does not run; these rows run: "start: gsv --version".', text)

    def test_rows_are_selected_by_the_beginning_of_their_names_also_with_commas(self):
        rows = [Row(name, "s", 1, False, None) for name in ("crowd 100, 1 thread", "crowd 100, 2 threads", "lidar, 360")]
        for text, names in (("lidar", [2]), ("crowd", [0, 1]), ("crowd 100, 2 threads, lidar", [1, 2]),
                            ("lidar, 360,crowd 100, 1", [0, 2]), ("", []), ("lidar,", [2])):
            self.assertEqual(bench.selected(rows, text), [rows[i] for i in names], text)


class Rows(unittest.TestCase):
    def test_have_names_of_their_own(self):
        with tempfile.TemporaryDirectory() as folder:
            names = [row.name for row in rows("/bin/true", Path(folder), True)]
        self.assertEqual(len(names), len(set(names)))
        self.assertGreater(len(names), 20)


if __name__ == "__main__":
    unittest.main()
