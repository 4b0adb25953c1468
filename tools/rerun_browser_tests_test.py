"""Tests tools/rerun_browser_tests with tests that pass only the second time, run by a real ctest."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOL = Path(__file__).parent / "rerun_browser_tests"
PASSES_THE_SECOND_TIME = "test -e ran || { touch ran; echo too slow; false; }"


class RerunBrowserTests(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.build = Path(folder.name)
        self.junit = self.build / "junit.xml"

    def run_twice(self, tests):
        """Runs ctest and then the tool. `tests` maps a name to a shell command and a label."""
        lines = [f'add_test([=[{name}]=] "sh" "-c" [=[{command}]=])\n'
                 f'set_tests_properties([=[{name}]=] PROPERTIES LABELS "{label}")\n'
                 for name, (command, label) in tests.items()]
        (self.build / "CTestTestfile.cmake").write_text("".join(lines))
        subprocess.run(["ctest", "--test-dir", self.build, "--output-junit", self.junit],
                       capture_output=True, check=False, timeout=60)
        return subprocess.run([sys.executable, TOOL, self.build, self.junit],
                              capture_output=True, text=True, check=False, timeout=60)

    def test_a_browser_test_that_passes_alone_counts_as_passed_and_is_called_unstable(self):
        done = self.run_twice({"page": (PASSES_THE_SECOND_TIME, "browser"), "units": ("true", "")})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("unstable (failed beside other tests, passed alone): page", done.stdout)
        self.assertNotIn('status="fail"', self.junit.read_text())

    def test_a_browser_test_that_fails_twice_fails(self):
        done = self.run_twice({"page": ("echo wrong colour; false", "browser")})
        self.assertEqual(done.returncode, 1)
        self.assertIn('status="fail"', self.junit.read_text())

    def test_no_test_runs_again_if_a_test_without_the_label_failed(self):
        done = self.run_twice({"page": (PASSES_THE_SECOND_TIME, "browser"), "hash": ("false", "determinism")})
        self.assertEqual(done.returncode, 1)
        self.assertNotIn("Second run", done.stdout)


if __name__ == "__main__":
    unittest.main()
