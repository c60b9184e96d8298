# SPDX-License-Identifier: GPL-2.0-or-later
"""What CMake and compilers say of the build: nothing, whichever they are."""
import json
import os
from pathlib import Path
import shlex
import shutil
import subprocess

from case import main, require

SOURCE, HOST = (os.environ[f"GRAINSCOPE_{name}"] for name in ("SOURCE", "HOST_SOURCE"))


def configured(*options):
    """(what CMake printed, the build folder)"""
    build = Path(os.environ["GRAINSCOPE_SCRATCH"]) / "build"
    done = subprocess.run(
        [os.environ["GRAINSCOPE_CMAKE"], "-S", SOURCE, "-B", build, f"-DLIGGGHTS_SOURCE_DIR={HOST}", *options],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    require(done.returncode == 0, f"configuring failed:\n{done.stdout}")
    return done.stdout, build


def compile_by_hand(build, names, wanted, *more):
    """Compiles these files as the build would, and wants the compiler to say nothing."""
    commands = {Path(entry["file"]).name: entry for entry in json.loads((build / "compile_commands.json").read_text())}
    for name in names:
        words = shlex.split(commands[name]["command"])
        require(
            all(word in words for word in wanted), f"{name} is compiled without {' '.join(wanted)}: {' '.join(words)}"
        )
        words[words.index("-o") + 1] = os.devnull
        done = subprocess.run(
            [*words, *more],
            cwd=commands[name]["directory"],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        require(done.returncode == 0 and not done.stdout, f"{name}: {done.stdout[:3000]}")


def configured_without_a_warning(ranks):
    """CMake's own policies, too: 3.30 and later warn of the module that looked for Boost."""
    output, _ = configured("-DGRAINSCOPE_TESTS=ON")
    require("Warning" not in output and "Deprecat" not in output, f"CMake warns:\n{output}")


def clang_takes_the_host_as_cxx17(ranks):
    """Current clang compiles C++17 when it is not asked for less; C++17 has no `register`, which LIGGGHTS says in these
    files' headers."""
    require(shutil.which("clang++"), "clang++ is missing: scripts/install-packages clang")
    _, build = configured("-DGRAINSCOPE_TESTS=OFF", "-DCMAKE_CXX_COMPILER=clang++", "-DCMAKE_CXX_STANDARD=17")
    compile_by_hand(
        build, ["contact_models.cpp", "lammps.cpp", "pair.cpp", "pair_gran_proxy.cpp"], ["-std=c++17"], "-fsyntax-only"
    )


def every_file_for_this_processor(ranks):
    """GRAINSCOPE_NATIVE: all that is ours, which is compiled with warnings."""
    _, build = configured("-DGRAINSCOPE_TESTS=OFF", "-DGRAINSCOPE_NATIVE=ON")
    ours = [path.name for path in sorted((Path(SOURCE) / "src").glob("*/*.cpp"))]
    compile_by_hand(build, ours, ["-march=native", "-Wall"])


main(
    {
        "configured-without-a-warning": configured_without_a_warning,
        "clang-takes-the-host-as-c++17": clang_takes_the_host_as_cxx17,
        "every-file-for-this-processor": every_file_for_this_processor,
    }
)
