"""Tests the output of tools/show_failures.py for a JUnit file."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOL = Path(__file__).parent / "show_failures.py"


def shown(junit):
    with tempfile.NamedTemporaryFile("w", suffix=".xml") as file:
        file.write(junit)
        file.flush()
        return subprocess.run(
            [sys.executable, TOOL, file.name], capture_output=True, text=True, check=True, timeout=60
        ).stdout


class ShowFailures(unittest.TestCase):
    def test_the_end_of_what_a_failed_test_said(self):
        said = "\n".join(f"line {number}" for number in range(1, 101))
        text = shown(
            '<testsuite><testcase name="A.Passes" status="run"><system-out>fine</system-out></testcase>'
            f'<testcase name="A.Fails" status="fail"><failure/><system-out>{said}</system-out></testcase>'
            '<testcase name="A.IsSkipped" status="notrun"/></testsuite>'
        )
        self.assertEqual(
            text, "A.Fails failed:\n" + "".join(f"  line {n}\n" for n in range(76, 101)) + "\n"
        )

    def test_nothing_where_all_passed(self):
        self.assertEqual(shown('<testsuite><testcase name="A.Passes" status="run"/></testsuite>'), "")


if __name__ == "__main__":
    unittest.main()
