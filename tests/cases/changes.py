# SPDX-License-Identifier: GPL-2.0-or-later
"""Computes and fixes that live on while their surroundings change: box, time step, step number, pair style, grains, and
after `clear`."""
from dataclasses import replace

import numpy as np

from case import main, require, require_close, require_equal, require_same_snapshots
from catalogue import DISPLACEMENT, everything, strain_lines
from contact_measures import DIRECTION, EXACT, FABRIC, GRAIN, comparisons, require_agreement
from deck import Deck, dump_grains, dump_local, thermo
from grainscope.columns import outputs
from motion_measures import fluctuations
from oracle import comparison_motion, measures
from oracle.state import ROW_WIDTH, rows_of
from packing import dense_packing
from run import run
from watch import Watched, grain_columns, moments_of, watched_deck

C_C = outputs("stress/contact").of("c")
C_FORCES = outputs("contact/force").of("forces")
C_GRAIN = outputs("contact/grain").of("grain")
C_LOSS = outputs("dissipation").of("loss")
C_MOVED = outputs("displacement/shear").of("moved")
C_STATE = outputs("packing").of("state")
C_STRESS = outputs("stress/contact").of("stress")
C_SURFACE = outputs("contact/surface").of("surface")
F_PRESS = outputs("press/strain").of("press")
KAPPAS = [outputs("stress/contact").of(name)["kappa"] for name in ("filled", "known")]

SPHERES, SPHEROIDS = dense_packing(atom_style="sphere"), dense_packing(1.5)
LOOSE = replace(dense_packing(atom_style="sphere", overlap=-0.15), triclinic=False)
STRESS = Watched("stress", "stress/contact", True, 36)
FLUCTUATIONS = fluctuations("xy")
PRESS = "fix press all press/strain axis y target 2e5 shear xy rate 0.05 every 7e-6"
ALL = "1:1000000"


def check_moment(moment, first):
    when = f"step {moment.step}"
    require_agreement(comparisons(moment, [], 0.0), EXACT, when)
    for watched, flow in FLUCTUATIONS.items():
        compared = comparison_motion.of_fluctuation(
            moment.vector(watched), moment.array(watched), moment, flow, (0, 1), 6
        )
        require_agreement(compared, EXACT, f"{when}, {watched.command}")
    expected = measures.stress_vector(moment.rows, moment.grains, moment.force_box, moment.chosen, 5e6, 1.0)
    found = moment.vector(STRESS)
    for name, part in (
        ("total", slice(0, 7)),
        ("kinetic", slice(19, 25)),
        ("P", slice(25, 26)),
        ("contacts, Z", slice(29, 31)),
    ):
        require_close(found[part], expected[part], EXACT, f"{when}, stress {name}")
    if first is not None:
        check_displacement(moment, first, when)


def unwrapped(moment, ids):
    at = moment.grains.index(ids)
    images = np.stack([moment.columns[name] for name in ("ix", "iy", "iz")], axis=1)
    return moment.grains.x[at] + (images @ moment.box.edges.T)[at]


def check_displacement(moment, first, when):
    """In a box at rest; of those grains that were there at the start and still are."""
    ids = np.intersect1d(first.grains.ids, moment.grains.ids)
    squares = np.mean((unwrapped(moment, ids) - unwrapped(first, ids)) ** 2, axis=0)
    found = moment.vector(DISPLACEMENT)
    require_close(found[1:4], squares, 1e-9, f"{when}, displacement")  # positions are 1e6 times as large
    require_equal(found[7], float(len(ids)), f"{when}, grains followed")


def still_right(packing, lines, box_at_rest=True, changed=None, **choices):
    """20 steps, the change, 20 steps: then everything is as the oracle has it."""

    def case(ranks):
        deck = Deck(packing, extra="tangential_damping off", body=strain_lines(0.05), **choices)
        computes = [FABRIC, DIRECTION, GRAIN, STRESS, DISPLACEMENT, *FLUCTUATIONS]
        deck = watched_deck(deck, computes, group=ALL, settle=5)
        result = run(replace(deck, body=[*deck.body, *lines, "run 20"]), ranks)
        start = result.thermo()[-1]["step"][0]
        moments = list(moments_of(result, group=ALL))
        after = [m for m in moments if m.step > start]
        require(len(after) == 4 and len(after[-1].rows["fn"]) > 20, "nothing to look at after the change")
        for moment in after:
            check_moment(moment, moments[0] if box_at_rest else None)
        if changed:
            changed(moments)

    return case


