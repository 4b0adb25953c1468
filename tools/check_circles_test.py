#!/usr/bin/env python3
"""Tests check_circles.py with small source trees."""

import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import check_circles


class CheckCircles(unittest.TestCase):
    def run_on(self, files):
        """Runs the check on a tree of {path: text}. Returns its exit code and the printed lines."""
        with tempfile.TemporaryDirectory() as root:
            for path, text in files.items():
                place = Path(root, path)
                place.parent.mkdir(parents=True, exist_ok=True)
                place.write_text(text)
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                code = check_circles.main([root])
            return code, printed.getvalue().splitlines()

    def assert_circle(self, files, expected):
        code, lines = self.run_on(files)
        self.assertEqual((code, lines), (1, [expected, "1 circles"]))

    def assert_none(self, files):
        self.assertEqual(self.run_on(files), (0, ["no circles"]))

    def test_accepts_headers_that_share_a_third_one(self):
        self.assert_none(
            {
                "gsv/base/a.h": '#include "gsv/base/b.h"\n#include "gsv/base/c.h"\n',
                "gsv/base/b.h": '#include "gsv/base/c.h"\n#include <vector>\n',
                "gsv/base/c.h": "",
            }
        )

    def test_refuses_headers_that_include_each_other_within_one_folder(self):
        self.assert_circle(
            {
                "gsv/base/a.h": '#pragma once\n#include "gsv/base/b.h"\n',
                "gsv/base/b.h": '#include "gsv/base/a.h"\n',
            },
            "gsv/base/a.h:2: the file includes itself: gsv/base/a.h -> gsv/base/b.h -> gsv/base/a.h",
        )

    def test_refuses_a_circle_over_folders_and_prints_it_once(self):
        self.assert_circle(
            {
                "gsv/base/a.h": '#include "sdk/b.h"\n',
                "sdk/b.h": '#include "tests/c.h"\n',
                "tests/c.h": '#include "gsv/base/a.h"\n',
                "gsv/base/outside.cc": '#include "gsv/base/a.h"\n',
            },
            "gsv/base/a.h:1: the file includes itself: gsv/base/a.h -> sdk/b.h -> tests/c.h -> gsv/base/a.h",
        )

    def test_an_include_in_a_comment_is_none(self):
        self.assert_none({"gsv/base/a.h": '/*\n#include "gsv/base/a.h"\n*/\n// #include "gsv/base/a.h"\n'})

    def test_refuses_modules_that_import_each_other(self):
        self.assert_circle(
            {
                "web/src/app/App.ts": 'import "./page.css";\nimport { Link } from "./Link";\n',
                "web/src/app/Link.ts": 'import { App } from "./App";\n',
            },
            "web/src/app/App.ts:2: the file imports itself: "
            "web/src/app/App.ts -> web/src/app/Link.ts -> web/src/app/App.ts",
        )

    def test_imports_of_types_lazy_imports_and_exports_count(self):
        for back in (
            'import type { A } from "./a";',
            'import type {\n  A,\n} from "./a";',
            'export { a } from "./a";',
            "export * from './a';",
            'const load = () => import("./a");',
            'import "./a";',
            'type A = import("./a").A;',
        ):
            with self.subTest(back):
                code, lines = self.run_on({"web/src/a.ts": 'import { b } from "./b";\n', "web/src/b.ts": f"{back}\n"})
                self.assertEqual(code, 1)
                self.assertIn("web/src/a.ts -> web/src/b.ts -> web/src/a.ts", lines[0])

    def test_an_import_in_a_comment_is_none(self):
        self.assert_none({"web/src/a.ts": '// import "./a"\n/* from "./a" */\n'})

    def test_refuses_folders_that_import_each_other_though_no_file_does(self):
        self.assert_circle(
            {
                "web/src/app/App.ts": 'import { A } from "../state/A";\n',
                "web/src/app/files.ts": "export const x = 1;\n",
                "web/src/state/A.ts": "export const A = 1;\n",
                "web/src/state/B.ts": '\nimport { x } from "../app/files";\n',
            },
            "web/src/app/App.ts:1: the folder imports itself: web/src/app -> web/src/state -> web/src/app",
        )

    def test_a_test_may_import_from_any_folder(self):
        self.assert_none(
            {
                "web/src/app/App.ts": 'import { A } from "../state/A";\n',
                "web/src/state/A.ts": "",
                "web/src/state/A.test.ts": 'import { App } from "../app/App";\n',
                "web/src/state/testApp.ts": 'import { App } from "../app/App";\n',
            }
        )


if __name__ == "__main__":
    unittest.main()
