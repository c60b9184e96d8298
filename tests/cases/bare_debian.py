# SPDX-License-Identifier: GPL-2.0-or-later
"""README's two commands in a Debian where nothing else is installed, oldstable and stable; as root, an hour or two for
each release."""
import os
from pathlib import Path
import subprocess

from case import main, require

SOURCE = Path(os.environ["GRAINSCOPE_SOURCE"])
RELEASES = ("bookworm", "trixie")
# Written by the demo's runs, and free of times: screen.txt tells seconds, pictures carry the version of what drew them.
FILES = (
    "series.txt",
    "micro.txt",
    "displacement.txt",
    "surface.txt",
    "direction.txt",
    "correlation.txt",
    "layering.txt",
    "memory.txt",
    "grains.dump",
    "parameters.txt",
)


def in_bare(release, *command):
    """Runs the command in a system of its own, which stays for the test; its output goes to a file beside it."""
    folder = Path(os.environ["GRAINSCOPE_SCRATCH"]) / release
    log = folder.with_suffix(".txt")
    with log.open("a") as output:
        done = subprocess.run(
            [SOURCE / "scripts" / "bare-debian", "--keep", folder, release, *command],
            stdout=output,
            stderr=output,
            check=False,
        )
    require(
        done.returncode == 0,
        f"{' '.join(command)} in {release} ended with {done.returncode}:\n{log.read_text()[-4000:]}",
    )
    return folder


def demo_of(release):
    return in_bare(release, "scripts/demo") / "grainscope" / "demo-results"


def demos_are_equal(ranks):
    """Compilers and libraries of both releases give the same files, byte for byte."""
    old, new = map(demo_of, RELEASES)
    for shape in ("prolate", "oblate"):
        for name in FILES:
            require(
                (old / shape / name).read_bytes() == (new / shape / name).read_bytes(),
                f"{shape}/{name} differs between {' and '.join(RELEASES)}",
            )
    for name in ("summary.txt", "series.png", "dissipation.png", "fig02.png", "fig18.png", "prolate.png", "oblate.png"):
        require(all((results / name).stat().st_size > 0 for results in (old, new)), f"{name} is empty")


def tests_pass(release):
    return lambda ranks: in_bare(release, "scripts/test")


def clang_of_trixie(ranks):
    """The current clang: what it builds gives what the tests of one rank want."""
    in_bare(
        "trixie",
        "bash",
        "-c",
        "scripts/install-packages snakemake clang && cmake --preset release -DCMAKE_CXX_COMPILER=clang++ && "
        "cmake --build --preset release -j $(nproc) && ctest --test-dir build/release -j $(nproc) "
        "--output-on-failure -L 'unit|example|doc'",
    )


main(
    {
        "demos-are-equal": demos_are_equal,
        "clang-of-trixie": clang_of_trixie,
        **{f"tests-on-{release}": tests_pass(release) for release in RELEASES},
    }
)
