# SPDX-License-Identifier: GPL-2.0-or-later
"""Configuring the build on a machine that lacks something: what is said of it; without network, root or FFTW."""
import json
import os
from pathlib import Path
import re
import shutil
import subprocess
import tarfile

from build import HOST, MUST_BE, ROOT, configure, configured, copy_of_host
from case import main, require

# The line of each thing that may be missing.
MISSING = {
    "MPI": "MPI, which lets processors work together. "
    "Debian: libopenmpi-dev openmpi-bin, conda: openmpi, Spack: openmpi.",
    "Eigen": "Eigen 3, headers for matrices. Debian: libeigen3-dev, conda: eigen, Spack: eigen.",
    "Boost": "Boost headers. Debian: libboost-dev, conda: libboost-headers, Spack: boost.",
    "FFTW": "FFTW 3 with MPI (asked for by GRAINSCOPE_FFTW). "
    "Debian: libfftw3-dev libfftw3-mpi-dev, conda: fftw=*=mpi_openmpi_*, Spack: fftw+mpi.",
}
# Hides what is installed: headers and libraries, and what packages tell CMake of themselves.
HIDDEN = (
    "-DCMAKE_IGNORE_PATH=/usr/include;/usr/lib/x86_64-linux-gnu;/usr/local/include",
    "-DCMAKE_DISABLE_FIND_PACKAGE_MPI=ON",
    "-DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON",
)


def packed_host(name="liggghts.tar.gz"):
    """A tar file as one has it of a git clone: all in one folder."""
    file = Path(os.environ["GRAINSCOPE_SCRATCH"]) / name
    with tarfile.open(file, "w:gz") as tar:
        tar.add(copy_of_host(), "LIGGGHTS-PUBLIC-bbd23c8/src")
    return file


def tar_file(ranks):
    """Given by name; then in the folder of downloads, where nothing is asked of the network."""
    file = packed_host()
    output, build = configured(file)
    require(f"LIGGGHTS: unpacking {file}" in output and f"LIGGGHTS source: {build}/liggghts-" in output, output)
    output, _ = configured(file, build=build)
    require("unpacking" not in output, f"unpacked again: {output}")
    downloads = Path(os.environ["GRAINSCOPE_SCRATCH"]) / "downloads"
    downloads.mkdir()
    file.rename(downloads / "anything.tgz")
    output, _ = configured("", f"-DGRAINSCOPE_DOWNLOADS={downloads}")
    require(f"LIGGGHTS source: {downloads}/liggghts/src" in output, output)
    require("asking apt" not in output and "cloning" not in output, output)


def tar_file_of_something_else(ranks):
    scratch = Path(os.environ["GRAINSCOPE_SCRATCH"])
    file = scratch / "other.tar.gz"
    with tarfile.open(file, "w:gz") as tar:
        tar.add(ROOT / "README.md", "other/README.md")
    code, output, _ = configure(file)
    require(code != 0 and f"{MUST_BE}, got '{file}'" in output, output)
    downloads = scratch / "downloads"
    downloads.mkdir()
    file.rename(downloads / file.name)
    code, output, _ = configure("", f"-DGRAINSCOPE_DOWNLOADS={downloads}")
    require(code != 0 and f"'{downloads / file.name}' must be a tar file of LIGGGHTS-PUBLIC" in output, output)
    require(not (downloads / "liggghts").exists(), "what was unpacked stays")


def no_network(ranks):
    """Neither apt-get nor git is there: both are named, and what to do."""
    downloads = Path(os.environ["GRAINSCOPE_SCRATCH"]) / "none"
    code, output, _ = configure(
        "", f"-DGRAINSCOPE_DOWNLOADS={downloads}", "-DAPT_GET=NO", "-DCMAKE_DISABLE_FIND_PACKAGE_Git=ON"
    )
    require(code != 0 and "apt: no apt-get on this machine git: no git on this machine" in output, output)
    require("Without network: get LIGGGHTS-PUBLIC elsewhere" in output and f"into {downloads}" in output, output)


def all_that_is_missing(ranks):
    """Told at once, each with its names; nothing else is."""
    code, output, _ = configure(HOST, *HIDDEN, "-DGRAINSCOPE_FFTW=ON")
    require(code != 0 and "Not found: " + " ".join(MISSING.values()) in output, output)
    debian = " ".join(re.findall(r"Debian: ([^,]*),", " ".join(MISSING.values())))
    require(f"sudo apt-get install {debian} Without root: doc/cluster.md." in output, output)
    code, output, _ = configure(HOST, "-DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON")
    require(code != 0 and f"Not found: {MISSING['Eigen']} On Debian" in output, output)


