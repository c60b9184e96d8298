# SPDX-License-Identifier: GPL-2.0-or-later
"""Text dumps as LIGGGHTS writes them, of numbers that a test chose, and what grainscope-tools makes of them."""
from contextlib import chdir
import os
from pathlib import Path
import tempfile

from case import require
from command import asked

PAGE = Path(__file__).resolve().parents[2] / "doc" / "visualise.md"


def new_folder():
    return Path(tempfile.mkdtemp(prefix="dumps-", dir=os.environ.get("GRAINSCOPE_SCRATCH")))


def snapshot(step, columns, edges=(10.0, 10.0, 10.0), tilts=None, kind="ATOMS", sides="pp pp ff"):
    """The text of one step, its box from the origin on; tilts: xy, xz, yz. A column is a list of numbers or words."""
    rows = list(zip(*columns.values()))
    lines = ["ITEM: TIMESTEP", str(step), f"ITEM: NUMBER OF {kind}", str(len(rows))]
    lines.append(f"ITEM: BOX BOUNDS {'' if tilts is None else 'xy xz yz '}{sides}")
    xy, xz, yz = tilts or (0.0, 0.0, 0.0)
    low = [min(0.0, xy, xz, xy + xz), min(0.0, yz), 0.0]
    high = [edges[0] + max(0.0, xy, xz, xy + xz), edges[1] + max(0.0, yz), edges[2]]
    for k in range(3):
        lines.append(f"{low[k]!r} {high[k]!r}" + (f" {tilts[k]!r}" if tilts else ""))
    lines.append(f"ITEM: {kind} {' '.join(columns)} ")
    lines += [" ".join(x if isinstance(x, str) else f"{x:.17g}" for x in row) + " " for row in rows]
    return "\n".join(lines) + "\n"


def tool(*words, folder=None):
    """A command of grainscope-tools in a folder: exit code, and what it prints."""
    with chdir(folder or new_folder()):
        return asked(*words)


def converted(*words, folder):
    """What convert prints."""
    code, said = tool("convert", *words, folder=folder)
    require(code == 0, f"convert {words}: {said}")
    return said


def refused(command, words, *sentences, folder=None):
    """It ends with exit code 1 and an error that has all these words."""
    code, said = tool(command, *words, folder=folder)
    missing = [sentence for sentence in sentences if sentence not in said]
    require(code == 1 and not missing, f"{command} {words}: code {code}, '{said}' lacks {missing}")