def grains_changed(by):
    def check(moments):
        found = len(moments[-1].grains.ids) - len(moments[0].grains.ids)
        require(found == by if by else found < 0, f"{found} grains came")

    return check


FEW = ["group few id 3:9 40"]
LOST = (
    "thermo_modify lost ignore format float %.17g norm no"  # the host counts before it has noted those that it inserts
)
INSERT = [
    "region top block 0.5 12 0.5 12 0.5 12 units box",
    "fix small all particletemplate/sphere 15485863 atom_type 1 density constant 1000 radius constant 0.2",
    "fix kinds all particledistribution/discrete 15485867 1 small 1.0",
    "fix insert chosen insert/rate/region seed 32452843 distributiontemplate kinds nparticles 30 particlerate "
    "1000 insert_every 8 "
    "vel constant 0 0 0 overlapcheck yes all_in yes region top",
    LOST,
]
LOSE = [LOST, "group few id 1:30", "velocity few set 0 0 2000 units box"]


DUMPS = [
    *dump_grains(SPHERES, 5, columns=grain_columns(SPHERES, "ix", "iy", "iz", *GRAIN.atom_columns())),
    *dump_local("rows", ROW_WIDTH, 5, "rows"),
]


def printed(result, block=-1):
    return result.thermo()[block]


def asking(packing, press=True):
    """Everything, in a flow under fix press/strain; the ledger too."""
    computes = [
        *(replace(w, command=w.command.replace(" strain v_strain", "")) if press else w for w in everything(packing)),
        Watched("stress", "stress/contact", True, 36),
        Watched("power", "dissipation", True, 10),
        Watched("books", "energy/ledger", True, 20),
        Watched("running", "velocity/correlation average running bins 6", True, 5, (6, 4)),
    ]
    quantities = [q for w in computes for q in w.columns()]
    flow = [PRESS] if press else strain_lines(0.05)
    state = F_PRESS.vector() if press else []
    return [*flow, *(w.define("all") for w in computes), *thermo(1, *quantities, *state)]


def outputs(suffix):
    """Of contacts and grains."""
    rows = dump_local("rows", 8, 1, f"rows{suffix}")
    return [
        "compute rows all contact/local id image normal",
        *rows,
        *dump_grains(SPHERES, 1, f"grains{suffix}", f"id x y z fx fy fz {C_GRAIN['N_c']}"),
    ]


def clear_starts_afresh(packing, surface="superquadric"):
    """The same deck twice in one process: to the last bit the same."""

    def case(ranks):
        once, again = (
            Deck(
                packing, surface=surface, extra="ledger on", body=[*asking(packing), *outputs(k), "run 10", "run 10"]
            ).text()
            for k in (1, 2)
        )
        result = run(f"{once}clear\n{again}", ranks)
        blocks = result.thermo()
        require(len(blocks) == 4 and blocks[0][C_STRESS["N_c"]].min() > 100, "too little was run")
        for before, after in ((blocks[0], blocks[2]), (blocks[1], blocks[3])):
            for name, values in before.items():
                require_equal(after[name], values, f"{name} after 'clear'")
        for name in ("rows", "grains"):
            require(
                result.file(f"{name}1.dump").read_text() == result.file(f"{name}2.dump").read_text(),
                f"{name}: another dump after 'clear'",
            )

    return case


def same_as(change, plain, but=(), **choices):
    """Two bodies that must tell the same in their last run."""

    def case(ranks):
        deck = Deck(SPHERES, extra="ledger on", **choices)
        found, expected = (printed(run(replace(deck, body=body), ranks)) for body in (change, plain))
        require(len(expected["step"]) > 5 and expected[C_STRESS["N_c"]].min() > 100, "too little was run")
        for name, values in expected.items():
            if name != "step" and not name.startswith(but):
                require_equal(found[name], values, name)

    return case


