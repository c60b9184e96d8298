# SPDX-License-Identifier: GPL-2.0-or-later
"""`compute pair/gran/local ... history` with surface ellipsoid: the columns of surface superquadric, in its order,
without a trace in the run."""
from dataclasses import replace

import numpy as np

from case import main, require, require_close, require_equal, require_same_snapshots
from deck import Deck, dump_grains, dump_local, shear
from oracle.state import ROW_WIDTH, rows_of
from packing import dense_packing, in_the_open
from run import run

HISTORY = "compute pairs all pair/gran/local id history"
WIDTH = 13  # two IDs and a flag, seven columns of the surface, the tangential spring
# The host's solver stops when normals agree to about 1e-5, and positions follow (ellipsoid_rows.py).
SOLVER = 1e-4


def history(result, snapshot=0, width=WIDTH):
    """{(lower ID, higher ID): columns} of a snapshot; i is the grain that comes first in the host's list."""
    columns = result.dump("pairs.dump")[snapshot][1]
    table = np.array([columns[f"c_pairs[{k}]"] for k in range(1, width + 1)]).T
    return {(int(row[0]), int(row[1])): row[3:] for row in table}


def asked(packing, **choices):
    deck = Deck(packing, **choices)
    return replace(deck, body=[HISTORY, *dump_local("pairs", WIDTH, 5, "pairs")])


def as_superquadric(packing, **choices):
    def case(ranks):
        found, expected = (
            history(run(replace(d, body=[*d.body, "run 0"]), ranks))
            for d in (asked(packing, surface=surface, **choices) for surface in ("ellipsoid", "superquadric"))
        )
        require(len(expected) > 100, f"only {len(expected)} contacts")
        smallest = min(packing.grains[0].semi_axes)
        for pair in found.keys() & expected.keys():
            ours, hosts = found[pair], expected[pair]
            require_equal(ours[:2], hosts[:2], f"{pair}: the first two columns")
            require_equal(ours[:2], [0.0, 2.0], f"{pair}: the first two columns")
            require_close(ours[2:5], hosts[2:5], SOLVER, f"{pair}: contact point", smallest)
            require_close(ours[5:7], hosts[5:7], SOLVER, f"{pair}: depths", smallest)
        # Contacts thinner than that are seen by one of them alone.
        thin = [
            p
            for both, one in ((found, expected), (expected, found))
            for p in both.keys() - one.keys()
            if both[p][5:7].sum() > SOLVER * smallest
        ]
        require(not thin, f"not the same contacts: {thin}")

    return case


def counted(ranks):
    """What scripts of the paper do: the sum of column 2 of the history is twice the number of contacts; depths and
    point are contact/local's."""
    packing = in_the_open(dense_packing(1.5))
    deck = asked(packing, surface="ellipsoid")
    deck.body += ["compute rows all contact/local", *dump_local("rows", ROW_WIDTH, 5, "rows"), "run 0"]
    result = run(deck, ranks)
    found, rows = history(result), rows_of(result.dump("rows.dump")[0][1], "rows")
    require(sum(row[1] for row in found.values()) == 2 * len(rows["id"]), "column 2 does not count the contacts")
    for k, (i, j) in enumerate(rows["id"]):
        row = found.get((int(i), int(j)), found.get((int(j), int(i))))
        # To rounding: another evaluation, begun at another point of the solver.
        require_close(row[2:5], rows["point"][k], 1e-11, "contact point", 1.0)
        require_close(row[5] + row[6], rows["overlap"][k], 1e-11, "overlap", 1.0)


def behind_the_surface(ranks):
    """Springs, and what `ledger on` keeps of the evaluation before: a stamp, the overlap, the elastic force."""
    width = WIDTH + 6
    deck = Deck(dense_packing(1.5), surface="ellipsoid", extra="ledger on tangential_damping off")
    deck.body = [
        "compute ledger all energy/ledger",
        "thermo_style custom step c_ledger[1]",
        "thermo 1",
        HISTORY,
        *dump_local("pairs", width, 20, "pairs"),
        shear(0.1 / (20 * deck.dt())),
        "run 20",
    ]
    table = np.array(list(history(run(deck, ranks), 1, width).values()))
    require(len(table) > 100, f"only {len(table)} contacts")
    overlap = table[:, 5] + table[:, 6]
    require((table[:, 10] == table[0, 10]).all() and table[0, 10] > 0.0, f"stamps {table[:, 10]}")
    require_close(table[:, 11], overlap, 1e-11, "overlap that the ledger keeps", 1.0)  # to rounding, as above
    sprung = np.linalg.norm(table[:, 7:10], axis=1)
    require((sprung > 0.0).mean() > 0.9, f"{(sprung == 0.0).sum()} of {len(table)} contacts have no spring")
    require((sprung < 10.0 * overlap.max()).all(), f"springs of {sprung.max()}, overlaps of {overlap.max()}")


def without_a_trace(**choices):
    """Output in every fifth step or none, the same trajectory: also of pair_style gran, which keeps no copy of its
    history."""

    def case(ranks):
        deck = asked(dense_packing(1.5), surface="ellipsoid", **choices)
        rest = [shear(0.3 / (300 * deck.dt())), *dump_grains(deck.packing, 300), "run 300"]
        talking = run(replace(deck, body=[*deck.body, *rest]), ranks)
        silent = run(replace(deck, body=rest), ranks)
        require(len(talking.dump("pairs.dump")) == 61, "pair/gran/local wrote too little")
        require_same_snapshots(talking.dump("grains.dump"), silent.dump("grains.dump"), "with output against without")

    return case


CASES = {
    "spheroids": as_superquadric(dense_packing(1.5)),
    "flat": as_superquadric(dense_packing(0.5)),
    "spheres": as_superquadric(dense_packing()),
    "under-gran": as_superquadric(dense_packing(1.5), pair="gran"),
    "counted": counted,
    "behind-the-surface": behind_the_surface,
    "without-a-trace": without_a_trace(),
    "without-a-trace-under-gran": without_a_trace(pair="gran"),
    "without-a-trace-cohesive": without_a_trace(cohesion="sjkr"),
}

if __name__ == "__main__":
    main(CASES)
