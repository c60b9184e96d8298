# SPDX-License-Identifier: GPL-2.0-or-later
"""Dumps for ParaView (--to vtk) or OVITO (--to ovito)."""
import math
from pathlib import Path
import re

from grainscope import contact_columns, vtk_scene
from grainscope.dumps import Dump
from grainscope.errors import InputError, warn
from grainscope.grains import grains_of
from grainscope.ovito_dump import write_ovito
from grainscope.progress import progress
from grainscope.surfaces import DEEPEST, read_stl
from grainscope.vtk_files import write_collection


class Series:
    """The files of one kind, and the .pvd file that gives each its time."""

    def __init__(self, folder, kind):
        self.path = folder / f"{kind}.pvd"
        self._folder, self._kind, self._entries = folder / kind, kind, []
        self._folder.mkdir(parents=True, exist_ok=True)

    def add(self, step, time):
        """The path of the next file."""
        path = self._folder / f"{self._kind}_{step}.vtp"
        self._entries.append((time, path.relative_to(self.path.parent)))
        return path

    def close(self):
        write_collection(self.path, self._entries)
        print(self.path)


class Walls:
    """Triangles of STL files: of a file always, of a pattern from the step on that * stands for."""

    def __init__(self, names):
        self._walls = []  # for each: its files by the step from which they hold
        for name in names:
            if "*" not in name:
                self._walls.append({0: name})
                continue
            matching = re.compile(".*".join(map(re.escape, Path(name).name.split("*"))).replace(".*", r"(\d+)", 1))
            found = {
                int(match[1]): str(path)
                for path in Path(name).parent.glob(Path(name).name)
                if (match := matching.fullmatch(path.name))
            }
            if not found:
                raise InputError(f"--walls {name}: no file with a step in place of *")
            self._walls.append(found)
        self.move = any(set(files) != {0} for files in self._walls)

    def require_readable(self):
        for path in {path for files in self._walls for path in files.values()}:
            read_stl(path)

    def numbered(self, step):
        """The file of each wall in a step, by the number of the wall, from 1; a wall may have none yet."""
        held = ([s for s in files if s <= step] for files in self._walls)
        walls = enumerate(zip(self._walls, held), 1)
        return {number: files[max(steps)] for number, (files, steps) in walls if steps}

    def files(self, step):
        return list(self.numbered(step).values())


class Contacts:
    """Contacts in the steps in which grains were dumped too. All have the columns that are needed."""

    def __init__(self, grains, arguments):
        self._grains, self._keywords = grains, arguments.contact_columns
        self._contacts = Dump(arguments.contacts)
        warn_of(self._contacts)
        dumped = self._contacts.steps
        self._steps = sorted(set(dumped).intersection(grains.steps))
        if not self._steps:
            raise InputError(
                "contacts and grains must be dumped in the same steps: "
                f"contacts are of {some(dumped)}, grains of {some(grains.steps)}"
            )
        if len(self._steps) < len(dumped):
            warn(f"contacts of {len(dumped) - len(self._steps)} steps are left out: their grains were not dumped")
        for step in self._steps:
            path = self._contacts.path(step)
            names = contact_columns.names_of_columns(path, self._contacts.names(step), self._keywords)
            remedy = ("id", "point", "branch", "force", "fn")
            contact_columns.require_columns(path, names, vtk_scene.OF_CONTACTS, remedy)
        contact_columns.named(self._contacts.at(self._steps[0]), self._keywords)

    def write(self, series, time):
        lost = 0
        for step in progress(self._steps, "contacts of snapshots"):
            snapshot = self._contacts.at(step)
            columns, grains = contact_columns.named(snapshot, self._keywords), self._grains.at(step)
            lost += vtk_scene.write_contacts(series.add(step, time(step)), time(step), columns, snapshot, grains)
        if lost:
            warn(f"{lost} contacts are left out: the grain i of each is not in the dump of grains")


def to_vtk(grains, arguments):
    """Nothing is written before all that is needed is there."""
    grains_of(grains.at(grains.steps[0]))
    contacts = Contacts(grains, arguments) if arguments.contacts else None
    walls = Walls(arguments.walls) if arguments.walls else None
    if walls:
        walls.require_readable()
    folder = Path(arguments.output or "vtk")
    kinds = ["grains", "box"] + ["surfaces"] * (arguments.mesh is not None)
    series = {kind: Series(folder, kind) for kind in kinds}

    def time(step):
        return float(step * arguments.dt)

    for step in progress(grains.steps, "snapshots"):
        snapshot = grains.at(step)
        vtk_scene.write_grains(series["grains"].add(step, time(step)), time(step), snapshot)
        vtk_scene.write_box(series["box"].add(step, time(step)), time(step), snapshot.box)
        if arguments.mesh is not None:
            path = series["surfaces"].add(step, time(step))
            vtk_scene.write_surfaces(path, time(step), snapshot, arguments.mesh)
    if contacts:
        series["contacts"] = Series(folder, "contacts")
        contacts.write(series["contacts"], time)
    if walls:
        series["walls"] = Series(folder, "walls")
        for step in grains.steps if walls.move else grains.steps[:1]:
            meshes = {number: read_stl(path) for number, path in walls.numbered(step).items()}
            if meshes:
                vtk_scene.write_walls(series["walls"].add(step, time(step)), time(step), meshes)
    for one in series.values():
        one.close()


def warn_of(dump):
    for note in dump.notes:
        warn(note)


def some(steps):
    return f"steps {', '.join(map(str, steps[:5]))}{' ...' if len(steps) > 5 else ''}"


def add_arguments(parser):
    parser.add_argument("dump", nargs="+", help="dump custom: files, or patterns with * in quotes")
    parser.add_argument("--to", choices=("vtk", "ovito"), required=True, help="for ParaView, or for OVITO")
    parser.add_argument("--output", metavar="PATH", help="folder (default: vtk) or, for OVITO, file (ovito.dump)")
    parser.add_argument("--dt", type=float, default=1.0, help="time step: times are in its unit (default: 1, steps)")
    parser.add_argument("--mesh", type=int, metavar="LEVEL", help="also surfaces, of 20 x 4^LEVEL triangles each")
    parser.add_argument("--contacts", nargs="+", metavar="DUMP", help="dump local of compute contact/local")
    parser.add_argument(
        "--contact-columns", nargs="+", metavar="WORD", help="the words of compute contact/local, if it had any"
    )
    parser.add_argument("--walls", nargs="+", metavar="FILE.stl", help="STL files; * is the step of walls that move")


def check(arguments):
    if arguments.mesh is not None and not 0 <= arguments.mesh <= DEEPEST:
        raise InputError(f"--mesh must be from 0 to {DEEPEST}, got {arguments.mesh}")
    if not 0 < arguments.dt < math.inf:
        raise InputError(f"--dt must be above 0, got {arguments.dt:g}")
    if arguments.contact_columns and not arguments.contacts:
        raise InputError("--contact-columns needs --contacts")
    if arguments.to == "ovito" and (arguments.contacts or arguments.walls or arguments.mesh is not None):
        raise InputError("--to ovito must be without --contacts, --walls and --mesh: it writes grains alone")


def run(arguments):
    check(arguments)
    grains = Dump(arguments.dump)
    warn_of(grains)
    if arguments.to == "ovito":
        write_ovito(grains, Path(arguments.output or "ovito.dump"))
    else:
        to_vtk(grains, arguments)