def pair_style_twice(ranks):
    """The host forgets springs then: the trajectory is that of pair_style gran, and the ledger adds up."""

    def trajectory(style):
        words = Deck(SPHERES).model()
        middle = [f"pair_style {style} {words}", "pair_coeff * *"]
        return run(Deck(SPHERES, pair=style, body=[*dump_grains(SPHERES, 5), "run 20", *middle, "run 20"]), ranks).dump(
            "grains.dump"
        )

    require_same_snapshots(trajectory("gran/insitu"), trajectory("gran"), "pair_style twice")
    deck = Deck(SPHERES, extra="ledger on")
    result = run(
        replace(
            deck,
            body=[*asking(SPHERES), "run 20", f"pair_style gran/insitu {deck.model()}", "pair_coeff * *", "run 20"],
        ),
        ranks,
    )
    require_close(printed(result)["c_books"], 0.0 * printed(result)["c_books"], 1e-12, "relative residual", 1.0)


def before_pair_style(ranks):
    """A compute may come before the pair style that it watches."""
    deck = Deck(SPHERES, body=[*thermo(1, "c_c", C_C["N_c"]), "run 20"])
    text, compute = deck.text(), "compute c all stress/contact\n"
    late, early = (
        text.replace(line, put)
        for line, put in (
            ("thermo_style custom step c_c", compute + "thermo_style custom step c_c"),
            ("pair_style", compute + "pair_style"),
        )
    )
    found, expected = printed(run(early, ranks)), printed(run(late, ranks))
    for name, values in expected.items():
        require_equal(found[name], values, name)
    require(expected[C_C["N_c"]].min() > 100, "no contacts")


def time_step_changes(lines):
    """The strain is the rate times the time that has passed, however it was cut into steps."""

    def case(ranks):
        body = [
            PRESS.replace("every 7e-6", "every/step 3"),
            "compute moved all displacement/shear",
            *thermo(1, "time", "dt", F_PRESS["strain"], C_MOVED["strain"]),
            "run 20",
            *lines,
        ]
        result = run(Deck(SPHERES, body=body), ranks)
        dts = np.concatenate([b["dt"] for b in result.thermo()])
        require(len(set(dts)) > 1, "the time step did not change")
        for block in result.thermo():
            require_close(block[F_PRESS["strain"]], 0.05 * block["time"], 1e-12, "strain")
            require_equal(block[C_MOVED["strain"]], block[F_PRESS["strain"]], "strain of the displacements")

    return case


def loss_of_a_changing_step(ranks):
    """What slipped in a step is divided by the time that step took, not by that of the next."""
    body = [
        "compute rows all contact/local",
        *dump_local("rows", ROW_WIDTH, 1, "rows"),
        "compute loss all dissipation",
        *thermo(1, "dt", C_LOSS["P_t"]),
        "fix adapt all dt/reset 1 1e-9 1 1e-5 units box",
        "run 20",
    ]
    result = run(Deck(SPHERES, body=body), ranks)
    table, rows = printed(result), [rows_of(columns, "rows") for _, columns in result.dump("rows.dump")]
    require(len(set(table["dt"])) > 10, "the time step did not change")
    for step in range(1, 21):
        expected = measures.friction_of_step(rows[step], table["dt"][step - 1])
        require_close(
            table[C_LOSS["P_t"]][step], expected, EXACT, f"friction in step {step}", np.abs(table[C_LOSS["P_t"]]).max()
        )


def box_scaled(ranks):
    """fix press/strain goes on with the box that it finds; what was displaced is displaced no further by a scaling of
    everything."""
    body = [
        *asking(SPHERES),
        f"thermo_style custom step ly {C_MOVED['strain']} {C_MOVED['d2_x']} {C_MOVED['d2_y']} {C_MOVED['d2_z']} "
        f"{F_PRESS['strain']} {F_PRESS['L']} c_books {C_STRESS['N_c']}",
        "thermo_modify format float %.17g norm no",
        "run 20",
        "change_box all x scale 1.001 y scale 1.001 z scale 1.001 remap",
        "run 20",
    ]
    first, second = run(Deck(SPHERES, extra="ledger on", body=body), ranks).thermo()
    require_equal(second[F_PRESS["L"]], second["ly"], "length")
    require_close(second["ly"][0], 1.001 * first["ly"][-1], 1e-14, "length after the change")
    require_equal(second[F_PRESS["strain"]][0], first[F_PRESS["strain"]][-1], "strain")
    for square in ("d2_x", "d2_y", "d2_z"):
        before, after = first[C_MOVED[square]][-1], second[C_MOVED[square]][:2]
        require_equal(after[0], before, "mean square of displacement")
        require(abs(after[1] - before) < 3e-6, f"it jumps from {before} to {after[1]}")  # the scaling itself: 1e-5
    require_close(second["c_books"], 0.0 * second["c_books"], 1e-12, "relative residual of the ledger", 1.0)


