# SPDX-License-Identifier: GPL-2.0-or-later
"""grainscope-tools convert --to vtk: files read back by the format's description, against closed forms and numbers that
the dumps were made of."""
import math

import numpy as np
from scipy.spatial.transform import Rotation
from scipy.special import beta

from case import main, require, require_close, require_equal
from dump_files import converted, new_folder, refused, snapshot, tool
import meshes
from vtp import collection

ICOSAHEDRON = 5.0 / 12.0 * (3.0 + math.sqrt(5.0)) / math.sin(0.4 * math.pi) ** 3  # volume, corners on the unit sphere
SHAPES = {
    "polydisperse": [(1.0, 1.0, 1.0), (0.5, 0.5, 0.5), (2.0, 2.0, 2.0)],
    "prolate": [(1.0, 1.0, 1.5), (0.7, 0.7, 2.1), (3.0, 0.3, 0.3)],
    "oblate": [(1.0, 1.0, 0.5), (0.6, 1.8, 1.8), (1.0, 1.0, 0.1)],
    "triaxial": [(1.0, 0.7, 0.4), (0.2, 1.1, 1.3), (1.0, 2.0, 3.0)],
}


def grains(shapes, seed=3, **more):
    """Columns of a dump of ellipsoids at random places in random orientations, and the rotations."""
    random = np.random.default_rng(seed)
    turns = Rotation.random(len(shapes), random_state=seed)
    i, j, k, w = turns.as_quat().T
    x, y, z = random.uniform(0.0, 10.0, (3, len(shapes)))
    a, b, c = np.array(shapes, dtype=float).T
    columns = {"id": list(range(len(shapes), 0, -1)), "type": [2] * len(shapes), "x": x, "y": y, "z": z}
    columns |= {"quat1": w, "quat2": i, "quat3": j, "quat4": k, "shapex": a, "shapey": b, "shapez": c}
    return columns | more, turns.as_matrix()


def spheres(number=4, **more):
    random = np.random.default_rng(5)
    x, y, z = random.uniform(0.0, 10.0, (3, number))
    return {"id": list(range(1, number + 1)), "x": x, "y": y, "z": z, "radius": random.uniform(0.5, 1.0, number)} | more


def folder_of(*texts, name="grains.dump"):
    folder = new_folder()
    (folder / name).write_text("".join(texts))
    return folder


def vtk(folder, *words, dump="grains.dump"):
    """What convert makes of the dump of a folder: by kind, the data by time."""
    converted(dump, "--to", "vtk", *words, folder=folder)
    return {path.stem: collection(path) for path in (folder / "vtk").glob("*.pvd")}


def glyph_tensors(shapes):
    """Eigenvalues are diameters, eigenvectors the grain's axes; semi-axes and quaternions are those of the dump."""

    def case(ranks):
        columns, turns = grains(shapes)
        data = vtk(folder_of(snapshot(7, columns)))["grains"][7.0]
        require_equal(data.points, np.transpose([columns[one] for one in "xyz"]), "centres")
        require(data.active == {"Tensors": "glyph_tensor"}, str(data.active))
        require([list(one) for one in data.verts] == [[0], [1], [2]], "a vertex for each grain")
        require_equal(data.point_data["semi_axes"], shapes, "semi-axes")
        require_equal(data.point_data["quaternion"], np.transpose([columns[f"quat{k}"] for k in (1, 2, 3, 4)]), "quat")
        tensors = data.point_data["glyph_tensor"].reshape(-1, 3, 3)
        for tensor, turn, axes in zip(tensors, turns, np.array(shapes)):
            require_close(np.linalg.eigvalsh(tensor), 2.0 * np.sort(axes), 1e-13, "eigenvalues")
            for k in range(3):
                require_close(tensor @ turn[:, k], 2.0 * axes[k] * turn[:, k], 1e-13, "a body axis is an eigenvector")
        require_equal(data.point_data["id"], columns["id"], "id")
        require(data.point_data["id"].dtype == np.int64, "IDs are whole numbers")

    return case


def volume_of(corners):
    return np.linalg.det(corners).sum() / 6.0


