# SPDX-License-Identifier: GPL-2.0-or-later
"""The page doc/render.md: its commands, after a run that dumps what it says; and the list of the gallery."""
import csv
from pathlib import Path
import re
import shlex
import shutil

from case import main, require
from deck import Deck
from dump_files import tool
import meshes
from packing import dense_packing
from run import run

SOURCE = Path(__file__).resolve().parents[2]
PAGE = SOURCE / "doc" / "render.md"
SMALL = ["--size", 96, 72, "--light", "none", "--jobs", 1]


def commands(page):
    """What follows `grainscope-tools render` in the lines of a page, as words."""
    text = re.sub(r" *\\\n *", " ", page.read_text())
    return [shlex.split(line) for line in re.findall(r"^    grainscope-tools render (.*)$", text, flags=re.M)]


def folder_of_a_run(ranks):
    """A run of spheroids with the dump lines of the page, every 10 steps, and a mesh."""
    blocks = re.findall(r"^```\n(.*?)^```", PAGE.read_text(), flags=re.M | re.S)
    lines = "".join(blocks).replace(" 1000 ", " 10 ").splitlines()
    deck = Deck(dense_packing(1.5, types=2))
    deck.body = [line for line in lines if not line.endswith("radius vx vy vz")] + ["run 20"]
    result = run(deck, ranks)
    (result.folder / "lid.stl").write_text(meshes.stl("lid", meshes.rectangle((0, 0, 0), (4, 0, 0), (0, 0, 4))))
    return result.folder


def page(ranks):
    """Each is run as it stands, but small; it writes the file that it names."""
    folder = folder_of_a_run(ranks)
    found = commands(PAGE)
    require(len(found) > 12, f"{len(found)} commands")
    for words in found:
        if "film.mp4" in words and shutil.which("ffmpeg") is None:
            continue
        code, said = tool("render", *words, *SMALL, folder=folder)
        require(code == 0, f"render {words}: {said}")
        path = folder / said.split()[-1]
        require(path.stat().st_size > 500, f"render {words} wrote {path}")
        path.unlink()


def gallery(ranks):
    """Pictures by render are small, shown in the README of their example, which draws the same dump."""
    with open(SOURCE / "doc" / "images" / "gallery.csv", newline="") as file:
        rows = [row for row in csv.DictReader(file) if "grainscope-tools render" in row["command"]]
    require(len(rows) >= 9, f"{len(rows)} pictures")
    for row in rows:
        readme = SOURCE / row["example folder"] / "README.md"
        words = shlex.split(row["command"].split(";")[-1])
        dumps = {word[0] for word in commands(readme)}
        require(words[2] in dumps, f"{readme} draws {dumps}, not {words[2]}")
        path = SOURCE / "doc" / "images" / row["picture"]
        if path.name != "prolate.png":  # which the demo draws, in full light
            require(path.stat().st_size < 250_000, f"{path} has {path.stat().st_size} bytes")
            require(path.name in readme.read_text(), f"{readme} does not show {path.name}")


main({"commands": page, "gallery": gallery})
