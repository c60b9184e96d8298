# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs each code block under '## Examples' of a doc page inside a small two-type deck."""
import os
from pathlib import Path
import re
import sys
import tempfile

from deck import Deck, Material
from packing import dense_packing
from plates import bed, plated
from run import SKIPPED, Failure, Skipped, run


def blocks(page):
    section = re.split(r"^## ", page.read_text(), flags=re.M)
    text = "\n".join(part for part in section if part.startswith("Examples"))
    return [block.strip("\n") for block in re.findall(r"^```[^\n]*\n(.*?)^```", text, flags=re.M | re.S)]


def template():
    packing = dense_packing(1.5, types=2)
    deck = Deck(packing, material=Material(friction=(0.4, 0.3, 0.3, 0.2)))
    deck.body = ["group flow type 1", "variable rate equal 0.05", "variable pressure equal 5e4"]
    return deck


def under_a_plate():
    """For blocks that move the mesh `plate`: where it is, above a bed."""
    deck = plated(bed(style="superquadric", shape=(1.0, 1.0, 1.5)))
    deck.body += ["variable pressure equal 5e4"]
    return deck


def lines_of(block, deck):
    lines = list(deck.lines())
    if re.search(r"^\s*pair_style", block, flags=re.M):
        at = next(k for k, line in enumerate(lines) if line.startswith("pair_style"))
        own = [line for line in block.splitlines() if line.lstrip().startswith("pair_style")]
        rest = [line for line in block.splitlines() if not line.lstrip().startswith("pair_style")]
        lines[at : at + 1] = [own[-1] if "surface" in own[-1] else own[-1] + " surface superquadric"]
        return lines + rest + ["run 20"]
    if re.search(r"^\s*(run|read_restart)\b", block, flags=re.M):
        return lines + ["run 20"] + block.splitlines()
    return lines + block.splitlines() + ["run 20"]


def main(page):
    found = blocks(page)
    if not found:
        raise Failure(f"{page.name} has '## Examples' but no fenced code block under it")
    with tempfile.TemporaryDirectory(prefix="grainscope-") as scratch:
        os.environ["GRAINSCOPE_SCRATCH"] = scratch
        for block in found:
            print(f"running:\n{block}\n")
            deck = under_a_plate() if "mesh plate" in block else template()
            run("\n".join(lines_of(block, deck)) + "\n")


if __name__ == "__main__":
    try:
        main(Path(sys.argv[1]))
    except Skipped as reason:
        print(f"SKIPPED {reason}")
        sys.exit(SKIPPED)
    except Failure as failure:
        print(f"FAILED {failure}")
        sys.exit(1)
