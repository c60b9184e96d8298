# SPDX-License-Identifier: GPL-2.0-or-later
"""Two programs, the same decks: every file that they write must be the same, byte for byte.

Usage: same_runs.py PROGRAM PROGRAM [WORD...]     # WORD: only decks in whose names it is; scripts/try-hosts calls it

The decks are all examples, and flows of spheres and superquadrics under the host's own pair_style gran and ours, with
dumps of 17 digits and a restart. Of log files, in which the host writes times, the thermo tables are compared."""
from dataclasses import replace
import json
import os
from pathlib import Path
import shutil
import sys
import tempfile

from case import require
from deck import Deck, dump_grains, shear, thermo
from packing import dense_packing, tilted
from run import Failure, run
from run_example import arguments

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
CLOCKS = ("cpu", "cpuremain")


def example(folder):
    expected = json.loads((folder / "expected.json").read_text())

    def start(scratch):
        copy = scratch / folder.name
        shutil.copytree(folder, copy)
        return run(
            (copy / f"in.{folder.name}").read_text(),
            expected["ranks"][0],
            folder=copy,
            arguments=list(arguments(expected.get("variables", {}))),
        )

    return start


def flow(packing, pair, ranks, **words):
    """A sheared packing: dumped, written to a restart file half way, and taken up from it."""

    def start(scratch):
        steps = [*thermo(20, "ke", "vol", "xy"), *dump_grains(packing, 20)]
        halves = ["run 100", "write_restart half.restart", "run 100"]
        deck = Deck(packing, pair=pair, body=[shear(0.05), *steps, *halves], **words)
        run(deck, ranks, folder=scratch / "whole")
        again = scratch / "again"
        again.mkdir()
        shutil.copy(scratch / "whole" / "half.restart", again)
        second = deck.restarted("half.restart", [shear(0.05), *steps, "run 100"])
        return run(second, ranks, folder=again)

    return start


def decks():
    for expected in sorted(EXAMPLES.glob("*/expected.json")):
        yield expected.parent.name, example(expected.parent)
    spheres = tilted(dense_packing(atom_style="sphere", speed=0.2), 0.3)
    spheroids = tilted(dense_packing(1.5, speed=0.2), 0.3)
    boxes = replace(spheroids, grains=[replace(grain, blockiness=(4.0, 4.0)) for grain in spheroids.grains])
    for ranks in (1, 2):
        yield f"spheres under gran on {ranks}", flow(spheres, "gran", ranks, rolling="cdt")
        yield f"spheroids under gran on {ranks}", flow(spheroids, "gran", ranks)
        ours = flow(spheroids, "gran/insitu", ranks, surface="ellipsoid", extra="setup neutral")
        yield f"spheroids under gran/insitu on {ranks}", ours
    yield "boxy grains under gran on 1", flow(boxes, "gran", 1, normal="hooke")


def written(start, program):
    """What a deck wrote: bytes by file name; of logs and screens, the numbers of the thermo tables."""
    with tempfile.TemporaryDirectory(prefix="grainscope-") as scratch:
        os.environ["GRAINSCOPE_BINARY"] = program
        start(Path(scratch))
        files = {}
        for file in sorted(Path(scratch).rglob("*")):
            if not file.is_file() or file.name.startswith("in.") or file.name in ("README.md", "expected.json"):
                continue
            content = file.read_bytes()
            if file.name in ("log.liggghts", "output"):
                lines = content.decode(errors="replace").splitlines()
                content = "\n".join(thermo_lines(lines)).encode()
            files[str(file.relative_to(scratch))] = content
        return files


def thermo_lines(lines):
    """The rows of thermo tables, without the columns that are clocks."""
    inside, columns = False, []
    for line in lines:
        words = line.split()
        if words[:2] == ["thermo_style", "custom"]:
            columns = words[2:]
        if words[:1] == ["Step"]:
            inside = True
        elif line.startswith("Loop time"):
            inside = False
        elif inside and len(words) == len(columns):
            yield " ".join(word for name, word in zip(columns, words) if name not in CLOCKS)


def main(one, other, words):
    chosen = [(name, start) for name, start in decks() if not words or any(word in name for word in words)]
    require(chosen, f"no deck is named like {' or '.join(words)}")
    good = True
    for name, start in chosen:
        left, right = written(start, one), written(start, other)
        differ = [file for file in sorted(set(left) | set(right)) if left.get(file) != right.get(file)]
        size = sum(map(len, left.values()))
        verdict = "DIFFER" if differ else "same"
        print(f"{verdict}  {name}: {len(left)} files, {size} bytes", *differ, sep="\n    ", flush=True)
        good = good and not differ
        require(size > 0, f"{name} wrote nothing")
    return good


if __name__ == "__main__":
    try:
        sys.exit(0 if main(*map(os.path.abspath, sys.argv[1:3]), sys.argv[3:]) else 1)
    except Failure as failure:
        print(f"FAILED {failure}")
        sys.exit(1)
