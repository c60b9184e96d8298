# SPDX-License-Identifier: GPL-2.0-or-later
"""Faces that move and no grain with them (boundary s and m, change_box without remap) are no flow and no change."""
from dataclasses import replace

import numpy as np

from case import main, require, require_close, require_same_snapshots
from deck import Deck, dump_grains, number, thermo
from grainscope.columns import outputs
from packing import Grain, Packing, dense_packing
from refusal import require_refused
from run import run

C_LAYERED = outputs("fluctuation").of("layered")
C_MOVED = outputs("displacement/shear").of("moved")
C_PROFILE = outputs("fluctuation").of("profile")
C_SMECTIC = outputs("layering").of("smectic")

MOVED = C_MOVED.vector()
RATE, DT = 0.2, 1e-3


def scene(flyer=(0.0, 0.0, 1.0), drift=(0.0, 0.0, 0.0), triclinic=False, **choices):
    """Eight spheres two layers deep, and a ninth above them that flies: nothing touches."""
    places = [(x, y, z) for z in (1.0, 5.0) for y in (-3.0, 3.0) for x in (-3.0, 3.0)]
    grains = [Grain(place, (0.5,) * 3, velocity=drift) for place in places]
    grains.append(Grain((0.0, 0.0, 6.0), (0.5,) * 3, velocity=flyer))
    packing = Packing((12.0, 12.0, 10.0), grains, atom_style="sphere", origin=(-6.0, -6.0, 0.0), triclinic=triclinic)
    return Deck(packing, timestep=DT, **choices)


def measured(deck, ranks, *lines, group="all", every=100, more=()):
    strain = [
        "group rest id 1:8",
        f"variable strain equal step*dt*{number(RATE)}",
        f"compute moved {group} displacement/shear strain v_strain",
    ]
    table = thermo(every, "zlo", "zhi", *MOVED, *more)
    return run(replace(deck, body=[*strain, *lines[:1], *table, *lines[1:]]), ranks).thermo()


def follows_the_flyer(boundary, group="all"):
    """Grains at rest do not move, the ninth moves by u t, wherever the face goes: <d_z^2> = (u t)^2/9, 0 without it."""

    def case(ranks):
        speed = 4.0 if "m" in boundary else 1.0  # beyond the least box
        part = measured(scene(flyer=(0.0, 0.0, speed), boundary=boundary), ranks, "", "run 1500", group=group)[0]
        require(part["zhi"][-1] > part["zhi"][0] + 1.0, "the face does not follow")
        t = np.arange(0, 1501, 100) * DT
        expected = (speed * t) ** 2 / 9.0 if group == "all" else np.zeros(len(t))
        # A position is a sum of 1500 steps.
        for name, square in (("d2_x", 0.0 * t), ("d2_y", 0.0 * t), ("d2_z", expected)):
            require_close(part[C_MOVED[name]], square, 1e-12 if group == "all" else 0.0, name, 1.0)

    return case


def top_layer(ranks):
    """Between neighbour lists the flyer is above the face that will follow it: it belongs to the highest of four
    layers, not to the lowest."""
    more = [C_PROFILE[k, "N"] for k in range(1, 5)] + [C_SMECTIC["N"], C_LAYERED["dv_z"]]
    lines = [
        "compute profile all fluctuation plane xz layers 4\ncompute smectic all layering axis z layers 4\n"
        "compute layered all fluctuation plane xz flow layers 4 layers 4"
    ]
    part = measured(scene(boundary="p p s"), ranks, *lines, "run 150", every=10, more=more)[0]
    # Four at the bottom, one at the top, four at 5 of 1 to 6 or more: in layers 3 or 4 (there with the flyer).
    require((part[C_PROFILE[1, "N"]] == 4.0).all(), f"grains in the lowest layer: {part[C_PROFILE[1, 'N']]}")
    require((part[C_PROFILE[4, "N"]] >= 1.0).all(), f"grains in the highest layer: {part[C_PROFILE[4, 'N']]}")
    require((part[C_SMECTIC["N"]] == 9.0).all(), "layering lost grains")
    # With four still grains in the layer of the flyer: dv = 1 - 1/5 and 4 x -1/5; alone it is its layer's mean.
    together = part[C_PROFILE[4, "N"]] == 5.0
    expected = np.where(together, np.sqrt((0.8**2 + 4 * 0.2**2) / 9.0), 0.0)
    require_close(part[C_LAYERED["dv_z"]], expected, 1e-12, "rms dv_z against layers", 1.0)