def elsewhere(ranks):
    """What CMAKE_PREFIX_PATH names is found, as of conda, where the system has nothing; by the installed program, too,
    in its own prefix first."""
    prefix = Path(os.environ["GRAINSCOPE_SCRATCH"]) / "prefix"
    for folder in ("include", "lib", "share/eigen3"):
        (prefix / folder).mkdir(parents=True)
    for headers in ("boost", "eigen3"):
        (prefix / "include" / headers).symlink_to(f"/usr/include/{headers}")
    (prefix / "share/eigen3/cmake").symlink_to("/usr/share/eigen3/cmake")
    for library in ("libfftw3.so", "libfftw3_mpi.so"):
        shutil.copy(f"/usr/lib/x86_64-linux-gnu/{library}", prefix / "lib")
    (prefix / "include/fftw3-mpi.h").symlink_to("/usr/include/fftw3-mpi.h")
    output, build = configured(HOST, f"-DCMAKE_PREFIX_PATH={prefix}", *HIDDEN[:1])
    require(f"FFTW with MPI: {prefix}/lib/libfftw3_mpi.so" in output, output)
    cache = (build / "CMakeCache.txt").read_text()
    require(f"Boost_INCLUDE_DIR:PATH={prefix}/include" in cache, "Boost was taken from elsewhere")
    rpath = re.search(r'NEW_RPATH "(.*)"', (build / "cmake_install.cmake").read_text())[1]
    require(rpath == f"\\$ORIGIN/../lib:{prefix}/lib", f"the installed program looks for libraries in '{rpath}'")


def old_compiler(ranks):
    """A compiler that says it is gcc 8."""
    old = Path(os.environ["GRAINSCOPE_SCRATCH"]) / "g++"
    old.write_text('#!/bin/sh\nexec g++ -U__GNUC__ -D__GNUC__=8 -w "$@"\n')
    old.chmod(0o755)
    code, output, _ = configure(HOST, f"-DCMAKE_CXX_COMPILER={old}", "-DCMAKE_CXX_COMPILER_FORCED=ON")
    require(code != 0 and "The C++ compiler must be gcc 12 or clang 14 or newer, got GNU 8." in output, output)


def static_runtime(ranks):
    """No file is compiled with the C++ bindings of MPI, whose library would bring the shared runtime back."""
    _, build = configured(HOST, "-DGRAINSCOPE_STATIC_RUNTIME=ON")
    commands = json.loads((build / "compile_commands.json").read_text())
    with_mpi = [entry for entry in commands if "/CORE/" not in entry["file"]]
    require(len(with_mpi) > 300, f"only {len(with_mpi)} files know MPI")
    for entry in with_mpi:
        require("-DOMPI_SKIP_MPICXX" in entry["command"], f"{entry['file']} has the bindings")
    link = (build / "CMakeFiles" / "grainscope.dir" / "link.txt").read_text().split()
    require({"-static-libstdc++", "-static-libgcc", "-Wl,--as-needed"} <= set(link), f"linked by {link[:20]}")


def without_fftw(ranks):
    """AUTO goes without where there is none, and says so; OFF does where there is."""
    for options in (HIDDEN[:1] + ("-DBoost_INCLUDE_DIR=/usr/include",), ("-DGRAINSCOPE_FFTW=OFF",)):
        output, build = configured(HOST, *options)
        require("FFTW with MPI: none, so `method mesh` of compute velocity/correlation is left out." in output, output)
        compiled = (build / "compile_commands.json").read_text()
        require("mesh_correlation_without_fftw.cpp" in compiled, "the stand-in is not compiled")
        require("/mesh_correlation.cpp" not in compiled, "the mesh is compiled")
    code, output, _ = configure(HOST, "-DGRAINSCOPE_FFTW=maybe")
    require(code != 0 and "GRAINSCOPE_FFTW must be AUTO, ON or OFF, got 'maybe'" in output, output)


def built_without_fftw(ranks):
    """What needs FFTW is refused or skipped, all else of the measure works."""
    output, build = configured(HOST, "-DGRAINSCOPE_FFTW=OFF", "-DGRAINSCOPE_TESTS=ON")
    cmake = os.environ["GRAINSCOPE_CMAKE"]
    for command in (
        [cmake, "--build", build, "-j", str(os.cpu_count())],
        [
            Path(cmake).with_name("ctest"),
            "--test-dir",
            build,
            "-L",
            "^velocity/correlation$",
            "-LE",
            "long",
            "--output-on-failure",
            "-j",
            str(os.cpu_count()),
        ],
    ):
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        require(done.returncode == 0, done.stdout[-4000:])
    require("velocity/correlation-refused-mesh-without-fftw" in done.stdout, "the refusal was not tested")


CASES = {
    "tar-file": tar_file,
    "tar-file-of-something-else": tar_file_of_something_else,
    "no-network": no_network,
    "all-that-is-missing": all_that_is_missing,
    "elsewhere": elsewhere,
    "old-compiler": old_compiler,
    "static-runtime": static_runtime,
    "without-fftw": without_fftw,
    "built-without-fftw": built_without_fftw,
}

if __name__ == "__main__":
    main(CASES)
