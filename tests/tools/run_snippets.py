# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs every code block of a page that answers questions, in the scene that the comment above it names, and wants each
thing that it prints or writes to be a number, and not 0 throughout."""
import math
import os
from pathlib import Path
import re
import sys
import tempfile

from doc_scenes import SCENES
from run import Failure, run

BLOCK = re.compile(r"(?:^<!-- run: (\w+) -->\n)?^```[^\n]*\n(.*?)^```", re.M | re.S)
PLACE_OR_ERROR = re.compile(r"[xyzrta]|.*_error")
WORDS = re.compile(r"^-?(?:\d|nan|inf)", re.I)


def snippets(page):
    """(scene, lines) of each block; one without a scene is a fault of the page."""
    text = page.read_text()
    for scene, block in BLOCK.findall(text):
        if scene not in SCENES:
            raise Failure(f"'<!-- run: SCENE -->', one of {', '.join(SCENES)}, must stand above this block:\n{block}")
        yield scene, block.splitlines()


def require_alive(what, columns):
    """Numbers, finite, and not 0 in every row."""
    for name, values in columns.items():
        if not all(math.isfinite(value) for value in values):
            raise Failure(f"{what}, {name}: not finite")
        if not any(values):
            raise Failure(f"{what}, {name}: 0 in every row")


def numbers_of(path):
    """Columns of a table or a dump, by their names where the line above the numbers has them; without places of cells
    and errors, which may be 0."""
    names, rows = [], []
    for line in path.read_text().splitlines():
        words = re.split(r"[ ,]+", line.strip())
        if WORDS.match(line) and len(words) >= len(rows[-1] if rows else words):
            rows = [row for row in rows if len(row) == len(words)] + [[float(word) for word in words]]
        elif not rows:
            names = words
    columns = list(zip(*rows))
    names = names if len(names) == len(columns) else [str(k + 1) for k in range(len(columns))]
    return {name: column for name, column in zip(names, columns) if not PLACE_OR_ERROR.fullmatch(name)}


def check(scene, lines):
    made = SCENES[scene]()
    tail = [] if any(line.startswith("run ") for line in lines) else [f"run {made.steps}"]
    deck = [*made.start, f"thermo {made.steps // 2}", *lines, *tail]
    result = run("\n".join(deck) + "\n", folder=made.folder)
    text = "\n".join(lines)
    if "thermo_style" in text:
        require_alive("thermo", result.thermo()[-1])
    for name in re.findall(r"\bfile (\S+)|^dump \S+ \S+ \S+ \d+ (\S+)", text, flags=re.M):
        pattern = "".join(name)
        found = sorted(result.folder.glob(pattern))
        if not found:
            raise Failure(f"it wrote no {pattern}")
        columns = numbers_of(found[-1])
        if not columns:
            raise Failure(f"{pattern} holds no numbers")
        require_alive(pattern, columns)


def main(page):
    found = list(snippets(page))
    if not found:
        raise Failure(f"{page.name} has no code block")
    with tempfile.TemporaryDirectory(prefix="grainscope-") as scratch:
        os.environ["GRAINSCOPE_SCRATCH"] = scratch
        for scene, lines in found:
            print(f"in {scene}:", *lines, sep="\n  ")
            check(scene, lines)


if __name__ == "__main__":
    try:
        main(Path(sys.argv[1]))
    except Failure as failure:
        print(f"FAILED {failure}")
        sys.exit(1)
