"""Tests each page of docs/tutorial: its listings equal the files that they name, its commands
succeed, and their output equals the output in the page.
"""
import os
import re
import subprocess
from pathlib import Path

import pytest

SOURCE = Path(os.environ["GSV_SOURCE_DIR"])
BUILD = Path(os.environ["GSV_BUILD_DIR"])
TUTORIAL = SOURCE / "docs" / "tutorial"
PAGES = sorted(TUTORIAL.glob("*.md"))
# The first line of a block is ```language [what]. `what` is the file of a listing, or "setup" for
# commands that the test does not need.
BLOCK = re.compile(r"^```(\w+)(?: (\S+))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def blocks(page):
    return BLOCK.findall(page.read_text())


def expected(text):
    """Returns a pattern for the lines of a page's output, in their order. A … matches any text in a line."""
    lines = [".*".join(map(re.escape, line.split("…"))) for line in text.splitlines()]
    return re.compile(r"(?:.*\n)*?.*".join(lines))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_listings_are_what_the_files_say(page):
    for language, file, text in blocks(page):
        if "/" in file:
            assert text.rstrip("\n") in (SOURCE / file).read_text(), f"{page}: {file}"
        else:
            assert language in ("sh", "text"), f"{page}: whose file is this?\n{text}"


@pytest.mark.parametrize("page", PAGES[:-1], ids=lambda page: page.stem)
def test_the_page_runs(page, tmp_path):
    environment = {
        **os.environ, "TMPDIR": str(tmp_path), "PYTHONPATH": str(BUILD / "python"),
        "PATH": f"{SOURCE / 'examples/tutorial'}:{BUILD / 'bin'}:{os.environ['PATH']}"}
    runs = 0
    output = ""
    for language, what, text in blocks(page):
        if language == "sh" and not what:
            ended = subprocess.run(["bash", "-euc", text], cwd=SOURCE, env=environment, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=240)
            output = ended.stdout
            assert ended.returncode == 0, f"{text}\n{output}"
            runs += 1
        elif language == "text":
            assert expected(text).search(output), f"expected:\n{text}\nfound:\n{output}"
    assert runs > 0
    if page.stem == "06-map-a-room":
        judge_map(tmp_path / "room.pgm")


def judge_map(path):
    """Checks the playground's map: walls 5 m from the middle, a box of 1 m at (2, 2), nothing at (3.5, 0)."""
    header, pixels = path.read_bytes().split(b"\n", 1)
    assert header == b"P5 120 120 255"
    at = lambda x, y: pixels[(119 - int((y + 6) * 10)) * 120 + int((x + 6) * 10)]
    along = [-4 + 0.1 * i for i in range(81)]
    for side in (-1, 1):  # the walls' faces lie where two rows of cells meet
        for wall in ([min(at(side * 4.95, y), at(side * 5.05, y)) for y in along],
                     [min(at(x, side * 4.95), at(x, side * 5.05)) for x in along]):
            assert sum(pixel < 64 for pixel in wall) > 0.8 * len(wall)
    assert at(3.5, 0.0) > 192 and at(0.0, 3.5) > 192
    face = [min(at(1.45, 1.65 + 0.1 * i), at(1.55, 1.65 + 0.1 * i)) for i in range(8)]
    assert sum(pixel < 64 for pixel in face) >= 6  # the box's western one
