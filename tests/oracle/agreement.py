# SPDX-License-Identifier: GPL-2.0-or-later
"""Prints, as a Markdown table, the largest difference between grainscope and the oracle for each quantity, relative to
its size, by aspect ratio: the largest over friction coefficients and snapshots of sheared packings.

    GRAINSCOPE_BINARY=build/release/bin/grainscope PYTHONPATH=tests/tools:tests python3 tests/oracle/agreement.py
      [ranks] [open|periodic]

open: a cluster in a box so large that no contact crosses a face, each evaluated once: rounding errors are all that is
left. periodic: a dense packing; contacts of non-spheres across faces and ranks are evaluated by both owners, by a
solver that stops at about 1e-7."""
import os
import re
import sys
import tempfile

import catalogue as c
from deck import Deck, Material
from oracle import comparison, correlation, motion
from oracle import comparison_motion as moving
from packing import dense_packing, in_the_open
from watch import deforming, image_of, watch

ALPHAS, FRICTIONS = ("sphere", 0.33, 0.67, 1.0, 1.5, 3.0), (0.0, 0.4, 10.0)
RATE, DOUBT = 0.05, 1e-4


def packing_of(alpha, where):
    style = {"atom_style": "sphere"} if alpha == "sphere" else {}
    number = 1.0 if alpha == "sphere" else alpha
    if where == "open":
        return in_the_open(dense_packing(number, overlap=0.03, speed=0.1, **style))
    return dense_packing(number, **style)


def of_contacts(moment, packing, doubt):
    printed = moment.vector(c.FABRIC)
    yield from comparison.of_fabric(printed[:22], moment.rows)
    yield from comparison.of_weighted(printed[22:], moment.rows)
    yield from comparison.of_direction(moment.array(c.DIRECTION), moment.rows, doubt=doubt)
    yield from comparison.of_grains(moment.peratom(c.GRAIN), moment.rows, moment.grains, moment.chosen)
    if packing.atom_style == "superquadric":
        yield from comparison.of_surface(moment.array(c.SURFACE), moment.vector(c.SURFACE), moment, doubt=doubt)


def of_motion(moment):
    yield from moving.of_fluctuation(moment.vector(c.FLUCTUATION), moment.array(c.FLUCTUATION), moment, layers=4)
    yield from moving.of_layering(moment.vector(c.LAYERING), moment.array(c.LAYERING), moment, layers=10)
    yield from moving.of_correlation(moment.vector(c.DIRECT), moment.array(c.DIRECT), moment, bins=6)
    yield from moving.of_correlation(moment.vector(c.MESH), moment.array(c.MESH), moment, bins=6, reach=4.037, mesh=4)


def of_series(moments):
    strains = [m.printed["v_strain"] for m in moments]
    calls = [(m.grains.x, image_of(m), m.box, m.force_box, s) for m, s in zip(moments, strains)]
    last = moments[-1]
    yield from moving.of_displacement(last.vector(c.DISPLACEMENT), calls)
    taken = correlation.samples_of(strains, 1e-4)
    samples = [motion.of_group(m.grains, m.chosen, m.box)[0][:, 1] for m in (moments[k] for k in taken)]
    yield from moving.of_memory(last.vector(c.MEMORY), last.array(c.MEMORY), samples, [strains[k] for k in taken], 3)


def differences(alpha, friction, where, ranks):
    packing = packing_of(alpha, where)
    deck = Deck(
        packing, extra="tangential_damping off", material=Material(friction=(friction,)), body=c.strain_lines(RATE)
    )
    moments = watch(
        deck,
        c.everything(packing),
        deforming(RATE),
        ranks,
        settle=5 if where == "open" else 100,
        every=1,
        steps=10,
        extra=("v_strain",),
    )
    doubt = 0.0 if alpha == "sphere" or (where == "open" and ranks == 1) else DOUBT
    for moment in moments[::5]:
        if not len(moment.rows["fn"]):
            raise SystemExit(f"no contacts at alpha {alpha}, mu {friction}, step {moment.step}")
        yield from of_contacts(moment, packing, doubt)
        yield from of_motion(moment)
    yield from of_series(moments)


def table(where, ranks):
    worst = {}
    for alpha in ALPHAS:
        for friction in FRICTIONS:
            for one in differences(alpha, friction, where, ranks):
                name = re.sub(", all bins$", " (sum)", one.name)
                cells = worst.setdefault(name, {})
                cells[alpha] = max(cells.get(alpha, 0.0), one.error())
    print(
        f"| {where}, {ranks} rank(s) | " + " | ".join(f"{a:g}" if a != "sphere" else "spheres" for a in ALPHAS) + " |"
    )
    print("|---" * (len(ALPHAS) + 1) + "|")
    for name, cells in worst.items():
        print(
            f"| {name} | "
            + " | ".join(f"{cells[a]:.0e}" if cells.get(a) else "0" if a in cells else "-" for a in ALPHAS)
            + " |"
        )


if __name__ == "__main__":
    with tempfile.TemporaryDirectory(prefix="grainscope-") as scratch:
        os.environ["GRAINSCOPE_SCRATCH"] = scratch
        table(sys.argv[2] if len(sys.argv) > 2 else "open", int(sys.argv[1]) if len(sys.argv) > 1 else 1)
