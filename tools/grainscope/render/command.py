# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures and films of the grains of a dump, by POV-Ray: spheres, ellipsoids and superquadrics in any box, with walls
and force chains."""

import argparse
import os
from pathlib import Path
import re

import matplotlib
import matplotlib.image
import numpy as np

from grainscope.errors import InputError, warn
from grainscope.render.camera import AXES
from grainscope.render.film import film, finished, require_writer
from grainscope.render.look import Look, Sources
from grainscope.render.scene import LIGHTS, require_povray, run_povray
from grainscope.render.walls import STYLES

NUMBER = re.compile(r"-(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$")
PLANES = ("xy", "xz", "yx", "yz", "zx", "zy")
SMALLEST = 32  # width and height of a picture


def add_arguments(parser):
    parser._negative_number_matcher = NUMBER  # argparse takes -1e-3 for an option before Python 3.14
    add = parser.add_argument
    add("dump", nargs="+", help="files of dump custom: id type x y z radius, or quat1-4 shapex-z in place of radius")
    add("--output", default="grains.png", metavar="FILE.png", help="the picture (default: grains.png)")
    add("--step", type=int, help="the snapshot to draw (default: the last)")
    add("--size", nargs=2, type=int, default=(1600, 1200), metavar=("W", "H"), help="in pixels (default: 1600 1200)")
    add(
        "--light",
        choices=tuple(LIGHTS),
        default="soft",
        help="plain is quicker, none shows pure colours (default: soft)",
    )
    add("--jobs", type=int, default=os.cpu_count() or 1, help="processor cores to use (default: all)")
    add("--scene", metavar="FILE.pov", help="also write POV-Ray's scene")

    group = parser.add_argument_group("view")
    add = group.add_argument
    add("--up", choices=tuple(AXES), default="y", help="the axis that points up (default: y)")
    text = "azimuth and elevation in degrees, or a vector x y z to the viewer (default: 18 16; of 2d runs 0 0)"
    add("--view", nargs="+", type=float, metavar="NUMBER", help=text)
    add("--orthographic", action="store_true", help="without perspective, as 2d runs are drawn")
    add("--box", action=argparse.BooleanOptionalAction, help="edges of the box (default: of periodic boxes)")
    add("--arrows", choices=(*PLANES, "none"), help="of the flow, in a plane flow-gradient (default: of sheared boxes)")

    group = parser.add_argument_group("grains")
    add = group.add_argument
    add("--where", metavar="CONDITION", help="only these grains, for example 'type == 2 and z > 0.01'")
    cut = "only grains with centres between two values of x, y or z, and walls there; may be repeated"
    add("--cut", nargs=3, action="append", default=[], metavar=("AXIS", "LO", "HI"), help=cut)
    text = "a column, NAME of a vector NAMEx NAMEy NAMEz, or alignment (default of grains that are no spheres)"
    add("--colour", metavar="COLUMN", help=text)
    add("--range", nargs=2, type=float, metavar=("LO", "HI"), help="ends of the colour bar (default: of all snapshots)")
    add("--colormap", metavar="NAME", help="of matplotlib (default: viridis, viridis_r for alignment, tab10 for types)")
    add("--label", help="what is written at the colour bar (default: the column)")
    add("--along", choices=tuple(AXES), help="the axis that alignment is against (default: of the flow, or x)")
    add("--opacity", type=float, help="from 0 to 1 (default: 1; with contacts 0.15)")

    group = parser.add_argument_group("walls")
    add = group.add_argument
    add("--walls", nargs="+", default=[], metavar="FILE.stl", help="meshes; * in a name stands for the step")
    text = "zplane Z or zcylinder RADIUS X Y [LO HI], and so for x and y, as in the deck; may be repeated"
    add("--primitive", nargs="+", action="append", default=[], metavar="WORD", help=text)
    add("--wall-style", choices=STYLES, default=STYLES[0], help=f"(default: {STYLES[0]})")

    group = parser.add_argument_group("force chains")
    add = group.add_argument
    add("--contacts", nargs="+", metavar="FILE", help="files of dump local of compute contact/local: id branch fn")
    add("--contact-columns", nargs="+", metavar="WORD", help="the words of compute contact/local (default: none)")
    add("--only-contacts", action="store_true", help="the chains without the grains")
    text = "normal force of the thickest chains (default: 1 %% of all are stronger)"
    add("--strongest", type=float, metavar="FORCE", help=text)

    group = parser.add_argument_group("films")
    add = group.add_argument
    add("--animate", metavar="FILE", help="a film of all snapshots, .mp4 (by ffmpeg) or .gif, in place of a picture")
    add("--every", type=int, default=1, metavar="N", help="frames of every Nth snapshot alone (default: 1)")
    add("--rate", type=float, default=12.0, help="snapshots per second (default: 12)")


def checked(given):
    """Refuses numbers and words that have no meaning, and makes numbers of the ends of cuts."""
    cuts = []
    for axis, low, high in given.cut:
        words = f"'{axis} {low} {high}'"
        try:
            cuts.append((axis, float(low), float(high)))
        except ValueError:
            raise InputError(f"--cut must be an axis and two numbers, got {words}") from None
        if axis not in tuple(AXES):
            raise InputError(f"--cut must begin with x, y or z, got {words}")
        if not cuts[-1][1] < cuts[-1][2]:
            raise InputError(f"--cut {axis}: the first number must be below the second, got {words}")
    given.cut = cuts
    if min(given.size) < SMALLEST:
        raise InputError(f"--size must be at least {SMALLEST} {SMALLEST}, got {given.size[0]} {given.size[1]}")
    if given.range and not (np.all(np.isfinite(given.range)) and given.range[0] < given.range[1]):
        raise InputError(
            f"--range: the first number must be below the second, got {given.range[0]:g} {given.range[1]:g}"
        )
    if given.opacity is not None and not 0.0 < given.opacity <= 1.0:
        raise InputError(f"--opacity must be above 0 and at most 1, got {given.opacity:g}")
    if given.colormap is not None and given.colormap not in matplotlib.colormaps:
        raise InputError(f"--colormap must be one of matplotlib's, got '{given.colormap}'")
    if given.jobs < 1:
        raise InputError(f"--jobs must be at least 1, got {given.jobs}")
    if not 0.0 < given.rate < np.inf:
        raise InputError(f"--rate must be above 0, got {given.rate:g}")
    if given.every < 1:
        raise InputError(f"--every must be at least 1, got {given.every}")
    if given.strongest is not None and not 0.0 < given.strongest < np.inf:
        raise InputError(f"--strongest must be above 0, got {given.strongest:g}")
    if not given.contacts:
        for option, value in (("--only-contacts", given.only_contacts), ("--contact-columns", given.contact_columns)):
            if value:
                raise InputError(f"{option} needs --contacts with the files of dump local")
    if given.only_contacts and given.colour:
        raise InputError("--colour is for grains, which --only-contacts leaves out")
    if not given.output.endswith(".png"):
        raise InputError(f"--output must end in .png, got '{given.output}'")
    if given.every != 1 and not given.animate:
        raise InputError("--every is for films: give --animate")
    if given.animate:
        require_writer(given.animate)
        if given.step is not None or given.scene:
            raise InputError("--animate draws all snapshots; leave out --step and --scene")
    require_povray()
    return given


def run(arguments):
    given = checked(arguments)
    sources = Sources(given)
    for note in sources.notes:
        warn(note)
    if given.animate:
        film(Look(sources, sources.steps[:: given.every], given), sources, given.animate, given.rate, given.jobs)
        print(given.animate)
        return
    step = sources.steps[-1] if given.step is None else given.step
    look, view = Look(sources, [step], given), sources.view(step)
    if given.scene:
        Path(given.scene).write_text(look.scene(view))
    pixels = run_povray(look.scene(view), *look.pixels, given.jobs)
    matplotlib.image.imsave(given.output, finished(look, step, pixels))
    print(given.output)
