# SPDX-License-Identifier: GPL-2.0-or-later
"""Asks every measurement that there is in every step of one run, and tells by how much two such runs differ, quantity
by quantity."""
from dataclasses import dataclass

import numpy as np

from case import require
from catalogue import (
    DIRECT,
    DIRECTION,
    DISPLACEMENT,
    FABRIC,
    FLUCTUATION,
    GRAIN,
    LAYERING,
    MEMORY,
    MESH,
    SURFACE,
    strain_lines,
)
from deck import box_columns, dump_grains, dump_local, thermo
from grainscope.columns import outputs
from oracle.state import ROW_COLUMNS, ROW_WIDTH, grains_of, rows_of
from watch import Watched, grain_columns

F_PRESS = outputs("press/strain").of("press")

RATE = 0.05
STRESS = Watched("stress", "stress/contact", True, 36)
INSTANT = Watched("instant", "dissipation mode instantaneous", True, 10)
STEP = Watched("stepwise", "dissipation mode step", True, 10)
EXACT = Watched("exact", "dissipation mode ledger", True, 10)
NEMATIC = Watched("order", "nematic", True, 20)
LEDGER = Watched("energy", "energy/ledger", True, 37)

# Entries of one scale: the scalar is 0. The scale of a block is its largest entry in all steps of the reference.
LOSSES = {"power": (0, 1, 2, 3), "contacts": (4,), "sliding contacts": (5,)}
BLOCKS = {
    "stress": {
        "stress, its parts, P": (0, *range(1, 27)),
        "mu_eff, N1, N2": (27, 28, 29),
        "N_c": (30,),
        "Z": (31,),
        "sliding": (32,),
        "overlaps": (33, 34),
        "kappa": (35,),
    },
    "instant": LOSSES,
    "stepwise": LOSSES,
    "exact": LOSSES,
    "order": {
        "S2, Q, eigenvalues": (0, *range(1, 7), 10, 18, 19, 20),
        "director": (7, 8, 9),
        "theta": (11, 12),
        "spin": (13, 14, 15),
        "grains": (16, 17),
    },
    "energy": {
        "totals": tuple(range(1, 19)),
        "rates": tuple(range(20, 38)),
    },  # 0 and 19: a residual of rounding, over the losses
    "fabric": {
        "F": (0, *range(1, 7), 19),
        "eigenvalues": (7, 8, 9),
        "eigenvectors": tuple(range(10, 19)),
        "angle": (20,),
        "ratio": (21,),
        "N_c": (22,),
        "weighted F": tuple(range(23, 41)),
    },
    "surface": {"P": (1,), "area": (2,), "grains": (3,)},
    "moving": {
        "rms dv": (1, 2, 3),
        "rms dw": (4, 5, 6),
        "energies": (7, 8),
        "E_rot/E_tr": (9,),
        "lever": (0, 10),
        "shear rates": (11, 12),
        "profile": (13, 14),
    },
    "layers": {"largest C": (1, 3), "its lag": (2,), "order": (0,), "grains": (4,)},
    "direct": {"length": (0, 1, 2), "<dv^2>": (3,), "grains": (4,), "bins in the fit": (5,)},
    "mesh": {"length": (0, 1, 2), "<dv^2>": (3,), "grains": (4,), "bins in the fit": (5,)},
    "moved": {"strain": (1,), "<d^2>": (0, 2, 3, 4), "D": (5, 6, 7), "grains": (8,)},
    "memory": {"strain of memory": (0, 1, 2), "samples": (3,)},
}
PRESS = {
    "pressure": ("f_press", F_PRESS["target"], F_PRESS["P"]),
    "strain": (F_PRESS["strain"],),
    "L": (F_PRESS["L"],),
    "dL/dt": (F_PRESS["L_rate"],),
    "inputs": (F_PRESS["inputs"], F_PRESS["clipped"]),
    "error": (F_PRESS["error"],),
    "box": box_columns(),
}
BOUNDED = {"surface": 2, "direction": 1}  # the column of counts of computes that bin contacts by an angle
MOTION = {
    "x": ("x", "y", "z"),
    "v": ("vx", "vy", "vz"),
    "omega": ("omegax", "omegay", "omegaz"),
    "force": ("fx", "fy", "fz"),
    "torque": ("tqx", "tqy", "tqz"),
}


def press(target, rate=RATE, every=7e-4):
    return f"fix press all press/strain axis y target {target:g} shear xy rate {rate} every {every}"


