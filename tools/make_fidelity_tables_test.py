#!/usr/bin/env python3
"""Tests of make_fidelity_tables."""

import importlib.machinery
import importlib.util
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

sys.dont_write_bytecode = True
SCRIPT = str(Path(__file__).parent / "make_fidelity_tables")
loader = importlib.machinery.SourceFileLoader("make_fidelity_tables", SCRIPT)
tables = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
loader.exec_module(tables)

PAGE = """# Title
| Body | Moved by |
|---|---|
| a | `b` |

| Expected | Bound | Seen | Test |
|---|---|---|---|
| it falls | old | old | `Ball.Falls*`, `Cone.Sounds` |
| it holds | to the bit | | `Ball.Rests` |

After."""


def outcome(name, inside="", **within):
    suite, test = name.rsplit(".", 1)
    properties = "".join(f'<property name="within {key.replace("_", " ")}" value="{value}"/>'
                         for key, value in within.items())
    return tables.Outcome(ElementTree.fromstring(
        f'<testcase classname="{suite}" name="{test}"><properties>{properties}</properties>{inside}</testcase>'))


class MakeFidelityTables(unittest.TestCase):
    def setUp(self):
        self.falls, self.holds = tables.read_rows(PAGE)

    def test_reads_rows_of_its_own_tables_alone(self):
        self.assertEqual(self.falls.names, ["Ball.Falls*", "Cone.Sounds"])
        self.assertEqual((self.falls.number, self.holds.number), (7, 8))

    def test_takes_the_largest_error_of_each_bound_and_unit(self):
        cells, problems = tables.fill(self.falls, [
            outcome("Ball.FallsFar", **{"1e-09_m": "2.34e-13", "0.5_%": "0.1"}),
            outcome("Many/Cone.Sounds/deep", **{"1e-09_m": "1.11e-12"}),
            outcome("Many/Cone.Sounds/high", **{"2_°": "0"}),
            outcome("Cone.SoundsElsewhere", **{"7_m": "7"})])
        self.assertEqual(problems, [])
        self.assertEqual(cells, ["it falls", "1e-9 m; 0.5 %; 2°", "1.1e-12 m; 0.1 %; 0°",
                                 "`Ball.Falls*`, `Cone.Sounds`"])

    def test_keeps_the_bound_of_what_leaves_nothing_behind(self):
        cells, problems = tables.fill(self.holds, [outcome("Ball.Rests")])
        self.assertEqual((cells[1:3], problems), (["to the bit", "holds"], []))

    def test_wants_a_bound_of_what_leaves_nothing_behind(self):
        _, problems = tables.fill(tables.Row(0, ["it holds", "", "", "`Ball.Rests`"]), [outcome("Ball.Rests")])
        self.assertEqual(problems, ["its tests leave no errors behind, and no bound is written"])

    def test_names_what_is_missing_and_what_failed(self):
        _, problems = tables.fill(self.falls, [outcome("Ball.FallsFar", inside="<failure/>")])
        self.assertEqual(problems, ["Ball.FallsFar failed", "no test is called Cone.Sounds"])

    def test_leaves_the_row_of_a_skipped_test_alone(self):
        cells, problems = tables.fill(self.holds, [outcome("Ball.Rests", inside="<skipped/>")])
        self.assertEqual((cells[2], problems), ("", []))

    def test_reads_the_reports_that_the_tests_left(self):
        with tempfile.TemporaryDirectory() as build:
            report = Path(build) / "test-reports" / "Many" / "Ball.Falls" / "0.xml"
            report.parent.mkdir(parents=True)
            report.write_text("""<?xml version="1.0"?><testsuites><testsuite name="Many/Ball">
                <testcase name="Falls/0" status="run" result="completed" classname="Many/Ball">
                  <properties><property name="within 1e-09 m" value="3.2e-14"/></properties>
                </testcase>
                <testcase name="Rests" status="notrun" result="suppressed" classname="Many/Ball"/>
              </testsuite></testsuites>""")
            outcomes = tables.read_outcomes(build)
        self.assertEqual([(each.name, each.errors) for each in outcomes],
                         [("Many/Ball.Falls/0", {(1e-9, "m"): 3.2e-14})])

    def test_writes_numbers_as_people_do(self):
        for value, unit, expected in ((0.002, "m", "2 mm"), (1e-6, "m", "1 µm"), (1e-9, "m", "1e-9 m"),
                                      (0.0101, "m/s", "10.1 mm/s"), (3, "σ", "3 σ"), (1.5, "m", "1.5 m"),
                                      (0.01, "%", "0.01 %"), (6, "of 3,072 pixels", "6 of 3,072 pixels")):
            self.assertEqual(tables.written(value, unit), expected)
        for value, expected in ((2.2204e-16, "2.2e-16 m"), (1.8712e-4, "0.19 mm"), (5e-7, "0.5 µm"), (9.99e-4, "1 mm"), (0, "0 m")):
            self.assertEqual(tables.written(value, "m", 2), expected)
        self.assertEqual(tables.written(1234, "%", 2), "1200 %")


if __name__ == "__main__":
    unittest.main()
