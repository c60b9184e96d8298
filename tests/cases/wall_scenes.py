# SPDX-License-Identifier: GPL-2.0-or-later
"""Contacts with walls where the answer is known: a column at rest, a ball that bounces, a plate that drags, rattlers;
fix press/strain between side walls; what is said of walls that nobody sees."""
from dataclasses import replace
import math

import numpy as np

from case import main, require, require_close, require_equal, require_same_snapshots
from deck import POISSON, YOUNG, Deck, Material, dump_grains, dump_local, thermo
from grainscope.columns import outputs
import meshes
from packing import Grain, Packing, dense_packing
from refusal import require_refused
from run import run

C_STRESS = outputs("stress/contact").of("stress")
C_POWER = outputs("dissipation").of("power")
C_GRAINS = outputs("contact/grain").of("grains")
C_WALL = outputs("wall/contact").of("wall")
F_PRESS = outputs("press/strain").of("press")
MODULUS = YOUNG / (2.0 * (1.0 - POISSON**2))
G = 9.81
GRAVITY = f"fix gravity all gravity {G} vector 0 0 -1"
FLOOR = meshes.rectangle((-5.0, -5.0, 0.0), (10.0, 0.0, 0.0), (0.0, 10.0, 0.0))


def open_box(grains, edges=(12.0, 12.0, 12.0), **choices):
    low = tuple(-0.5 * e for e in edges[:2]) + (-1.0,)
    packing = Packing(edges, grains, atom_style="sphere", origin=low, triclinic=False)
    return Deck(packing, boundary="f f f", **choices)


def floor(deck, kind, more=""):
    wall = f"fix floor all wall/gran {replace(deck, extra='').model()}"
    if kind == "plane":
        return [f"{wall} primitive type 1 zplane 0.0 {more} {deck.extra}"]
    return ["fix mesh all mesh/surface file floor.stl type 1", f"{wall} mesh n_meshes 1 meshes mesh {deck.extra}"]


def overlap_under(force, radius):
    """Of Hertz, effective radius given."""
    return (0.75 * force / (MODULUS * math.sqrt(radius))) ** (2.0 / 3.0)


def column(kind):
    """Three spheres, one on the other: each contact carries what is above it. -Omega sigma_zz is the sum of these
    loads times their branches; half an overlap of a contact with a wall lies below the contact point."""

    def case(ranks):
        count = 3
        load = [Grain((0, 0, 0)).mass() * G * k for k in range(count, 0, -1)]
        overlaps = [overlap_under(load[0], 1.0), *(overlap_under(w, 0.5) for w in load[1:])]
        heights = np.cumsum([1.0 - overlaps[0], *(2.0 - d for d in overlaps[1:])])
        deck = open_box([Grain((0.0, 0.0, float(z))) for z in heights], material=Material(restitution=(0.1,)))
        deck.body = [
            GRAVITY,
            *floor(deck, kind),
            "compute stress all stress/contact",
            "compute power all dissipation",
            *thermo(1000, "vol", "c_stress", *C_STRESS.vector(), *C_POWER.vector()),
            "run 2000",
        ]
        table = {k: v[-1] for k, v in run(deck, ranks, folder=meshes.folder_with(floor=FLOOR)).thermo()[0].items()}
        branches = [1.0 - 0.5 * overlaps[0], *(2.0 - d for d in overlaps[1:])]
        # at rest to what rounding leaves of motion
        require_close(-table[C_STRESS["szz"]] * table["vol"], np.dot(load, branches), 1e-9, "-Omega sigma_zz")
        require_equal([table[C_STRESS[n]] for n in ("N_c", "N_w")], [2, 1], "N_c, N_w")
        require_close(table[C_STRESS["Z"]], 5.0 / 3.0, 1e-15, "Z")
        require_close(table[C_STRESS["overlap_mean"]], np.mean(overlaps), 1e-8, "mean overlap")
        require_close(table[C_STRESS["overlap_max"]], max(overlaps), 1e-8, "largest overlap")
        require_equal([table[C_POWER[n]] for n in ("N_c", "N_w", "N_sliding_w")], [2, 1, 0], "contacts of dissipation")

    return case