def surfaces(ranks):
    """Volumes: 4/3 pi abc less the share of the mesh, known for an icosahedron; corners lie on the ellipsoids, normals
    are their gradients."""
    shapes = [axes for several in SHAPES.values() for axes in several]
    columns, turns = grains(shapes, vx=np.arange(12.0))
    folder = folder_of(snapshot(0, columns))
    shares = []
    for level in range(4):
        data = vtk(folder, "--mesh", level)["surfaces"][0.0]
        require(len(data.polys) == 12 * 20 * 4**level, "triangles of the surfaces")
        corners = data.points.reshape(12, -1, 3).astype(float)
        triangles = np.array(data.polys).reshape(12, -1, 3) - len(corners[0]) * np.arange(12)[:, None, None]
        normals = data.point_data["Normals"].reshape(12, -1, 3)
        found = []
        for k, (axes, turn) in enumerate(zip(np.array(shapes), turns)):
            centre = np.array([columns[one][k] for one in "xyz"])
            local = (corners[k] - centre) @ turn
            require_close(((local / axes) ** 2).sum(axis=1), np.ones(len(local)), 1e-4, "corners on the ellipsoid")
            gradient = local / axes**2
            gradient /= np.linalg.norm(gradient, axis=1, keepdims=True)
            require_close(normals[k] @ turn, gradient, 1e-3, "normals")
            found.append(volume_of((corners[k] - centre)[triangles[k]]) / (4.0 / 3.0 * math.pi * axes.prod()))
        require_close(found, np.full(12, found[0]), 1e-5, "each has the same share of its ellipsoid")
        shares.append(found[0])
        require_equal(data.point_data["id"].reshape(12, -1)[:, 0], columns["id"], "IDs of the surfaces")
        require_equal(data.point_data["vx"].reshape(12, -1)[:, -1], columns["vx"], "columns of the surfaces")
    require_close(shares[0], ICOSAHEDRON / (4.0 / 3.0 * math.pi), 1e-5, "volume of an icosahedron")
    lost = 1.0 - np.array(shares)
    require(bool((lost[1:] < 0.34 * lost[:-1]).all()), f"each level loses a quarter of the last: {lost}")


def boxy_surfaces(ranks):
    """Superquadrics: volumes by their closed form (Jaklic, Leonardis & Solina 2000), less what the mesh cuts."""
    exponents = np.array([(2.0, 2.0), (4.0, 4.0), (6.0, 2.0), (2.0, 5.0)])
    columns, _ = grains([(1.0, 0.7, 2.0)] * 4, blockiness1=exponents[:, 0], blockiness2=exponents[:, 1])
    data = vtk(folder_of(snapshot(0, columns)), "--mesh", 4)["surfaces"][0.0]
    corners = data.points[np.array(data.polys)].reshape(4, -1, 3, 3).astype(float)
    for k, (n1, n2) in enumerate(exponents):
        e1, e2 = 2.0 / n1, 2.0 / n2
        exact = 2.0 * 1.4 * e1 * e2 * beta(0.5 * e1 + 1.0, e1) * beta(0.5 * e2, 0.5 * e2)
        centre = np.array([columns[one][k] for one in "xyz"])
        require_close(volume_of(corners[k] - centre), exact, 4e-3, f"blockiness {n1} {n2}")


def all_columns(ranks):
    """Vectors together, single columns by their names, words left out; the same for every step."""
    more = {name: np.random.default_rng(n).normal(size=4) for n, name in enumerate(("vx", "vy", "vz", "fx", "c_n[3]"))}
    columns = spheres(mol=[1, 1, 2, 2], element=list("CCOO"), **more)
    data = vtk(folder_of(snapshot(0, columns)))["grains"][0.0].point_data
    expected = {"id", "radius", "mol", "velocity", "fx", "c_n[3]", "glyph_tensor", "semi_axes", "quaternion"}
    require(set(data) == expected, f"{set(data) ^ expected}")
    require_equal(data["velocity"], np.transpose([more[name] for name in ("vx", "vy", "vz")]), "velocity")
    require_equal(data["c_n[3]"], more["c_n[3]"], "a column of a compute")