@dataclass(frozen=True)
class Questions:
    """What of all this is asked: a deck with `ledger on`, fix press/strain, one shape, can be asked everything."""

    packing: object
    ledger: bool = True
    pressed: bool = True

    def computes(self):
        surface = [SURFACE] if self.packing.atom_style == "superquadric" else []
        ledger = [EXACT, LEDGER] if self.ledger else []
        return [
            STRESS,
            INSTANT,
            STEP,
            NEMATIC,
            *ledger,
            FABRIC,
            DIRECTION,
            *surface,
            FLUCTUATION,
            LAYERING,
            DIRECT,
            MESH,
            DISPLACEMENT,
            MEMORY,
        ]

    def defined(self, rate=RATE):
        """Variables and computes; `rate` is that of the flow, which comes before."""
        return [
            *strain_lines(rate),
            *(w.define("all") for w in (*self.computes(), GRAIN)),
            "compute rows all contact/local",
        ]

    def output(self, every=1):
        quantities = [q for w in self.computes() for q in w.columns()]
        quantities += [q for names in PRESS.values() for q in names if self.pressed or q[0] != "f"]
        columns = grain_columns(self.packing, *GRAIN.atom_columns())
        return [
            *thermo(every, *quantities),
            *dump_grains(self.packing, every, columns=columns),
            *dump_local("rows", ROW_WIDTH, every, "rows"),
        ]


def _blocks_of_thermo(questions, table):
    """(name, values of shape (steps, entries))."""
    for watched in questions.computes():
        prefix = f"c_{watched.name}"
        vector = {k: table[f"{prefix}[{k}]"] for k in range(1, watched.vector + 1)}
        if watched.scalar:
            vector[0] = table[prefix]
        for label, entries in BLOCKS.get(watched.name, {}).items():
            yield f"{watched.command.split(' bins')[0]}: {label}", np.stack([vector[k] for k in entries], axis=1)
    for label, names in PRESS.items():
        if questions.pressed or label == "box":
            yield f"fix press/strain: {label}", np.stack([table[q] for q in names], axis=1)


def _tables_of_thermo(questions, table):
    """(watched, values of shape (steps, bins, columns))."""
    for watched in questions.computes():
        rows, columns = watched.array
        if rows:
            values = [[table[f"c_{watched.name}[{r}][{c}]"] for c in range(1, columns + 1)] for r in range(1, rows + 1)]
            yield watched, np.moveaxis(np.array(values), 2, 0)


def rows_from_lower(rows, grains):
    """Rows with i the lower number, points relative to its centre, in a fixed order: whichever owner wrote them."""
    rows = {name: np.array(values) for name, values in rows.items()}
    rows["point"] = rows["point"] - grains.x[grains.index(rows["id"][:, 0])]
    turned = rows["id"][:, 0] > rows["id"][:, 1]
    rows["point"][turned] += rows["branch"][turned]
    rows["id"][turned] = rows["id"][turned][:, ::-1]
    for name in ("image", "normal", "branch", "force", "ft", "ut"):
        rows[name][turned] *= -1.0
    order = np.lexsort((*np.round(rows["image"].T), rows["id"][:, 1], rows["id"][:, 0]))
    return {name: values[order] for name, values in rows.items()}


def _scaled(found, expected, scale=None):
    scale = max(float(np.abs(expected).max(initial=0.0)), 1e-300) if scale is None else scale
    return float(np.abs(found - expected).max(initial=0.0)) / scale


class Differences(dict):
    """The worst difference of each quantity, over its scale. `moved`: contacts that two runs count in neighbouring
    bins."""

    moved = 0

    def note(self, name, value):
        self[name] = max(self.get(name, 0.0), value)

    def merge(self, other):
        for name, value in other.items():
            self.note(name, value)
        self.moved += other.moved


def _compare_bins(watched, found, expected, differences):
    """Column by column. A contact on the edge between two bins may be counted in either: those bins are then compared
    in sum only."""
    name, counts = watched.command.split(" bins")[0], BOUNDED.get(watched.name)
    alike = np.ones(expected.shape[:2], dtype=bool)
    if counts is not None:
        alike = found[:, :, counts] == expected[:, :, counts]
        differences.moved += int((~alike).sum())
        require(
            bool((found[:, :, counts].sum(axis=1) == expected[:, :, counts].sum(axis=1)).all()),
            f"{name}: contacts over all bins differ",
        )
    for column in range(expected.shape[2]):
        scale = float(np.abs(expected[:, :, column]).max())
        if (
            watched.name in ("direct", "mesh", "memory") and column == 2
        ):  # a sum of terms of either sign, of which there are [4]
            scale = max(scale, np.sqrt(expected[:, :, 3].max()) * 0.1)
        differences.note(
            f"{name}: bins", _scaled(found[:, :, column][alike], expected[:, :, column][alike], max(scale, 1e-300))
        )


