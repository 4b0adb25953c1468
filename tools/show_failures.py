#!/usr/bin/env python3
"""Prints the last lines of the output of each failed test, so that they are at the end of a log.

usage: show_failures.py JUNIT.xml

JUNIT.xml is the file that `ctest --output-junit` writes. At most LINES lines of each test's output
are printed.
"""

import sys
import xml.etree.ElementTree as ElementTree

LINES = 25


def failures(root):
    """Returns the name and the end of the output of each failed test, in the order of the file."""
    found = []
    for case in root.iter("testcase"):
        if case.get("status") != "fail":
            continue
        said = (case.findtext("system-out") or "").strip().splitlines()
        found.append((case.get("name"), said[-LINES:]))
    return found


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: show_failures.py JUNIT.xml")
    for name, said in failures(ElementTree.parse(sys.argv[1]).getroot()):
        print(f"{name} failed:")
        for line in said:
            print(f"  {line}")
        print()


if __name__ == "__main__":
    main()