def in_a_shear_flow(ranks):
    """The box is sheared along x over y, and grains with it; across z the face follows one of them. d = 0 but for that
    one's own t."""
    deck = scene(boundary="p p s", triclinic=True)
    grains = [replace(g, velocity=(RATE * g.position[1], 0.0, g.velocity[2])) for g in deck.packing.grains]
    deck = replace(deck, packing=replace(deck.packing, grains=grains))
    part = measured(deck, ranks, f"fix flow all deform 1 xy erate {number(RATE)} remap v", "run 1500")[0]
    t = np.arange(0, 1501, 100) * DT
    require_close(part[C_MOVED["d2_x"]], 0.0 * t, 1e-20, "<d_x^2>", 1.0)
    require_close(part[C_MOVED["d2_z"]], t**2 / 9.0, 1e-12, "<d_z^2>", 1.0)


def change_box(words, boundary="p p f", **choices):
    """Between two runs of 0.5 s the box is changed, and no grain moves in it: the displacement is that of free
    flight."""

    def case(ranks):
        drift = choices.get("drift", (0.0, 0.0, 0.0))
        flyer = choices.get("flyer", drift)
        deck = scene(flyer=flyer, drift=drift, boundary=boundary, triclinic="xy" in words)
        parts = measured(deck, ranks, "", "run 500", f"change_box all {words}", "run 500")
        t = np.arange(5, 11) * 100 * DT
        for k in range(3):
            square = (8.0 * drift[k] ** 2 + flyer[k] ** 2) / 9.0 * t**2
            # Positions of 10 grains are sums of 1000 steps; squares.
            require_close(parts[1][C_MOVED[f"d2_{'xyz'[k]}"]], square, 1e-11, f"<d_{'xyz'[k]}^2>", max(1.0, square[-1]))

    return case


def refuses(line, *words):
    def case(ranks):
        deck = scene(boundary="p p p", triclinic=True)
        lines = [
            "group some id 1:4",
            "variable strain equal step",
            line,
            "compute moved all displacement/shear strain v_strain",
            "run 1",
        ]
        require_refused(replace(deck, body=lines), ranks, *words)

    return case


def opened(boundary, **choices):
    """Dense spheres that fly apart along z."""
    packing = replace(dense_packing(atom_style="sphere"), triclinic=False, tilt=0.0)
    return Deck(packing, boundary=boundary, extra="setup neutral ledger on", **choices)


def room(boundary):
    """Above and below, where faces do not make it."""
    return ["change_box all z delta -2 2 units box"] if boundary == "p p f" else []


def is_no_change(boundary, *between):
    """`run 40; run 40`: forces of the first run go on to hold, and the run does not say otherwise. Against one run of
    80."""

    def case(ranks):
        deck = opened(boundary)
        dump = [*room(boundary), *dump_grains(deck.packing, 80)]
        parts = run(replace(deck, body=[*dump, "run 40", *between, "run 40"]), ranks)
        whole = run(replace(deck, body=[*dump, "run 80"]), ranks)
        require("were changed since" not in parts.output, "the run says that something was changed")
        (_, expected), (_, found) = whole.dump("grains.dump")[-1], parts.dump("grains.dump")[-1]
        for name in ("x", "y", "z", "vx", "vy", "vz", "omegax", "omegay", "omegaz"):
            edge = deck.packing.edges["xyz".index(name)] if name in "xyz" else 0.0
            difference = found[name] - expected[name]
            if name in ("x", "y"):
                difference -= edge * np.round(difference / edge)  # lists of other steps wrap in other steps
            # Lists built in other steps sum forces in another order: rounding of 80 steps.
            require_close(difference, 0.0 * difference, 1e-9, name, max(1.0, np.abs(expected[name]).max()))

    return case