def bounce(kind, restitution):
    """All that the ball loses is lost by the normal damping of the wall."""

    def case(ranks):
        deck = open_box(
            [Grain((0.0, 0.0, 1.001), velocity=(0, 0, -1.0))], material=Material(restitution=(restitution,))
        )
        deck = replace(deck, timestep=0.2 * deck.dt(), extra="tangential_damping off")
        deck.body = [
            *floor(deck, kind),
            "compute power all dissipation",
            *thermo(1, "c_power", *C_POWER.vector()),
            *dump_grains(deck.packing, 2000),
            "run 2000",
        ]
        result = run(deck, ranks, folder=meshes.folder_with(floor=FLOOR))
        table, mass = result.thermo()[0], deck.packing.grains[0].mass()
        before, after = (columns["vz"][0] for _, columns in result.dump("grains.dump"))
        require(before < 0.0 < after, f"no bounce: {before} {after}")
        lost = 0.5 * mass * (before**2 - after**2)
        # the step's sum errs in the second order of the step, here 2 % of a Rayleigh time
        require_close(table[C_POWER["P_n_w"]].sum() * deck.dt(), lost, 1e-3, "energy lost")
        require_equal(table["c_power"], table[C_POWER["P_n_w"]], "P_total")
        require_equal(table[C_POWER["P_n"]], np.zeros(len(table["c_power"])), "power between grains")
        require(table[C_POWER["N_w"]].max() == 1.0 and table[C_POWER["N_c"]].max() == 0.0, "contacts")

    return case


def without_coefficients(kind):
    """thornton_ning has no dashpot and gives no coefficient of one: no part of its force is damping."""

    def case(ranks):
        deck = open_box([Grain((0.0, 0.0, 1.001), velocity=(0, 0, -1.0))], normal="thornton_ning", tangential="off")
        deck.body = [
            "fix adhesion all property/global surfaceEnergy peratomtypepair 1 0.0",
            "fix yield all property/global coefficientYieldRatio peratomtype 0.5",
            *floor(deck, kind),
            "compute rows all contact/local overlap fn fn_damping",
            *dump_local("rows", 3, 5, "rows"),
            "run 50",
        ]
        text = deck.text()
        properties, wall = "\n".join(deck.body[:2]) + "\n", deck.body[2]
        text = text.replace(properties, "").replace("pair_style", properties + "pair_style", 1)
        touched = 0
        for _, columns in run(text, ranks, folder=meshes.folder_with(floor=FLOOR)).dump("rows.dump"):
            overlap, normal, damping = columns.values()
            require_equal(damping, np.zeros(len(damping)), f"{wall}: damping part of {normal}")
            touched += len(overlap)
        require(touched > 3, f"{touched} contacts")

    return case


def booked(ranks):
    """`mode ledger` of a ball that bounces while two others collide: each loss among its own."""
    grains = [
        Grain((0.0, 0.0, 1.001), velocity=(0, 0, -1.0)),
        Grain((3.0, 0.0, 4.0), velocity=(0, 0, -1.0)),
        Grain((3.0, 0.0, 1.999), velocity=(0, 0, 1.0)),
    ]
    deck = open_box(grains, extra="tangential_damping off")
    deck = replace(deck, timestep=0.2 * deck.dt())
    walls = floor(deck, "plane")
    kinds = {kind: outputs("dissipation").of(kind).vector() for kind in ("step", "all", "no", "only")}
    deck.body = [
        *walls,
        "compute step all dissipation",
        *(
            f"compute {w} all dissipation mode ledger walls {k}"
            for w, k in (("all", "yes"), ("no", "no"), ("only", "only"))
        ),
        *thermo(1, *(q for words in kinds.values() for q in words)),
        "run 800",
    ]
    table = run(replace(deck, extra="ledger on tangential_damping off"), ranks).thermo()[0]
    found = {kind: np.array([table[q][1:].sum() for q in words]) for kind, words in kinds.items()}
    require(found["step"][0] > 0.0 and found["step"][5] > 0.0, "no collision of each kind")
    for k in (0, 5):
        # two ways to pair the same forces with velocities, alike in the limit of a short step
        require_close(found["all"][k], found["step"][k], 1e-3, f"entry {k}")
    require_equal(found["no"], [*found["all"][:5], *[0.0] * 5], "walls no")
    require_equal(found["only"], [*[0.0] * 5, *found["all"][5:]], "walls only")


def dragged(ranks):
    """A ball that may not turn lies on a floor that slides away under it: the floor does mu m g V, all of it lost to
    friction while the ball slides."""
    friction, speed = 0.2, 3.0
    weight = Grain((0, 0, 0)).mass() * G
    height = 1.0 - overlap_under(weight, 1.0)
    deck = open_box(
        [Grain((-3.0, 0.0, height))], material=Material(friction=(friction,)), extra="tangential_damping off"
    )
    deck.body = [
        GRAVITY,
        *floor(deck, "plane", f"shear x {speed}"),
        "fix still all freeze",
        "compute power all dissipation",
        *thermo(1, *C_POWER.vector()),
        "run 200",
    ]
    table = run(deck, ranks).thermo()[0]
    require_close(table[C_POWER["P_t_w"]][50:], np.full(151, friction * weight * speed), 1e-9, "P_t of the walls")
    require(table[C_POWER["N_sliding_w"]][50:].all(), "the ball does not slide")


