# SPDX-License-Identifier: GPL-2.0-or-later
"""Resident memory of a run at places that its deck names."""
import os
from pathlib import Path
import tempfile

import numpy as np

from case import require
from run import binary, run

# The host's `shell` is run by the first rank: it looks at all ranks, whose process numbers the launcher has left.
NOTE = "for p in pid.*; do sed -n 's/^VmRSS: *//p' /proc/$(cat $p)/status; done | tr -d 'kB\\n' >> memory.txt; echo >> memory.txt\n"
LAUNCHER = "#!/bin/sh\necho $$ > pid.${OMPI_COMM_WORLD_RANK:-0}\nexec '%s' \"$@\"\n"
SANITIZED = "LSAN_OPTIONS" in os.environ
NOTED = "shell sh ./note"  # the deck line


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
