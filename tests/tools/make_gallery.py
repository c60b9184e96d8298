# SPDX-License-Identifier: GPL-2.0-or-later
"""The page doc/gallery.md of the pictures that doc/images/gallery.csv lists, each with its input scripts and commands.

Usage: make_gallery.py            # prints it
       make_gallery.py --write    # into doc/gallery.md
"""
import csv
from pathlib import Path
import re
import sys

TOP = Path(__file__).resolve().parent.parent.parent
HEAD = """# Gallery

Each picture is drawn by the commands below it, in the folder of an example, after the run of its input script. They
want `build/release/bin` and `tools` on the path. The page is made from `images/gallery.csv` by
`tests/tools/make_gallery.py --write`.
"""


def pictures():
    with open(TOP / "doc/images/gallery.csv", newline="") as file:
        yield from csv.DictReader(file)


def lines_of(command):
    """A command as it may be typed, on lines of at most 120 characters."""
    line = "   "
    for word in re.findall(r"(?:[^\s\"]|\"[^\"]*\")+", command):
        if len(line) + len(word) > 116:
            yield line + " \\"
            line = "       "
        line += " " + word
    yield line


def section(picture):
    name, title, folder = picture["picture"], picture["title"], picture["example folder"]
    decks = sorted(path.name for path in (TOP / folder).glob("in.*")) or ["README.md"]
    links = ",\n".join(f"[{deck}](../{folder}/{deck})" for deck in decks)
    commands = "\n".join(line for command in picture["command"].split(";") for line in lines_of(command))
    return f"\n## {title}\n\n![{title}](images/{name})\n\n{commands}\n\nIn [{folder}](../{folder}):\n{links}\n"


def page():
    return HEAD + "".join(section(picture) for picture in pictures())


if __name__ == "__main__":
    if sys.argv[1:] == ["--write"]:
        (TOP / "doc/gallery.md").write_text(page())
    elif sys.argv[1:]:
        sys.exit(__doc__)
    else:
        print(page(), end="")
