#!/usr/bin/env python3
"""Tests make_late_library: compiles a program that calls a library through the generated source."""

import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parent / "make_late_library"

# Every register that carries an argument, and one argument on the stack.
LIBRARY = """
struct Big { long values[4]; };
extern "C" Big sum(long a, long b, long c, long d, long e, long f, double g, double h, double i,
                   double j, double k, double l, double m, double n) {
  return {{a + 2 * b, c + 2 * d, e + 2 * f,
           long(g + 2 * h + 3 * i + 4 * j + 5 * k + 6 * l + 7 * m + 8 * n)}};
}
extern "C" int fails(int code) { throw code; }
"""
PROGRAM = """
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
struct Big { long values[4]; };
extern "C" Big sum(long, long, long, long, long, long, double, double, double, double, double,
                   double, double, double);
extern "C" int fails(int code);
extern "C" void* gsv_late_function(const char* file, const char* name) {
  printf("late %s\\n", name);
  void* library = dlopen(file, RTLD_NOW);
  return library == nullptr ? (puts(dlerror()), exit(127), nullptr) : dlsym(library, name);
}
int main() {
  for (int times = 0; times < 2; ++times) {
    Big big = sum(1, 2, 3, 4, 5, 6, 1, 2, 3, 4, 5, 6, 7, 8);
    printf("%ld %ld %ld %ld\\n", big.values[0], big.values[1], big.values[2], big.values[3]);
    try {
      fails(7);
    } catch (int code) {
      printf("caught %d\\n", code);
    }
  }
}
"""


@unittest.skipIf(shutil.which("g++") is None, "needs g++")
class LateLibrary(unittest.TestCase):
    def test_calls_pass_arguments_results_and_exceptions(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            library = folder / "liblate.so"
            (folder / "library.cc").write_text(LIBRARY)
            (folder / "program.cc").write_text(PROGRAM)

            def run(*command):
                return subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True).stdout

            if run("g++", "-dumpmachine").split("-")[0] != "x86_64":
                self.skipTest("writes for x86-64 only")
            run("g++", "-shared", "-fPIC", f"-Wl,-soname,{library}", "library.cc", "-o", str(library))
            run(str(SCRIPT), "late.s", str(library))
            run("g++", "program.cc", "late.s", "-o", "program")
            self.assertNotIn("liblate", run("readelf", "-d", "program"))
            line = "5 11 17 204\ncaught 7\n"
            calls = line.splitlines(keepends=True)
            expected = "late sum\n" + calls[0] + "late fails\n" + calls[1] + line
            self.assertEqual(run("./program"), expected)


if __name__ == "__main__":
    unittest.main()