def rattlers(ranks):
    """Grains with fewer than 4 contacts, with walls among them: one in a corner on three walls, one on a fourth grain
    in a nest."""
    grains = [Grain((0.99, 0.99, 0.99)), Grain((5.0, 5.0, 5.0)), Grain((6.99, 5.0, 5.0)), Grain((0.99, 0.99, 2.97))]
    packing = Packing((12.0,) * 3, grains, atom_style="sphere", origin=(-1.0,) * 3, triclinic=False)
    wall = "wall/gran model hertz tangential history primitive type 1"
    deck = Deck(packing, boundary="f f f")
    deck.body = [
        *(f"fix {axis} all {wall} {axis}plane 0.0" for axis in "xyz"),
        "compute grains all contact/grain",
        f'variable rattler atom "{C_GRAINS["N_c"]} < 4"',
        "compute rattlers all reduce sum v_rattler",
        *thermo(1, "c_rattlers"),
        f"dump each all custom 1 each.dump id {C_GRAINS['N_c']} {C_GRAINS['N_w']}",
        "dump_modify each sort id",
        "run 0",
    ]
    result = run(deck, ranks)
    ((_, each),) = result.dump("each.dump")
    require_equal(each[C_GRAINS["N_c"]], [4, 1, 1, 3], "contacts of each grain")
    require_equal(each[C_GRAINS["N_w"]], [3, 0, 0, 2], "of these with walls")
    require_equal(result.thermo()[0]["c_rattlers"], [3], "rattlers")


SIDES = "wall/gran model hertz tangential history surface ellipsoid primitive type 1 zplane {} {}"


def between_sides(press_first, more=(), shear=True):
    """Spheroids between two side walls, under pressure control along y."""
    packing = dense_packing(1.5)
    high = packing.edges[2]
    deck = Deck(packing, boundary="p p f", surface="ellipsoid")
    special = "allow_special_domain_periodic yes"
    walls = [f"fix side{k} all {SIDES.format(z, special)}" for k, z in enumerate((0.2, high - 0.2))]
    flow = "shear xy rate 0.05 every 1e-4" if shear else "every/step 5"
    press = [f"fix press all press/strain axis y target 2e5 {flow}"]
    stress = ["compute stress all stress/contact", "compute grains_only all stress/contact walls no"]
    order = [*stress, *more, *press, *walls] if press_first else [*stress, *walls, *more, *press]
    deck.body = [*order, *thermo(1, F_PRESS["P"], C_STRESS["P"], "c_grains_only", C_STRESS["N_w"])]
    deck.body += [*dump_grains(packing, 50), "run 50"]
    return deck


def press_between_sides(ranks):
    """Its pressure is that of stress/contact in every step, the first evaluation included, wherever the walls are
    defined; the side walls carry part of it."""
    first, last = (run(between_sides(press_first), ranks) for press_first in (True, False))
    for table in (first.thermo()[0], last.thermo()[0]):
        # sums of some hundred terms, in two orders of their factors
        require_close(table[F_PRESS["P"]], table[C_STRESS["P"]], 1e-13, "P of press/strain and stress/contact")
        require(table[C_STRESS["N_w"]].min() > 10, "too few contacts with walls")
        share = np.abs(table[C_STRESS["P"]] - table["c_grains_only"]) / table[C_STRESS["P"]]
        require(share.max() > 1e-5, f"the walls carry {share.max()} of P: nothing is proved")
    require_same_snapshots(first.dump("grains.dump"), last.dump("grains.dump"), "walls after or before")


ASKED = "evaluated at the start of a run before all fixes wall/gran have computed their contacts"
AVERAGE = "fix mean all ave/time 1 1 1 c_stress file mean.txt"


def asked_before_walls(ranks):
    """A fix that asks in its own set-up, before walls that are defined after it."""
    require_refused(between_sides(True, [AVERAGE]), ranks, f"compute stress/contact stress: {ASKED}")
    table = run(between_sides(False, [AVERAGE]), ranks)
    means = table.averages("mean.txt")["c_stress"]
    require_close(means, table.thermo()[0][C_STRESS["P"]], 1e-5, "fix ave/time, six digits")  # as it prints
    without = replace(between_sides(True), body=[])
    without.body = [AVERAGE.replace("c_stress", "c_grains_only"), *between_sides(True).body]
    at = without.body.index("compute grains_only all stress/contact walls no")
    without.body.insert(0, without.body.pop(at))
    run(without, ranks)
    target = ["variable wanted equal 2e5+0*f_press[3]"]
    deck = between_sides(True, target)
    deck.body = [line.replace("target 2e5", "target v_wanted") for line in deck.body]
    require_refused(deck, ranks, f"fix press/strain: {ASKED}")


