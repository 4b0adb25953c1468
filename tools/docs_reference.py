"""Prepares the public headers, the IDL and the Python module for doxygen, for tools/make_docs.

The comments of this tree begin with "//", but doxygen reads "///". A comment above a declaration
documents the declaration. A comment behind a declaration documents the declaration before the comment.
The first comment of a file documents the file.
"""

import re
from pathlib import Path

# Folders of headers for applications, behaviours and sensor plug-ins. cmake/GsvInstall.cmake
# installs these, and the headers that they include.
CPP_FOLDERS = ("sdk", "sdk/behaviour", "sdk/testing", "gsv/base", "gsv/readings", "gsv/geometry", "gsv/broker/client",
               "gsv/sensing", "gsv/services")
REFERENCES = {"cpp": "GSV C++ reference", "idl": "GSV IDL reference", "python": "GSV Python reference"}
MAIN_PAGES = {
    "cpp": "[Documentation](../../index.html), [all classes](annotated.html).\n\nHeaders of the SDK (`sdk/`) and of the libraries that it uses. Behaviours begin at "
           "gsv::sdk, sensor plug-ins at gsv::sensing.",
    "idl": "[Documentation](../../index.html), [all interfaces](annotated.html).\n\nInterfaces of the CORBA services, module gsv::sba.",
    "python": "[Documentation](../../index.html), [all classes](annotated.html).\n\nThe module `gsv`: behaviours, applications and fixtures for pytest.",
}


def escaped(comment):
    """Returns a comment in which all characters are literal, except for code in backticks."""
    parts = re.split(r"(`[^`]*`)", comment)
    for index in range(0, len(parts), 2):
        parts[index] = re.sub(r"([\\@#%])", r"\\\1", parts[index]).replace("<", "&lt;")
    return "".join(parts)


def documented(source):
    """Returns the source with comments in doxygen's format."""
    lines, column, is_first = [], None, True
    for line in source.splitlines():
        found = re.match(r'((?:[^"/]|"(?:[^"\\]|\\.)*"|/(?![/*]))*)//(?!/)\s?(.*)', line)
        if not found:
            column = None
            is_first = is_first and not line.strip()
            lines.append(line)
            continue
        code, words = found.groups()
        continues = column == len(code) and not code.strip()
        if words.startswith(("namespace", "clang-format", "NOLINT")):
            lines.append(line)
        elif code.strip() or continues:
            column = len(code)
            lines.append(f"{code}///< {escaped(words)}")
        else:
            column = None
            lines.append(f"{code}/// " + ("\\file\n/// " if is_first and not code else "") + escaped(words))
            is_first = False
    return "\n".join(lines) + "\n"


def files_of(root, language):
    root = Path(root)
    if language == "cpp":
        for folder in CPP_FOLDERS:
            yield from sorted(file for file in (root / folder).glob("*.h") if not file.stem.startswith("test_"))
    elif language == "idl":
        yield from sorted((root / "idl").glob("*.idl"))
    else:
        yield from sorted((root / "sdk/python/gsv").glob("*.py*"))


def prepare(root, language, folder):
    """Copies the sources of a language's reference documentation into a folder, with a main page."""
    for file in files_of(root, language):
        text = file.read_text(encoding="utf-8")
        there = Path(folder) / file.relative_to(root)
        if language == "python":
            there = Path(folder) / "gsv" / file.name.replace(".pyi", ".py")
        there.parent.mkdir(parents=True, exist_ok=True)
        there.write_text(text if language == "python" else documented(text), encoding="utf-8")
    title = REFERENCES[language]
    Path(folder, "main.md").write_text(f"# {title} {{#mainpage}}\n\n{MAIN_PAGES[language]}\n", encoding="utf-8")
