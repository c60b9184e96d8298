# SPDX-License-Identifier: GPL-2.0-or-later
"""pair_style gran/insitu inside LIGGGHTS: host output, restarts, `clear`, warnings, fixes that ask for `gran`, the
virial."""
from dataclasses import replace

import numpy as np

from case import main, require, require_close, require_same_snapshots
from deck import Deck, dump_grains, shear, thermo
from grainscope.columns import outputs
from packing import Grain, Packing, dense_packing, in_the_open
from run import run

C_ROWS = outputs("contact/local").of("rows")

STEPS = 600
WARNING = "neigh_modify contact_distance_factor 1.05"


def moving(alpha=1.5, **choices):
    packing = dense_packing(alpha)
    deck = Deck(packing, **choices)
    deck.body = [shear(0.2 / (STEPS * deck.dt())), *dump_grains(packing, STEPS)]
    return deck


def local_output_does_not_disturb(ranks, **choices):
    deck = moving(**choices)
    silent = run(replace(deck, body=[*deck.body, f"run {STEPS}"]), ranks).dump("grains.dump")
    output = [
        "compute pairs all pair/gran/local pos id force contactPoint delta",
        "dump pairs all local 50 pairs.dump c_pairs[1]",
        f"run {STEPS}",
    ]
    talking = run(replace(deck, body=[*deck.body, *output]), ranks)
    require(len(talking.dump("pairs.dump")[-1][1]["c_pairs[1]"]) > 100, "pair/gran/local wrote no rows")
    require_same_snapshots(talking.dump("grains.dump"), silent, "with local output against without")


def contact_local_output_does_not_disturb(ranks):
    deck = moving()
    silent = run(replace(deck, body=[*deck.body, f"run {STEPS}"]), ranks).dump("grains.dump")
    output = ["compute rows all contact/local", f"dump rows all local 50 rows.dump {C_ROWS['id_i']}", f"run {STEPS}"]
    talking = run(replace(deck, body=[*deck.body, *output]), ranks)
    require_same_snapshots(talking.dump("grains.dump"), silent, "with contact/local output against without")


def restart_continues(deck, ranks):
    rest = [*dump_grains(deck.packing, STEPS), f"run {STEPS}"]
    through = run(replace(deck, body=[f"run {STEPS}", "write_restart half.restart", *rest]), ranks)
    again = run(deck.restarted(through.folder / "half.restart", rest), ranks)
    require_same_snapshots(
        again.dump("grains.dump")[-1:], through.dump("grains.dump")[-1:], "restarted against write-and-continue"
    )


def clear_and_begin_again(ranks):
    """A second deck in the same process, after `clear`, moves exactly as in a process of its own."""
    deck = moving()
    deck.body += ["compute stress all stress/contact", *thermo(1, "c_stress"), f"run {STEPS}"]
    alone = run(deck, ranks)
    twice = run(
        "\n".join(
            [
                *moving(0.5).lines(),
                "compute stress all stress/contact",
                *thermo(1, "c_stress"),
                "run 20",
                "clear",
                *deck.lines(),
            ]
        )
        + "\n",
        ranks,
    )
    require_same_snapshots(twice.dump("grains.dump")[-1:], alone.dump("grains.dump")[-1:], "after clear against alone")


def pair_style_again(ranks):
    """pair_style gran/insitu issued twice, with other models the first time."""
    deck = moving()
    once = run(replace(deck, body=[*deck.body, f"run {STEPS}"]), ranks)
    lines = list(deck.lines())
    at = next(k for k, line in enumerate(lines) if line.startswith("pair_style"))
    lines.insert(at, "pair_style gran/insitu model hooke tangential no_history surface superquadric")
    twice = run("\n".join([*lines, f"run {STEPS}"]) + "\n", ranks)
    require_same_snapshots(twice.dump("grains.dump"), once.dump("grains.dump"), "issued twice against once")


BODIES = [  # rigid bodies have LIGGGHTS's loop for all contacts
    "group one id 1 2",
    "group free subtract all one",
    "unfix integrate",
    "fix integrate free nve/sphere",
    "fix bodies one rigid group 1 one",
]


def stale_springs(
    factor, model, expected, packing=dense_packing(1.0, atom_style="sphere"), surface="superquadric", before=()
):
    def case(ranks):
        deck = Deck(
            packing,
            contact_distance_factor=factor,
            tangential=model,
            surface=surface,
            body=[*before, "run 20", "run 20"],
        )
        found = run(deck, ranks).output.count(WARNING)
        require(found == expected, f"factor {factor}, tangential {model}: {found} warnings, expected {expected}")

    return case


