#!/usr/bin/env python3
"""Tests of check_language."""

import contextlib
import importlib.machinery
import importlib.util
import io
import shutil
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

sys.dont_write_bytecode = True
SCRIPT = str(Path(__file__).parent / "check_language")
loader = importlib.machinery.SourceFileLoader("check_language", SCRIPT)
language = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
sys.modules[loader.name] = language
loader.exec_module(language)

import language_texts as texts  # noqa: E402: found through the script's folder


def problems(words, kind="docs"):
    return list(language.problems_in(texts.Text(1, kind, words)))


class Rules(unittest.TestCase):
    def assert_finds(self, words, part, kind="docs"):
        found = problems(words, kind)
        self.assertEqual(len(found), 1, found)
        self.assertIn(part, found[0])

    def test_flags_a_clause_without_a_subject(self):
        for words in ("who shows it may act", "What is collided with, as it is computed",
                      "Of several that it pushes the slowest tells us.",
                      "whose certificates are taken (default: ca.pem)"):
            self.assert_finds(words, "begins without its subject", "help" if words[0].islower() else "docs")

    def test_flags_such_a_clause_at_a_later_sentence(self):
        self.assert_finds("The server checks tokens. Who shows one may act.", "begins without its subject")

    def test_accepts_questions_headings_and_short_cells(self):
        self.assertEqual(problems("What does the robot do?"), [])
        self.assertEqual(problems("What it is and how to use it", "heading"), [])
        self.assertEqual(problems("What", "cell"), [])
        self.assertEqual(problems("token that allows control (16+ characters)", "help"), [])

    def test_flags_phrases_with_the_words_to_write(self):
        self.assert_finds("Without it: simulation", "(default: …)")
        self.assert_finds("The viewer is told when a run ends.", "reports")
        self.assert_finds("The page tells of failures.", "reports")
        self.assert_finds("The run goes on.", "continues")
        self.assert_finds("The camera sends a picture.", "image")
        self.assert_finds("It takes two wall seconds.", "wall-clock time")

    def test_leaves_names_alone(self):
        self.assertEqual(problems("Set `picture` or --record-pictures or pictures=1 or go_on."
                                  .replace("`picture`", texts.CODE)), [])

    def test_flags_words_of_names(self):
        self.assert_finds("kMostViewers", "max", "name")
        self.assert_finds("kLeast", "min", "name")
        self.assert_finds("TakePicture", "image", "name")
        self.assert_finds("is_told_", "report", "name")
        self.assert_finds("kSeeThrough", "transparent", "name")
        for name in ("kMaxViewers", "almost", "Depicture", "Storytelling", "utmost_", "IMUs"):
            self.assertEqual(problems(name, "name"), [])

    def test_counts_the_words_of_each_sentence(self):
        self.assertEqual(problems(f"{'word ' * 34}end. {'Word ' * 34}end."), [])
        self.assert_finds(f"{'word ' * 35}end.", "a sentence of 36 words")

    def test_an_abbreviation_ends_no_sentence(self):
        self.assertEqual(language.sentences_of("Use a tool, e.g. Drake. It helps."),
                         ["Use a tool, e.g. Drake.", "It helps."])

    def test_bounds_help_texts(self):
        self.assertEqual(problems("x" * 90, "help"), [])
        self.assert_finds("x" * 91, "91 characters", "help")
        self.assert_finds("seed of all noise.", "full stop", "help")

    @unittest.skipUnless(shutil.which("codespell"), "codespell is not installed")
    def test_flags_spelling_at_its_line(self):
        found = language.spelling_in({"a.md": [texts.Text(3, "docs", "All is well."),
                                               texts.Text(7, "docs", "Recieve it.")]})
        self.assertEqual([(finding.path, finding.line) for finding in found], [("a.md", 7)])
        self.assertIn("Receive", found[0].what)


