# SPDX-License-Identifier: GPL-2.0-or-later
"""`time_level synchronized`: a small ball that rolls off the neck of two large ones, or of two points, leaves where an
integration on its own says (oracle/ball_on_neck.py), and by LIGGGHTS's way later or never; the order of single contacts
in the time step; lanes do as the models do one by one; runs that are taken up again go on."""
from dataclasses import replace

import numpy as np

from case import main, require, require_close, require_same_snapshots
from deck import Deck, Material, dump_grains, shear, thermo
from grainscope.columns import outputs
from oracle.ball_on_neck import Neck
from oracle.sticking_pair import Pair
from packing import Grain, Packing, dense_packing
from run import run
from walled import flat, run_with_meshes

C_EACH = outputs("contact/grain").of("each")
C_LOSS = outputs("dissipation").of("loss")
C_STRESS = outputs("stress/contact").of("stress")

SYNCHRONIZED = "time_level synchronized"
SIZES = (0.8, 0.9, 1.0, 1.1, 1.2)
FRICTION = (0.5, 1.0, 10.0)
STEPS = 10  # in a Rayleigh time: LIGGGHTS's usual 0.1
STEP = 0.4  # degrees: the last step with contact is one more or less, and the largest ball takes one of 0.3


def neck_deck(neck, level, style="sphere", surface="ellipsoid", steps=STEPS, extra=""):
    """The balls, of which two are held fast; or one, for a wall."""
    y, z = neck.start()
    places = [(0.0, y, z), (-1.0, 0.0, 0.0), (1.0, 0.0, 0.0)][: 1 if neck.points else 3]
    grains = [Grain(x, (r, r, r)) for x, r in zip(places, (neck.radius, 1.0, 1.0))]
    low, high = (-6.0, -6.0, -6.0), (12.0, 12.0, 12.0)
    packing = Packing(high, grains, atom_style=style, origin=low, triclinic=False)
    material = Material(young=(neck.young,), restitution=(neck.restitution,), friction=(neck.friction,))
    deck = Deck(packing, boundary="f f f", material=material, surface=surface, timestep=neck.rayleigh_time() / steps)
    deck.extra = f"time_level {level} {extra}".strip()
    return deck


def leaves_at(neck, steps, ranks, deck, apexes=()):
    """The angle of the last step with contact; None where there still is one at the end."""
    lines = [
        *apexes,
        f"fix pull ball gravity {neck.gravity!r} vector 0 0 -1",
        "compute each all contact/grain",
        f"compute touches ball reduce sum {C_EACH['N_c']}",
        "variable y equal y[1]",
        "variable z equal z[1]",
        *thermo(1, "v_y", "v_z", "c_touches"),
        f"run {steps}",
    ]
    text = replace(deck, body=lines).text()
    text = text.replace("fix integrate all", "group ball id 1\nfix integrate ball")
    table = run_with_meshes(text, ranks, **(APEXES if apexes else {})).thermo()[0]
    if table["c_touches"][-1] > 0.0:
        return None
    last = np.flatnonzero(table["c_touches"])[-1]
    return float(np.degrees(np.arctan2(table["v_y"][last], table["v_z"][last])))


# Two triangles that point at each other, whose points are 2 apart.
APEXES = {f"apex{k}": [((x, 0.0, 0.0), (3.0 * x, -1.0, 0.0), (3.0 * x, 1.0, 0.0))] for k, x in ((1, 1.0), (2, -1.0))}


def on_points(level, model):
    names = " ".join(APEXES)
    return [
        *(f"fix {name} all mesh/surface file {name}.stl type 1 verbose no" for name in APEXES),
        f"fix points all wall/gran {model} mesh n_meshes 2 meshes {names} time_level {level}",
    ]


def neck_of(radii, points=False, wrong=1.0, frictions=FRICTION, **choices):
    """`wrong`: by how much LIGGGHTS's way is at the largest friction, in degrees, or it never leaves."""

    def case(ranks):
        for radius in radii:
            for friction in frictions:
                neck = Neck(radius, friction, points)
                expected, steps = neck.leaves_at(STEPS)
                found = {}
                for level in ("host", "synchronized"):
                    deck = neck_deck(neck, level, **choices)
                    apexes = on_points(level, replace(deck, extra="").model()) if points else ()
                    found[level] = leaves_at(neck, int(1.2 * steps), ranks, deck, apexes)
                what = f"radius {radius}, friction {friction}: leaves at {expected:.2f} degrees"
                require(found["synchronized"] is not None, f"{what}: it never does")
                require_close(found["synchronized"], expected, STEP, what, 1.0)
            late = found["host"] is None or abs(found["host"] - expected) > wrong
            require(late, f"{what}: LIGGGHTS's way is right, with {found['host']}: the keyword can go")

    return case


