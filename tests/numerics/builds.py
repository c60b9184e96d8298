# SPDX-License-Identifier: GPL-2.0-or-later
"""The whole program built by gcc and clang, at -O2 and at -O3 -march=native: the same deck, the same numbers within
stated bounds.

Builds that are missing are made in build/numerics (GRAINSCOPE_BUILDS names another folder): about a quarter of an hour
each on two processors."""
from dataclasses import replace
import itertools
import os
from pathlib import Path
import shutil
import subprocess

from case import main, require
from deck import Deck
from everything import Questions, differences, press
from packing import dense_packing, tilted
from run import run

OPTIMISED = ["-DCMAKE_BUILD_TYPE=Fast", "-DCMAKE_CXX_FLAGS_FAST=-O3 -DNDEBUG", "-DGRAINSCOPE_NATIVE=ON"]
PLAIN = ["-DCMAKE_BUILD_TYPE=Release"]  # -O2, as every user runs it
BUILDS = {
    "gcc -O2": ("gcc", "g++", PLAIN),
    "clang -O2": ("clang", "clang++", PLAIN),
    "gcc -O3 -march=native": ("gcc-fast", "g++", OPTIMISED),
    "clang -O3 -march=native": ("clang-fast", "clang++", OPTIMISED),
}
JOBS = os.environ.get("GRAINSCOPE_JOBS", "2")

# Every build is made not to contract a * b + c (-ffp-contract=off), none to reorder sums. What -march=native changes
# are Eigen's own kernels, which add as many numbers side by side as a vector holds, and fuse: rounding, in what is
# measured. 2e-14 was seen; a factor of 50 for other processors. Other libraries of mathematical functions may move
# grains by rounding, which a hundred steps amplify (shuffle.py: to 3e-12).
AT_ONCE, GROWN = 1e-12, 1e-9
# The host's solver of superquadrics stops at 1e-7: a step more or less, by the last bit of a number, is that much (see
# shuffle.py).
SOLVER, SOLVER_GROWN = 1e-3, 1e-1


def command(words):
    done = subprocess.run(
        words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", check=False
    )
    require(
        done.returncode == 0, f"{' '.join(map(str, words))} ended with code {done.returncode}:\n{done.stdout[-3000:]}"
    )
    return done.stdout


def built(name):
    """The binary of this build, up to date. The release build of this tree is that of gcc -O2, if gcc is what built
    it."""
    folder, compiler, options = BUILDS[name]
    own = Path(os.environ["GRAINSCOPE_BINARY"])
    if (
        folder == "gcc"
        and "GNU"
        in subprocess.run(["readelf", "-p", ".comment", own], stdout=subprocess.PIPE, text=True, check=False).stdout
    ):
        return own
    require(
        shutil.which(compiler) is not None,
        f"{compiler} is not on this machine: without it two of the four builds cannot be compared",
    )
    source, cmake = Path(os.environ["GRAINSCOPE_SOURCE"]), os.environ["GRAINSCOPE_CMAKE"]
    build = Path(os.environ.get("GRAINSCOPE_BUILDS", source / "build" / "numerics")) / folder
    command([cmake, "-S", source, "-B", build, "-DGRAINSCOPE_TESTS=OFF", f"-DCMAKE_CXX_COMPILER={compiler}", *options])
    command([cmake, "--build", build, "-j", JOBS])
    return build / "bin" / "grainscope"


def results_of(deck, ranks):
    results, own = {}, os.environ["GRAINSCOPE_BINARY"]
    for name in BUILDS:
        os.environ["GRAINSCOPE_BINARY"] = str(built(name))
        results[name] = run(deck, ranks)
        os.environ["GRAINSCOPE_BINARY"] = own
    return results


def builds(packing, surface, bounds):
    def case(ranks):
        questions = Questions(packing)
        turn = ["unfix integrate", "fix integrate all nve/spheroid"] if surface == "ellipsoid" else []
        deck = Deck(packing, surface=surface, extra="ledger on tangential_damping off")
        # Sheared for ten steps: springs of nothing but rounding have no scale. Then a row each at 0, 1, 2, ... 100.
        deck = replace(deck, body=[*turn, press(2e5), "run 10", *questions.defined(), *questions.output(), "run 100"])
        results = results_of(deck, ranks)
        print(
            "| builds | at once | worst in | 1 step | worst in | 100 steps | worst in |\n|---|---|---|---|---|---|---|"
        )
        faults = []
        for a, b in itertools.combinations(BUILDS, 2):
            cells = []
            for moments, bound in ((slice(0, 1), bounds[0]), (slice(0, 2), bounds[0]), (slice(None), bounds[1])):
                found = differences(questions, results[a], results[b], moments)
                quantity, value = max(found.items(), key=lambda item: item[1])
                cells += [f"{value:.1e}", quantity if value else "equal to the last bit"]
                if value > bound:
                    faults.append(f"{a} against {b}: {quantity} differs by {value:.3e} of its scale, allowed {bound}")
            print(f"| {a}, {b} | {' | '.join(cells)} |", flush=True)
        require(not faults, "; ".join(faults))

    return case


SPHEROIDS = tilted(dense_packing(1.5, speed=0.2), 0.45)
CASES = {
    "spheres": builds(tilted(dense_packing(atom_style="sphere", speed=0.2), 0.45), "", (AT_ONCE, GROWN)),
    "spheroids": builds(SPHEROIDS, "ellipsoid", (AT_ONCE, GROWN)),
    "superquadrics": builds(SPHEROIDS, "superquadric", (SOLVER, SOLVER_GROWN)),
}

if __name__ == "__main__":
    main(CASES)