def groups_changed_without_set_up(ranks):
    """A run that is not set up builds no neighbour list, and contacts across faces and ranks know the new members."""
    asked = {
        "compute stress chosen stress/contact": C_STRESS["N_c"],
        "compute loss chosen dissipation": C_LOSS["N_c"],
        "compute state chosen packing": C_STATE["N_c"],
        "compute forces chosen contact/force": C_FORCES["N_c"],
        "compute surface chosen contact/surface": C_SURFACE["N"],
    }
    body = [
        "group chosen id 1:9",
        "group filled id 999999",  # nobody: the smallest modulus of no grain is 0
        "group known id 1:70",
        "compute filled filled stress/contact",
        "compute known known stress/contact",
        *asked,
        "compute rows all contact/local id",
        *dump_local("rows", 2, 2, "rows"),
        *thermo(2, "step", *asked.values(), *KAPPAS),
        "run 4",
        "group chosen id 1:70",
        "group filled id 1:70",
        "run 4 pre no",
    ]
    result = run(Deck(SPHEROIDS, body=body), ranks)
    table, rows = result.thermo()[-1], dict(result.dump("rows.dump"))
    for step in (6, 8):
        i, j = (column.astype(int) for column in rows[step].values())
        at, contacts = list(table["step"]).index(step), float(np.sum((i <= 70) & (j <= 70)))
        for name in asked.values():
            expected = 70.0 if name == C_SURFACE["N"] else contacts
            require_equal(table[name][at], expected, f"step {step}, {name}")
        require(table[KAPPAS[1]][at] > 0.0, "no stiffness number to compare with")
        require_equal(table[KAPPAS[0]][at], table[KAPPAS[1]][at], f"step {step}, kappa")


CASES = {
    "groups-changed-without-set-up": groups_changed_without_set_up,
    "box-turned-orthogonal": still_right(
        SPHERES, ["undump rows", "undump grains", "change_box all ortho", *DUMPS], box_at_rest=False
    ),
    "box-turned-triclinic": still_right(
        replace(SPHERES, triclinic=False),
        ["undump rows", "undump grains", "change_box all triclinic", *DUMPS],
        box_at_rest=False,
    ),
    "grains-deleted": still_right(LOOSE, [*FEW, "delete_atoms group few compress no"], changed=grains_changed(-8)),
    "grains-deleted-and-renumbered": still_right(
        LOOSE, [*FEW, "delete_atoms group few"], box_at_rest=False, changed=grains_changed(-8)
    ),
    "grains-inserted": still_right(LOOSE, INSERT, changed=grains_changed(30)),
    "grains-lost": still_right(LOOSE, LOSE, changed=grains_changed(0), boundary="p p f"),
    "clear-starts-afresh": clear_starts_afresh(SPHERES),
    "clear-starts-afresh-with-ellipsoids": clear_starts_afresh(SPHEROIDS, "ellipsoid"),
    "steps-renumbered": same_as(
        [*asking(SPHERES), "run 20", "reset_timestep 0", "run 20"], [*asking(SPHERES), "run 20", "run 20"]
    ),
    "pair-style-twice-at-first": same_as(
        [
            f"pair_style gran/insitu {Deck(SPHERES, extra='ledger on').model()}",
            "pair_coeff * *",
            *asking(SPHERES),
            "run 20",
        ],
        [*asking(SPHERES), "run 20"],
    ),
    "pair-style-twice": pair_style_twice,
    "compute-before-pair-style": before_pair_style,
    "time-step-changed-between-runs": time_step_changes(["timestep 1e-5", "run 20"]),
    "time-step-changed-every-ten-steps": time_step_changes(['run 20 every 10 "timestep 2e-5"']),
    "time-step-changed-in-mid-run": time_step_changes(["fix adapt all dt/reset 3 1e-9 1 1e-5 units box", "run 20"]),
    "loss-while-the-time-step-changes": loss_of_a_changing_step,
    "box-scaled": box_scaled,
}

if __name__ == "__main__":
    main(CASES)
