# SPDX-License-Identifier: GPL-2.0-or-later
"""Contacts with walls in every contact measure, against the oracle and against what is known: spheres in a box of
primitive walls of which one moves, spheroids in a drum of triangles that turns, spheres in a hopper."""
from dataclasses import dataclass, field, replace
import math

import numpy as np

from case import main, require, require_close, require_equal
from deck import YOUNG, Deck, dump_local, number, thermo
import meshes
from oracle import comparison, measures
from oracle.state import ROW_COLUMNS, ROW_WIDTH, chosen_rows
from packing import Grain, Packing, dense_packing
from run import run
from watch import Watched, moments_of, watched_deck

# Sums of some hundred terms in double precision.
EXACT = 1e-10
GRAVITY = np.array([1.0, -0.5, -9.81])
CHOICES = ("no", "yes", "only")
UNDAMPED = "tangential_damping off"


def gravity(g=GRAVITY):
    size = float(np.linalg.norm(g))
    return f"fix gravity all gravity {number(size)} vector " + " ".join(repr(float(x / size)) for x in g)


def short(walls, name):
    return f"{name}_{walls}"


STRESS = {w: Watched(short(w, "stress"), f"stress/contact walls {w}", True, 36) for w in CHOICES}
INSTANT = {w: Watched(short(w, "now"), f"dissipation mode instantaneous walls {w}", True, 10) for w in CHOICES}
STEP = {w: Watched(short(w, "loss"), f"dissipation mode step walls {w}", True, 10) for w in CHOICES}
GRAIN = {w: Watched(short(w, "grain"), f"contact/grain walls {w}", peratom=7) for w in CHOICES}
WEIGHTED = "branch force/normal force/tangential"
FABRIC = {w: Watched(short(w, "fabric"), f"fabric {WEIGHTED} walls {w}", True, 40) for w in CHOICES}
DIRECTION = {w: Watched(short(w, "rose"), f"contact/direction bins 24 walls {w}", array=(24, 9)) for w in CHOICES}
SURFACE = {w: Watched(short(w, "surface"), f"contact/surface walls {w}", vector=3, array=(10, 17)) for w in CHOICES}


@dataclass
class Scene:
    """A deck with walls. `velocity(normals, points)`: of the walls at contacts; along the normal that is the same for
    the point of the wall below the contact point, whose velocity the host takes."""

    deck: Deck
    meshes: dict = field(default_factory=dict)
    settle: int = 0
    viscous: bool = False  # the tangential force of a contact that does not slide is all damping
    velocity: object = lambda normals, points: np.zeros((len(points), 3))

    def computes(self):
        kinds = [STRESS, INSTANT, STEP, GRAIN, FABRIC, DIRECTION]
        if self.deck.packing.atom_style == "superquadric":
            kinds.append(SURFACE)
        return [watched for kind in kinds for watched in kind.values()]

    def loss_of_step(self, moment, rows, part):
        """By forces of contacts between grains, or with walls."""
        if part == "no":
            return lambda force: measures.loss_of_step(rows, moment.grains, moment.box, force)
        velocities = self.velocity(rows["normal"], rows["point"])
        return lambda force: measures.wall_loss_of_step(rows, moment.grains, velocities, force)

    def moments(self, ranks, group="all"):
        deck = watched_deck(self.deck, self.computes(), group=group, settle=self.settle)
        result = run(deck, ranks, folder=meshes.folder_with(**self.meshes))
        return list(moments_of(result, group=group))


def wall(deck, name, words):
    """By the models of the grains."""
    return f"fix {name} all wall/gran {replace(deck, extra='').model()} {words} {deck.extra}"


def box_of_walls(**choices):
    """Dense spheres between six planes that each overlap the outermost ones; the floor slides along x."""
    packing = dense_packing(atom_style="sphere")
    deck = Deck(
        replace(packing, origin=(-2.0,) * 3, edges=tuple(e + 4.0 for e in packing.edges), triclinic=False),
        boundary="f f f",
        **choices,
    )
    deck.body = [gravity()]
    for axis in range(3):
        for side in (0, 1):
            place = packing.edges[axis] + 0.29 if side else -0.29
            plane = f"primitive type 1 {'xyz'[axis]}plane {number(place)}"
            moving = " shear x 0.5" if (axis, side) == (2, 0) else ""
            deck.body.append(wall(deck, f"plane{axis}{side}", plane + moving))
    return deck


def floor_slides(normals, points):
    return np.where(normals[:, 2:] > 0.5, [[0.5, 0.0, 0.0]], 0.0)


