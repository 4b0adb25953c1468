#!/usr/bin/env python3
"""Tests of check_requirements.py."""

import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import check_requirements


def page(overrides=None):
    """Returns a page with one use case per requirement, each with the test Good.Test."""
    rows = {f"RQ{n}": f"| RQ{n}.1 | somebody does something | `Good.Test` |" for n in range(1, 13)}
    rows.update(overrides or {})
    return "".join(
        f"## {name} is required\n| Use case | What | Shown by |\n|---|---|---|\n{row}\n\n"
        for name, row in rows.items()
    )


# The three possible results in the format of ctest 3.25.
JUNIT = """<?xml version="1.0" encoding="UTF-8"?>
<testsuite name="(empty)" tests="3" failures="1" disabled="0" skipped="1">
  <testcase name="Good.Test" classname="Good.Test" time="0.1" status="run"/>
  <testcase name="Bad.Test" classname="Bad.Test" time="0.1" status="fail">
    <failure message=""/>
  </testcase>
  <testcase name="Skipped.Test" classname="Skipped.Test" time="0.1" status="notrun">
    <skipped message="SKIP_REGULAR_EXPRESSION_MATCHED"/>
  </testcase>
</testsuite>
"""


class CheckRequirements(unittest.TestCase):
    def run_on(self, text, junit=JUNIT, other=None):
        with tempfile.TemporaryDirectory() as folder:
            requirements, results = Path(folder, "requirements.md"), Path(folder, "junit.xml")
            requirements.write_text(text)
            results.write_text(junit)
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                pages = []
                if other is not None:
                    pages = [str(Path(folder, "other.md"))]
                    Path(pages[0]).write_text(other)
                code = check_requirements.main([str(requirements), str(results), *pages])
            return code, printed.getvalue()

    def assert_problem(self, overrides, sentence):
        code, printed = self.run_on(page(overrides))
        self.assertEqual(code, 1)
        self.assertIn(sentence, printed)
        self.assertEqual(len(printed.splitlines()), 2, printed)

    def test_is_content_when_every_named_test_passed(self):
        code, printed = self.run_on(page())
        self.assertEqual(code, 0)
        self.assertEqual(printed, "requirements: all 12 use cases are shown by tests that passed\n")

    def test_names_a_test_that_did_not_run(self):
        self.assert_problem(
            {"RQ2": "| RQ2.1 | x | `No.Such`, `Good.Test` |"},
            "requirements.md:9: RQ2.1: the test No.Such is not among the tests that ran",
        )

    def test_names_a_test_that_failed(self):
        self.assert_problem({"RQ3": "| RQ3.1 | x | `Bad.Test` |"}, "RQ3.1: the test Bad.Test failed")

    def test_a_skipped_test_shows_nothing(self):
        self.assert_problem(
            {"RQ4": "| RQ4.1 | x | `Skipped.Test` |"}, "RQ4.1: the test Skipped.Test was skipped"
        )

    def test_a_use_case_without_a_test_is_refused(self):
        self.assert_problem({"RQ5": "| RQ5.1 | x | later |"}, "RQ5.1 names no test")

    def test_a_requirement_without_a_use_case_is_refused(self):
        self.assert_problem({"RQ6": "nothing yet"}, "RQ6 has no use case")

    def test_an_identifier_stands_once_and_in_its_own_section(self):
        row = "| RQ7.1 | x | `Good.Test` |"
        self.assert_problem({"RQ7": f"{row}\n{row}"}, "RQ7.1 appears twice")
        self.assert_problem(
            {"RQ8": "| RQ8.1 | x | `Good.Test` |\n| RQ9.2 | x | `Good.Test` |"},
            "RQ9.2 stands in the section RQ8",
        )

    def test_tests_that_other_pages_name_must_have_passed(self):
        head = "| Who | Shown by |\n|---|---|\n"
        self.assertEqual(self.run_on(page(), other=f"{head}| x | `Good.Test` |\n| y | |")[0], 0)
        code, printed = self.run_on(page(), other=f"{head}| x | `Bad.Test`, `Good.Test` |")
        self.assertEqual(code, 1)
        self.assertIn("other.md:3: this row: the test Bad.Test failed", printed)
        # Text in another column, or in a table of another kind, names no test.
        code, printed = self.run_on(page(), other="| Name | At most |\n|---|---|\n| `Bad.Test` | 1 |")
        self.assertIn("no table here names a test", printed)

    def test_results_that_cannot_be_read_are_a_sentence(self):
        code, printed = self.run_on(page(), junit="<testsuite>")
        self.assertEqual(code, 1)
        self.assertIn("run the tests first", printed)


if __name__ == "__main__":
    unittest.main()
