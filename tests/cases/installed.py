# SPDX-License-Identifier: GPL-2.0-or-later
"""The program and what belongs to it, installed to a prefix: links of its pages, and a run and a study by its tools."""
import os
from pathlib import Path
import shutil
import subprocess

from case import main, require, require_equal
from grainscope import program
from grainscope.shear.output import read_table
from links import broken_links
from run import Failure, environment

SOURCE, BINARY = Path(os.environ["GRAINSCOPE_SOURCE"]), Path(os.environ["GRAINSCOPE_BINARY"])
SMALL = ["N=100", "alpha=1", "strain=0.1", "part=0.05"]


def scratch():
    return Path(os.environ["GRAINSCOPE_SCRATCH"])


def installed():
    """A prefix where this build was installed."""
    prefix = scratch() / "prefix"
    call([os.environ["GRAINSCOPE_CMAKE"], "--install", BINARY.parents[1], "--prefix", prefix])
    return prefix


def moved():
    """The same, moved away as a whole, where names have spaces."""
    return installed().rename(scratch() / "moved away")


def outside(**changes):
    """The environment of a user who has neither the source tree nor the program on PATH or PYTHONPATH."""
    env = {
        name: value
        for name, value in environment(1).items()
        if name != "PYTHONPATH" and not name.startswith("GRAINSCOPE_")
    }
    path = [folder for folder in env["PATH"].split(os.pathsep) if not (Path(folder) / "grainscope").exists()]
    return {**env, "PATH": os.pathsep.join(path), **changes}


