# SPDX-License-Identifier: GPL-2.0-or-later
"""Resident memory of a run at places that its deck names."""
import os
from pathlib import Path
import tempfile

import numpy as np

from case import require
from run import binary, run

# The host's `shell` is run by the first rank: it looks at all ranks, whose process numbers the launcher has left.
NOTE = """for p in pid.*; do
  read pid < $p
  while read key value unit; do [ "$key" != VmRSS: ] || printf '%s ' $value; done < /proc/$pid/status
done >> memory.txt
echo >> memory.txt
"""
# The C library is told to give large blocks back as soon as they are free: it would keep a megabyte now and then.
LAUNCHER = """#!/bin/sh
export MALLOC_MMAP_THRESHOLD_=131072 MALLOC_TRIM_THRESHOLD_=131072
echo $$ > pid.${OMPI_COMM_WORLD_RANK:-0}
exec '%s' "$@"
"""
SANITIZED = "LSAN_OPTIONS" in os.environ
NOTED = "shell . ./note"  # the deck line


def watched_run(deck, ranks=1, **options):
    """(Result, kilobytes: one row per NOTED line, one column per rank)."""
    folder = Path(tempfile.mkdtemp(prefix="memory-", dir=os.environ.get("GRAINSCOPE_SCRATCH")))
    (folder / "note").write_text(NOTE)
    launcher = folder / "launcher"
    launcher.write_text(LAUNCHER % binary())
    launcher.chmod(0o755)
    result = run(deck, ranks, folder=folder, program=str(launcher), **options)
    return result, np.loadtxt(folder / "memory.txt", ndmin=2)


def require_flat(kilobytes, allowed, what):
    """From the first row on, no rank ever grows by more than `allowed` kB. The address sanitizer keeps what is freed: it tells leaks itself."""
    growth = kilobytes.max(axis=0) - kilobytes[0]
    print(f"{what}: {kilobytes[0].astype(int)} kB at first, {kilobytes[-1].astype(int)} kB at last, {growth.astype(int)} kB more at most")
    require(SANITIZED or bool((growth <= allowed).all()), f"{what}: memory grew by {growth} kB, allowed {allowed}: {kilobytes.tolist()}")
    return float(growth.max())
