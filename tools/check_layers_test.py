#!/usr/bin/env python3
"""Tests check_layers.py with small source trees."""

import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import check_layers

LAYERS = """
idl
gsv/base
gsv/model     gsv/base   # a remark
gsv/world/parts  gsv/model
gsv/world     gsv/world/parts
gsv/services  gsv/world idl
gsv/broker/storage  gsv/base
gsv/broker    gsv/broker/storage
apps/gsv      *
core gsv/base gsv/model gsv/world
except gsv/world/pacer.h wall-clock
"""


class CheckLayers(unittest.TestCase):
    def run_on(self, files, layers=LAYERS):
        """Runs the check on a tree of {path: text}. Returns its exit code and the printed lines."""
        with tempfile.TemporaryDirectory() as root:
            for path, text in {**files, "docs/layers.txt": layers}.items():
                place = Path(root, path)
                place.parent.mkdir(parents=True, exist_ok=True)
                place.write_text(text)
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                code = check_layers.main([root])
            return code, printed.getvalue().splitlines()

    def assert_violation(self, files, expected_beginning, expected_word):
        code, lines = self.run_on(files)
        self.assertEqual(code, 1)
        self.assertEqual(len(lines), 2, lines)
        self.assertTrue(lines[0].startswith(expected_beginning), lines[0])
        self.assertIn(expected_word, lines[0])

    def test_accepts_includes_downwards_however_far(self):
        code, lines = self.run_on({"gsv/world/a.h": '#include "gsv/base/b.h"\n#include <vector>\n'})
        self.assertEqual((code, lines), (0, ["the layers hold"]))

    def test_refuses_an_include_upwards_and_says_where(self):
        self.assert_violation(
            {"gsv/base/b.cc": '#include "gsv/base/b.h"\n#include "gsv/world/a.h"\n'},
            "gsv/base/b.cc:2: ",
            "gsv/world",
        )

    def test_a_layer_that_is_not_reached_is_refused_though_it_stands_above(self):
        self.assert_violation(
            {"gsv/world/a.cc": '#include "idl/sba.hh"\n'}, "gsv/world/a.cc:1: ", "idl"
        )

    def test_a_test_may_include_whatever_stands_above_its_folder(self):
        code, _ = self.run_on({"gsv/services/a_test.cc": '#include "gsv/base/b.h"\n'})
        self.assertEqual(code, 0)
        self.assert_violation(
            {"gsv/base/b_test.cc": '#include "gsv/model/a.h"\n'}, "gsv/base/b_test.cc:1", "gsv/model"
        )

    def test_a_test_may_include_all_of_its_library_and_other_sources_may_not(self):
        include = '#include "gsv/broker/broker.h"\n'
        code, _ = self.run_on({"gsv/broker/storage/a_test.cc": include})
        self.assertEqual(code, 0)
        self.assert_violation(
            {"gsv/broker/storage/a.cc": include}, "gsv/broker/storage/a.cc:1: ", "gsv/broker"
        )

    def test_the_core_sees_no_orb_socket_or_opengl(self):
        for header in ("omniORB4/CORBA.h", "COS/CosTrading.hh", "boost/asio.hpp", "sys/socket.h"):
            self.assert_violation(
                {"gsv/model/a.cc": f"\n#include <{header}>\n"}, "gsv/model/a.cc:2: the core", header
            )
        self.assert_violation({"gsv/model/a.h": "#include <GL/gl.h>\n"}, "gsv/model/a.h:1", "opengl")

    def test_what_lies_within_a_folder_of_the_core_is_core(self):
        self.assert_violation(
            {"gsv/world/parts/a.h": "#include <GL/gl.h>\n"}, "gsv/world/parts/a.h:1: the core", "opengl"
        )

    def test_above_the_core_they_are_free(self):
        code, _ = self.run_on({"gsv/services/a.cc": "#include <omniORB4/CORBA.h>\n"})
        self.assertEqual(code, 0)

    def test_the_core_sees_no_wall_clock_but_where_excepted(self):
        code = "auto t = std::chrono::steady_clock::now();\n"
        self.assert_violation({"gsv/world/step.cc": code}, "gsv/world/step.cc:1: the core", "steady_clock")
        self.assertEqual(self.run_on({"gsv/world/pacer.h": code})[0], 0)
        self.assertEqual(self.run_on({"gsv/world/step.h": "// never steady_clock\n"})[0], 0)

    def test_internals_of_omniorb_are_open_to_the_excepted_folder_alone(self):
        internals = "#include <omniORB4/giopEndpoint.h>\n#include <tcpSocket.h>\n"
        layers = LAYERS + "except gsv/services omniorb-internals\n"
        self.assertEqual(self.run_on({"gsv/services/a.cc": internals}, layers)[0], 0)
        code, lines = self.run_on({"gsv/broker/a.cc": internals}, layers)
        self.assertEqual((code, len(lines)), (1, 3))
        self.assertTrue(lines[0].startswith("gsv/broker/a.cc:1: gsv/broker may not use omniorb-int"), lines[0])

    def test_locks_that_clang_cannot_check_are_refused_but_where_excepted_and_in_tests(self):
        code = "std::mutex mutex;\n"
        self.assert_violation({"gsv/services/a.h": code}, "gsv/services/a.h:1: ", "gsv/base/mutex.h")
        excepted = LAYERS + "except gsv/base/mutex.h unchecked-locks\n"
        self.assertEqual(self.run_on({"gsv/base/mutex.h": code}, excepted)[0], 0)
        self.assertEqual(self.run_on({"gsv/services/a_test.cc": code})[0], 0)

    def test_a_folder_nobody_declared_is_refused(self):
        self.assert_violation({"gsv/extra/a.cc": "\n"}, "gsv/extra/a.cc:1: ", "does not name")

    def test_includes_are_written_from_the_root(self):
        self.assert_violation(
            {"gsv/base/a.cc": '#include "b.h"\n', "gsv/base/b.h": "\n"}, "gsv/base/a.cc:1: ", "root"
        )

    def test_everything_is_open_to_the_application(self):
        code, _ = self.run_on({"apps/gsv/main.cc": '#include "gsv/services/a.h"\n#include "idl/s.hh"\n'})
        self.assertEqual(code, 0)

    def test_a_table_with_a_layer_above_itself_is_refused(self):
        with self.assertRaisesRegex(ValueError, "gsv/model, which is not declared above"):
            self.run_on({}, layers="gsv/base gsv/model\ngsv/model\n")


if __name__ == "__main__":
    unittest.main()
