# SPDX-License-Identifier: GPL-2.0-or-later
"""Assertions that say what differs, and the entry point of every case script."""
import os
import resource
import shutil
import signal
import sys
import tempfile
import traceback

import numpy as np

from run import SKIPPED, Failure, Skipped


def skip(reason):
    """Ends the test as one that cannot be made here."""
    raise Skipped(reason)


def require(condition, message):
    if not condition:
        raise Failure(message)


def require_close(found, expected, tolerance, what, scale=None):
    """|found - expected| <= tolerance x scale, elementwise; scale defaults to the largest |expected|."""
    found, expected = np.asarray(found, dtype=float), np.asarray(expected, dtype=float)
    require(found.shape == expected.shape, f"{what}: found shape {found.shape}, expected {expected.shape}")
    if not expected.size:
        return
    require(bool(np.isfinite(found).all()), f"{what}: not finite: {found}")
    scale = float(np.max(np.abs(expected))) if scale is None else scale
    difference = np.abs(found - expected)
    k = np.unravel_index(int(np.argmax(difference)), difference.shape)
    require(
        bool(difference[k] <= tolerance * scale),
        f"{what}: at {tuple(int(i) for i in k)} found {found[k]!r}, expected {expected[k]!r}: off by "
        f"{difference[k]:.3e}, "
        f"allowed {tolerance * scale:.3e}",
    )


def require_equal(found, expected, what):
    """Equal to the last bit."""
    require_close(found, expected, 0.0, what, 1.0)


def require_same_snapshots(found, expected, what):
    """Two dumps, equal to the last bit in every step and column."""
    require([step for step, _ in found] == [step for step, _ in expected], f"{what}: different steps")
    require(len(found) > 0, f"{what}: no snapshot")
    for (step, left), (_, right) in zip(found, expected):
        require(left.keys() == right.keys(), f"{what}: different columns")
        for name in left:
            require_equal(left[name], right[name], f"{what}, step {step}, column {name}")


def main(cases):
    """Runs `cases[name](ranks)` for the name and rank count on the command line; folders are kept where a case
    fails."""
    name, ranks = sys.argv[1], int(sys.argv[2])
    scratch = tempfile.mkdtemp(prefix="grainscope-")
    os.environ["GRAINSCOPE_SCRATCH"] = scratch
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("stopped by SIGTERM"))  # what was started is ended first
    try:
        cases[name](ranks)
    except Skipped as reason:
        shutil.rmtree(scratch)
        print(f"SKIPPED {name}: {reason}")
        sys.exit(SKIPPED)
    except Failure as failure:
        print(f"FAILED {name} on {ranks} rank(s): {failure}\nfiles: {scratch}")
        sys.exit(1)
    except Exception:
        traceback.print_exc()
        print(f"files: {scratch}")
        sys.exit(1)
    shutil.rmtree(scratch)
    usage = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    print(f"processor time: {sum(u.ru_utime + u.ru_stime for u in usage):.1f} s")