BOX = Scene(box_of_walls(extra=UNDAMPED), velocity=floor_slides, settle=60)
VISCOUS = replace(BOX, deck=box_of_walls(tangential="no_history"), viscous=True)

TURN, AXIS = 0.7, np.array([0.8, 0.0, -0.5])  # radians per time, about y through this point


def drum():
    """Spheroids that have fallen onto the shell of a drum, which turns about another axis than its own: the shell
    moves along its normals too."""
    grains = []
    for k in range(36):
        x, y, z = k % 3, (k // 3) % 4, k // 12
        turned = np.array([1.0, 0.3 * math.sin(k), 0.2 * math.cos(3 * k), 0.1])
        turned /= np.linalg.norm(turned)
        place = (2.3 * (x - 1) + 0.05 * y, 2.2 * (y - 1.5) + 0.03 * z, 3.1 * (z - 1) + 0.02 * x)
        grains.append(Grain(place, (1.0, 1.0, 1.5), tuple(turned), (0.0, 0.0, -1.0)))
    packing = Packing((20.0, 12.0, 20.0), grains, origin=(-10.0, -6.0, -10.0), triclinic=False)
    deck = Deck(packing, boundary="f f f", extra=UNDAMPED, surface="ellipsoid")
    deck.body = [
        gravity(),
        "fix shell all mesh/surface file drum.stl type 1",
        wall(deck, "walls", "mesh n_meshes 1 meshes shell"),
        f"fix turn all move/mesh mesh shell rotate origin {AXIS[0]} 0 {AXIS[2]} axis 0 1 0 period "
        f"{2.0 * math.pi / TURN!r}",
    ]
    return deck


def turning(normals, points):
    return np.cross([0.0, TURN, 0.0], points - AXIS)


DRUM = Scene(drum(), {"drum": meshes.drum(6.0, -5.0, 5.0)}, settle=300, velocity=turning)


def hopper(**choices):
    """Spheres of three sizes in a hopper with a closed mouth, stress and wear of the mesh on."""
    grains = []
    for k in range(45):
        x, y, z = k % 3, (k // 3) % 3, k // 9
        place = (2.2 * (x - 1) + 0.05 * z, 2.2 * (y - 1) + 0.03 * x, 3.6 + 2.2 * z)
        grains.append(Grain(place, ((0.8, 0.9, 1.0)[k % 3],) * 3, velocity=(0.0, 0.0, -3.0)))
    packing = Packing((10.0, 10.0, 20.0), grains, atom_style="sphere", origin=(-5.0, -5.0, -2.0), triclinic=False)
    deck = Deck(packing, boundary="f f f", extra=UNDAMPED, **choices)
    deck.body = [
        gravity(),
        "fix silo all mesh/surface/stress file hopper.stl type 1",
        wall(deck, "walls", "mesh n_meshes 1 meshes silo"),
    ]
    return deck


def piston():
    """Spheres in a box of triangles, under a plate that comes down."""
    packing = dense_packing(atom_style="sphere", overlap=-0.02)
    x, y, z = packing.edges
    box, plate = meshes.box((0.0, 0.0, 0.0), (x, y, z + 1.0)), meshes.rectangle((0, 0, z + 0.2), (x, 0, 0), (0, y, 0))
    deck = Deck(
        replace(packing, origin=(-2.0,) * 3, edges=tuple(e + 4.0 for e in packing.edges), triclinic=False),
        boundary="f f f",
        extra=UNDAMPED,
    )
    deck.body = [
        gravity(),
        "fix box all mesh/surface file box.stl type 1",
        "fix plate all mesh/surface file plate.stl type 1",
        wall(deck, "walls", "mesh n_meshes 2 meshes box plate"),
        f"fix move all move/mesh mesh plate linear 0.1 0.2 -{SPEED}",
    ]
    return Scene(deck, {"box": box, "plate": plate}, settle=200, velocity=coming_down)


def coming_down(normals, points):
    return np.where(normals[:, 2:] < -0.5, [[0.1, 0.2, -SPEED]], 0.0)


SPEED = 1.0
PISTON = piston()
HOPPER_MESH = {"hopper": meshes.hopper(4.0, 1.5, 4.0, 16.0)}
HOPPER = Scene(hopper(), HOPPER_MESH, settle=400)
FRICTIONLESS = Scene(hopper(tangential="off"), HOPPER_MESH, settle=400)


def check_stress(moment, walls, rows, tolerance, flattest):
    expected = measures.stress_vector(rows, moment.grains, moment.force_box, moment.chosen, YOUNG, flattest)
    found = moment.vector(STRESS[walls])
    size = float(np.abs(expected[:7]).max()) or 1.0
    require_close(found[:26], expected[:26], tolerance, "stress and its parts", size)
    blown_up = size / expected[25] if expected[25] > 0.0 else 1.0
    require_close(found[26:29], expected[26:29], tolerance * blown_up, "ratios", 1.0 + blown_up)
    require_equal(found[[29, 35]], expected[[29, 35]], "N_c, N_w")
    require_close(found[30:34], expected[30:34], tolerance, "Z, sliding, overlaps", max(expected[30], 1.0))
    require_close(found[34], expected[34], tolerance * blown_up, "kappa", max(expected[34], 1.0))


def check_powers(moment, scene, walls, rows, tolerance):
    size = float(np.sum(np.abs(rows["fn"]) * (np.abs(rows["un"]) + np.linalg.norm(rows["ut"], axis=1)))) or 1.0
    for kind in (INSTANT, STEP):
        found = moment.vector(kind[walls])
        for part, first in (("no", 0), ("only", 5)):
            own = chosen_rows(rows, part)
            drag = own["ft"] * (scene.viscous * (own["sliding"] == 0))[:, None]
            if kind is INSTANT:
                powers = [*measures.dissipation_instantaneous(own), -np.sum(drag * own["ut"])]
            else:
                damping, lost = (measures.normal_damping(own), drag), scene.loss_of_step(moment, own, part)
                powers = [lost(damping[0]), measures.friction_of_step(own, scene.deck.dt()), lost(damping[1])]
            what = f"{kind[walls].command}, entry {first}"
            require_close(found[first : first + 3], powers, tolerance, what, size)
            counts = [len(own["fn"]), own["sliding"].sum()]
            require_equal(found[first + 3 : first + 5], counts, what + ": contacts")
        require_close(moment.scalar(kind[walls]), found[[0, 1, 2, 5, 6, 7]].sum(), 1e-14, "P_total", size)


def check_grains(moment, walls, rows, tolerance):
    for c in comparison.of_grains(moment.peratom(GRAIN[walls]), rows, moment.grains, moment.chosen):
        require_close(c.found, c.expected, 0.0 if c.counted else tolerance, f"walls {walls}, {c.name}", c.scale)


def check_bins(moment, walls, rows, tolerance, doubt):
    fabric = moment.vector(FABRIC[walls])
    compared = [
        *comparison.of_fabric(fabric[:22], rows),
        *comparison.of_weighted(fabric[22:], rows),
        *comparison.of_direction(moment.array(DIRECTION[walls]), rows, doubt=doubt),
    ]
    if moment.grains.shape is not None:
        found = moment.array(SURFACE[walls]), moment.vector(SURFACE[walls])
        compared += comparison.of_surface(*found, moment, doubt=doubt, walls=walls)
    for c in compared:
        require_close(c.found, c.expected, 0.0 if c.counted else tolerance, f"walls {walls}, {c.name}", c.scale)


def agrees(scene, group="all", fewest=20, tolerance=EXACT, doubt=0.0):
    """`fewest`: contacts with walls that must be there, to prove something; `doubt`: as in oracle.comparison."""

    def case(ranks):
        flattest = min(sorted(g.semi_axes)[0] / sorted(g.semi_axes)[1] for g in scene.deck.packing.grains)
        moments = scene.moments(ranks, group)
        require(len(moments) == 5, f"{len(moments)} snapshots")
        for moment in moments:
            require(len(chosen_rows(moment.rows, "only")["fn"]) >= fewest, "too few contacts with walls")
            for walls in CHOICES:
                rows = chosen_rows(moment.rows, walls)
                check_stress(moment, walls, rows, tolerance, flattest)
                check_powers(moment, scene, walls, rows, tolerance)
                check_grains(moment, walls, rows, tolerance)
                check_bins(moment, walls, rows, tolerance, doubt)
            if group == "all":
                check_balance(moment)

    return case


def check_balance(moment):
    """Per grain the forces of the rows and the weight are f. Omega sigma = - sum (f - m g) x + sum over contacts with
    walls of F x_contact, exactly, whatever moves: every pair's forces cancel. At rest f = 0."""
    rows, grains = moment.rows, moment.grains
    weight = grains.mass[:, None] * GRAVITY
    total = weight.copy()
    np.add.at(total, grains.index(rows["id"][:, 0]), rows["force"])
    between, at_walls = chosen_rows(rows, "no"), chosen_rows(rows, "only")
    np.add.at(total, grains.index(between["id"][:, 1]), -between["force"])
    size = float(np.abs(rows["force"]).max())
    require_close(total, grains.force, 1e-10, "rows' forces and weight per grain", size)
    moments = np.einsum("ca,cb->ab", at_walls["force"], at_walls["point"]) - np.einsum(
        "ia,ib->ab", grains.force - weight, grains.x
    )
    found = moment.vector(STRESS["yes"])[:7] * moment.force_box.volume
    expected = [*measures.six(moments), moments[1, 0]]
    require_close(found, expected, EXACT, "stress by what walls and weight do", size * len(rows["fn"]))


def rows_of_walls(scene, ranks, steps=5):
    """(step, rows by column) of contact/local with the columns that only walls have, and `walls only`."""
    words = [*ROW_COLUMNS, "wall", "triangle"]
    every = [f"c_walls[{k}]" for k in range(1, ROW_WIDTH + 3)]
    body = [
        *scene.deck.body,
        *thermo(100, "step"),
        f"run {scene.settle}",
        f"compute walls all contact/local walls only {' '.join(words)}",
        "compute grains all contact/local walls no id",
        "compute both all contact/local walls yes id",
        f"dump walls all local {steps} walls.dump {' '.join(every)}",
        'dump_modify walls format "' + " ".join(["%.17g"] * len(every)) + '"',
        *dump_local("grains", 2, steps, "grains"),
        *dump_local("both", 2, steps, "both"),
        f"run {steps}",
    ]
    result = run(replace(scene.deck, body=body), ranks, folder=meshes.folder_with(**scene.meshes))
    for (step, columns), *others in zip(*map(result.dump, ("walls.dump", "grains.dump", "both.dump"))):
        own, none, both = (list(c.values()) for _, c in ((step, columns), *others))
        require(len(own[0]) + len(none[0]) == len(both[0]) and len(own[0]) > 20, "rows by the keyword walls")
        require((own[1] == 0).all() and (none[1] > 0).all(), "id_j is 0 for walls alone")
        table, rows, first = np.stack(own, axis=1), {}, 0
        for name in words:
            width = ROW_COLUMNS.get(name, 1)
            rows[name] = table[:, first] if width == 1 else table[:, first : first + width]
            first += width
        yield step, rows


def numbers_of_planes(ranks):
    """Walls count in the order of their fixes; a primitive wall has no triangle."""
    for _, rows in rows_of_walls(replace(BOX, settle=0), ranks):
        inward = np.repeat(np.eye(3), 2, axis=0) * np.tile([1.0, -1.0], 3)[:, None]
        require_close(rows["normal"], inward[rows["wall"].astype(int) - 1], 1e-12, "normals by the wall's number")
        require(set(rows["wall"]) == {1, 2, 3, 4, 5, 6}, f"walls {sorted(set(rows['wall']))}")
        require((rows["triangle"] == -1).all() and (rows["image"] == 0).all(), "triangle -1, image 0")
        # from the contact point, half an overlap inside, to the centre
        arm = (1.0 - 0.5 * rows["overlap"])[:, None]
        require_close(rows["branch"], arm * rows["normal"], 1e-12, "branch")


def numbers_of_triangles(ranks):
    """Each mesh of a fix is a wall; triangles count from 0 in the order of their file."""
    triangles = [np.array(PISTON.meshes[name], dtype=float) for name in ("box", "plate")]
    seen = set()
    for _, rows in rows_of_walls(PISTON, ranks):
        for k, (wall, triangle) in enumerate(zip(rows["wall"].astype(int), rows["triangle"].astype(int))):
            a, b, c = triangles[wall - 1][triangle]
            normal = np.cross(b - a, c - a) / np.linalg.norm(np.cross(b - a, c - a))
            seen.add(wall)
            if wall == 1:  # the plate is no longer where its file has it
                depth = abs(normal @ (rows["point"][k] - a))
                require_close(depth, 0.5 * rows["overlap"][k], 1e-10, "distance of the triangle", 1.0)
            require_close(abs(normal @ rows["normal"][k]), 1.0, 1e-6, "normal of the triangle", 1.0)
    require(seen == {1, 2}, f"walls {seen}")


CASES = {
    "numbers-of-planes": numbers_of_planes,
    "numbers-of-triangles": numbers_of_triangles,
    "box": agrees(BOX),
    "box-viscous": agrees(VISCOUS),
    "box-subgroup": agrees(BOX, "10:60", fewest=10),
    "box-empty-group": agrees(BOX, "5000:5001", fewest=0),
    "drum": agrees(DRUM, doubt=1e-9),  # normals of the shell lie on the edge of a bin
    "piston": agrees(PISTON, doubt=1e-9),
    "hopper": agrees(HOPPER),
    "hopper-frictionless": agrees(FRICTIONLESS),
}

if __name__ == "__main__":
    main(CASES)
