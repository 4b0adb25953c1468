#!/usr/bin/env python3
"""Tests of make_man_pages.

usage: make_man_pages_test.py [GSV]

With GSV, the pages of this program are also made: each command must have a page that groff reads without
a warning.
"""

import importlib.machinery
import importlib.util
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
TOOLS = Path(__file__).resolve().parent
SCRIPT = str(TOOLS / "make_man_pages")
loader = importlib.machinery.SourceFileLoader("make_man_pages", SCRIPT)
pages = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
sys.modules[loader.name] = pages
loader.exec_module(pages)

PROGRAM = None
HELP = """Run scenarios and judge them
Usage: gsv test [OPTIONS] scenarios...

Arguments:
  scenarios ...             scenario files, or
                            folders

Runs:
  -j, --jobs N              scenarios to run at the same time
  --engine local|slurm      where to run (default: local; not with --broker)
  --token TOKEN             token [env: GSV_TOKEN]
  --property NAME=VALUE ...
                            property of the offer

Slurm:
  --runs-per-task, --runs-a-task N
                            runs of one task

Options:
  -h, --help                print this help
"""


class Parsing(unittest.TestCase):
    def entry(self, name):
        parsed = pages.parse_help(HELP)
        return next(pages.sentence_of(entry) for entries in parsed.sections.values()
                    for entry in entries if name in entry.left)

    def test_a_help_text_in_its_parts(self):
        parsed = pages.parse_help(HELP)
        self.assertEqual(parsed.description, "Run scenarios and judge them")
        self.assertEqual(parsed.usage, "gsv test [OPTIONS] scenarios...")
        self.assertEqual(list(parsed.sections), ["Arguments", "Runs", "Slurm", "Options"])
        self.assertEqual([len(entries) for entries in parsed.sections.values()], [1, 4, 1, 1])

    def test_an_option_with_its_value(self):
        self.assertEqual(self.entry("--jobs"), ("\\fB\\-j\\fR, \\fB\\-\\-jobs\\fR \\fIN\\fR",
                                                "scenarios to run at the same time"))
        self.assertEqual(self.entry("--engine"), ("\\fB\\-\\-engine\\fR \\fIlocal|slurm\\fR",
                                                  "where to run (default: local; not with \\-\\-broker)"))

    def test_a_description_on_the_next_line(self):
        self.assertEqual(self.entry("--property"),
                         ("\\fB\\-\\-property\\fR \\fINAME=VALUE\\fR ...", "property of the offer"))
        self.assertEqual(self.entry("--runs-per-task"),
                         ("\\fB\\-\\-runs\\-per\\-task\\fR, \\fB\\-\\-runs\\-a\\-task\\fR \\fIN\\fR", "runs of one task"))

    def test_an_argument(self):
        self.assertEqual(self.entry("scenarios"), ("\\fIscenarios\\fR ...", "scenario files, or folders"))

    def test_what_is_no_help_text_is_refused(self):
        for text in ("no usage", "Usage: gsv\n\nOptions:\n odd line\n"):
            with self.assertRaises(ValueError):
                pages.parse_help(text)

    def test_characters_that_roff_reads(self):
        self.assertEqual(pages.roff(".a-b\\c…"), "\\&.a\\-b\\ec\\[u2026]")


class Program(unittest.TestCase):
    def setUp(self):
        if PROGRAM is None:
            self.skipTest("no program was given")
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.assertEqual(pages.main([PROGRAM, str(TOOLS.parent / "docs/gsv.1.in"), str(self.folder)]), 0)

    def test_every_command_has_a_page_that_groff_reads(self):
        help_text = subprocess.run([PROGRAM, "--help"], text=True, capture_output=True, check=True).stdout
        commands = re.findall(r"^  ([a-z][\w-]*)", help_text, re.MULTILINE)
        self.assertGreater(len(commands), 20)
        whole = (self.folder / "gsv.1").read_text()
        for command in commands:
            page = (self.folder / f"gsv-{command}.1").read_text()
            self.assertIn(pages.roff(f"gsv-{command}") + " \\- ", page)
            self.assertIn(pages.roff(f"gsv-{command}") + " (1)", whole)
        self.assertEqual(len(list(self.folder.iterdir())), len(commands) + 1)
        self.assertIn("\\-\\-lockstep", (self.folder / "gsv-run.1").read_text())
        self.assertIn(".SS gsv world check", (self.folder / "gsv-world.1").read_text())
        if shutil.which("groff"):
            for page in self.folder.iterdir():
                read = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-z", str(page)], text=True,
                                      capture_output=True)
                self.assertEqual((read.returncode, read.stderr), (0, ""), page.name)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        PROGRAM = sys.argv.pop(1)
    unittest.main()
