# SPDX-License-Identifier: GPL-2.0-or-later
"""Text dumps as LIGGGHTS writes them, of numbers that a test chose, and what grainscope-tools makes of them."""
import os
from pathlib import Path
import subprocess
import sys
import tempfile

from case import require

SOURCE = Path(__file__).resolve().parents[2]
TOOLS = SOURCE / "tools" / "grainscope-tools"
PAGE = SOURCE / "doc" / "visualise.md"


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


def tool(command, *words, folder=None):
    """A subcommand of grainscope-tools, run as a user does: exit code, output, messages."""
    done = subprocess.run(
        [sys.executable, str(TOOLS), command, *map(str, words)],
        cwd=folder or new_folder(),
        capture_output=True,
        text=True,
    )
    require("Traceback" not in done.stderr, f"{command} {words}: {done.stderr}")
    return done.returncode, done.stdout, done.stderr


def converted(*words, folder):
    code, output, messages = tool("convert", *words, folder=folder)
    require(code == 0, f"convert {words}: {messages}")
    return output.split(), messages


def refused(command, words, *sentences, folder=None):
    """It ends with exit code 1 and one error that has all these words."""
    code, _, messages = tool(command, *words, folder=folder)
    missing = [sentence for sentence in sentences if sentence not in messages]
    require(code == 1 and not missing, f"{command} {words}: code {code}, '{messages}' lacks {missing}")