class Extraction(unittest.TestCase):
    def test_markdown_without_its_code(self):
        page = ("# A title\nOne `gsv run`\nparagraph.\n\n```\nWho is code\n```\n"
                "- an item\n- a [link](b.md)\n\n| A | `b` c |\n|---|---|\n")
        self.assertEqual([(text.line, text.kind, text.words) for text in texts.texts_of_markdown(page)],
                         [(1, "heading", "A title"), (2, "docs", "One CODE paragraph."),
                          (8, "docs", "an item"), (9, "docs", "a link"), (11, "cell", "A"),
                          (11, "cell", "CODE c")])

    def test_help_of_options_and_commands(self):
        source = ('command->add_option("--name", name, "of the "\n   "simulation")->check(f("no"));\n'
                  'app.add_flag_callback("--x", [&] { Print("Who, not this"); }, "says (x), y");\n'
                  'app.add_option<int>("--n", n);\n')
        self.assertEqual([(text.line, text.words) for text in texts.texts_of_help(source)],
                         [(1, "of the simulation"), (3, "says (x), y")])

    def test_comments_as_paragraphs(self):
        header = ('// One contract\n// in two lines.\n//\n// Another.\n#include "a//b.h"\nint a;  // of a,\n'
                  '        // and more\n// Of the next.\nint b;\n}  // namespace x\n')
        self.assertEqual([(text.line, text.words) for text in texts.texts_of_comments(header)],
                         [(1, "One contract in two lines."), (4, "Another."), (6, "of a, and more"),
                          (8, "Of the next.")])

    def test_comments_and_docstrings_of_a_script(self):
        source = '#!/usr/bin/env python3\n"""Does one thing.\n\nusage: it FILE\n\n- An item\n"""\n# A comment\n# of two lines.\n'
        self.assertEqual([(text.line, text.words) for text in texts.texts_of_script(source)],
                         [(8, "A comment of two lines."), (2, "Does one thing."), (6, "- An item")])

    def test_comments_of_the_page(self):
        found = [text.words for text in texts.texts_of_web('show("Two words"); // the first frame\n')]
        self.assertEqual(found, ["Two words", "the first frame"])

    def test_flags_a_comment_that_names_nothing(self):
        self.assertEqual(len(list(language.problems_in(texts.Text(1, "comment", "of each body")))), 1)
        self.assertEqual(list(language.problems_in(texts.Text(1, "comment", "the mass of each body"))), [])

    def test_names_of_a_header(self):
        header = ('#include "picture.h"\n// Of TakePicture.\nint Take(int most_);  // told\n'
                  'const char* kText = "wish";\nint Take();\n'
                  'using Picture [[deprecated("use Image")]] = Image;\n')
        self.assertEqual([(text.line, text.words) for text in texts.names_in(header)],
                         [(3, "int"), (3, "Take"), (3, "most_"), (4, "const"), (4, "char"), (4, "kText")])
        self.assertEqual(texts.parts_of_name("kMaxGPUWait2_"), "max gpu wait 2")

    def test_strings_of_the_page(self):
        source = ('import { a } from "who knows this";\n// "Who is a comment"\n'
                  'element("div", { class: "button plain", title: "Add a robot" }, `It lags: ${n} %`);\n'
                  'path("M4 5h3v3H4zm5 .5h11v2H9z");\n')
        self.assertEqual([text.words for text in texts.texts_of_typescript(source)],
                         ["Add a robot", "It lags: CODE %"])
        self.assertEqual([text.words for text in texts.texts_of_html(
            '<p title="Who is it">Two words</p><script>let no = a > b < c;</script>')],
            ["Who is it", "Two words"])

    def test_strings_of_all_files_of_the_page(self):
        with tempfile.TemporaryDirectory() as folder:
            source = Path(folder, "web/src")
            source.mkdir(parents=True)
            for name in ("a.ts", "b.test.ts", "c.ts"):
                (source / name).write_text('say("Add a robot");\n// Shows a robot.\n')
            self.assertEqual(
                {path: [text.kind for text in found] for path, found in texts.texts_below(folder).items()},
                {"web/src/a.ts": ["ui", "comment"], "web/src/b.test.ts": ["comment"],
                 "web/src/c.ts": ["ui", "comment"]})

    def test_descriptions_of_the_api(self):
        page = 'a:\n  summary: The viewer\n  description: >\n    Two\n    lines.\n  - {description: Short, x: y}\n'
        self.assertEqual([text.words for text in texts.texts_of_openapi(page)],
                         ["The viewer", "Two lines.", "Short"])


class Ratchet(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        without_codespell = unittest.mock.patch.object(language, "spelling_in", lambda texts: [])
        without_codespell.start()
        self.addCleanup(without_codespell.stop)
        (self.root / "docs").mkdir()
        (self.root / "tools").mkdir()

    def write(self, path, text):
        (self.root / path).parent.mkdir(parents=True, exist_ok=True)
        (self.root / path).write_text(text)

    def check(self, *arguments):
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
            code = language.main(["--root", str(self.root), *arguments])
        return code, printed.getvalue()

    def test_more_findings_than_allowed_fail_with_their_places(self):
        self.write("docs/a.md", "Fine.\n\nIt is told so.\n")
        code, printed = self.check()
        self.assertEqual(code, 1)
        self.assertIn('docs/a.md:3: "is told"', printed)
        self.write(language.BASELINE, "1 docs/a.md\n")
        self.assertEqual(self.check()[0], 0)

    def test_fewer_findings_pass_with_a_note(self):
        self.write("docs/a.md", "Fine.\n")
        self.write(language.BASELINE, "2 docs/a.md\n")
        code, printed = self.check()
        self.assertEqual(code, 0)
        self.assertIn("2 fewer than the baseline, which --update lowers", printed)

    def test_a_file_that_moved_keeps_its_number(self):
        self.write("docs/new/a.md", "It is told so.\n")
        self.write(language.BASELINE, "1 docs/old/a.md\n")
        self.assertEqual(self.check()[0], 0)

    def test_update_lowers_and_raises_only_what_is_named(self):
        self.write("docs/a.md", "It is told so.\n")
        self.write("docs/b.md", "It is told so.\n\nIt is told so.\n")
        self.write(language.BASELINE, "3 docs/a.md\n1 docs/b.md\n")
        self.assertEqual(self.check("--update")[0], 1)
        self.assertEqual(language.read_baseline(self.root / language.BASELINE),
                         {"docs/a.md": 1, "docs/b.md": 1})
        self.assertEqual(self.check("--update", "docs/b.md")[0], 0)
        self.assertEqual(self.check()[0], 0)

    def test_a_baseline_that_cannot_be_read_is_refused(self):
        self.write(language.BASELINE, "many docs/a.md\n")
        with self.assertRaisesRegex(SystemExit, "not a line of the form NUMBER PATH"):
            self.check()

    def test_a_file_that_is_not_there_is_refused(self):
        self.assertEqual(self.check("docs/none.md")[0], 2)


if __name__ == "__main__":
    unittest.main()
