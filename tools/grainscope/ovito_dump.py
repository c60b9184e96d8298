# SPDX-License-Identifier: GPL-2.0-or-later
"""A text dump whose columns OVITO maps to its properties by itself: its reader of LAMMPS dumps knows c_orient[1] to [4]
as Orientation, in the order x y z w, and c_shape[1] to [3] as Aspherical Shape, semi-axes. It would halve LIGGGHTS's
shapex to shapez, which it takes for diameters as those of LAMMPS, and does not know quat1 to quat4."""
from grainscope import grains as of_grains
from grainscope.errors import InputError
from grainscope.progress import progress

ORIENTATION = [f"c_orient[{k}]" for k in (1, 2, 3, 4)]
SHAPE = [f"c_shape[{k}]" for k in (1, 2, 3)]


def write_ovito(dump, path):
    """All snapshots in one file, with all columns but other places than x y z, of which OVITO would take the last."""
    if path.exists() and any(path.samefile(one) for one in dump.files):
        raise InputError(f"--output must not be a file that is read, got '{path}'")
    with open(path, "w") as file:
        for step in progress(dump.steps, "snapshots"):
            snapshot = dump.at(step)
            _write_header(file, snapshot)
            columns = _columns(snapshot)
            file.write(f"ITEM: ATOMS {' '.join(columns)}\n")
            for row in zip(*columns.values()):
                file.write(" ".join(map(_text, row)) + "\n")
    print(path)


def _text(value):
    """A number as text that reads back as the same number; a word as it is."""
    return value if isinstance(value, str) else repr(float(value)).removesuffix(".0")


def _columns(snapshot):
    sets = (*of_grains.PLACES[1:], of_grains.FRACTIONS, *of_grains.SEMI_AXES, *of_grains.QUATERNIONS)
    replaced = [name for names in sets for name in names]
    columns = {name: values for name, values in snapshot.columns.items() if name not in replaced}
    places = dict(zip("xyz", of_grains.positions(snapshot).T))
    w, x, y, z = of_grains.quaternions(snapshot).T
    orientation = dict(zip(ORIENTATION, (x, y, z, w)))
    return columns | places | orientation | dict(zip(SHAPE, of_grains.semi_axes(snapshot).T))


def _write_header(file, snapshot):
    box = snapshot.box
    low, high = box.corners().min(axis=0), box.corners().max(axis=0)
    tilts = box.edges[1, 0], box.edges[2, 0], box.edges[2, 1]
    sides = " ".join("pp" if periodic else "ff" for periodic in box.periodic)
    tilted = any(tilts)
    file.write(f"ITEM: TIMESTEP\n{snapshot.step}\nITEM: NUMBER OF ATOMS\n{len(snapshot)}\n")
    file.write(f"ITEM: BOX BOUNDS {'xy xz yz ' if tilted else ''}{sides}\n")
    for k in range(3):
        file.write(" ".join(map(_text, (low[k], high[k], tilts[k]) if tilted else (low[k], high[k]))) + "\n")
