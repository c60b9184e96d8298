# SPDX-License-Identifier: GPL-2.0-or-later
"""A long shear flow on one rank and on several: two chaotic runs, whose means agree within what they fluctuate."""
import math

import numpy as np

from case import main, require
from deck import Deck, number, thermo
from grainscope.columns import outputs
from packing import DENSITY, dense_packing
from run import run

C_LOSS = outputs("dissipation").of("loss")
C_ORDER = outputs("nematic").of("order")
C_S = outputs("stress/contact").of("s")

INERTIAL, TARGET = 0.1, 500.0
SETTLE, BLOCK, BLOCKS = 4.0, 2.0, 10  # strains: the memory of orientations is about 1
QUANTITIES = {
    "mu": C_S["mu_eff"],
    "phi": "v_phi",
    "P_t/(gd P V)": "v_loss",
    "P_n/(gd P V)": "v_damped",
    "S2": "c_order",
    "Z": C_S["Z"],
    "theta_x": C_ORDER["theta"],
    "P/P_t": "v_pressure",
}
# Of ten blocks the error of a mean is known to a quarter: Student's t with 18 degrees of freedom is beyond 4 in 0.08 %
# of comparisons.
SIGMAS = 4.0


def flow(ranks, alpha=1.5):
    """Mean and its error of every quantity, from means over blocks of strain; and the last places of the grains."""
    packing = dense_packing(alpha, overlap=-0.02, speed=0.05, minimum=250)
    volume = sum(g.volume() for g in packing.grains)
    rate = INERTIAL / (2.0 * alpha ** (1.0 / 3.0) * math.sqrt(DENSITY / TARGET))
    deck = Deck(packing, surface="ellipsoid", extra="tangential_damping off", timestep=0.0)
    per_strain = round(1.0 / (rate * deck.dt()))
    steps, every = round((SETTLE + BLOCK * BLOCKS) * per_strain), max(per_strain // 200, 1)
    deck.body = [
        "unfix integrate",
        "fix integrate all nve/spheroid",
        f"fix press all press/strain axis y target {TARGET} shear xy rate {number(rate)} every 5e-4",
        "compute s all stress/contact",
        "compute loss all dissipation",
        "compute order all nematic",
        f"variable phi equal {volume!r}/vol",
        f"variable loss equal {C_LOSS['P_t']}/({rate!r}*{TARGET}*vol)",
        f"variable damped equal {C_LOSS['P_n']}/({rate!r}*{TARGET}*vol)",
        f"variable pressure equal {C_S['P']}/{TARGET}",
        *thermo(every, *QUANTITIES.values(), C_S["overlap_mean"]),
        f"run {steps}",
    ]
    table = run(deck, ranks).thermo()[0]
    print(f"{ranks} rank(s): {len(packing.grains)} grains, {steps} steps", flush=True)
    strain = table["step"] * rate * deck.dt() - SETTLE
    results = {}
    for name, column in QUANTITIES.items():
        means = np.array(
            [table[column][(strain >= k * BLOCK) & (strain < (k + 1) * BLOCK)].mean() for k in range(BLOCKS)]
        )
        results[name] = means.mean(), means.std(ddof=1) / math.sqrt(BLOCKS)
    return results, table[C_S["overlap_mean"]][-1]


def same_means(ranks):
    (one, end_of_one), (many, end_of_many) = flow(1), flow(ranks)
    require(abs(end_of_one - end_of_many) > 1e-6 * end_of_one, "the two runs have not parted: they prove nothing")
    for name in QUANTITIES:
        (a, ea), (b, eb) = one[name], many[name]
        error = math.hypot(ea, eb)
        print(f"{name}: {a:.5g} +- {ea:.2g} on one rank, {b:.5g} +- {eb:.2g} on {ranks}: {(b - a) / error:+.2f} sigma")
    for name in QUANTITIES:
        (a, ea), (b, eb) = one[name], many[name]
        require(math.hypot(ea, eb) < 0.1 * abs(a), f"{name} = {a} +- {ea}: nothing is proved by agreement")
        require(abs(a - b) <= SIGMAS * math.hypot(ea, eb), f"{name}: {a} +- {ea} on one rank, {b} +- {eb} on {ranks}")


CASES = {"prolate-flow": same_means}

if __name__ == "__main__":
    main(CASES)