def walls_that_change(ranks):
    """A wall that is given again under its ID replaces the other; one that is gone is missed where nothing is set up
    and contacts are measured."""
    deck = open_box([Grain((0.0, 0.0, 0.99))])
    wall = floor(deck, "plane")[-1]
    measured = ["compute stress all stress/contact", *thermo(1, C_STRESS["N_w"])]
    deck.body = [wall, *measured, "run 1", wall, "run 1"]
    for part in run(deck, ranks).thermo():
        require_equal(part[C_STRESS["N_w"]][-1], 1.0, "contacts with the wall that is there")
    removed = f"unfix {wall.split()[1]}"
    deck.body = [wall, "run 1", removed, "run 1 pre no"]
    run(deck, ranks)
    deck.body = [wall, *measured, "run 1", removed, "run 1 pre no"]
    require_refused(
        deck,
        ranks,
        "pair_style gran/insitu: a fix wall/gran was removed after the last set-up of a run, and contacts are "
        "measured: do not use 'pre no'",
    )
    deck.body = [wall, *measured, "run 1", removed, "run 1"]
    require_equal(run(deck, ranks).thermo()[-1][C_STRESS["N_w"]][-1], 0.0, "contacts with the wall that is gone")


def resumed_under_a_plate(late):
    """A mesh that moves has its velocity in the first row after a restart, whether it is moved by a fix before or after
    that of the wall."""

    def case(ranks):
        deck = open_box([Grain((0.3, 0.2, 0.99))], extra="setup neutral")
        wall = floor(replace(deck, extra=""), "mesh")
        move = "fix move all move/mesh mesh mesh linear 0.05 0. 0.05"
        body = [*wall, move] if late else [wall[0], move, wall[1]]
        body += ["compute power all dissipation mode instantaneous", "compute wall all wall/contact"]
        body += thermo(3, C_POWER["P_n_w"], C_WALL["power"], C_WALL["force_z"])
        deck.body = [*body, "run 3", "write_restart half.restart", "run 3"]
        folder = meshes.folder_with(floor=FLOOR)
        done = run(deck, ranks, folder=folder)
        before, after = done.thermo()[0], done.thermo()[1]
        resumed = run(deck.restarted("half.restart", [*body, "run 3"]), ranks, folder=folder).thermo()[0]
        for name in (C_POWER["P_n_w"], C_WALL["power"], C_WALL["force_z"]):
            last = before[name][-1]
            require(last != 0.0, f"{name} does nothing")
            require_close([after[name][0], resumed[name][0]], [last, last], 1e-10, f"{name} as a run begins", abs(last))
            require_close(resumed[name][-1], after[name][-1], 1e-10, f"{name} at the end", abs(last))

    return case


def ledger_asked_before_walls(ranks):
    """As other measures, the ledger does not answer before walls have been evaluated."""
    deck = open_box([Grain((0.0, 0.0, 0.99))])
    deck.extra = "ledger on"
    plain = replace(deck, extra="")
    asks = ["compute ledger all energy/ledger", "fix mean all ave/time 1 1 1 c_ledger file mean.txt"]
    deck.body = [*asks, *floor(plain, "plane"), "run 1"]
    require_refused(deck, ranks, f"compute ledger (energy/ledger): {ASKED}")
    deck.body = [*floor(plain, "plane"), *asks, "run 1"]
    run(deck, ranks)


UNSEEN = "WARNING: pair_style gran/insitu: contacts with the walls of"


def unseen_walls(ranks):
    """Walls of other fixes are named once, in however many runs; those of wall/gran never."""
    deck = open_box([Grain((0.0, 0.0, 2.0))])
    region = ["region hall block -5 5 -5 5 -0.5 10 units box", "fix hall all wall/region hall lj93 1.0 1.0 0.8"]
    deck.body = [*floor(deck, "plane"), "run 1", *region, "run 1", "run 1"]
    output = run(deck, ranks).output
    require(output.count(UNSEEN) == 1, f"said {output.count(UNSEEN)} times")
    require(f"{UNSEEN} fix hall (wall/region) are not measured" in output, "other words")


CASES = {
    "column-on-a-plane": column("plane"),
    "column-on-a-mesh": column("mesh"),
    **{f"bounce-on-a-{kind}-e-{e}": bounce(kind, e) for kind in ("plane", "mesh") for e in (0.1, 0.9)},
    **{f"without-coefficients-on-a-{kind}": without_coefficients(kind) for kind in ("plane", "mesh")},
    "booked": booked,
    "dragged": dragged,
    "rattlers": rattlers,
    "press-between-sides": press_between_sides,
    "asked-before-walls": asked_before_walls,
    "ledger-asked-before-walls": ledger_asked_before_walls,
    "change": walls_that_change,
    "resumed-under-a-plate": resumed_under_a_plate(False),
    "resumed-under-a-plate-moved-late": resumed_under_a_plate(True),
    "unseen-walls": unseen_walls,
}

if __name__ == "__main__":
    main(CASES)