# Two balls of 1 and 0.2 in contact at an overlap of 0.01, for 0.4 of a collision; k_n and k_t in units of
# the effective mass.
RADII, PLACES, DURATION = (1.0, 0.2), ((0.0, 0.0, 0.0), (0.714, 0.952, 0.0)), 0.02
REST = (0.0, 0.0, 0.0)
MOTIONS = {
    "normal": ((REST, (-0.06, -0.08, 0.0)), (REST, REST)),
    "tangential": ((REST, (-1.6, 1.2, 1.0)), (REST, REST)),
    "rolling": ((REST, (-1.6, 1.2, 0.0)), (REST, (0.0, 0.0, 8.0))),
    "all": ((REST, (-1.6, 1.2, 0.5)), ((1.0, 2.0, -1.0), (3.0, -5.0, 6.0))),
}


# An error of first order has one of second beside it, which at these steps is an eighth of it at the most: the order
# that is seen then lies within 0.25; one of second order has one of third, a hundredth of it.
NEAR = {1.0: 0.25, 2.0: 0.02}


def pair_of(motion, damping, by_size=False):
    velocities, spins = MOTIONS[motion]
    pair = Pair(RADII, PLACES, velocities, spins, 0.0, 0.0, 2.0 * damping, damping, by_size)
    masses = pair.masses()
    mass = masses[0] * masses[1] / sum(masses)
    return replace(pair, k_n=4000.0 * mass, k_t=2000.0 * mass)


def ended(pair, level, steps, ranks, style="sphere", shapes=None):
    """Places, velocities and spins of the two, of shape (3, 2, 3)."""
    shapes = shapes or [((r, r, r), (1.0, 0.0, 0.0, 0.0)) for r in pair.radii]
    grains = [
        Grain(x, *shape, velocity=v, omega=w)
        for x, shape, v, w in zip(pair.places, shapes, pair.velocities, pair.spins)
    ]
    packing = Packing((12.0, 12.0, 12.0), grains, atom_style=style, origin=(-6.0, -6.0, -6.0), triclinic=False)
    deck = Deck(packing, boundary="f f f", normal="hooke/stiffness", surface="ellipsoid")
    deck = replace(deck, material=Material(friction=(1e9,)), timestep=DURATION / steps)
    deck.extra = f"time_level {level}" + ("" if pair.gamma_t else " tangential_damping off")
    constants = {"kn": pair.k_n, "kt": pair.k_t, "gamman": pair.gamma_n, "gammat": pair.gamma_t}
    return state_of(deck, steps, constants, ranks)


def state_of(deck, steps, constants, ranks):
    """Places, velocities and spins after so many steps."""
    deck = replace(deck, body=[*deck.body, *dump_grains(deck.packing, steps), f"run {steps}"])
    lines = [f"fix {k} all property/global {k} peratomtypepair 1 {v!r}\n" for k, v in constants.items()]
    text = deck.text().replace("pair_style", "".join(lines) + "pair_style", 1)
    _, found = run(text, ranks).dump("grains.dump")[-1]
    grains = range(len(deck.packing.grains))
    return np.array([[[found[p + c][k] for c in "xyz"] for k in grains] for p in ("", "v", "omega")])


def order_of(motion, host, synchronized, damping=0.0, style="sphere"):
    """In the time step, for both levels, of all that changes."""

    def case(ranks):
        pair = pair_of(motion, damping, by_size=style != "sphere")
        expected = pair.at(DURATION)
        what = slice(0, 2) if motion == "normal" else slice(0, 3)  # nothing turns
        errors = {}
        for level, order in (("host", host), ("synchronized", synchronized)):
            ends = [ended(pair, level, steps, ranks, style) for steps in (200, 400, 800)]
            errors[level] = np.array([np.abs(end - expected).max(axis=(1, 2))[what] for end in ends])
            found = np.log2(errors[level][:-1] / errors[level][1:])
            require_close(found[-1], np.full(found[-1].shape, order), NEAR[order], f"order of {motion}, {level}", 1.0)
        if host < synchronized:
            gain = errors["host"][-1] / errors["synchronized"][-1]
            require(gain[2] > 10.0, f"the error of the spins is smaller only by {gain[2]:.3g}")

    return case


