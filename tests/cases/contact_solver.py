# SPDX-License-Identifier: GPL-2.0-or-later
"""compute contact/solver: its counts against the host's neighbour lists and against the contacts themselves, on any
number of ranks."""
from dataclasses import replace
import re

import numpy as np

from case import main, require, require_close, require_equal
from deck import Deck, dump_grains, dump_local, shear, thermo
from grainscope.columns import outputs
from oracle.state import ROW_WIDTH, rows_of
from packing import dense_packing
from run import run

C_SOLVER = outputs("contact/solver").of("solver")
C_STRESS = outputs("stress/contact").of("stress")

SOLVER = "compute solver all contact/solver"
COUNTS = (
    C_SOLVER["pairs_listed"],
    C_SOLVER["pairs_solved"],
    C_SOLVER["pairs_touching"],
    C_SOLVER["steps"],
    C_SOLVER["steps_max"],
    C_SOLVER["fallbacks"],
)


def counts(table, row=-1):
    return np.array([table[name][row] for name in COUNTS])


def flow(steps=100):
    deck = Deck(dense_packing(1.5), surface="ellipsoid")
    deck.body = [shear(0.02), SOLVER, *thermo(1, "c_solver", *COUNTS), f"run {steps}"]
    return deck


def lists_and_contacts(ranks):
    """At one moment: pairs listed are those of the host's lists; a contact between ranks, or across a face, is solved
    by both owners."""
    packing = replace(dense_packing(1.5), triclinic=False)
    grid = {1: (1, 1, 1), 2: (2, 1, 1), 4: (2, 1, 2)}[ranks]
    deck = Deck(packing, surface="ellipsoid", processors=" ".join(map(str, grid)))
    deck.body = [
        SOLVER,
        *thermo(1, "c_solver", *COUNTS),
        "compute rows all contact/local",
        *dump_local("rows", ROW_WIDTH, 1, "rows"),
        *dump_grains(packing, 1),
        "run 0",
    ]
    result = run(deck, ranks)
    listed, solved, touching, steps, most, fallbacks = counts(result.thermo()[0])
    neighbours = int(re.search(r"^Total # of neighbors = (\d+)", result.output, flags=re.M).group(1))
    rows, grains = rows_of(result.dump("rows.dump")[0][1], "rows"), result.dump("grains.dump")[0][1]
    x = np.stack([grains[a] for a in "xyz"], axis=1)
    cell = np.floor(x / (np.array(packing.edges) / grid)).astype(int)
    i, j = (np.searchsorted(grains["id"], rows["id"][:, k]) for k in (0, 1))
    seen_twice = (cell[i] != cell[j]).any(axis=1) | rows["image"].any(axis=1)
    require(100 < seen_twice.sum() < len(i), "contacts are all of one kind")
    require_equal(listed, neighbours, "pairs listed")
    require_equal(touching, len(i) + seen_twice.sum(), "pairs touching")
    require(touching < solved <= listed, f"{solved} pairs solved")
    require(
        1.0 <= most <= 60.0 and touching <= steps <= most * solved, f"{steps} Newton steps, at most {most} in a pair"
    )
    require_equal([fallbacks, result.thermo()[0]["c_solver"][0]], [0.0, 0.0], "fallbacks")


def add_up(ranks):
    """Over a run: every count but the largest grows by what each step did, and goes on over `run` commands."""
    deck = flow()
    deck.body += ["run 0", "run 50"]
    tables = run(deck, ranks).thermo()
    values = np.concatenate([np.stack([counts(t, row) for row in range(len(t["step"]))]) for t in tables])
    grown = np.diff(values, axis=0)
    require(bool((grown[:, :5] >= 0.0).all()) and bool((grown[:, :3] > 0.0).all()), "a count stood still or fell")
    # Warm contacts: a step or two each, and what is surely apart is not asked for at all.
    late = grown[50:100].sum(axis=0)
    require(late[2] <= late[3] <= 2.5 * late[1], f"{late[3]} Newton steps for {late[1]} pairs")
    require(late[1] < 0.8 * late[0], f"{late[1]} of {late[0]} listed pairs solved")
    require_equal(values[-1][5], 0.0, "fallbacks")


def same_on_ranks(ranks):
    """Touching pairs of one state, on one rank and on several: more there, by those between ranks, but no more than all
    are."""
    deck = flow(300)
    state = run(replace(deck, body=[*deck.body, "write_restart state.restart"])).folder / "state.restart"
    lines = [SOLVER, "compute stress all stress/contact", *thermo(1, *COUNTS, C_STRESS["N_c"]), "run 0"]
    one, many = (run(deck.restarted(state, lines), n).thermo()[0] for n in (1, ranks))
    require_equal(many[C_STRESS["N_c"]], one[C_STRESS["N_c"]], "contacts, each once")
    contacts = one[C_STRESS["N_c"]][0]
    for table in (one, many):
        require(
            contacts <= table[C_SOLVER["pairs_touching"]][0] <= 2.0 * contacts,
            f"{table[C_SOLVER['pairs_touching']][0]} touching, {contacts} contacts",
        )
    require(
        many[C_SOLVER["pairs_touching"]][0] > one[C_SOLVER["pairs_touching"]][0]
        and many[C_SOLVER["pairs_listed"]][0] > one[C_SOLVER["pairs_listed"]][0],
        "no pair is between ranks",
    )
    require_equal(many[C_SOLVER["fallbacks"]], one[C_SOLVER["fallbacks"]], "fallbacks")


def begins_with_the_pair_style(ranks):
    """A new pair_style: counts from 0. Under cohesion the loop is the host's, whose lists are not counted."""
    deck = flow()
    model = deck.model()
    deck.body += [
        f"pair_style gran/insitu {model}",
        "pair_coeff * *",
        "run 0",
        f"pair_style gran/insitu {replace(deck, cohesion='sjkr').model()}",
        "pair_coeff * *",
        "run 0",
    ]
    first, again, cohesive = (counts(t) for t in run(deck, ranks).thermo())
    require(
        again[2] < 0.05 * first[2] and again[0] >= again[1] >= again[2] > 0.0, f"counts {first} before, {again} after"
    )
    require(cohesive[0] == 0.0 < cohesive[2], f"counts {cohesive} with cohesion")


def does_not_disturb(ranks):
    deck = flow()
    ends = [
        run(replace(deck, body=[*dump_grains(deck.packing, 100), *body]), ranks).dump("grains.dump")[-1][1]
        for body in (deck.body, [deck.body[0], deck.body[-1]])
    ]
    for name in ("x", "y", "z", "fx", "fy", "fz", "tqx", "omegaz"):
        require_close(ends[0][name], ends[1][name], 0.0, name, 1.0)


CASES = {
    "lists-and-contacts": lists_and_contacts,
    "add-up": add_up,
    "same-on-ranks": same_on_ranks,
    "begins-with-the-pair-style": begins_with_the_pair_style,
    "does-not-disturb": does_not_disturb,
}

if __name__ == "__main__":
    main(CASES)
