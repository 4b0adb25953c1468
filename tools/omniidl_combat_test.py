#!/usr/bin/env python3
"""Tests tools/omniidl/combat.py."""

import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent
EXAMPLES = pathlib.Path("/usr/share/doc/tcl-combat/examples")

EVERYTHING = """
#pragma prefix "acme"
module m {
  const unsigned short limit = 7;
  enum Colour { RED, GREEN };
  typedef sequence<long, 4> Few;
  typedef double Pose[2][3];
  struct Point { double x, y; string<8> name; };
  union Choice switch (Colour) { case RED: long number; default: sequence<Point> points; };
  exception Wrong { string why; };
  interface Thing;
  interface Base { readonly attribute long size; };
  interface Thing : Base {
    attribute Colour paint;
    oneway void poke(in any what);
    Thing find(in Few which, out Choice found, inout unsigned long long n) raises (Wrong);
  };
};
"""

# The expected output of the back end, in the syntax that combat(n), "Interface Repository", and
# str.tcl require.
TOLD = """combat::ir add {
{module {IDL:acme/m:1.0 m 1.0} {\
{const {IDL:acme/m/limit:1.0 limit 1.0} {unsigned short} 7} \
{enum {IDL:acme/m/Colour:1.0 Colour 1.0} {RED GREEN}} \
{typedef {IDL:acme/m/Few:1.0 Few 1.0} {sequence long 4}} \
{typedef {IDL:acme/m/Pose:1.0 Pose 1.0} {array {array double 3} 2}} \
{struct {IDL:acme/m/Point:1.0 Point 1.0} {{x double} {y double} {name {string 8}}} {}} \
{union {IDL:acme/m/Choice:1.0 Choice 1.0} IDL:acme/m/Colour:1.0 \
{{RED number long} {(default) points {sequence IDL:acme/m/Point:1.0}}} {}} \
{exception {IDL:acme/m/Wrong:1.0 Wrong 1.0} {{why string}} {}} \
{interface {IDL:acme/m/Thing:1.0 Thing 1.0}} \
{interface {IDL:acme/m/Base:1.0 Base 1.0} {} \
{{attribute {IDL:acme/m/Base/size:1.0 size 1.0} long readonly}}} \
{interface {IDL:acme/m/Thing:1.0 Thing 1.0} IDL:acme/m/Base:1.0 {\
{attribute {IDL:acme/m/Thing/paint:1.0 paint 1.0} IDL:acme/m/Colour:1.0} \
{operation {IDL:acme/m/Thing/poke:1.0 poke 1.0} void {{in what any}} {} oneway} \
{operation {IDL:acme/m/Thing/find:1.0 find 1.0} IDL:acme/m/Thing:1.0 \
{{in which IDL:acme/m/Few:1.0} {out found IDL:acme/m/Choice:1.0} \
{inout n {unsigned long long}}} IDL:acme/m/Wrong:1.0}}}}}
}
"""

# Prints the commands of a script to Combat, with every list written in the same way.
CANONICAL = """
proc canonical {list depth} {
    if {$depth == 0} { return $list }
    lmap element $list { canonical $element [expr {$depth - 1}] }
}
namespace eval combat { proc ir {add data} { puts [canonical $data 8] } }
package provide combat 0.8
source [lindex $argv 0]
"""


def script(idl):
    return subprocess.run(["omniidl", f"-p{ROOT}/tools/omniidl", "-bcombat", f"-I{ROOT}/idl", idl],
                          check=True, capture_output=True, text=True).stdout


def tclsh(text, *arguments):
    with tempfile.NamedTemporaryFile("w", suffix=".tcl") as file:
        file.write(text)
        file.flush()
        return subprocess.run(["tclsh", file.name, *arguments], check=True, capture_output=True,
                              text=True).stdout


def canonical(path):
    return tclsh(CANONICAL, path)


class CombatTest(unittest.TestCase):
    def test_tells_everything_that_idl_can_say(self):
        with tempfile.NamedTemporaryFile("w", suffix=".idl") as file:
            file.write(EVERYTHING)
            file.flush()
            self.assertIn(TOLD, script(file.name))

    @unittest.skipUnless(EXAMPLES.exists(), "the examples of tcl-combat are not installed")
    def test_says_what_idl2tcl_says(self):
        for name in ("account/account", "hello/hello", "random/Random"):
            with tempfile.NamedTemporaryFile("w", suffix=".tcl") as file:
                file.write(script(EXAMPLES / f"{name}.idl"))
                file.flush()
                self.assertEqual(canonical(file.name), canonical(EXAMPLES / f"{name}.tcl"))

    def test_combat_takes_our_idl(self):
        for idl in sorted((ROOT / "idl").glob("*.idl")):
            self.assertEqual(tclsh(script(idl) + "\nputs taken"), "taken\n", idl)

    def test_refuses_what_combat_cannot_be_told(self):
        with tempfile.NamedTemporaryFile("w", suffix=".idl") as file:
            file.write("valuetype V { public long x; };")
            file.flush()
            with self.assertRaises(subprocess.CalledProcessError) as raised:
                script(file.name)
            self.assertIn("V: Combat is not told of value types", raised.exception.stderr)


if __name__ == "__main__":
    unittest.main()
