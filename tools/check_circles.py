#!/usr/bin/env python3
"""Finds cycles among the includes of the C++ sources and among the imports of web/src.

usage: check_circles.py [ROOT]    ROOT: the repository (default: the repository of this script)

C++         no file may include itself, directly or by other files. docs/layers.txt prevents cycles of folders.
TypeScript  no file may import itself, directly or by other files. The statements import, export … from and
            import(…) count as imports, also if they import only types. No cycle of folders in web/src may result
            from the imports of their files. Imports of tests do not count for folders.

Prints each cycle as FILE:LINE: SENTENCE, where FILE:LINE is one of its includes or imports. Exits with 1 if there
is a cycle.
"""

import posixpath
import re
import sys
from pathlib import Path

CPP_TOPS = ("gsv", "sdk", "apps", "behaviours", "examples", "tests")
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
WEB = "web/src"
IMPORT = re.compile(r"""(?:^|[^\w.])(?:from|import)\s*\(?\s*["'](\.[^"']*)["']""")
BLOCK_COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)
LINE_COMMENT = re.compile(r"^\s*//.*$", re.MULTILINE)
# Tests, and files that only tests use, may import from any folder.
WEB_TEST = re.compile(r"\.test\.ts$|/test[A-Z]\w*\.ts$")


def blanked(text, *patterns):
    """Returns the text without the matches of the patterns. Line numbers do not change."""
    for pattern in patterns:
        text = pattern.sub(lambda match: "\n" * match.group(0).count("\n"), text)
    return text


def line_of(text, offset):
    return text.count("\n", 0, offset) + 1


def cpp_edges(root):
    """Returns {file: {included file: line}} for GSV's C++ sources."""
    files = {
        path.relative_to(root).as_posix(): path
        for top in CPP_TOPS
        for path in sorted((root / top).rglob("*"))
        if path.suffix in (".h", ".cc") and "node_modules" not in path.parts
    }
    edges = {}
    for name, path in files.items():
        text = blanked(path.read_text(encoding="utf-8", errors="replace"), BLOCK_COMMENT)
        edges[name] = {
            match.group(1): line_of(text, match.start(1))
            for match in INCLUDE.finditer(text)
            if match.group(1) in files
        }
    return edges


def web_edges(root):
    """Returns {file: {imported file: line}} for the viewer's TypeScript sources."""
    files = {path.relative_to(root).as_posix(): path for path in sorted((root / WEB).rglob("*.ts"))}
    edges = {}
    for name, path in files.items():
        text = blanked(path.read_text(encoding="utf-8"), BLOCK_COMMENT, LINE_COMMENT)
        edges[name] = {}
        for match in IMPORT.finditer(text):
            target = posixpath.normpath(posixpath.join(posixpath.dirname(name), match.group(1)))
            for candidate in (target, f"{target}.ts", f"{target}/index.ts"):
                if candidate in files:
                    edges[name].setdefault(candidate, line_of(text, match.start(1)))
    return edges


def folder_edges(edges):
    """Returns {folder: {folder: (file, line)}} with the first import between two folders. Tests are left out."""
    folders = {}
    for name, targets in edges.items():
        if WEB_TEST.search(name):
            continue
        folder = posixpath.dirname(name)
        for target, line in targets.items():
            if posixpath.dirname(target) != folder:
                folders.setdefault(folder, {}).setdefault(posixpath.dirname(target), (name, line))
    return folders


def circles(edges):
    """Returns cycles: a shortest cycle through each node that no earlier cycle contains."""
    found, passed = [], set()
    for start in sorted(edges):
        if start in passed:
            continue
        circle = shortest_way_back(edges, start)
        if circle:
            found.append(circle)
            passed.update(circle)
    return found


def shortest_way_back(edges, start):
    """Returns the shortest path [start, …, start], or None if no path leads back."""
    came_from, front = {}, [start]
    while front:
        behind = []
        for node in front:
            for target in edges.get(node, ()):
                if target == start:
                    way = [start, node]
                    while way[-1] != start:
                        way.append(came_from[way[-1]])
                    return way[::-1]
                if target not in came_from:
                    came_from[target] = node
                    behind.append(target)
        front = behind
    return None


def problems(root):
    for verb, edges in (("includes", cpp_edges(root)), ("imports", web_edges(root))):
        for circle in circles(edges):
            yield f"{circle[0]}:{edges[circle[0]][circle[1]]}: the file {verb} itself: {' -> '.join(circle)}"
        if verb == "includes":
            continue
        folders = folder_edges(edges)
        for circle in circles(folders):
            file, line = folders[circle[0]][circle[1]]
            yield f"{file}:{line}: the folder imports itself: {' -> '.join(circle)}"


def main(arguments):
    root = Path(arguments[0] if arguments else Path(__file__).parent.parent).resolve()
    found = list(problems(root))
    for problem in found:
        print(problem)
    print(f"{len(found)} circles" if found else "no circles")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