def across_z(angle):
    """The rotation that takes the axis z to one across it."""
    c, s = np.cos(0.5 * angle), np.sin(0.5 * angle)
    return tuple(np.sqrt(0.5) * np.array([c, -s, c, s]))


SPHEROIDS = [((0.9, 0.9, 1.4), across_z(0.6)), ((0.2, 0.2, 0.3), across_z(1.9))]


def order_of_spheroids(ranks):
    """In a plane: the spin of a spheroid that wobbles is, to the models, that of its orientation at the beginning of a
    step."""
    pair = replace(pair_of("rolling", 0.0), places=(REST, (0.714, 1.05, 0.0)))
    require_orders(lambda level, steps: ended(pair, level, steps, ranks, "superquadric", SPHEROIDS))


def order_in_a_cylinder(style):
    """A ball that rolls along and around on the inside, and spins about the normal."""

    def case(ranks):
        grain = Grain((0.0, 2.0, 0.0), velocity=(2.0, 0.1, 0.7), omega=(3.0, -5.0, 6.0))
        packing = Packing((12.0, 12.0, 12.0), [grain], atom_style=style, origin=(-6.0, -6.0, -6.0), triclinic=False)
        stiffness = 4000.0 * grain.mass()
        constants = {"kn": stiffness, "kt": 0.5 * stiffness, "gamman": 0.0, "gammat": 0.0}

        def end(level, steps):
            deck = Deck(packing, boundary="f f f", normal="hooke/stiffness", surface="ellipsoid")
            deck = replace(deck, material=Material(friction=(1e9,)), timestep=DURATION / steps)
            wall = f"fix tube all wall/gran {deck.model()} primitive type 1 zcylinder 2.99 0 0"
            deck.body = [f"{wall} time_level {level} tangential_damping off"]
            deck.extra = "tangential_damping off"
            return state_of(deck, steps, constants, ranks)

        require_orders(end)

    return case


def require_orders(end):
    """Nobody knows where the grains go; but both levels go to the same limit, each by its order. `end(level, steps)` is
    the state after so many steps."""
    limits = {}
    for level, order in (("host", 1.0), ("synchronized", 2.0)):
        ends = [end(level, steps) for steps in (400, 800, 1600, 3200)]
        changes = np.array([np.abs(b - a).max(axis=(1, 2)) for a, b in zip(ends, ends[1:])])
        found = np.log2(changes[:-1] / changes[1:])
        require_close(found[-1], np.full(3, order), NEAR[order], f"order, {level}", 1.0)
        limits[level] = (ends[-1] + (ends[-1] - ends[-2]) / (2.0**order - 1.0), changes[-1])
    # The host's, found as if all of its error were of first order: an eighth of it is not, at these steps.
    for k, what in enumerate(("places", "velocities", "spins")):
        (one, change), (other, _) = limits["host"], limits["synchronized"]
        require_close(one[k], other[k], 0.125, f"limit of the {what}", change[k])


def lanes_as_one_by_one(packing, **choices):
    """To the last bit: a word that no lane knows, and that does nothing here, makes contacts go through the models."""

    def case(ranks):
        deck = Deck(packing, surface="ellipsoid", **choices)
        deck.body = [shear(0.3), *dump_grains(packing, 100), "run 300"]
        one, other = (
            run(replace(deck, extra=SYNCHRONIZED + more), ranks).dump("grains.dump")
            for more in ("", " heating_tracking on")
        )
        require_same_snapshots(one, other, "lanes against one by one")
        watched = [
            "compute loss all dissipation",
            "compute stress all stress/contact",
            *thermo(1, "c_stress", "c_loss"),
        ]
        seen = run(replace(deck, extra=SYNCHRONIZED, body=[*watched, *deck.body]), ranks).dump("grains.dump")
        require_same_snapshots(seen, one, "watched against not")
        host = run(deck, ranks).dump("grains.dump")
        apart = np.abs(host[-1][1]["vx"] - one[-1][1]["vx"]).max()
        require(apart > 1e-6, f"the levels differ by {apart} only: nothing is proved")

    return case


def same_on_ranks(packing):
    """Rounding grows in a dense flow: to 1e-9 in a hundred steps."""

    def case(ranks):
        deck = Deck(packing, surface="ellipsoid", extra=SYNCHRONIZED)
        deck.body = [shear(0.3), *dump_grains(packing, 100), "run 100"]
        (_, expected), (_, found) = (run(deck, n).dump("grains.dump")[-1] for n in (1, ranks))
        for name in ("vx", "vy", "vz", "omegax", "omegay", "omegaz"):
            require_close(found[name], expected[name], 1e-9, name, 1.0)

    return case