def is_a_change(words):
    """Across periodic faces it moves images, so that contacts change: forces are recomputed, as by the host."""

    def case(ranks):
        # Without tangential damping, which `neutral` keeps to the friction limit there (first_evaluation.py).
        deck = replace(opened("p p f"), extra="setup neutral ledger on tangential_damping off")
        dump = dump_grains(deck.packing, 40)
        lines = [*room("p p f"), "run 20", f"change_box all {words}", *dump, "run 20"]
        found = run(replace(deck, body=lines), ranks)
        expected = run(replace(deck, body=lines, extra="ledger on tangential_damping off"), ranks)
        require("were changed since" in found.output, "the run does not say that something was changed")
        require_same_snapshots(found.dump("grains.dump"), expected.dump("grains.dump"), "against setup host")

    return case


def restarts_without_change(ranks):
    """The box of a restart file is wrapped again when the run begins."""
    deck = opened("p p s")
    first = run(replace(deck, body=["run 30", "write_restart half.restart", "run 30"]), ranks)
    again = run(deck.restarted(first.folder / "half.restart", ["run 30"]), ranks)
    for result in (first, again):
        require("were changed since" not in result.output, "the run says that something was changed")


CASES = {
    "shrink-wrapped": follows_the_flyer("p p s"),
    "shrink-wrapped-grains-at-rest": follows_the_flyer("p p s", "rest"),
    "shrink-wrapped-all-around": follows_the_flyer("s s s", "rest"),
    "shrink-wrapped-with-minimum": follows_the_flyer("p p m", "rest"),
    "shrink-wrapped-above": follows_the_flyer("p p fs", "rest"),
    "top-layer": top_layer,
    "in-a-shear-flow": in_a_shear_flow,
    "changed": change_box("z final 0 20 units box", flyer=(0.0, 0.0, 1.0)),
    "changed-and-back": change_box("z final 0 40 z final -1 12 units box", flyer=(0.0, 0.0, 1.0)),
    "changed-with-remap": change_box("z scale 1.5 remap", flyer=(0.0, 0.0, 0.0)),
    "changed-periodic": change_box("z delta -1 2 x scale 1.2 units box", "p p p", drift=(0.0, 0.0, 30.0)),
    "changed-periodic-with-remap": change_box("z scale 1.2 remap", "p p p", drift=(40.0, 0.0, 30.0)),
    "changed-tilt": change_box("xy final 4 units box", "p p p", drift=(0.0, 30.0, -30.0)),
    "changed-tilt-with-remap": change_box("xy final 4 remap units box", "p p p", drift=(0.0, 30.0, -30.0)),
    "changed-boundary": change_box("boundary p p s", flyer=(0.0, 0.0, 1.0)),
    "remap-none": refuses(
        "fix flow all deform 1 xy erate 0.1 remap none",
        "compute displacement/shear: fix flow (deform) must move grains along",
        "got 'remap none'",
    ),
    "deform-of-some": refuses(
        "fix flow some deform 1 xy erate 0.1 remap v", "must move all grains of group 'all', got group 'some'"
    ),
    "neutral-shrink-wrapped": is_no_change("p p s"),
    "neutral-with-minimum": is_no_change("p p m"),
    "neutral-changed-beyond-grains": is_no_change("p p f", "change_box all z delta -5 5 units box"),
    "neutral-notices-periodic": is_a_change("x delta 0 0.01 units box"),
    "neutral-restart": restarts_without_change,
}

if __name__ == "__main__":
    main(CASES)
