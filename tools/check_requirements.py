#!/usr/bin/env python3
"""Checks docs/requirements.md: every use case must name tests, and these must have run and passed.

usage: check_requirements.py REQUIREMENTS.md JUNIT.xml [PAGE.md ...]

The requirements are sections ("## RQ1 …") with table rows
    | RQ1.1 | use case | `Suite.Name`, `a-ctest-name` |
In the other pages, every test named in the last column of a table headed "Shown by" must have
passed as well. JUNIT.xml is the file that `ctest --output-junit` writes. Prints one sentence for
each problem, and exits with 1 if there are any. A skipped test counts as not run.
"""

import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

EXPECTED_SECTIONS = [f"RQ{number}" for number in range(1, 13)]
SECTION = re.compile(r"^## (\w+)\b")
USE_CASE = re.compile(r"^\|\s*(\w+)\.(\d+)\s*\|(.*)\|([^|]*)\|\s*$")
NAME = re.compile(r"`([^`]+)`")


class UseCase:
    def __init__(self, identifier, line, tests):
        self.identifier = identifier
        self.line = line
        self.tests = tests


def read_requirements(text, source):
    """Returns the use cases by section, and a sentence for each problem of the page."""
    sections, problems, section = {}, [], None
    seen = set()
    for number, line in enumerate(text.splitlines(), start=1):
        heading = SECTION.match(line)
        if heading:
            section = heading.group(1)
            sections.setdefault(section, [])
            continue
        row = USE_CASE.match(line)
        if not row:
            continue
        identifier = f"{row.group(1)}.{row.group(2)}"
        if row.group(1) != section:
            problems.append(f"{source}:{number}: {identifier} stands in the section {section}")
        if identifier in seen:
            problems.append(f"{source}:{number}: {identifier} appears twice")
        seen.add(identifier)
        sections.setdefault(row.group(1), []).append(
            UseCase(identifier, number, NAME.findall(row.group(4)))
        )
    for expected in EXPECTED_SECTIONS:
        if not sections.get(expected):
            problems.append(f"{source}: {expected} has no use case")
    return sections, problems


def outcome(case):
    """Returns the result of one <testcase>: "passed", "failed" or "skipped"."""
    if case.find("failure") is not None or case.find("error") is not None:
        return "failed"
    if case.find("skipped") is not None or case.get("status") in ("notrun", "disabled"):
        return "skipped"
    return "failed" if case.get("status") == "fail" else "passed"


def read_outcomes(junit):
    return {case.get("name"): outcome(case) for case in ElementTree.parse(junit).iter("testcase")}


def unkept(sections, outcomes, source):
    """Returns a sentence for each use case without passed tests."""
    says = {None: "is not among the tests that ran", "failed": "failed", "skipped": "was skipped"}
    for use_cases in sections.values():
        for use_case in use_cases:
            place = f"{source}:{use_case.line}: {use_case.identifier}"
            if not use_case.tests:
                yield f"{place} names no test"
            for test in use_case.tests:
                result = outcomes.get(test)
                if result != "passed":
                    yield f"{place}: the test {test} {says[result]}"


def read_promises(text, source):
    """Returns the tests in the last column of a page's tables, as use cases by line."""
    promises, shows = [], False
    for number, line in enumerate(text.splitlines(), start=1):
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if not line.startswith("|"):
            shows = False
        elif cells[-1] == "Shown by":
            shows = True
        elif shows and NAME.search(cells[-1]):
            promises.append(UseCase("this row", number, NAME.findall(cells[-1])))
    if not promises:
        return [], [f"{source}: no table here names a test"]
    return promises, []


def main(arguments):
    if len(arguments) < 2:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    source, junit, *pages = arguments
    sections, problems = read_requirements(Path(source).read_text(encoding="utf-8"), source)
    try:
        outcomes = read_outcomes(junit)
    except (OSError, ElementTree.ParseError) as error:
        print(f"{junit}: no test results to read ({error}); run the tests first")
        return 1
    problems += unkept(sections, outcomes, source)
    for page in pages:
        promises, wrong = read_promises(Path(page).read_text(encoding="utf-8"), page)
        problems += wrong
        problems += unkept({page: promises}, outcomes, page)
    for problem in problems:
        print(problem)
    count = sum(len(use_cases) for use_cases in sections.values())
    if problems:
        print(f"requirements: {len(problems)} problems in {count} use cases")
        return 1
    print(f"requirements: all {count} use cases are shown by tests that passed")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
