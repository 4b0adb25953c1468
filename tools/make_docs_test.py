#!/usr/bin/env python3
"""Tests make_docs: the collection of pages, the conversion of comments and the check of links."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).parent))
import docs_check
import docs_pages
import docs_reference


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)

    def write(self, path, text):
        (self.root / path).parent.mkdir(parents=True, exist_ok=True)
        (self.root / path).write_text(text)


class Pages(Folder):
    def collected(self):
        return docs_pages.Site(self.root).collect()

    def test_links_lead_to_the_places_of_the_site(self):
        self.write("README.md", "[a](docs/a.md#there) ![i](docs/images/i.png)\n")
        self.write("docs/a.md", "[home](../README.md) [b](formats/b.md) [web](https://a.b/c)\n")
        self.write("docs/formats/b.md", "[a](../a.md) [adr](../adr/)\n")
        self.write("docs/adr/README.md", "# Decisions\n")
        self.write("docs/images/i.png", "")
        pages = self.collected().pages
        self.assertEqual(pages["index.md"], "[a](a.md#there) ![i](images/i.png)\n")
        self.assertEqual(pages["a.md"], "[home](index.md) [b](formats/b.md) [web](https://a.b/c)\n")
        self.assertEqual(pages["formats/b.md"], "[a](../a.md) [adr](../adr/README.md)\n")

    def test_a_file_of_the_source_tree_becomes_a_page_that_shows_it(self):
        self.write("docs/a.md", "[folder](../examples/x)\n")
        self.write("examples/x/x.cc", "int a;\n")
        pages = self.collected().pages
        self.assertEqual(pages["a.md"], "[folder](sources/examples/x.md)\n")
        self.assertIn("- [x.cc](x/x.cc.md)", pages["sources/examples/x.md"])
        self.assertIn("cpp\nint a;\n", pages["sources/examples/x/x.cc.md"])

    def test_a_dead_link_is_named_with_its_line(self):
        self.write("docs/a.md", "fine\n[gone](none.md)\n[out](../../etc/passwd)\n")
        self.assertEqual(self.collected().dead, ["docs/a.md:2: the link none.md leads to nothing",
                                                 "docs/a.md:3: the link ../../etc/passwd leads to nothing"])

    def test_code_is_left_as_it_is(self):
        page = "`[a](none.md)`\n\n```\n[a](none.md)\n- x\n```\n"
        self.write("docs/a.md", page)
        site = self.collected()
        self.assertEqual((site.pages["a.md"], site.dead), (page, []))

    def test_a_list_begins_after_an_empty_line(self):
        self.write("docs/a.md", "Text:\n- one\n- two\n")
        self.assertEqual(self.collected().pages["a.md"], "Text:\n\n- one\n- two\n")

    def test_pages_that_no_section_lists_are_found_under_more(self):
        for path in ("README.md", "docs/install.md", "docs/odd.md", "docs/tutorial/README.md", "docs/tutorial/01.md"):
            self.write(path, "# x\n")
        self.assertEqual(self.collected().navigation(), [
            {"Home": "index.md"}, {"Tutorial": ["tutorial/README.md", "tutorial/01.md"]},
            {"Guides": ["install.md"]}, {"Reference": ["reference.md"]}, {"More": ["odd.md"]}])


class Reference(unittest.TestCase):
    def test_comments_as_doxygen_reads_them(self):
        self.assertEqual(docs_reference.documented(
            "// The file.\n#pragma once\n\n// Of `<a>` and <b>.\nint c;  // behind,\n        // and on\n"),
            "/// \\file\n/// The file.\n#pragma once\n\n/// Of `<a>` and &lt;b>.\n"
            "int c;  ///< behind,\n        ///< and on\n")


class Check(Folder):
    def problems(self):
        return list(docs_check.problems_in(self.root))

    def test_dead_links_and_headings_are_named(self):
        self.write("index.html", '<a href="a/b.html#there">x</a> <a href="a/b.html#gone">x</a>'
                                 '<a href="none.html">x</a> <a href="/docs/a/b.html">x</a>')
        self.write("a/b.html", '<h1 id="there">B</h1> <a href="../index.html">x</a>')
        self.assertEqual(self.problems(), [
            "index.html: the page of the link a/b.html#gone has no such heading",
            "index.html: the link none.html leads to nothing",
            "index.html: the link /docs/a/b.html leads to nothing"])

    def test_nothing_is_loaded_from_the_network(self):
        self.write("index.html", '<script src="https://cdn.example/x.js"></script> <a href="https://x.y/">x</a>')
        self.write("reference/x.html", '<link href="//fonts.example/x.css">')
        self.write("a.css", "@font-face { src: url(https://fonts.example/x.woff2) }")
        problems = self.problems()
        self.assertEqual(len(problems), 3, problems)
        self.assertTrue(all("from the network" in problem for problem in problems), problems)


if __name__ == "__main__":
    unittest.main()