def other_names(ranks):
    """Diameters, fractions of the box, orientations in OVITO's order, clumps as spheres."""
    columns, turns = grains(SHAPES["triaxial"])
    renamed = {"quat1": "c_orient[4]", "quat2": "c_orient[1]", "quat3": "c_orient[2]", "quat4": "c_orient[3]"}
    renamed |= {"shapex": "c_shape[1]", "shapey": "c_shape[2]", "shapez": "c_shape[3]"}
    folder = folder_of(snapshot(0, columns))
    (folder / "other.dump").write_text(snapshot(0, {renamed.get(name, name): x for name, x in columns.items()}))
    found = vtk(folder, dump="other.dump")["grains"][0.0].point_data
    for name, values in vtk(folder)["grains"][0.0].point_data.items():
        require_equal(found[name], values, name)
    edges, tilts = (10.0, 8.0, 6.0), (2.0, -1.0, 0.5)
    cell = np.array([[10.0, 0, 0], [2.0, 8.0, 0], [-1.0, 0.5, 6.0]])
    fractions = np.random.default_rng(1).uniform(size=(4, 3))
    columns = dict(zip(("id", "xs", "ys", "zs", "diameter"), ([1, 2, 3, 4], *fractions.T, [1.0, 2.0, 3.0, 4.0])))
    data = vtk(folder_of(snapshot(0, columns, edges, tilts)))
    require_close(data["grains"][0.0].points, fractions @ cell, 1e-14, "fractions of the box")
    require_equal(data["grains"][0.0].point_data["semi_axes"], np.outer([0.5, 1, 1.5, 2], [1, 1, 1]), "diameters")
    box = data["box"][0.0]
    corners = np.array(list(np.ndindex(2, 2, 2))) @ cell
    require_close(box.points, corners, 1e-14, "corners of the box", 10.0)
    sides = sorted(np.linalg.norm(np.diff(box.points[line], axis=0)) for line in box.lines)
    require_close(sides, sorted(4 * list(np.linalg.norm(cell, axis=1))), 1e-14, "edges of the box")


def series(ranks):
    """A file for each step, its time the step times --dt; snapshots without grains too, of two dimensions too."""
    flat = dict(spheres(), z=[0.0] * 4)
    none = {name: [] for name in flat}
    folder = new_folder()
    for step, columns in ((0, flat), (500, none), (1000, flat)):
        (folder / f"d.{step}").write_text(snapshot(step, columns, (10.0, 10.0, 1.0), sides="pp pp pp"))
    data = vtk(folder, "--dt", "0.002", "--mesh", 1, dump="d.*")
    for kind in ("grains", "surfaces", "box"):
        require(list(data[kind]) == [0.0, 1.0, 2.0], f"{kind}: {list(data[kind])}")
    require([len(one.points) for one in data["grains"].values()] == [4, 0, 4], "grains of each step")
    require(len(data["surfaces"][1.0].polys) == 0, "surfaces of no grains")
    require(set(data["grains"][0.0].point_data) == set(data["grains"][1.0].point_data), "columns of no grains")
    require(list(vtk(folder, dump="d.*")["grains"]) == [0.0, 500.0, 1000.0], "times are steps")


