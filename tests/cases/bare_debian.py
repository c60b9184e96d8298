# SPDX-License-Identifier: GPL-2.0-or-later
"""README's two commands in a Debian where nothing else is installed, oldstable and stable; the Debian package, made in
one such system and used in another; as root, an hour or two for each release."""
import os
from pathlib import Path
import shutil
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


# The package's user has nothing that builds, nor what a package merely recommends but mpirun.
INSTALLED = """
apt-get update -qq
apt-get install -y -qq --no-install-recommends /package/grainscope_*.deb openmpi-bin python3-scipy python3-matplotlib
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
! command -v g++
grainscope-tools --help
cp -r /usr/share/grainscope/examples/collision /tmp/collision
cd /tmp/collision
liggghts -in in.collision
cd /grainscope
GRAINSCOPE_BINARY=/usr/bin/grainscope PYTHONPATH=tests/tools:tests:tools python3 tests/tools/run_example.py \
  examples/collision
"""


def in_bare(release, *command, name=None):
    """Runs the command in a system of its own, which stays for the test; its output goes to a file beside it."""
    folder = Path(os.environ["GRAINSCOPE_SCRATCH"]) / (name or release)
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


def package_of(release):
    """Made as containers/Dockerfile does, without an error of lintian, and installed where nothing can build."""

    def case(ranks):
        build = (Path(os.environ["GRAINSCOPE_SOURCE"]) / "containers" / "Dockerfile").read_text()
        command = build.split("\nRUN ")[1].split("\n\n")[0]
        lint = "lintian --allow-root --fail-on error /package/grainscope_*.deb"
        made = in_bare(release, "bash", "-ec", f"{command}\nscripts/install-packages lintian\n{lint}")
        user = in_bare(release, "true", name=f"user-of-{release}")
        shutil.copytree(made / "package", user / "package", ignore=shutil.ignore_patterns("_CPack_Packages"))
        in_bare(release, "bash", "-ec", INSTALLED, name=f"user-of-{release}")

    return case


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
        **{f"package-of-{release}": package_of(release) for release in RELEASES},
    }
)
