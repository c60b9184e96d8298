"""Finds the grainscope program, for tools that run from the source tree and from the folder where they were
installed."""

from pathlib import Path
import shutil

from grainscope.errors import InputError

TOP = Path(__file__).resolve().parents[2]  # of the source tree, or <prefix>/share/grainscope
NAME = "grainscope"


class NoProgram(InputError):
    """No program where one was looked for; the message names the places."""


def find_program(named=NAME):
    """The path of the program. A name without '/' is that of the release build of this source tree, or of the prefix
    where the tools are installed, or on PATH, whichever there is first; any other is a path from the top of the source
    tree, or an absolute one.
    """
    named = str(named)
    places = (
        [TOP / named] if "/" in named else [TOP / "build" / "release" / "bin" / named, TOP.parents[1] / "bin" / named]
    )
    for place in places:
        if place.is_file():
            return place
    on_path = None if "/" in named else shutil.which(named)
    if on_path:
        return Path(on_path)
    looked = " or ".join(map(str, places)) + ("" if "/" in named else " or on PATH")
    raise NoProgram(
        f"program must be the grainscope program, got '{named}', which is not at {looked}: build it, or name another"
    )