def walls(ranks):
    """STL files, ASCII and binary, at rest and moving; refused where they are damaged."""
    folder = folder_of(*[snapshot(step, spheres()) for step in (0, 10, 20)])
    ramp = np.array(meshes.two((0, 0, 0), (4, 0, 1), (4, 4, 1), (0, 4, 0)), dtype=float)
    (folder / "ramp.stl").write_text(meshes.stl("ramp", ramp))
    record = np.zeros(2, dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attributes", "<u2")])
    record["corners"] = ramp
    binary = b"solid binary".ljust(80) + np.uint32(2).tobytes() + record.tobytes()
    (folder / "binary.stl").write_bytes(binary)
    for step in (0, 20):
        (folder / f"lid{step}.stl").write_text(meshes.stl("lid", ramp[:1] + step))
    data = vtk(folder, "--walls", "ramp.stl", "binary.stl")["walls"]
    require(list(data) == [0.0] and len(data[0.0].polys) == 4, f"walls at rest: {list(data)}")
    require_equal(data[0.0].points, np.concatenate([ramp, ramp]).reshape(-1, 3), "corners")
    require_equal(data[0.0].cell_data["wall"], [1, 1, 2, 2], "numbers of walls")
    require_equal(data[0.0].cell_data["triangle"], [0, 1, 0, 1], "numbers of triangles")
    data = vtk(folder, "--walls", "ramp.stl", "lid*.stl")["walls"]
    for step in (0, 10, 20):
        require_equal(data[step].points[6:], ramp[0] + (step if step == 20 else 0), f"the lid of step {step}")
    (folder / "lid0.stl").unlink()
    data = vtk(folder, "--walls", "lid*.stl", "ramp.stl")["walls"]
    require_equal(data[0.0].cell_data["wall"], [2, 2], "a wall keeps its number before another is there")
    (folder / "cut.stl").write_bytes(binary[:-1])
    (folder / "short.stl").write_text(meshes.stl("ramp", ramp)[:-40])
    for name in ("cut.stl", "short.stl"):
        refused("convert", ["grains.dump", "--to", "vtk", "--walls", name], name, "STL", folder=folder)
    refused("convert", ["grains.dump", "--to", "vtk", "--walls", "a*.stl"], "a*.stl: no file", folder=folder)
    folder = folder_of(snapshot(0, spheres()))
    refused("convert", ["grains.dump", "--to", "vtk", "--walls", "a.stl"], "a.stl: No such file", folder=folder)
    require(not (folder / "vtk").exists(), "something was written before a wall was refused")


def refusals(ranks):
    """What a dump lacks is said with the line that dumps it; options with what they must be and what they are."""
    columns, _ = grains(SHAPES["prolate"])
    for left_out in ("x", "quat3", "shapey"):
        folder = folder_of(snapshot(0, {name: values for name, values in columns.items() if name != left_out}))
        line = "dump grains all custom 1000 grains.*.dump id type x y z quat1 quat2 quat3 quat4 shapex shapey shapez"
        refused("convert", ["grains.dump", "--to", "vtk"], f"no column {left_out}", line, folder=folder)
        require(not (folder / "vtk").exists(), "something was written before grains were refused")
    folder = folder_of(snapshot(0, {name: values for name, values in spheres().items() if name != "radius"}))
    line = "dump grains all custom 1000 grains.*.dump id type x y z radius"
    refused("convert", ["grains.dump", "--to", "vtk"], "no column radius", line, folder=folder)
    folder = folder_of(snapshot(0, dict(columns, quat1=[0] * 3, quat2=[0] * 3, quat3=[0] * 3, quat4=[0] * 3)))
    refused("convert", ["grains.dump", "--to", "vtk"], "step 0: a quaternion", "is 0 0 0 0", folder=folder)
    folder = folder_of(snapshot(0, spheres()))
    for words, sentence in (
        (["--mesh", "6"], "--mesh must be from 0 to 5, got 6"),
        (["--mesh", "-1"], "--mesh must be from 0 to 5, got -1"),
        (["--dt", "0"], "--dt must be above 0, got 0"),
        (["--dt", "nan"], "--dt must be above 0, got nan"),
        (["--contact-columns", "id"], "--contact-columns needs --contacts"),
    ):
        refused("convert", ["grains.dump", "--to", "vtk", *words], sentence, folder=folder)
    code, messages = tool("convert", "grains.dump", "--to", "xyz", folder=folder)
    require(code == 2 and "'xyz'" in messages and "ovito" in messages, messages)


main(
    {f"glyph-tensors-{name}": glyph_tensors(shapes) for name, shapes in SHAPES.items()}
    | {
        "surfaces": surfaces,
        "boxy-surfaces": boxy_surfaces,
        "all-columns": all_columns,
        "other-names": other_names,
        "series": series,
        "walls": walls,
        "refusals": refusals,
    }
)
