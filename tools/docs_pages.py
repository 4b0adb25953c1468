"""Collects the pages of the documentation site from the source tree, for tools/make_docs.

The text of a page is unchanged. Links are changed if their target has another place in the site: pages
of the root folder are in the same folder as pages of docs/. If a link leads to a file or folder of the
source tree that is no page, such as an example, the site gets a page that shows this file or folder.
"""

import posixpath
import re
from pathlib import Path

ROOT_PAGES = {"README.md": "index.md", "ARCHITECTURE.md": "architecture.md",
              "CONTRIBUTING.md": "contributing.md", "CHANGELOG.md": "changelog.md",
              "web/README.md": "web.md"}
IMAGES = {".png", ".jpg", ".svg", ".gif", ".webp"}
LANGUAGES = {".cc": "cpp", ".h": "cpp", ".idl": "idl", ".py": "python", ".mjs": "javascript", ".ts": "typescript",
             ".json": "json", ".yaml": "yaml", ".yml": "yaml", ".tcl": "tcl", ".sdf": "xml", ".urdf": "xml",
             ".cmake": "cmake", ".sh": "bash", ".md": "markdown"}
MAX_SOURCE_BYTES = 200_000

# The order of pages. A page that is not listed is in the section of its folder, or else in "More".
SECTIONS = (
    ("Tutorial", ("tutorial/README.md", "tutorial/*")),
    ("Guides", ("install.md", "viewer.md", "worlds.md", "sensors.md", "actuators.md", "ros2.md", "python.md",
                "testing.md", "campaigns.md")),
    ("Services", ("services.md", "broker.md")),
    ("Operation", ("security.md", "limits.md", "monitoring.md", "reliability.md", "performance.md")),
    ("Accuracy", ("fidelity.md", "reality.md", "determinism.md")),
    ("Formats", ("formats/*",)),
    ("Reference", ("reference.md",)),
    ("Development", ("architecture.md", "extending.md", "contributing.md", "web.md", "requirements.md",
                     "changelog.md")),
    ("Decisions", ("adr/README.md", "adr/*")),
)
REFERENCE_PAGE = """# Reference

- <a href="reference/cpp/index.html">C++</a>: headers of the SDK and of the libraries below it
- <a href="reference/idl/index.html">IDL</a>: interfaces of the CORBA services
- <a href="reference/python/index.html">Python</a>: the module `gsv`
"""

LINK = re.compile(r"(\]\(|\b(?:src|href)=\")([^)\s\"#]*)(#[^)\s\"]*)?(?=[)\s\"])")


class Site:
    """The pages of the site, by their paths in the site."""

    def __init__(self, root):
        self.root = Path(root)
        self.places = {}  # {path in the source tree: path in the site}, for pages and images
        self.pages = {}  # {path in the site: text or bytes}
        self.dead = []  # "file:line: sentence"
        self._sources = []

    def collect(self):
        files = {name: place for name, place in ROOT_PAGES.items() if (self.root / name).exists()}
        for file in sorted((self.root / "docs").rglob("*")):
            if file.suffix == ".md" or file.suffix in IMAGES:
                path = file.relative_to(self.root).as_posix()
                files[path] = path.removeprefix("docs/")
        self.places = dict(files)
        for path, place in files.items():
            if not path.endswith(".md"):
                self.pages[place] = (self.root / path).read_bytes()
        for path, place in files.items():
            if path.endswith(".md"):
                self.pages[place] = self._page(path, place)
        self.pages["reference.md"] = REFERENCE_PAGE
        while self._sources:
            self._show(self._sources.pop())
        return self

    def _page(self, path, place):
        lines, fence = [], None
        text = (self.root / path).read_text(encoding="utf-8")
        for number, line in enumerate(text.splitlines(), start=1):
            mark = re.match(r"\s*(```+|~~~+)", line)
            if mark and (fence is None or line.strip() == fence):
                fence = None if fence else mark.group(1)
            elif fence is None:
                line = self._relinked(line, path, place, number)
                if begins_list(line, lines):
                    lines.append("")
            lines.append(line)
        return "\n".join(lines) + "\n"

    def _relinked(self, line, path, place, number):
        code = [found.span() for found in re.finditer(r"(`+)(?:.+?)\1", line)]

        def link(found):
            target, anchor = found.group(2), found.group(3) or ""
            within_code = any(start <= found.start() < end for start, end in code)
            if within_code or not target or re.match(r"[a-z]+:", target):
                return found.group()
            there = posixpath.normpath(posixpath.join(posixpath.dirname(path), target))
            new = self._place_of(there)
            if new is None:
                self.dead.append(f"{path}:{number}: the link {target} leads to nothing")
                return found.group()
            return found.group(1) + posixpath.relpath(new, posixpath.dirname(place) or ".") + anchor

        return LINK.sub(link, line)

    def _place_of(self, path):
        """Returns the path in the site of a file or folder of the source tree, or None."""
        for candidate in (path, f"{path}/README.md"):
            if candidate in self.places:
                return self.places[candidate]
        if path.startswith("..") or not (self.root / path).exists():
            return None
        self.places[path] = f"sources/{path}.md"
        self._sources.append(path)
        return self.places[path]

    def _show(self, path):
        """Adds the page that shows a file or folder of the source tree."""
        file, place = self.root / path, self.places[path]
        lines = ["---", "search:", "  exclude: true", "---", f"# {path}", ""]
        if file.is_dir():
            for entry in sorted(file.iterdir()):
                name = entry.relative_to(self.root).as_posix()
                if entry.name.startswith((".", "__pycache__")):
                    continue
                is_shown = entry.is_dir() or is_text(entry)
                there = self._place_of(name) if is_shown else None
                link = f"[{entry.name}]({posixpath.relpath(there, posixpath.dirname(place))})" if there else entry.name
                lines.append(f"- {link}")
        else:
            fence = "`" * 10
            shown = file.read_text(encoding="utf-8") if is_text(file) else f"{file.stat().st_size} bytes"
            lines += [fence + LANGUAGES.get(file.suffix, "text"), shown.rstrip("\n"), fence]
        self.pages[place] = "\n".join(lines) + "\n"

    def navigation(self):
        """Returns the sections and their pages, in order, in the format of mkdocs."""
        left = sorted(page for page in self.pages
                      if page.endswith(".md") and not page.startswith("sources/") and page != "index.md")
        navigation = [{"Home": "index.md"}]
        for title, patterns in SECTIONS:
            pages = []
            for pattern in patterns:
                found = [page for page in left if page == pattern or
                         (pattern.endswith("/*") and posixpath.dirname(page) == pattern[:-2])]
                pages += found
                left = [page for page in left if page not in found]
            if pages:
                navigation.append({title: pages})
        if left:
            navigation.append({"More": left})
        return navigation

    def inputs(self):
        """Returns the paths whose changes change the site: its source files, and the folders of docs/ in
        which they are."""
        files = [self.root / path for path in self.places]
        return files + sorted({file.parent for file in files if file.is_relative_to(self.root / "docs")})

    def write(self, folder):
        for place, content in self.pages.items():
            file = Path(folder) / place
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(content if isinstance(content, bytes) else content.encode())


def begins_list(line, before):
    """Returns whether a list begins here without the empty line that Python-Markdown requires."""
    item = re.compile(r"\s*([-*+]|\d+\.)\s")
    return bool(item.match(line) and before and before[-1].strip() and not item.match(before[-1])
                and not before[-1].startswith((" ", "|", "#")))


def is_text(file):
    if not file.is_file() or file.stat().st_size > MAX_SOURCE_BYTES:
        return False
    try:
        return "\0" not in file.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        return False
