#!/usr/bin/env python3
"""Checks every #include in the C++ sources by the rules of docs/layers.txt.

usage: check_layers.py [ROOT]    ROOT: the repository (default: the repository of this script)

Prints each violation as FILE:LINE: SENTENCE. Exits with 1 if there is a violation.
"""

import re
import sys
from pathlib import Path

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
LINE_COMMENT = re.compile(r"//.*")
STRING = re.compile(r'"(?:[^"\\]|\\.)*"')
TEST_SOURCE = re.compile(r"_(test|testing|benchmark|fuzz)\.(h|cc)$|(^|/)testing/")

# Code that the core must not use: its name in docs/layers.txt, and a pattern that recognises it in
# the path of an include or in a line of code.
FORBIDDEN_INCLUDES = {
    "corba": re.compile(r"^(omniORB4|omnithread|omniconfig|COS|idl)(/|\.|$)"),
    "sockets": re.compile(r"^(boost/(asio|beast)|sys/(socket|un)\.h|netinet/|arpa/|netdb\.h)"),
    "opengl": re.compile(r"^(EGL|GL|GLES\d?|KHR)/"),
}
FORBIDDEN_CODE = {
    "wall-clock": re.compile(
        r"\b(steady_clock|system_clock|high_resolution_clock|clock_gettime|gettimeofday)\b"
    ),
}
# Headers that may be included only in folders with a line "except FOLDER NAME" in docs/layers.txt.
# NAME is the key below.
WALLED_INCLUDES = {
    "omniorb-internals": re.compile(
        r"^(omniORB4/((giop|tcp|unix)\w+|omniIOR|omniObjRef|omniURI)\.h|tcpSocket\.h"
        r"|SocketCollection\.h|gsv/orb/transport/omniorb_internals\.h)$"
    ),
}

# Code that only tests and examples may use, because gsv/base has equivalents that clang can check.
UNCHECKED_CODE = re.compile(r"\bstd::((timed_|shared_|recursive_)?mutex|condition_variable)\b")


class Table:
    """The content of docs/layers.txt: the ordered folders, their allowed includes, and the limits of the core."""

    def __init__(self, text):
        self.folders = []
        self.core = set()
        self.exceptions = []  # (path or folder, name of the forbidden code that it may use)
        self.allowed = {}
        for line in text.splitlines():
            words = line.split("#")[0].split()
            if not words:
                continue
            if words[0] == "core":
                self.core.update(words[1:])
            elif words[0] == "except":
                self.exceptions.append((words[1], words[2]))
            else:
                self._add_folder(words[0], words[1:])

    def _add_folder(self, folder, may_include):
        reached = {folder}
        for lower in may_include:
            if lower == "*":
                reached.update(self.folders)
            elif lower in self.allowed:
                reached |= self.allowed[lower]
            else:
                raise ValueError(f"{folder} may include {lower}, which is not declared above it")
        self.folders.append(folder)
        self.allowed[folder] = reached

    def folder_of(self, path):
        """Returns the deepest declared folder that contains the path, or None."""
        holding = [f for f in self.folders if path.startswith(f + "/")]
        return max(holding, key=len, default=None)

    def may_include(self, path, folder, included_folder):
        if TEST_SOURCE.search(path):
            if library_of(included_folder) == library_of(folder):
                return True
            return self.folders.index(included_folder) <= self.folders.index(folder)
        return included_folder in self.allowed[folder]

    def is_core(self, folder):
        return any(folder == core or folder.startswith(core + "/") for core in self.core)

    def is_excepted(self, path, use):
        return any(
            use == allowed_use and (path == place or path.startswith(place + "/"))
            for place, allowed_use in self.exceptions
        )


def library_of(folder):
    """Returns the library of a folder, such as gsv/broker for gsv/broker/storage."""
    return "/".join(folder.split("/")[:2])


def sources_below(root, tops):
    for top in sorted(tops):
        for path in sorted((root / top).rglob("*")):
            if path.suffix in (".h", ".cc") and "node_modules" not in path.parts:
                yield path.relative_to(root).as_posix()


def check_include(table, root, path, folder, quote, included):
    """Returns a sentence about the problem of one include, or None."""
    included_folder = table.folder_of(included)
    if included_folder is None:
        if quote == '"' and (root / path).parent.joinpath(included).exists():
            return f'"{included}" is not written from the repository\'s root'
    elif not table.may_include(path, folder, included_folder):
        return f"{folder} may not include {included_folder} ({included}); see docs/layers.txt"
    for use, pattern in WALLED_INCLUDES.items():
        if pattern.search(included) and not table.is_excepted(path, use):
            return f"{folder} may not use {use} ({included}); see docs/layers.txt"
    if not table.is_core(folder):
        return None
    for use, pattern in FORBIDDEN_INCLUDES.items():
        if pattern.search(included) and not table.is_excepted(path, use):
            return f"the core may not use {use} ({included}); see docs/layers.txt"
    return None


def check_code(table, path, folder, code):
    """Returns a sentence about a forbidden use in one line of code, or None."""
    if TEST_SOURCE.search(path) or folder.startswith(("tests", "examples")):
        return None
    unchecked = UNCHECKED_CODE.search(code)
    if unchecked and not table.is_excepted(path, "unchecked-locks"):
        return f"use gsv/base/mutex.h, which clang can check, instead of {unchecked.group(0)}"
    if not table.is_core(folder):
        return None
    for use, pattern in FORBIDDEN_CODE.items():
        found = pattern.search(code)
        if found and not table.is_excepted(path, use):
            return f"the core may not use {use} ({found.group(0)}); see docs/layers.txt"
    return None


def violations(root, table):
    tops = {folder.split("/")[0] for folder in table.folders}
    for path in sources_below(root, tops):
        folder = table.folder_of(path)
        if folder is None:
            yield f"{path}:1: docs/layers.txt does not name this folder"
            continue
        text = (root / path).read_text(encoding="utf-8", errors="replace")
        for number, line in enumerate(text.splitlines(), start=1):
            include = INCLUDE.match(line)
            if include:
                problem = check_include(table, root, path, folder, *include.groups())
            else:
                code = LINE_COMMENT.sub("", STRING.sub('""', line))
                problem = check_code(table, path, folder, code)
            if problem:
                yield f"{path}:{number}: {problem}"


def main(arguments):
    root = Path(arguments[0] if arguments else Path(__file__).parent.parent).resolve()
    table = Table((root / "docs" / "layers.txt").read_text(encoding="utf-8"))
    found = list(violations(root, table))
    for violation in found:
        print(violation)
    print(f"{len(found)} violations of docs/layers.txt" if found else "the layers hold")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
