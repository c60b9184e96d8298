# SPDX-License-Identifier: GPL-2.0-or-later
"""Includes go down the floors of src/ (cmake/Floors.cmake)."""
import os
from pathlib import Path
import subprocess
import sys
import tempfile

from case import main, require

SOURCE = Path(os.environ["GRAINSCOPE_SOURCE"])
TREE = {
    "CORE/tensor.h": "#include <vector>",
    "CORE/tensor.cpp": '#include "tensor.h"',
    "HOST/box.h": '#include "domain.h"\n#include "tensor.h"',
    "PAIR/loop.cpp": '#include "box.h"\n#include <mpi.h>',
    "FIX/fix_press.cpp": '#include "box.h"',
    "RUN/guard.h": "",
    "RUN/guard.cpp": '#include "guard.h"',
}


def graph(tree):
    done = subprocess.run([sys.executable, SOURCE / "scripts" / "include-graph", tree], capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def graph_of(changes):
    """Of a small tree with some files changed."""
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder)
        for name, text in {
            **{f"src/{n}": t for n, t in {**TREE, **changes}.items()},
            "cmake/Floors.cmake": (SOURCE / "cmake" / "Floors.cmake").read_text(),
        }.items():
            (tree / name).parent.mkdir(parents=True, exist_ok=True)
            (tree / name).write_text(text + "\n")
        return graph(tree)


def includes_go_down(ranks):
    code, arrows, faults = graph(SOURCE)
    print(arrows)
    require(code == 0 and not faults, faults)
    for arrow in ("HOST     -> CORE", "COMPUTE  -> PAIR", "FIX      -> HOST"):
        require(arrow in arrows, f"'{arrow}' is not among what it found:\n{arrows}")


def refused(changes, words):
    def case(ranks):
        code, _, faults = graph_of(changes)
        require(code == 1 and faults == words + "\n", f"exit code {code}: {faults}, expected {words}")

    return case


def small_tree_passes(ranks):
    code, arrows, faults = graph_of({})
    require(code == 0 and not faults, faults)
    require("PAIR     -> HOST        1" in arrows, arrows)


main(
    {
        "includes-go-down": includes_go_down,
        "small-tree-passes": small_tree_passes,
        "up-refused": refused(
            {"HOST/box.h": '#include "guard.h"'}, "src/HOST/box.h includes guard.h of RUN, which is not below HOST"
        ),
        "up-by-angle-brackets-refused": refused(
            {"CORE/tensor.cpp": "  #  include <box.h>"},
            "src/CORE/tensor.cpp includes box.h of HOST, which is not below CORE",
        ),
        "beside-refused": refused(
            {"FIX/fix_press.cpp": '#include "guard.h"'},
            "src/FIX/fix_press.cpp includes guard.h of RUN, which is not below FIX",
        ),
        "host-in-core-refused": refused(
            {"CORE/tensor.cpp": '#include "domain.h"'},
            "src/CORE/tensor.cpp includes domain.h: CORE is free of LIGGGHTS and MPI",
        ),
        "mpi-in-core-refused": refused(
            {"CORE/tensor.cpp": "#include <mpi.h>"},
            "src/CORE/tensor.cpp includes mpi.h: CORE is free of LIGGGHTS and MPI",
        ),
        "two-of-one-name-refused": refused({"PAIR/box.h": ""}, "src/PAIR/box.h: the name is taken by src/HOST/box.h"),
        "unknown-folder-refused": refused(
            {"EXTRA/more.h": ""}, "src/EXTRA/more.h: EXTRA is no folder of cmake/Floors.cmake"
        ),
    }
)