def with_walls(style):
    """A heap in a cylinder that falls onto a floor which turns."""
    spheres = style == "sphere"
    packing = dense_packing(1.0 if spheres else 1.5, sizes=(0.6, 1.0), minimum=60, atom_style=style)
    (x, y, _), centre = packing.edges, 0.5 * np.array(packing.edges)
    packing = replace(packing, origin=(-20.0, -20.0, -20.0), edges=(60.0, 60.0, 60.0), triclinic=False)
    deck = Deck(packing, boundary="f f f", surface="ellipsoid", extra=SYNCHRONIZED + " setup neutral")
    wall = f"all wall/gran {replace(deck, extra='').model()}"
    lines = [
        "fix pull all gravity 9.81 vector 0 0 -1",
        "fix floor all mesh/surface file floor.stl type 1",
        f"fix under {wall} mesh n_meshes 1 meshes floor {SYNCHRONIZED}",
        f"fix around {wall} primitive type 1 zcylinder {0.5 * max(x, y) + 0.8!r} {centre[0]!r} {centre[1]!r} "
        f"{SYNCHRONIZED}",
        f"fix turn all move/mesh mesh floor rotate origin {centre[0]!r} {centre[1]!r} 0 axis 0.1 0 1 period 3.0",
        "compute loss all dissipation walls yes",
        "compute stress all stress/contact walls yes",
    ]
    return deck, lines, [*thermo(1, "c_stress", *C_LOSS.vector(), *C_STRESS.vector())]


FLOOR = {"floor": flat(-12.0, 18.0, 3, height=-0.6, aside=-0.3)}


def restart_goes_on(style):
    """Through a restart file, and what is measured in the first row too: to the last bit. In lists of another order of
    triangles nothing is promised, so all is written by the one that goes on, too."""

    def case(ranks):
        deck, lines, printed = with_walls(style)
        rest = [*dump_grains(deck.packing, 60), "run 60"]
        body = [*lines, *printed, "run 60", "write_restart half.restart", *rest]
        through = run_with_meshes(replace(deck, body=body), ranks, **FLOOR)
        again = run_with_meshes(
            deck.restarted(through.folder / "half.restart", [*lines, *printed, *rest]), ranks, **FLOOR
        )
        expected, found = through.thermo()[-1], again.thermo()[-1]
        touching = expected[C_LOSS["N_w"]].min()
        require(touching >= 8.0, f"only {touching} contacts with walls")
        for name in expected:
            require_close(found[name], expected[name], 0.0, name, 1.0)
        require_same_snapshots(again.dump("grains.dump"), through.dump("grains.dump"), "restarted")
        if ranks > 1:  # where i and j are exchanged contacts at the limit may be solved to the other side of it
            return
        # And it is the last row of the run before; slip is not known in a repetition.
        before = through.thermo()[0]
        for name in set(expected) - {C_LOSS["P_t"], C_LOSS["P_t_w"]}:
            require_close(expected[name][0], before[name][-1], 1e-12, name, max(1.0, np.abs(before[name]).max()))

    return case


def first_evaluation_repeated(style):
    """With `setup neutral` a run repeats the last evaluation also where that one was a first one, which goes LIGGGHTS's
    way: at the beginning, and after velocities were set. By then springs are at their limit, which a first evaluation
    cuts them by; what is damped along the normal does not feel that."""

    def case(ranks):
        deck, lines, printed = with_walls(style)
        still = [line for line in lines if "move/mesh" not in line]
        pushed = ["group pushed id 1:20", "velocity pushed set 0.1 0.0 -0.2"]
        deck.body = [*still, *printed, "run 0", "run 0", "run 60", *pushed, "run 0", "run 0"]
        rows = run_with_meshes(deck, ranks, **FLOOR).thermo()
        require(rows[3][C_LOSS["N_w"]][0] >= 8.0, "too few contacts with walls")
        require(min(rows[3][name][0] for name in (C_LOSS["P_n"], C_LOSS["P_n_w"])) > 0.0, "nothing is damped")
        for first, names in ((0, rows[0]), (3, (C_LOSS["P_n"], C_LOSS["P_n_w"]))):
            for name in names:
                values = rows[first][name]
                scale = max(1.0, abs(values[0]))
                require_close(rows[first + 1][name][0], values[0], 1e-9, f"run {first + 1}, {name}", scale)

    return case


