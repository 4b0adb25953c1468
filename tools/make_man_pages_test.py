#!/usr/bin/env python3
"""Tests of make_man_pages.

usage: make_man_pages_test.py [GSV]

With the program, its pages are made as well: each command has one, which groff reads without a warning.
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
# As CLI11 2.3 prints it: a description begins at column 30, or on the next line.
HELP = """Run scenarios and judge them
Usage: gsv test [OPTIONS] scenarios...

Positionals:
  scenarios TEXT ... REQUIRED files, or folders

Options:
  -h,--help                   Print this help message and exit
  -j,--jobs INT:INT in [0 - 256]=0
                              how many at once
  --engine TEXT:{local,slurm} Excludes: --broker --failures
                              where to run (default: local)
  --token TEXT (Env:GSV_TOKEN)
                              the token
  --property NAME=VALUE ...   a property of the offer


Slurm:
  --partition TEXT ...        Slurm's partition
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
        self.assertEqual(list(parsed.sections), ["Positionals", "Options", "Slurm"])
        self.assertEqual([len(entries) for entries in parsed.sections.values()], [1, 5, 1])

    def test_an_option_with_its_value_and_limits(self):
        self.assertEqual(self.entry("--jobs"), ("\\fB\\-j\\fR, \\fB\\-\\-jobs\\fR \\fIINT\\fR",
                                                "how many at once (0 to 256; default: 0)"))

    def test_what_holds_for_an_option_joins_its_default(self):
        self.assertEqual(self.entry("--engine")[1], "where to run (default: local; one of local, slurm; "
                                                    "not with \\-\\-broker, \\-\\-failures)")
        self.assertEqual(self.entry("--token")[1], "the token (environment: GSV_TOKEN)")

    def test_a_value_that_looks_like_a_default_is_none(self):
        self.assertEqual(self.entry("--property"),
                         ("\\fB\\-\\-property\\fR \\fINAME=VALUE\\fR ...", "a property of the offer"))

    def test_an_argument(self):
        self.assertEqual(self.entry("scenarios"), ("\\fIscenarios\\fR ...", "files, or folders"))

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
        commands = re.findall(r"^  ([\w-]+)", help_text.split("Subcommands:\n")[1], re.MULTILINE)
        self.assertGreater(len(commands), 20)
        whole = (self.folder / "gsv.1").read_text()
        for command in commands:
            page = (self.folder / f"gsv-{command}.1").read_text()
            self.assertIn(f"gsv\\-{command} \\- ".replace("set-", "set\\-"), page)
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
