#!/usr/bin/env python3
"""Tests tools/omniidl/message_signatures.py."""

import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent

EVERYTHING = """
#pragma prefix "acme"
module m {
  enum Colour { RED, GREEN, BLUE };
  typedef sequence<string> Names;
  struct Point { double x; short y; boolean is_known; any content; };
  typedef sequence<Point> Points;
  union Choice switch (Colour) { case GREEN: Names all; case RED: any one; default: Point other; };
  exception Wrong { string why; };
  exception Puzzling { long code; any what; };
  interface Thing {
    readonly attribute CORBA::TypeCode kind;
    attribute any content;
    void plain(in string name);
    Point move(in Names which, inout Choice chosen, in Thing other, out octet rest);
    oneway void poke(in Points where, in unsigned long long id, in float weight);
  };
};
"""

CHOICE = "<4;1:[s];0:a;*:821a;>"
TABLES = f"""
constexpr orb::Signature kRequests[] = {{
    {{"_set_content", "a"}},
    {{"move", "[s]{CHOICE}o"}},
    {{"poke", "[821a]84"}},
}};

constexpr orb::Signature kReplies[] = {{
    {{"_get_content", "a"}},
    {{"_get_kind", "t"}},
    {{"move", "821a{CHOICE}1"}},
}};

constexpr orb::Signature kExceptions[] = {{
    {{"IDL:acme/m/Puzzling:1.0", "4a"}},
}};
"""


def signatures(idl):
    with tempfile.NamedTemporaryFile("w", suffix=".idl") as file:
        file.write(idl)
        file.flush()
        return subprocess.run(
            ["omniidl", f"-p{ROOT}/tools/omniidl", "-bmessage_signatures", "-Wbfunction=acme::Signatures",
             "-Wbheader=acme/signatures.h", file.name], check=True, capture_output=True, text=True).stdout


class MessageSignaturesTest(unittest.TestCase):
    def test_lists_what_passes_an_any_or_a_type_code(self):
        self.assertIn(TABLES, signatures(EVERYTHING))

    def test_defines_the_function_that_it_is_told(self):
        source = signatures(EVERYTHING)
        self.assertIn('#include "acme/signatures.h"', source)
        self.assertIn("namespace acme {", source)
        self.assertIn("const orb::Signatures& Signatures() {", source)

    def test_refuses_one_name_with_two_signatures(self):
        self.refuses("interface A { void put(in any what); }; interface B { void put(in string name, in any what); };",
                     "two operations put pass different types: a and sa")

    def test_refuses_types_that_it_does_not_know(self):
        self.refuses("interface A { void put(in any what, in wstring name); };", "does not know the type")
        self.refuses("struct S { long values[3]; any what; }; interface A { void put(in S all); };",
                     "does not know arrays: values")

    def refuses(self, idl, sentence):
        with self.assertRaises(subprocess.CalledProcessError) as raised:
            signatures(idl)
        self.assertIn(sentence, raised.exception.stderr)


if __name__ == "__main__":
    unittest.main()