def sinks_come_and_go(ranks):
    """Computes deleted between runs, the pair style replaced under a living compute, and both in `clear`."""
    deck = moving()
    model = f"pair_style gran/insitu {deck.model()}"
    define = [
        "compute stress all stress/contact",
        "compute rows all contact/local",
        f"compute count all reduce sum {C_ROWS['id_i']}",
    ]
    deck.body = [
        *define,
        *thermo(5, "c_stress", "c_count"),
        "run 20",
        *thermo(5, "step"),
        "uncompute count",
        "uncompute stress",
        "run 20",
        model,
        "pair_coeff * *",
        "run 20",
        "uncompute rows",
        *define,
        *thermo(5, "c_stress", "c_count"),
        "run 20",
        model,
        "pair_coeff * *",
        "run 20",
        "clear",
    ]
    table = run(deck, ranks).thermo()
    require(len(table) == 5 and (table[4]["c_stress"] != 0.0).all(), "the computes stopped seeing contacts")


def every_way_to_ask(ranks):
    """thermo, fix ave/time and a variable get the same numbers."""
    deck = moving()
    deck.body = [
        "compute stress all stress/contact",
        "variable twice equal 2*c_stress",
        *thermo(10, "c_stress", "v_twice"),
        "fix mean all ave/time 5 1 5 c_stress v_twice file mean.txt",
        "run 100",
    ]
    result = run(deck, ranks)
    table, means = result.thermo()[-1], result.averages("mean.txt")
    require_close(table["v_twice"], 2.0 * table["c_stress"], 1e-15, "variable")
    steps = dict(zip(means["TimeStep"], means["c_stress"]))
    # fix ave/time prints six digits.
    require_close([steps[step] for step in table["step"][1:]], table["c_stress"][1:], 1e-5, "fix ave/time")


def spin_of_frictionless_spheres(ranks):
    """No torque at all: angular velocities stay what they were, to the last bit."""
    deck = Deck(dense_packing(atom_style="sphere"), tangential="off")
    deck.body = [shear(0.05), *dump_grains(deck.packing, 300), "run 300"]
    (_, before), (_, after) = run(deck, ranks).dump("grains.dump")
    require(np.abs(after["vx"] - before["vx"]).max() > 0.1, "nothing collided")
    for name in ("omegax", "omegay", "omegaz"):
        require_close(after[name], before[name], 0.0, name, 1.0)


def time_step_check(ranks):
    """fix check/timestep/gran looks for pair_style gran by name."""
    deck = moving()
    deck.body = ["fix check all check/timestep/gran 1 0.2 0.2", *thermo(1, "f_check[1]", "f_check[2]"), "run 5"]
    rayleigh = run(deck, ranks).thermo()[0]["f_check[1]"]
    # 0.1 of the Rayleigh time of the smallest semi-axis here, of the bounding sphere (1.5 times as large) there.
    require(0.0 < rayleigh[-1] < 0.2, f"fraction of the Rayleigh time: {rayleigh[-1]}")


def virial(pair, ranks, surface="superquadric"):
    """Pressure tensor V from the host, and sum over grains of x f from the dump, which it must equal: no contact
    crosses a face."""
    packing = in_the_open(dense_packing(1.5))
    deck = Deck(
        packing,
        pair=pair,
        surface=surface,
        body=[
            "compute virial all pressure thermo_temp virial",
            "compute atoms all stress/atom pair",
            *[f"compute sum{k} all reduce sum c_atoms[{k}]" for k in range(1, 7)],
            *thermo(10, "vol", *[f"c_virial[{k}]" for k in range(1, 7)], *[f"c_sum{k}" for k in range(1, 7)]),
            *dump_grains(packing, 10),
            "run 30",
        ],
    )
    result = run(deck, ranks)
    step, grains = result.dump("grains.dump")[-1]
    table = {name: values[-1] for name, values in result.thermo()[0].items()}
    x, f = (np.stack([grains[p + a] if p == "f" else grains[a] for a in "xyz"]) for p in ("x", "f"))
    moment = x @ f.T
    expected = np.array([moment[a, b] for a, b in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))])
    by_pressure = np.array([table[f"c_virial[{k}]"] for k in range(1, 7)]) * table["vol"]
    by_atom = -np.array([table[f"c_sum{k}"] for k in range(1, 7)])
    return by_pressure, by_atom, expected


