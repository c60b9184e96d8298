# SPDX-License-Identifier: GPL-2.0-or-later
"""Memory of a run at places that its deck names: what it has written to, in RAM or swapped out. Pages of its files,
which come and go with what else runs on the machine, are not counted."""
import ctypes
import os
from pathlib import Path
import tempfile

import numpy as np

from case import require
from run import binary, run

# The host's `shell` is run by the first rank: it looks at all ranks, whose process numbers the launcher has left.
NOTE = """for p in pid.*; do
  read pid < $p
  total=0
  while read key value unit; do
    case $key in RssAnon: | VmSwap:) total=$((total + value)) ;; esac
  done < /proc/$pid/status
  printf '%s ' $total
done >> memory.txt
echo >> memory.txt
"""
# The C library is set to give large blocks back as soon as they are free: it would keep a megabyte now and then.
LAUNCHER = """#!/bin/sh
export MALLOC_MMAP_THRESHOLD_=16384 MALLOC_TRIM_THRESHOLD_=131072
echo $$ > pid.${OMPI_COMM_WORLD_RANK:-0}
exec '%s' "$@"
"""
SANITIZED = "LSAN_OPTIONS" in os.environ
# Pages of 2 MB, which the kernel gives when it has some to spare, would look like growth. Children inherit this.
NO_HUGE_PAGES = 41  # PR_SET_THP_DISABLE
# The deck lines. Counting grains, which needs all ranks, sees to it that none is still at work on a line before; they
# then wait for the first one's next.
NOTED = 'variable grains_noted equal count(all)\nprint "${grains_noted} grains"\nshell . ./note'


def watched_run(deck, ranks=1, **options):
    """(Result, kilobytes: one row per NOTED line, one column per rank)."""
    folder = Path(tempfile.mkdtemp(prefix="memory-", dir=os.environ.get("GRAINSCOPE_SCRATCH")))
    (folder / "note").write_text(NOTE)
    launcher = folder / "launcher"
    launcher.write_text(LAUNCHER % binary())
    launcher.chmod(0o755)
    ctypes.CDLL(None).prctl(NO_HUGE_PAGES, 1, 0, 0, 0)
    result = run(deck, ranks, folder=folder, program=str(launcher), **options)
    kilobytes = np.loadtxt(folder / "memory.txt", ndmin=2)
    require(bool((kilobytes > 0).all()), f"no memory was noted: {kilobytes.tolist()}")
    return result, kilobytes


def require_flat(kilobytes, allowed, what):
    """No rank grows by more than `allowed` kB from the first row to the last, were it to grow as from the first half to
    the second: the least of each, since what is in use between two holes of the heap comes and goes by a hundred
    kilobytes, while what is lost stays. The address sanitizer keeps what is freed: it tells leaks itself."""
    rows = len(kilobytes)
    half = rows // 2
    least = kilobytes[:half].min(axis=0), kilobytes[rows - half :].min(axis=0)
    growth = (least[1] - least[0]) * (rows - 1) / (rows - half)
    print(
        f"{what}: {kilobytes[0].astype(int)} kB at first, {kilobytes[-1].astype(int)} kB at last, "
        f"{growth.astype(int)} kB of growth"
    )
    require(
        SANITIZED or bool((growth <= allowed).all()),
        f"{what}: memory grew by {growth} kB, allowed {allowed}: {kilobytes.tolist()}",
    )
    return float(growth.max())
