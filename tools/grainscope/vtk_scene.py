# SPDX-License-Identifier: GPL-2.0-or-later
"""What ParaView is given of a step: grains, their surfaces, contacts, walls and the box, each as a .vtp file."""
import numpy as np

from grainscope import grains as of_grains
from grainscope.surfaces import grain_surfaces
from grainscope.vtk_files import write_polydata

OF_CONTACTS = ["id_i", "id_j", *(f"{name}_{end}" for name in ("point", "branch") for end in "xyz")]
WHOLE = ("id", "type", "mol", "id_multisphere", "wall", "triangle", "strong", "sliding", "cluster")
TRIPLES = {
    "velocity": ("vx", "vy", "vz"),
    "force": ("fx", "fy", "fz"),
    "torque": ("tqx", "tqy", "tqz"),
    "omega": ("omegax", "omegay", "omegaz"),
    "angmom": ("angmomx", "angmomy", "angmomz"),
}
SIDES = ((0, 1), (2, 3), (4, 5), (6, 7), (0, 2), (1, 3), (4, 6), (5, 7), (0, 4), (1, 5), (2, 6), (3, 7))


def _arrays(columns, triples):
    """Arrays by name: the columns, those of a vector together; whole numbers as such, words left out."""
    arrays, used = {}, set()
    for name, parts in triples.items():
        if all(part in columns for part in parts):
            arrays[name] = np.stack([columns[part] for part in parts], axis=1)
            used.update(parts)
    for name, values in columns.items():
        if name not in used and name not in arrays and values.dtype.kind == "f":
            arrays[name] = values
    return {name: values.astype(int) if name in WHOLE else values for name, values in arrays.items()}


def _grain_arrays(snapshot):
    shown = {
        name: values
        for name, values in snapshot.columns.items()
        if not any(name in names for names in (*of_grains.PLACES[:1], *of_grains.SEMI_AXES, *of_grains.QUATERNIONS))
    }
    return _arrays(shown, TRIPLES)


def write_grains(path, time, snapshot):
    """A point for each grain. The tensor turns a sphere of diameter 1 into the grain: ParaView's sphere for glyphs."""
    quaternions, semi_axes = of_grains.quaternions(snapshot), of_grains.semi_axes(snapshot)
    turn = of_grains.rotation_matrices(quaternions)
    tensors = (turn * 2.0 * semi_axes[:, None]) @ turn.transpose(0, 2, 1)
    arrays = {"glyph_tensor": tensors.reshape(-1, 9), "semi_axes": semi_axes, "quaternion": quaternions}
    number = len(snapshot)
    vertices = (np.ones(number), np.arange(number))
    points, arrays = of_grains.positions(snapshot), _grain_arrays(snapshot) | arrays
    write_polydata(path, time, points, {"Verts": vertices}, arrays, active=' Tensors="glyph_tensor"')


def write_surfaces(path, time, snapshot, level):
    grains = of_grains.grains_of(snapshot)
    points, normals, triangles = grain_surfaces(
        level, grains.positions, grains.rotations, grains.semi_axes, of_grains.blockiness(snapshot)
    )
    each = points.shape[1]
    arrays = {name: np.repeat(values, each, axis=0) for name, values in _grain_arrays(snapshot).items()}
    arrays = {name: values.astype("f4") if values.dtype.kind == "f" else values for name, values in arrays.items()}
    surface = {"Polys": (np.full(len(triangles), 3), triangles)}
    arrays["Normals"] = normals.reshape(-1, 3).astype("f4")
    write_polydata(path, time, points.reshape(-1, 3).astype("f4"), surface, arrays, active=' Normals="Normals"')


def write_contacts(path, time, columns, snapshot, grains):
    """A line for each contact: from the centre of i to the contact point and on to the centre of the image of j that i
    touches, or to the wall; `columns` by name has OF_CONTACTS. Returns how many contacts are left out because `grains`
    has no i."""
    there = np.isin(columns["id_i"], grains["id"])
    columns = {name: values[there] for name, values in columns.items()}
    point, branch = (np.stack([columns[f"{name}_{end}"] for end in "xyz"], axis=1) for name in ("point", "branch"))
    order = np.argsort(grains["id"])
    rows = order[np.searchsorted(grains["id"], columns["id_i"], sorter=order)]
    start = point - snapshot.box.nearest(point - of_grains.positions(grains)[rows])
    wall = columns["id_j"] == 0
    end = start - branch
    points = np.stack([start, point, end], axis=1)[~np.stack([wall & False, wall & False, wall], axis=1)]
    lengths = np.where(wall, 2, 3)
    triples = {name[:-2]: tuple(f"{name[:-2]}_{end}" for end in "xyz") for name in columns if name.endswith("_x")}
    arrays = _arrays(columns, triples)
    at_points = {"fn": np.repeat(arrays["fn"], lengths)} if "fn" in arrays else {}
    write_polydata(path, time, points, {"Lines": (lengths, np.arange(len(points)))}, at_points, arrays)
    return np.count_nonzero(~there)


def write_walls(path, time, meshes):
    """`meshes`: corners (M,3,3) of the triangles, by the number of the wall."""
    counts = [len(mesh) for mesh in meshes.values()]
    arrays = {
        "wall": np.repeat(list(meshes), counts),
        "triangle": np.concatenate([np.arange(count) for count in counts]),
    }
    points = np.concatenate(list(meshes.values())).reshape(-1, 3)
    surface = {"Polys": (np.full(sum(counts), 3), np.arange(len(points)))}
    write_polydata(path, time, points, surface, cell_data=arrays)


def write_box(path, time, box):
    write_polydata(path, time, box.corners(), {"Lines": (np.full(12, 2), SIDES)})
