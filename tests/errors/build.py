# SPDX-License-Identifier: GPL-2.0-or-later
"""Configuring the build: where the host comes from, what is done to it (nothing), and what the staged copy holds."""
import hashlib
import os
from pathlib import Path
import re
import shutil
import subprocess
import tempfile

from case import main, require

ROOT = Path(os.environ["GRAINSCOPE_SOURCE"])
HOST = Path(os.environ["GRAINSCOPE_HOST_SOURCE"])
MUST_BE = "LIGGGHTS_SOURCE_DIR must be a LIGGGHTS-PUBLIC checkout (or its src/), or a tar file of one"
LAMDA = "prd_lamda[0] = prd_lamda[1] = prd_lamda[2] = {};"
HALF_LAMDA = "prd_half_lamda[0] = prd_half_lamda[1] = prd_half_lamda[2] = {};"


def probe_passed():
    """That our styles fit the host was found when the program of these tests was configured: by the same compiler from
    the same headers, or else it is looked at again."""
    cache = (Path(os.environ["GRAINSCOPE_BUILD"]) / "CMakeCache.txt").read_text()
    return f"-D{re.search('^HOST_PROBE_PASSED:.*', cache, re.M)[0]}"


def configure(source, *options, build=None):
    """(exit code, output with lines unwrapped, build folder)."""
    build = build or Path(tempfile.mkdtemp(dir=os.environ["GRAINSCOPE_SCRATCH"])) / "build"
    done = subprocess.run(
        [
            os.environ["GRAINSCOPE_CMAKE"],
            "-S",
            ROOT,
            "-B",
            build,
            "-DGRAINSCOPE_TESTS=OFF",
            probe_passed(),
            f"-DLIGGGHTS_SOURCE_DIR={source}",
            *options,
        ],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    return done.returncode, " ".join(done.stdout.split()), build


def configured(source, *options, build=None):
    code, output, build = configure(source, *options, build=build)
    require(code == 0, f"configuring failed:\n{output}")
    return output, build


def stage_of(build):
    """Where the host is laid out in a build folder."""
    stages = [folder for folder in build.glob("host*") if folder.is_dir()]
    require(len(stages) == 1, f"not one staged host but {stages}")
    return stages[0]


def copy_of_host():
    copy = Path(tempfile.mkdtemp(dir=os.environ["GRAINSCOPE_SCRATCH"])) / "liggghts" / "src"
    copy.mkdir(parents=True)
    for file in HOST.iterdir():
        if file.suffix in (".h", ".cpp", ".txt"):
            shutil.copy(file, copy)
    return copy


def checksums(folder):
    return {
        str(f.relative_to(folder)): hashlib.sha256(f.read_bytes()).hexdigest() for f in folder.rglob("*") if f.is_file()
    }


def folder_without_liggghts(ranks):
    empty = tempfile.mkdtemp(dir=os.environ["GRAINSCOPE_SCRATCH"])
    code, output, _ = configure(empty)
    require(code != 0, "an empty folder was accepted")
    require(f"{MUST_BE}, got '{empty}'" in output, output)


def root_or_src(ranks):
    """Both the checkout and its src/ are found."""
    copy = copy_of_host()
    for source in (copy, copy.parent):
        output, _ = configured(source)
        require(f"LIGGGHTS source: {copy.resolve()}" in output, output)


def source_left_untouched(ranks):
    copy = copy_of_host()
    before = checksums(copy)
    configured(copy)
    require(checksums(copy) == before, "configuring changed the source tree")


def styles_are_listed(ranks):
    """Every style of ours and a few of the host's stand in the lists that LIGGGHTS reads."""
    _, build = configured(HOST)
    stage = stage_of(build)
    ours = [
        (kind, header.name)
        for kind, folder in (("pair", "PAIR"), ("fix", "FIX"), ("compute", "COMPUTE"))
        for header in (ROOT / "src" / folder).glob("*.h")
        if re.search(rf"^#ifdef {folder}_CLASS", header.read_text(), re.M)
    ]
    require(len(ours) >= 6, f"only {ours}")
    theirs = [
        ("pair", "pair_gran_proxy.h"),
        ("fix", "fix_deform.h"),
        ("atom", "atom_vec_superquadric.h"),
        ("command", "run.h"),
        ("surface_model", "surface_model_superquadric.h"),
        ("normal_model", "normal_model_hertz.h"),
    ]
    for kind, header in ours + theirs:
        require(
            f'#include "{header}"' in (stage / f"style_{kind}.h").read_text(), f"{header} is missing in style_{kind}.h"
        )
    require((stage / "angle.cpp").is_symlink(), "an unmended file is a copy")


def set_mends(copy, value, half_value):
    file = copy / "domain.cpp"
    text = file.read_text(errors="surrogateescape")
    for line, wanted in ((LAMDA, value), (HALF_LAMDA, half_value)):
        text, count = re.subn(re.escape(line).replace(r"\{\}", r"[0-9.]+"), line.format(wanted), text)
        require(count == 1, f"domain.cpp has {count} lines like {line}")
    file.write_text(text, errors="surrogateescape")


def mended_where_needed(ranks):
    copy = copy_of_host()
    set_mends(copy, "0.0", "0.0")
    output, build = configured(copy)
    staged = stage_of(build) / "domain.cpp"
    require("domain.cpp: prd_lamda is 0, which loses atoms of triclinic boxes" in output, output)
    require(not staged.is_symlink(), "the mended file is still a link")
    text = staged.read_text(errors="replace")
    require(LAMDA.format("1.0") in text and HALF_LAMDA.format("0.5") in text, "domain.cpp was not mended")


def not_mended_where_right(ranks):
    copy = copy_of_host()
    set_mends(copy, "1.0", "0.5")
    output, build = configured(copy)
    require("domain.cpp" not in output, output)
    require((stage_of(build) / "domain.cpp").is_symlink(), "a right file was copied")


def configured_twice_rebuilds_nothing(ranks):
    _, build = configured(HOST)
    times = {f: f.lstat().st_mtime_ns for f in stage_of(build).iterdir() if not f.is_symlink()}
    configured(HOST, build=build)
    changed = [f.name for f, time in times.items() if f.lstat().st_mtime_ns != time]
    require(not changed, f"rewritten by a second configure: {changed}")


def own_whitelist(ranks):
    line = "GRAN_MODEL(HERTZ, TANGENTIAL_HISTORY, COHESION_SJKR, ROLLING_OFF, SURFACE_SUPERQUADRIC)"
    extra = Path(os.environ["GRAINSCOPE_SCRATCH"]) / "own.whitelist"
    extra.write_text(line + "\n")
    _, build = configured(HOST, f"-DGRAINSCOPE_WHITELIST={extra}")
    require(line in (stage_of(build) / "style_contact_model.h").read_text(), "the extra combination is missing")


def missing_whitelist(ranks):
    code, output, _ = configure(HOST, "-DGRAINSCOPE_WHITELIST=/no/such/file")
    require(
        code != 0 and "GRAINSCOPE_WHITELIST must name a file of GRAN_MODEL(...) lines, got '/no/such/file'" in output,
        output,
    )


CASES = {
    "folder-without-liggghts": folder_without_liggghts,
    "root-or-src": root_or_src,
    "source-left-untouched": source_left_untouched,
    "styles-are-listed": styles_are_listed,
    "mended-where-needed": mended_where_needed,
    "not-mended-where-right": not_mended_where_right,
    "configured-twice-rebuilds-nothing": configured_twice_rebuilds_nothing,
    "own-whitelist": own_whitelist,
    "missing-whitelist": missing_whitelist,
}

if __name__ == "__main__":
    main(CASES)