def differences(questions, found, expected, moments=slice(None), numbers=None):
    """Of two results: every number that was printed at these moments. `numbers`: what grain 1, 2, ... of `found` is
    called in `expected`."""
    worst, tables = Differences(), [
        {name: values[moments] for name, values in r.thermo()[-1].items()} for r in (found, expected)
    ]
    require(len(tables[0]["step"]) == len(tables[1]["step"]) > 0, "different steps")
    for (name, a), (_, b) in zip(*(_blocks_of_thermo(questions, t) for t in tables)):
        require(bool(np.isfinite(a).all()), f"{name}: not finite")
        # P/P_t - 1 is of the order 1, and dL/dt = k_p P_t (P/P_t - 1), where P is near its target too.
        scale = 1.0 if name.endswith(": error") else None
        if name.endswith(": dL/dt"):
            scale = float(np.abs(b).max()) / min(max(float(np.abs(tables[1][F_PRESS["error"]]).max()), 1e-300), 1.0)
        worst.note(name, _scaled(a, b, scale or None))
    for (watched, a), (_, b) in zip(*(_tables_of_thermo(questions, t) for t in tables)):
        _compare_bins(watched, a, b, worst)
    grains = [[columns for _, columns in r.dump("grains.dump")][moments] for r in (found, expected)]
    rows = [[rows_of(table, "rows") for _, table in r.dump("rows.dump")][moments] for r in (found, expected)]
    if numbers is not None:
        grains[0], rows[0] = [_renamed(columns, numbers) for columns in grains[0]], [
            {**r, "id": numbers[r["id"].astype(int) - 1]} for r in rows[0]
        ]
    _compare_grains(*grains, worst)
    _compare_rows(
        *([rows_from_lower(r, grains_of(columns)) for r, columns in zip(*pair)] for pair in zip(rows, grains)), worst
    )
    return worst


def _renamed(columns, numbers):
    columns = {**columns, "id": numbers[columns["id"].astype(int) - 1]}
    order = np.argsort(columns["id"])
    return {name: values[order] for name, values in columns.items()}


def _largest(tables, *names):
    return max(max(float(np.abs(table[name]).max(initial=0.0)) for table in tables for name in names), 1e-300)


def _compare_grains(found, expected, worst):
    """Grains are about 1 large: positions are compared relative to 1, torques to the largest force times 1."""
    scales = {"x": 1.0, "torque": _largest(expected, *MOTION["force"])}
    for label, names in (
        *MOTION.items(),
        *((f"[{k}]", (word,)) for k, word in enumerate(outputs("contact/grain").of("grain").all("per grain"), 1)),
    ):
        scale = scales.get(label) or _largest(expected, *names)
        for a, b in zip(found, expected):
            value = max(_scaled(a[n], b[n], scale) for n in names)
            worst.note(f"contact/grain: {label}" if label[0] == "[" else f"grains: {label}", value)
    for a, b in zip(found, expected):
        if "quat1" in b:
            a, b = (np.stack([c[f"quat{k}"] for k in range(1, 5)]) for c in (a, b))
            worst.note("grains: quaternion", _scaled(a * np.sign((a * b).sum(axis=0)), b))


def _compare_rows(found, expected, worst):
    force, speed, overlap = (_largest(expected, *names) for names in (("force",), ("un", "ut"), ("overlap",)))
    scales = {
        "force": force,
        "fn": force,
        "fn_damping": force,
        "ft": force,
        "un": speed,
        "ut": speed,
        "overlap": overlap,
        "slip": overlap,
    }
    for a, b in zip(found, expected):
        same = a["id"].shape == b["id"].shape and (a["id"] == b["id"]).all() and (a["image"] == b["image"]).all()
        require(bool(same), f"{len(a['id'])} contacts, and {len(b['id'])}: not the same ones")
        for name in ROW_COLUMNS:
            if name not in ("id", "image"):
                worst.note(f"contact/local: {name}", _scaled(a[name], b[name], scales.get(name, 1.0)))
