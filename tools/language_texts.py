"""Extracts from the source tree the texts that people read, for tools/check_language.

A text is one paragraph, list item, table cell, heading, help line, string of the page or comment.
Code inside a text (`like_this`) becomes the word "CODE", so that names do not count as language.
"""

import ast
import re
from dataclasses import dataclass
from pathlib import Path

SKIPPED_FOLDERS = {"build", "node_modules", ".git", "generated"}
CODE = "CODE"


@dataclass(frozen=True)
class Text:
    line: int  # line of the first character, from 1
    kind: str  # "docs", "heading", "cell", "help", "ui", "comment", "name", "test"
    words: str


def without_code(text):
    """Replaces code spans by CODE, and Markdown links and images by their visible texts."""
    text = re.sub(r"(`+)(.+?)\1", CODE, text)
    text = re.sub(r"<!--.*?-->", "", text)
    text = re.sub(r"!\[([^\]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"\bhttps?://\S+", CODE, text)
    return re.sub(r"\*\*|__|\s+", lambda found: " " if found.group().isspace() else "", text).strip()


def texts_of_markdown(source):
    paragraph, start, fence = [], 0, None

    def ended():
        nonlocal paragraph
        words, paragraph = without_code(" ".join(paragraph)), []
        return [Text(start, "docs", words)] if words else []

    for number, line in enumerate(source.splitlines(), start=1):
        stripped = line.strip()
        mark = re.match(r"(```+|~~~+)", stripped)
        if fence or mark:
            yield from ended()
            if mark and (fence is None or stripped == fence):
                fence = None if fence else mark.group(1)
            continue
        heading = re.match(r"#+\s+(.*)", stripped)
        item = re.match(r"([-*+]|\d+\.)\s+(.*)", stripped)
        if heading:
            yield from ended()
            yield Text(number, "heading", without_code(heading.group(1)))
        elif stripped.startswith("|"):
            yield from ended()
            for cell in re.split(r"(?<!\\)\|", stripped.strip("|")):
                if re.search(r"\w", cell):
                    yield Text(number, "cell", without_code(cell))
        elif not stripped or stripped.startswith("<"):
            yield from ended()
        else:
            if item:
                yield from ended()
                stripped = item.group(2)
            if not paragraph:
                start = number
            paragraph.append(stripped.lstrip("> "))
    yield from ended()


STRING = re.compile(r'"((?:[^"\\]|\\.)*)"')


def end_of_string(source, start):
    """Returns the position behind the string literal whose opening quote is at `start`."""
    quote, at = source[start], start + 1
    while at < len(source) and source[at] != quote:
        at += 2 if source[at] == "\\" else 1
    return at + 1


def arguments_of_call(source, start):
    """Returns the arguments of the call whose "(" is at `start`, as (position, text)."""
    arguments, depth, begin, at = [], 0, start + 1, start
    while at < len(source):
        character = source[at]
        if character in "\"'":
            at = end_of_string(source, at)
            continue
        if source.startswith("//", at):
            at = source.find("\n", at)
            if at < 0:
                break
            continue
        if character in "([{":
            depth += 1
        elif character in ")]}":
            depth -= 1
        if (character == "," and depth == 1) or depth == 0:
            arguments.append((begin, source[begin:at]))
            begin = at + 1
        if depth == 0:
            break
        at += 1
    return arguments


HELP_CALL = re.compile(
    r"\b(?:add_(?:option|flag|subcommand|option_function|flag_function|flag_callback)|"
    r"CLI::App \w+)\s*(?:<[\w:]+>)?(?=\()"
)


def texts_of_help(source):
    """Returns the descriptions of CLI11 options and commands: the first string literal behind the name."""
    for call in HELP_CALL.finditer(source):
        arguments = arguments_of_call(source, call.end())
        named = 0 if call.group().startswith("CLI::App") else 1
        for begin, argument in arguments[named:]:
            if argument.lstrip().startswith('"'):
                begin += len(argument) - len(argument.lstrip())
                words = "".join(STRING.findall(argument)).replace('\\"', '"')
                line = source.count("\n", 0, begin) + 1
                short, _, details = words.partition("\\n")  # details are for the manual page
                yield Text(line, "help", without_code(short))
                if details:
                    yield Text(line, "docs", without_code(details.replace("\\n", " ")))
                break


WORDS_OF_UI = re.compile(r"^[A-Za-z(][\w'’(),:;.!?%…/-]*(?: [\w'’(),:;.!?%…/&·–—-]+)+[ ]?$")
NOT_FOR_READERS = re.compile(
    r"^\s*(import|export \* from|export \{|throw )|console\.|class:|className|querySelector|"
    r"\.style\.|viewBox|data-testid\"?: *$"
)
UI_STRING = re.compile(r'"((?:[^"\\\n]|\\.)*)"|`((?:[^`\\]|\\.)*)`')


def texts_of_typescript(source):
    """Returns string literals of at least two words that the page may show.

    Comments, CSS classes, and lines that only programmers see (such as imports) are left out."""
    source = re.sub(r"/\*.*?\*/", lambda found: "\n" * found.group().count("\n"), source, flags=re.S)
    for number, line in enumerate(source.splitlines(), start=1):
        line = re.sub(r"(^|\s)//.*", "", line)
        line = re.sub(r'\bclass: "[^"]*"', "", line)
        if NOT_FOR_READERS.search(line):
            continue
        for found in UI_STRING.finditer(line):
            words = re.sub(r"\$\{[^}]*\}+", CODE, found.group(1) or found.group(2) or "")
            if WORDS_OF_UI.match(words) and re.search(r"[A-Za-z]{3}", words):  # excludes the drawings of icons
                yield Text(number, "ui", words)


def texts_of_html(source):
    blanked = re.sub(r"<(script|style)\b.*?</\1>|<!--.*?-->",
                     lambda found: "\n" * found.group().count("\n"), source, flags=re.S)
    for found in re.finditer(r'>([^<>]*\w \w[^<>]*)<|(?:title|placeholder|aria-label)="([^"]*)"', blanked):
        words = " ".join((found.group(1) or found.group(2) or "").split())
        if words:
            yield Text(blanked.count("\n", 0, found.start()) + 1, "ui", words)


def looks_like_code(comment):
    return bool(re.search(r"[{;]\s*$|^\s*#|^(clang-format|NOLINT|namespace)", comment))


def texts_of_comments(source):
    """Returns paragraphs of // comments. A comment behind code and its continuation lines are a separate text."""
    paragraph, start, column = [], 0, None

    def ended():
        nonlocal paragraph
        words, paragraph = without_code(" ".join(paragraph)), []
        return [Text(start, "comment", words)] if re.search(r"\w", words) else []

    for number, line in enumerate(source.splitlines(), start=1):
        found = re.match(r'((?:[^"/]|"(?:[^"\\]|\\.)*"|/(?![/*]))*)//+[!<]?\s?(.*)', line)
        if not found:
            yield from ended()
            column = None
            continue
        here, words = len(found.group(1)), found.group(2)
        follows = not found.group(1).strip() and here == column
        indented = re.match(r"\s{2,}|[-*] ", words)  # the line belongs to a list, a formula or a drawing
        if not follows or not words.strip() or indented:
            yield from ended()
        column = here
        if looks_like_code(words) or not words.strip():
            continue
        if not paragraph:
            start = number
        paragraph.append(words.strip().removeprefix("- "))
    yield from ended()


def texts_of_web(source):
    """Returns the strings and the comments of the viewer's sources."""
    yield from texts_of_typescript(source)
    yield from texts_of_comments(source)


def texts_of_script(source):
    """Returns paragraphs of the comments and docstrings of Python, and of the comments of shell scripts.
    Usage lines and indented lines are no texts."""
    first = source.partition("\n")[0]
    if first.startswith("#!") and "python" not in first and not first.endswith("sh"):
        return
    found = []
    for number, line in enumerate(source.splitlines(), start=1):
        comment = re.match(r"\s*#\s(\s*)(.*)", line)
        found.append((number, comment.group(2) if comment and not comment.group(1) else ""))
    found.append((0, ""))
    if not first.endswith("sh"):
        for node in ast.walk(ast.parse(source)):
            if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and ast.get_docstring(node):
                lines = ast.get_docstring(node).splitlines()
                found += [(node.body[0].lineno + i, "" if line.startswith((" ", "usage:")) else line)
                          for i, line in enumerate([*lines, ""])]
    paragraph, start = [], 0
    for number, words in [*found, (0, "")]:
        if paragraph and words.startswith("- "):
            yield Text(start, "comment", without_code(" ".join(paragraph)))
            paragraph = []
        if words.strip() and not looks_like_code(words):
            start = start if paragraph else number
            paragraph.append(words.strip())
        elif paragraph:
            yield Text(start, "comment", without_code(" ".join(paragraph)))
            paragraph = []


def parts_of_name(name):
    """Returns the words of an identifier in lower case: "max wait" for kMaxWait and max_wait_."""
    words = re.findall(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+", re.sub(r"^k(?=[A-Z])", "", name))
    return " ".join(words).lower()


def names_in(source):
    """Returns the identifiers of C++ code outside of comments and strings, each once, with its first line.

    Lines with [[deprecated]] are left out: they keep old names for users of the library."""
    seen = set()
    for number, line in enumerate(source.splitlines(), start=1):
        if line.lstrip().startswith("#") or "[[deprecated" in line:
            continue
        code = re.sub(r'"(?:[^"\\]|\\.)*"|//.*', " ", line)
        for name in re.findall(r"\b[A-Za-z_]\w+", code):
            if name not in seen:
                seen.add(name)
                yield Text(number, "name", name)


def texts_of_header(source):
    yield from texts_of_comments(source)
    yield from names_in(source)


TEST_CASE = re.compile(r"^TEST(?:_F|_P)?\(\s*\w+,\s*(\w+)\s*\)", re.MULTILINE)


def test_names_in(source):
    """Returns the names of GoogleTest's test cases, without their suites."""
    for found in TEST_CASE.finditer(source):
        yield Text(source.count("\n", 0, found.start()) + 1, "test", found.group(1))


def texts_of_source(source):
    yield from texts_of_comments(source)
    yield from test_names_in(source)


def texts_of_program(source):
    yield from texts_of_help(source)
    yield from texts_of_source(source)


def texts_of_openapi(source):
    """Returns the summaries and descriptions of an OpenAPI document in YAML."""
    lines = source.splitlines()
    for number, line in enumerate(lines, start=1):
        found = re.search(r"\b(?:summary|description): *(.*)", line)
        if not found or line.lstrip().startswith("#"):
            continue
        words = found.group(1)
        if words.strip() in (">", "|", ">-", "|-"):
            indent = len(line) - len(line.lstrip())
            block = []
            for below in lines[number:]:
                if below.strip() and len(below) - len(below.lstrip()) <= indent:
                    break
                block.append(below.strip())
            words = " ".join(block)
        elif words.startswith('"'):
            words = STRING.match(words).group(1) if STRING.match(words) else words
        elif line.lstrip().startswith(("-", "{")) or "{" in line[: found.start()]:
            words = re.split(r"[,}]", words)[0]
        if re.search(r"\w", words):
            yield Text(number, "docs", without_code(words))


# The files that contain texts for readers, as patterns below the root, and the function that finds
# the texts.
SOURCES = (
    ("*.md", texts_of_markdown),
    ("docs/**/*.md", texts_of_markdown),
    ("web/*.md", texts_of_markdown),
    ("docs/api.yaml", texts_of_openapi),
    ("apps/**/*.cc", texts_of_program),
    ("behaviours/**/*.cc", texts_of_program),
    ("sdk/**/*.cc", texts_of_program),
    ("gsv/**/*.cc", texts_of_source),
    ("tests/**/*.cc", texts_of_source),
    ("apps/**/*.h", texts_of_header),
    ("tests/**/*.h", texts_of_header),
    ("web/*.html", texts_of_html),
    ("web/src/**/*.ts", texts_of_web),
    ("gsv/**/*.h", texts_of_header),
    ("sdk/**/*.h", texts_of_header),
    ("idl/*.idl", texts_of_comments),
    ("bench/*", texts_of_script),
    ("tools/**/*", texts_of_script),
    ("examples/**/*.py", texts_of_script),
    ("gsv/**/*.py", texts_of_script),
    ("sdk/**/*.py", texts_of_script),
    ("tests/**/*.py", texts_of_script),
)


def texts_below(root):
    """Returns all texts, as {path relative to the root: [Text]}, ordered by path."""
    texts = {}
    for pattern, extract in SOURCES:
        for file in Path(root).glob(pattern):
            path = file.relative_to(root)
            if SKIPPED_FOLDERS & set(path.parts) or not file.is_file():
                continue
            source = file.read_text(encoding="utf-8")
            if extract is texts_of_script and not (file.suffix == ".py" or source.startswith("#!")):
                continue
            is_test = file.name.endswith(".test.ts")  # the strings of such a file are names of tests and data
            texts[str(path)] = list((texts_of_comments if is_test else extract)(source))
    return dict(sorted(texts.items()))
