# SPDX-License-Identifier: GPL-2.0-or-later
"""What `ledger on`, compute energy/ledger and compute dissipation mode ledger refuse."""
from dataclasses import replace

from case import main
from deck import Deck
from packing import dense_packing
from refusal import refusal, require_refused
from run import run

SPHERES = dense_packing(atom_style="sphere")
LEDGER = "compute c all energy/ledger"
NAME = "compute c (energy/ledger): "


def refused(*words, extra="ledger on", before=(), compute=LEDGER, after=("run 1",), **choices):
    return refusal(
        lambda: Deck(
            choices.get("packing", SPHERES),
            body=[*before, compute, *after],
            extra=extra,
            **{k: v for k, v in choices.items() if k != "packing"},
        ),
        *words,
    )


def restarts(written, read, *words):
    """A restart file of one kind, read by a deck of another."""

    def case(ranks):
        deck = Deck(SPHERES, extra=written, body=["run 5", "write_restart state.restart"])
        state = run(deck, ranks).folder / "state.restart"
        require_refused(replace(deck, extra=read).restarted(state, ["run 1"]), ranks, *words)

    return case


ROLLING = ("coeffRollingStiffness", "coefficientRollingViscousDamping")
CASES = {
    "ledger-off": refused(
        NAME + "needs 'ledger on' in pair_style gran/insitu", "got 'model hertz tangential history", extra=""
    ),
    "dissipation-ledger-off": refused(
        "compute c (dissipation mode ledger): needs 'ledger on'",
        extra="",
        compute="compute c all dissipation mode ledger",
    ),
    "needs-gran-insitu": refused(
        "compute c (energy/ledger) requires pair_style gran/insitu, got 'gran'", extra="", pair="gran"
    ),
    "cohesion": refused(
        NAME + "works with 'cohesion off' only, got 'model hertz tangential history " "cohesion sjkr'",
        cohesion="sjkr",
    ),
    "rolling": refused(
        NAME + "works with 'rolling_friction' off, cdt, epsd and epsd2 only",
        "rolling_friction luding",
        rolling="luding",
        before=[f"fix c{k} all property/global {name} peratomtypepair 1 1e5" for k, name in enumerate(ROLLING)],
    ),
    "loose-grains": refused(
        NAME + "every grain of the group must be moved by fix nve/sphere",
        "got ",
        "that are not",
        before=["unfix integrate", "group few id 1:50", "fix integrate few nve/sphere"],
    ),
    "other-integrator": refused(
        NAME + "needs grains that are moved by fix nve/sphere",
        "got fix integrate of style nve/limit",
        before=["unfix integrate", "fix integrate all nve/limit radius_ratio 0.1"],
    ),
    "grains-that-grow": refused(
        NAME + "needs grains whose diameters do not change within a run, got fix grow of style adapt with 'diameter'",
        before=["variable wide equal 2.0+1e-5*step", "fix grow all adapt 1 atom diameter v_wide"],
    ),
    "box-without-flow": refused(
        NAME + "needs 'remap v' where the box deforms, got fix shear (deform) without it",
        before=["fix shear all deform 1 xy erate 0.01 remap x"],
    ),
    "box-of-some-grains": refused(
        NAME + "needs a box that deforms for the group all, got fix shear (deform) for the group few",
        before=["group few id 1:50", "fix shear few deform 1 xy erate 0.01 remap v"],
    ),
    "time-step-changed": refused(
        NAME + "the time step changed from",
        "without a new set-up of the run",
        after=["run 5", "timestep 1e-4", "run 5 pre no"],
    ),
    "record-taken": refused(
        "compute c needs the fix ID 'c_ledger' for its ledger, but it is taken", before=["fix c_ledger all nve/noforce"]
    ),
    "record-gone": refused(
        "fix c_ledger, which keeps the ledger of compute c, no longer exists", after=["unfix c_ledger", "run 1"]
    ),
    "record-by-hand": refused(
        "fix ledger/record: is made by the computes that need it", compute="fix r all ledger/record x"
    ),
    "wall-cohesion": refused(
        NAME + "wall 'floor': works with 'cohesion off' only, got 'model hertz tangential "
        "history cohesion sjkr primitive",
        before=["fix floor all wall/gran model hertz tangential history cohesion sjkr primitive type 1 zplane 0.0"],
        packing=replace(SPHERES, triclinic=False),
    ),
    "restart-without": restarts(
        "",
        "ledger on",
        "pair_style gran/insitu: the restart file holds 3 numbers per contact, and this pair_style has 9",
        "it was written without 'ledger on'",
    ),
    "restart-with": restarts(
        "ledger on",
        "",
        "the restart file holds 9 numbers per contact, and this pair_style has 3",
        "it was written with 'ledger on'",
    ),
    "pre-no-at-first": refused(
        NAME + "was not set up: do not use 'pre no' in the first run with it",
        compute="",
        before=["run 1"],
        after=[LEDGER, "thermo_style custom step c_c", "run 1 pre no"],
    ),
}

if __name__ == "__main__":
    main(CASES)
