# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs a deck with computes in thermo and grains and contacts in dumps, and hands back one Moment per snapshot: what
the computes gave, and what the oracle starts from."""
from dataclasses import dataclass, replace

import numpy as np

from deck import GRAIN_COLUMNS, SPHEROID_COLUMNS, Deck, box_columns, dump_grains, dump_local, number, thermo
from grainscope.columns import outputs
from oracle.state import ROW_WIDTH, Box, grains_of, rows_of
from run import run

F_FLOW = outputs("press/strain").of("flow")


@dataclass(frozen=True)
class Watched:
    """A compute and what it gives: `vector` entries, an `array` of (rows, columns), `peratom` columns."""

    name: str
    command: str
    scalar: bool = False
    vector: int = 0
    array: tuple = (0, 0)
    peratom: int = 0

    def define(self, group):
        return f"compute {self.name} {group} {self.command}"

    def columns(self):
        scalar = [f"c_{self.name}"] if self.scalar else []
        vector = [f"c_{self.name}[{k}]" for k in range(1, self.vector + 1)]
        rows, columns = self.array
        return [
            *scalar,
            *vector,
            *(f"c_{self.name}[{r}][{c}]" for r in range(1, rows + 1) for c in range(1, columns + 1)),
        ]

    def atom_columns(self):
        return [f"c_{self.name}[{k}]" for k in range(1, self.peratom + 1)]


@dataclass(frozen=True)
class Flow:
    """How the box of a deck moves: its fix, the shear rate, the plane, the thermo column of dL/dt along y (if any)."""

    line: str = ""
    rate: float = 0.0
    plane: tuple = (0, 1)
    length_rate: str = ""


def deforming(rate, plane=(0, 1)):
    name = "xyz"[plane[0]] + "xyz"[plane[1]]
    return Flow(f"fix flow all deform 1 {name} erate {number(rate)} remap v", rate, plane)


def pressed(rate, target=1e5, plane=(0, 1), every="1e-3"):
    """fix press/strain: the box shears, and L_y moves."""
    name = "xyz"[plane[0]] + "xyz"[plane[1]]
    line = f"fix flow all press/strain axis y target {number(target)} shear {name} rate {number(rate)} every {every}"
    return Flow(line, rate, plane, F_FLOW["L_rate"])


@dataclass
class Moment:
    step: int
    printed: dict
    columns: dict
    grains: object
    rows: dict  # of the group, or None
    box: Box  # as it is now
    force_box: Box  # as the force evaluation saw it
    chosen: np.ndarray

    def scalar(self, watched):
        return self.printed[f"c_{watched.name}"]

    def vector(self, watched):
        return np.array([self.printed[f"c_{watched.name}[{k}]"] for k in range(1, watched.vector + 1)])

    def array(self, watched):
        rows, columns = watched.array
        return np.array(
            [[self.printed[f"c_{watched.name}[{r}][{c}]"] for c in range(1, columns + 1)] for r in range(1, rows + 1)]
        )

    def peratom(self, watched):
        return np.stack([self.columns[c] for c in watched.atom_columns()], axis=1)


def image_of(moment):
    """Image flags of all grains."""
    return np.stack([moment.columns[name] for name in ("ix", "iy", "iz")], axis=1)


def grain_columns(packing, *more):
    base = SPHEROID_COLUMNS if packing.atom_style == "superquadric" else GRAIN_COLUMNS
    return " ".join([base, *more])


def watched_deck(
    deck, computes, flow=Flow(), group="all", every=5, steps=20, settle=0, contacts=True, extra=(), thermo_every=1
):
    """`settle` steps of flow first, then `steps` with dumps every `every` and thermo every `thermo_every`; `extra`:
    further thermo columns."""
    start = [f"group chosen id {group}"] if group != "all" else ["group chosen union all"]
    start += [flow.line] if flow.line else []
    start += [*thermo(100, "step"), f"run {settle}"] if settle else []
    more = ["ix", "iy", "iz", *(c for w in computes for c in w.atom_columns())]
    quantities = [
        *box_columns(),
        *extra,
        *([flow.length_rate] if flow.length_rate else []),
        *(q for w in computes for q in w.columns()),
    ]
    output = [
        *thermo(thermo_every, *quantities),
        *dump_grains(deck.packing, every, columns=grain_columns(deck.packing, *more)),
    ]
    if contacts:
        output += ["compute rows chosen contact/local", *dump_local("rows", ROW_WIDTH, every, "rows")]
    return replace(deck, body=[*deck.body, *start, *(w.define("chosen") for w in computes), *output, f"run {steps}"])


def box_at(table, row, flow):
    value = {name: float(table[name][row]) for name in box_columns()}
    edges = np.array(
        [[value["lx"], value["xy"], value["xz"]], [0.0, value["ly"], value["yz"]], [0.0, 0.0, value["lz"]]]
    )
    rate, (a, b) = np.zeros((3, 3)), flow.plane
    rate[a, b] = flow.rate * edges[b, b]
    if flow.length_rate:
        rate[1, 1] = table[flow.length_rate][row]
    return Box(edges, np.array([value["xlo"], value["ylo"], value["zlo"]]), rate)


def force_box(table, row, flow):
    before, now = (box_at(table, r, flow) for r in (max(row - 1, 0), row))
    for a, b in ((1, 2), (0, 2), (0, 1)):
        before.edges[:, b] += round((now.edges[a, b] - before.edges[a, b]) / now.edges[a, a]) * before.edges[:, a]
    return before


def moments_of(result, flow=Flow(), group="all"):
    table = result.thermo()[-1]
    grains_dump = result.dump("grains.dump")
    rows_dump = (
        result.dump("rows.dump") if (result.folder / "rows.dump").exists() else [(None, None)] * len(grains_dump)
    )
    for (step, columns), (_, rows) in zip(grains_dump, rows_dump):
        row, grains = int(np.searchsorted(table["step"], step)), grains_of(columns)
        low, high = map(int, group.split(":")) if group != "all" else (1, len(grains.ids))
        # The force evaluation of a step saw the box that the end of the step before had left (if that was printed),
        # turned back if due.
        yield Moment(
            step,
            {name: float(values[row]) for name, values in table.items()},
            columns,
            grains,
            None if rows is None else rows_of(rows, "rows"),
            box_at(table, row, flow),
            force_box(table, row, flow),
            (grains.ids >= low) & (grains.ids <= high),
        )


def watch(deck: Deck, computes, flow=Flow(), ranks=1, group="all", **choices):
    """The moments of one run."""
    result = run(watched_deck(deck, computes, flow, group, **choices), ranks)
    return list(moments_of(result, flow, group))
