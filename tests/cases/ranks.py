# SPDX-License-Identifier: GPL-2.0-or-later
"""The same state on 1, 2 and 4 ranks gives the same measures; ranks and groups may be empty; the host's stress/atom
agrees."""
from dataclasses import replace

import numpy as np

from case import main, require, require_close
from deck import Deck, shear, thermo
from grainscope.columns import outputs
from packing import dense_packing, in_the_open
from run import run

C_S = outputs("stress/contact").of("s")

# Sums in another order; for non-spheres the host's solver, stopped at about 1e-7, sees a contact from one side or the
# other.
SUMS, SOLVER = 1e-10, 2e-6
COMMANDS = ("stress/contact", "dissipation mode instantaneous", "dissipation mode step", "nematic")


def measured(group="all"):
    """Lines that compute everything, and the thermo quantities, in blocks of one physical dimension each."""
    lines, blocks = [], []
    for n, command in enumerate(COMMANDS):
        lines.append(f"compute m{n} {group} {command}")
        vector = outputs(command.split()[0]).of(f"m{n}").vector()
        if command == "stress/contact":
            blocks += [[f"c_m{n}", *vector[:26]], vector[26:29], vector[29:32], vector[32:34], vector[34:]]
        elif command == "nematic":
            blocks += [[f"c_m{n}", *vector[:6], vector[9], *vector[15:]], vector[12:15]]
        else:
            blocks += [[f"c_m{n}", *vector[:3]], vector[3:]]
    return lines, blocks


def state_of(deck, steps=300):
    deck = replace(deck, processors="", body=[shear(0.02), f"run {steps}", "write_restart state.restart"])
    return run(deck).folder / "state.restart"


def measure(deck, state, ranks, group_lines=(), group="all"):
    lines, blocks = measured(group)
    deck = replace(deck, processors=deck.processors if ranks == 4 else "")
    body = [*group_lines, *lines, *thermo(1, *[q for block in blocks for q in block]), "run 0"]
    result = run(deck.restarted(state, body), ranks)
    table = result.thermo()[0]
    return [np.array([table[q][0] for q in block]) for block in blocks], result


def same_on(deck, tolerance, group_lines=(), group="all"):
    def case(ranks):
        state = state_of(deck)
        (one, _), (many, _) = (measure(deck, state, n, group_lines, group) for n in (1, ranks))
        require(one[0][0] != 0.0, "the state has no stress")
        for a, b in zip(many, one):
            require_close(a, b, tolerance, f"{ranks} ranks against 1", max(float(np.abs(b).max()), 1e-12))

    return case


def empty_ranks(ranks):
    """A cluster in the middle of a large box cut in four along x: the outer ranks hold no grain."""
    deck = Deck(in_the_open(dense_packing(1.5, overlap=0.04, speed=0.05)), processors="4 1 1")
    state = state_of(deck, 10)
    (one, _), (many, result) = (measure(deck, state, n) for n in (1, ranks))
    grains = next(line for line in result.output.splitlines() if line.startswith("Nlocal:")).split()
    require(grains[5:7] == ["0", "min"], f"no rank was empty: {' '.join(grains)}")
    for a, b in zip(many, one):
        require_close(a, b, SOLVER, f"{ranks} ranks against 1", max(float(np.abs(b).max()), 1e-12))


def empty_group(ranks):
    """Zero, not NaN, for a group that holds no grain."""
    deck = Deck(dense_packing(1.5))
    state = state_of(deck)
    for block in measure(deck, state, ranks, ["group nobody id 99999"], "nobody")[0]:
        require_close(block, np.zeros_like(block), 0.0, "an empty group", 1.0)


def stress_atom(deck):
    """The host's own tally, sum of stress/atom over the volume. Its xy entry is r_x F_y: our total yx."""
    sums = [f"compute sum{k} all reduce sum c_atoms[{k}]" for k in range(1, 7)]
    body = [
        shear(0.02),
        "compute s all stress/contact",
        "compute atoms all stress/atom pair",
        *sums,
        *thermo(50, "vol", *[f"c_sum{k}" for k in range(1, 7)], *(C_S[name] for name in ("sxx", "syy", "szz", "syx"))),
        "run 300",
    ]

    def case(ranks):
        table = run(replace(deck, body=body), ranks).thermo()[0]
        # The tally is over grains (both owners add half); thermo's volume does not change in simple shear.
        host = np.stack([table[f"c_sum{k}"] for k in (1, 2, 3, 4)], axis=1) / table["vol"][:, None]
        ours = np.stack([table[C_S[name]] for name in ("sxx", "syy", "szz", "syx")], axis=1)
        require_close(ours, host, SUMS, "stress/contact against stress/atom")
        require(np.abs(ours[1:, 3]).min() > 0.0, "no shear stress: nothing is proved about yx")

    return case


CASES = {
    "spheres": same_on(Deck(dense_packing(atom_style="sphere", speed=0.2)), SUMS),
    "spheroids": same_on(Deck(dense_packing(1.5, speed=0.2)), SOLVER),
    "oblate-grains": same_on(Deck(dense_packing(0.5, speed=0.2)), SOLVER),
    **{
        f"ellipsoids-{name}": same_on(Deck(packing, surface="ellipsoid", processors=grid), SUMS)
        for name, packing, grid in (
            ("0.33", dense_packing(0.33, speed=0.2), "1 4 1"),
            ("1.5", dense_packing(1.5, speed=0.2), "2 2 1"),
            ("3", dense_packing(3.0, speed=0.2), "1 2 2"),
            ("polydisperse", dense_packing(1.5, sizes=(0.5, 1.0, 1.5), overlap=-0.05, speed=0.2), "4 1 1"),
        )
    },
    "subgroup": same_on(Deck(dense_packing(atom_style="sphere", speed=0.2)), SUMS, ["group some id 10:90"], "some"),
    "empty-ranks": empty_ranks,
    "empty-group": empty_group,
    "stress-atom-of-spheres": stress_atom(Deck(dense_packing(atom_style="sphere", speed=0.2))),
    "stress-atom-of-spheroids": stress_atom(Deck(dense_packing(1.5, speed=0.2))),
}

if __name__ == "__main__":
    main(CASES)
