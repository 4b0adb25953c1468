"""Checks a site of tools/make_docs: it has no dead links, and loads nothing from the network."""

import posixpath
import re
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

LOADED = {("script", "src"), ("img", "src"), ("link", "href"), ("iframe", "src"), ("source", "src")}


class Page(HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.names, self.links, self.loaded = set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if value is None:
                continue
            if name == "id" or (tag, name) == ("a", "name"):
                self.names.add(value)
            elif (tag, name) in LOADED:
                self.loaded.append(value)
                self.links.append(value)
            elif (tag, name) == ("a", "href"):
                self.links.append(value)


def is_external(link):
    return bool(urlsplit(link).scheme or urlsplit(link).netloc)


def problems_in(site):
    """Returns sentences about problems. For doxygen's pages, below reference/, only loaded files are checked."""
    site = Path(site)
    pages = {}

    def page(file):
        if file not in pages:
            pages[file] = Page(file.read_text(encoding="utf-8"))
        return pages[file]

    for file in sorted(site.rglob("*.html")):
        place = file.relative_to(site).as_posix()
        for link in page(file).loaded:
            if is_external(link) and not link.startswith(("data:", "javascript:")):
                yield f"{place} loads {link} from the network"
        if place.startswith("reference/"):
            continue
        for link in page(file).links:
            if is_external(link):
                continue
            parts = urlsplit(link)
            path = posixpath.join(posixpath.dirname(place), unquote(parts.path)) if parts.path else place
            target = site / posixpath.normpath(path)
            if target.is_dir():
                target /= "index.html"
            if posixpath.normpath(path).startswith("..") or parts.path.startswith("/") or not target.is_file():
                yield f"{place}: the link {link} leads to nothing"
            elif parts.fragment and target.suffix == ".html" and not parts.fragment.startswith("__") \
                    and unquote(parts.fragment) not in page(target).names:
                yield f"{place}: the page of the link {link} has no such heading"
    for file in sorted(site.rglob("*.css")):
        for found in re.finditer(r"url\(\s*['\"]?(https?:)?//|@import\s+['\"]https?:", file.read_text(encoding="utf-8")):
            yield f"{file.relative_to(site)} loads {found.group()} from the network"