def sieve(ranks):
    """Small balls, a twentieth of the large, are dropped onto a layer of large ones that is held fast, on a square
    lattice. Its holes are eight times as wide, and no ball rests on a neck: in twice the time that one takes to roll
    off all are through. By LIGGGHTS's way they stick to the necks."""
    neck, across = Neck(0.05, 10.0), 4
    random = np.random.default_rng(11)
    large = [Grain((2.0 * i + 1.0, 2.0 * j + 1.0, 0.0)) for i in range(across) for j in range(across)]
    # above the necks along x, a little aside
    small = []
    for i in range(across - 1):
        for j in range(across):
            aside = float(random.choice((-1.0, 1.0)) * random.uniform(0.05, 0.15))
            small.append(Grain((2.0 * i + 2.0, 2.0 * j + 1.0 + aside, 0.45), (0.05, 0.05, 0.05)))
    packing = Packing(
        (12.0, 12.0, 50.0), small + large, atom_style="sphere", origin=(-2.0, -2.0, -40.0), triclinic=False
    )
    many, (_, steps) = len(small), neck.leaves_at(STEPS)
    through = {}
    for level in ("host", "synchronized"):
        deck = Deck(packing, boundary="f f f", extra=f"time_level {level}", timestep=neck.rayleigh_time() / STEPS)
        deck.material = Material(young=(neck.young,), restitution=(neck.restitution,), friction=(neck.friction,))
        deck.body = [
            f"fix pull all gravity {neck.gravity!r} vector 0 0 -1",
            f"group large id {many + 1}:{len(packing.grains)}",
            "fix hold large freeze",
            *dump_grains(packing, 2 * steps),
            f"run {2 * steps}",
        ]
        heights = run(deck, ranks).dump("grains.dump")[-1][1]["z"][:many]
        through[level] = int((heights < -1.0).sum())
    require(through["synchronized"] == many, f"of {many} only {through['synchronized']} fell through")
    require(through["host"] < many, "by LIGGGHTS's way all fell through: nothing is proved")


if __name__ == "__main__":
    main(
        {
            "neck": neck_of((0.3, 0.1, 0.05)),
            "neck-equal": neck_of((1.0,), wrong=0.5),
            "neck-ellipsoids": neck_of((0.1,), style="superquadric"),
            "neck-superquadrics": neck_of((0.1,), style="superquadric", surface="superquadric"),
            "neck-one-by-one": neck_of((0.1,), extra="heating_tracking on"),
            "neck-tiny": neck_of((0.02,)),
            "neck-hundred": neck_of((0.01,), frictions=(0.5,)),  # with more it hangs on beneath
            "order-normal": order_of("normal", 2.0, 2.0),
            "order-normal-damped": order_of("normal", 1.0, 1.0, 10.0),
            "order-tangential": order_of("tangential", 1.0, 2.0),
            "order-rolling": order_of("rolling", 1.0, 2.0),
            "order-all": order_of("all", 1.0, 2.0),
            "order-all-damped": order_of("all", 1.0, 1.0, 10.0),
            "order-ellipsoids": order_of("all", 1.0, 2.0, style="superquadric"),
            "order-spheroids": order_of_spheroids,
            "order-cylinder": order_in_a_cylinder("sphere"),
            "order-cylinder-ellipsoid": order_in_a_cylinder("superquadric"),
            "lanes-spheres": lanes_as_one_by_one(dense_packing(atom_style="sphere", sizes=SIZES)),
            "lanes-spheroids": lanes_as_one_by_one(dense_packing(1.5)),
            "lanes-balls": lanes_as_one_by_one(dense_packing(1.0)),
            "lanes-viscous": lanes_as_one_by_one(dense_packing(1.5), tangential="no_history"),
            "sieve": sieve,
            "restart-spheres": restart_goes_on("sphere"),
            "restart-spheroids": restart_goes_on("superquadric"),
            "repeated-spheres": first_evaluation_repeated("sphere"),
            "repeated-spheroids": first_evaluation_repeated("superquadric"),
            "ranks-spheres": same_on_ranks(dense_packing(atom_style="sphere", sizes=SIZES)),
            "ranks-spheroids": same_on_ranks(dense_packing(1.5)),
            "points": neck_of((1.2, 1.05, 1.01), points=True),
            "points-ellipsoid": neck_of((1.05,), points=True, style="superquadric"),
        }
    )
