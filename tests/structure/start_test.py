#!/usr/bin/env python3
"""Tests that gsv starts without the libraries that it loads late, and that it replaces functions of libraries.

usage: start_test.py GSV
"""

import subprocess
import sys
import unittest
from ctypes.util import find_library

GSV = sys.argv.pop(1)
# The functions of libstdc++ that compile a regular expression; gsv/formats/sdf/shared_regex.cc
# defines them.
COMPILERS = {
    "_ZNSt8__detail13__compile_nfaINSt7__cxx1112regex_traitsIcEEPKcEENSt9enable_ifIXsrNS_20__is_contiguous_"
    "iterIT0_EE5valueESt10shared_ptrIKNS_4_NFAIT_EEEE4typeES8_S8_RKNSC_11locale_typeENSt15regex_constants18syntax_"
    "option_typeE",
    "_ZNSt7__cxx1111basic_regexIcNS_12regex_traitsIcEEE10_M_compileEPKcS5_NSt15regex_constants18syntax_option_typeE",
}
# The functions sdf::Element::Clone() and sdf::initFile(), which gsv/formats/sdf/shared_descriptions.cc defines.
OWN_SDF = (
    "_ZNK3sdf3v127Element5CloneEv",
    "_ZN3sdf3v128initFileERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEESt10shared_ptrINS0_7ElementEE",
)
LATE = (
    "libsdformat",
    "libignition",
    "libassimp",
    "libembree",
    "libssl",
    "libcrypto",
    "libsqlite",
    "libtiff",
    "libEGL",
    "libOpenGL",
    "libpng",
    "libturbojpeg",
)


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


class Start(unittest.TestCase):
    def test_links_to_no_late_library(self):
        needed = [line.rpartition("[")[2] for line in output_of("readelf", "-dW", GSV).splitlines() if "NEEDED" in line]
        self.assertEqual([name for name in needed if name.startswith(LATE)], [])

    def test_shares_regular_expressions(self):
        defined = {line.split()[-1] for line in output_of("nm", "-D", "--defined-only", GSV).splitlines()}
        for name in ("sdformat12", "ignition-math6"):
            library = f"/usr/lib/x86_64-linux-gnu/{find_library(name)}"
            called = {line.split()[4] for line in output_of("readelf", "-rW", library).splitlines() if "JUMP_SLO" in line}
            compilers = {word for word in called if word in COMPILERS}
            self.assertTrue(compilers, f"{name} compiles its regular expressions with another function")
            self.assertLessEqual(compilers, defined)

    def test_shares_descriptions_of_elements(self):
        defined = {line.split()[-1] for line in output_of("nm", "-D", "--defined-only", GSV).splitlines()}
        called = output_of("readelf", "-rW", f"/usr/lib/x86_64-linux-gnu/{find_library('sdformat12')}")
        for name in OWN_SDF:
            self.assertIn(name, defined)
            self.assertIn(name, called, "libsdformat cannot call another definition")


if __name__ == "__main__":
    unittest.main()