def call(command, **options):
    done = subprocess.run([*map(str, command)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)
    require(done.returncode == 0, f"{' '.join(map(str, command))} ended with {done.returncode}: {done.stdout}")
    return done.stdout


def require_links(pages, top, at_least):
    followed, broken = broken_links(pages, top)
    require(not broken, "; ".join(broken))
    require(followed >= at_least, f"only {followed} links were found, of at least {at_least}")


def links_of_source(ranks):
    """Pages that are part of the source, not what was built or run beside it."""
    pages = list(SOURCE.glob("*.md"))
    for folder in ("bench", "doc", "examples", "tests"):
        pages += (SOURCE / folder).rglob("*.md")
    require_links(pages, SOURCE, 200)


def links_of_installed(ranks):
    share = installed() / "share" / "grainscope"
    pages = sorted(share.rglob("*.md"))
    for name in ("README.md", "ARCHITECTURE.md", "CHANGELOG.md", "doc/howto_study.md", "examples/study/README.md"):
        require(share / name in pages, f"{name} is not installed")
    require_links(pages, share, 200)


def broken_links_are_found(ranks):
    """Each way in which a link can be wrong, among right ones."""
    top = scratch() / "tree"
    (top / "sub").mkdir(parents=True)
    (scratch() / "beyond.md").write_text("# Beyond\n")
    (top / "picture.png").touch()
    (top / "sub" / "right.md").write_text("# One `word`, [two](../page.md)!\n\n## Again\n\n## Again\n")
    right = (
        '[a](sub/right.md) [b](sub/right.md#one-word-two) [c](sub/right.md#again-1) ![d](picture.png "title") '
        "[e](sub) [f](#top)\n"
        '[g]: sub/right.md\n<img src="picture.png"> [web](https://example.org/x) '
        "`[code](nothing.md)`\n\n```\n[code](nothing.md)\n```\n"
    )
    wrong = ["gone.md", "../beyond.md", "sub/right.md#again-2", "#bottom", "picture.png#again"]
    (top / "page.md").write_text(
        "# Top\n\n"
        + right
        + " ".join(f"[x]({target})" for target in wrong)
        + "\n\n[ref]: gone.png\n<a href='gone.html'>\n"
    )
    followed, broken = broken_links([top / "page.md", top / "sub" / "right.md"], top)
    require(followed == 16, f"{followed} links were followed, of 16")
    found = [text.split(": ")[1].split(" ")[0].rstrip(":") for text in broken]
    require(sorted(found) == sorted([*wrong, "gone.png", "gone.html"]), f"found to be broken: {broken}")


def run_of_installed(ranks):
    """grainscope-tools and the deck of a moved prefix, with the program there: the bits of this build's own."""
    prefix = moved()
    call(
        [prefix / "bin/grainscope-tools", "study", "run", scratch() / "out", *SMALL],
        env=outside(),
        cwd=scratch(),
    )
    call(
        [SOURCE / "tools/grainscope-tools", "study", "run", scratch() / "own", *SMALL, "--binary", BINARY],
        env=environment(1),
        cwd=scratch(),
    )
    found, expected = (read_table(scratch() / name, "series.txt")[0] for name in ("out", "own"))
    for column in expected:
        require_equal(found[column], expected[column], column)


def knows_no_place(ranks):
    """No file of the prefix names a folder of this machine, so that it can be moved; it also answers to liggghts."""
    prefix = moved()
    for file in prefix.rglob("*"):
        if file.is_file() and not file.is_symlink():
            data = file.read_bytes()
            for place in (scratch(), SOURCE, BINARY.parents[1]):
                require(f"{place}/".encode() not in data, f"{file.relative_to(prefix)} names {place}")
    link = prefix / "bin" / "liggghts"
    require(link.is_symlink() and os.readlink(link) == "grainscope", "bin/liggghts is no link to grainscope")
    deck = prefix / "share/grainscope/examples/collision/in.collision"
    output = call([link, "-in", deck, "-log", "none"], env=outside(), cwd=scratch())
    require("LIGGGHTS (Version" in output and "ERROR" not in output, output[-2000:])


def without_the_link(ranks):
    """-DGRAINSCOPE_LIGGGHTS_LINK=OFF, for a prefix that has a LIGGGHTS of its own."""
    build = scratch() / "build"
    for choice, expected in (("ON", True), ("OFF", False)):
        call(
            [
                *(os.environ["GRAINSCOPE_CMAKE"], "-S", SOURCE, "-B", build, "-DGRAINSCOPE_TESTS=OFF"),
                f"-DLIGGGHTS_SOURCE_DIR={os.environ['GRAINSCOPE_HOST_SOURCE']}",
                f"-DGRAINSCOPE_LIGGGHTS_LINK={choice}",
            ]
        )
        found = '/bin" TYPE FILE FILES' in (build / "cmake_install.cmake").read_text()
        require(found == expected, f"GRAINSCOPE_LIGGGHTS_LINK={choice} installs {'a' if found else 'no'} link")


def study_of_installed(ranks):
    """Its plan, from the configuration as it is installed, names the program of the prefix."""
    prefix = installed()
    require(shutil.which("snakemake"), "snakemake is missing: scripts/install-packages snakemake")
    output = call(
        ["snakemake", "-s", prefix / "share/grainscope/examples/study/Snakefile", "-n", "-p", "--directory", scratch()],
        env=outside(XDG_CACHE_HOME=str(scratch() / "cache")),
        cwd=scratch(),
    )
    require(
        output.count(f"--binary {prefix.resolve() / 'bin/grainscope'} ") == 5 * 6 * 4,
        f"other runs are planned:\n{output[-3000:]}",
    )


def program_is_found(ranks):
    """The source tree's before that of the prefix, before that on PATH; a path is taken as it is."""
    top, path = scratch() / "prefix" / "share" / "grainscope", scratch() / "on-path"
    places = [top / "build/release/bin/grainscope", scratch() / "prefix/bin/grainscope", path / "grainscope"]
    for place in [*places, top / "build/fast/bin/grainscope"]:
        place.parent.mkdir(parents=True, exist_ok=True)
        place.touch(mode=0o755)
    program.TOP = top
    os.environ["PATH"] = f"{path}:{os.environ['PATH']}"
    for place in places:
        require(program.find_program() == place, f"found {program.find_program()}, expected {place}")
        place.unlink()
    require(
        program.find_program("build/fast/bin/grainscope") == top / "build/fast/bin/grainscope",
        "a path from the top was not taken",
    )
    require(program.find_program(BINARY) == BINARY, "an absolute path was not taken")
    for named, words in (("no-such-program", "or on PATH"), ("build/fast/bin/other", "is not at")):
        try:
            found = program.find_program(named)
        except program.NoProgram as error:
            require(f"got '{named}'" in str(error) and words in str(error), f"it said: {error}")
        else:
            raise Failure(f"{named} was found at {found}")


main(
    {
        "links-of-source": links_of_source,
        "links-of-installed": links_of_installed,
        "broken-links-are-found": broken_links_are_found,
        "run-of-installed": run_of_installed,
        "knows-no-place": knows_no_place,
        "without-the-link": without_the_link,
        "study-of-installed": study_of_installed,
        "program-is-found": program_is_found,
    }
)
