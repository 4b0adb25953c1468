#!/usr/bin/env python3
"""Tests of bench/all: its table, its checks, and the options that it refuses. It runs no bench."""

import contextlib
import importlib.machinery
import importlib.util
import io
import sys
import tempfile
import unittest
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


class Rows(unittest.TestCase):
    def test_have_names_of_their_own(self):
        with tempfile.TemporaryDirectory() as folder:
            names = [row.name for row in rows("/bin/true", Path(folder), True)]
        self.assertEqual(len(names), len(set(names)))
        self.assertGreater(len(names), 20)


if __name__ == "__main__":
    unittest.main()