def virial_is_right(ranks, surface="superquadric"):
    by_pressure, by_atom, expected = virial("gran/insitu", ranks, surface)
    scale = np.abs(expected).max()
    # 1e-10: sums of ~500 terms in double precision. 1e-6 on several ranks: two owners of a contact between them solve
    # for the contact point from either side, and the host's solver stops at 1e-7 or so, so that F_ij + F_ji is not
    # exactly zero.
    tolerance = 1e-6 if ranks > 1 and surface == "superquadric" else 1e-10
    require_close(by_pressure[:3], expected[:3], tolerance, "compute pressure, diagonal", scale)
    require_close(by_atom[:3], expected[:3], tolerance, "stress/atom, diagonal", scale)
    require_close(by_pressure, by_atom, 1e-10, "pressure against stress/atom", scale)


def virial_of_plain_gran_is_wrong(ranks):
    """The host's fault that gran/insitu survives: its virial of non-spheres takes the overlap vector for the branch
    vector."""
    by_pressure, _, expected = virial("gran", ranks)
    require(
        np.abs(by_pressure[:3]).max() < 0.1 * np.abs(expected[:3]).max(),
        f"plain gran now gives {by_pressure[:3]} where {expected[:3]} is right: drop the correction",
    )


def host_deck_with_walls(ranks):
    """A deck of the host's own kind: spheres fall on a wall inside a cylinder."""
    grains = [Grain((0.1 * k - 0.3, 0.05 * k - 0.1, 2.2 * k + 1.2), velocity=(0, 0, -1.0)) for k in range(4)]
    packing = Packing((8.0, 8.0, 12.0), grains, atom_style="sphere", origin=(-4.0, -4.0, 0.0))
    wall = "wall/gran model hertz tangential history primitive type 1"
    deck = Deck(
        packing,
        boundary="f f f",
        body=[
            "fix gravity all gravity 9.81 vector 0 0 -1",
            f"fix floor all {wall} zplane 0.0",
            f"fix side all {wall} zcylinder 3.0 0. 0.",
            *dump_grains(packing, 1500),
            "run 1500",
        ],
    )
    plain = run(replace(deck, pair="gran"), ranks).dump("grains.dump")
    insitu = run(deck, ranks).dump("grains.dump")
    require_same_snapshots(insitu, plain, "gran/insitu with walls against gran")
    require(insitu[-1][1]["z"].min() > 0.9, "a sphere fell through the floor")


CASES = {
    "pair-local-output-does-not-disturb": local_output_does_not_disturb,
    "pair-local-output-does-not-disturb-ellipsoids": lambda ranks: local_output_does_not_disturb(
        ranks, surface="ellipsoid"
    ),
    "contact-local-output-does-not-disturb": contact_local_output_does_not_disturb,
    "restart-continues": lambda ranks: restart_continues(replace(moving(), body=[]), ranks),
    "restart-of-spheres-continues": lambda ranks: restart_continues(Deck(dense_packing(atom_style="sphere")), ranks),
    "clear-and-begin-again": clear_and_begin_again,
    "pair-style-again": pair_style_again,
    "no-stale-springs-of-spheres": stale_springs(1.0, "history", 0),
    "stale-springs-beside-rigid-bodies": stale_springs(
        1.0, "history", 1, dense_packing(1.0, atom_style="sphere"), before=BODIES
    ),
    "stale-springs-warned-once": stale_springs(1.0, "history", 1, dense_packing(1.0)),
    "stale-springs-cured-no-warning": stale_springs(1.05, "history", 0, dense_packing(1.0)),
    "no-springs-no-warning": stale_springs(1.0, "off", 0, dense_packing(1.0)),
    "no-stale-springs-of-ellipsoids": stale_springs(1.0, "history", 0, dense_packing(1.0), "ellipsoid"),
    "no-stale-springs-of-spheroids": stale_springs(1.0, "history", 0, dense_packing(1.5)),
    "sinks-come-and-go": sinks_come_and_go,
    "every-way-to-ask": every_way_to_ask,
    "spin-of-frictionless-spheres": spin_of_frictionless_spheres,
    "check-timestep-gran": time_step_check,
    "virial-of-spheroids": virial_is_right,
    "virial-of-ellipsoids": lambda ranks: virial_is_right(ranks, "ellipsoid"),
    "restart-of-ellipsoids-continues": lambda ranks: restart_continues(
        replace(moving(surface="ellipsoid"), body=[]), ranks
    ),
    "virial-of-plain-gran-is-wrong": virial_of_plain_gran_is_wrong,
    "host-deck-with-walls": host_deck_with_walls,
}

if __name__ == "__main__":
    main(CASES)
