# SPDX-License-Identifier: GPL-2.0-or-later
"""A small sheared packing at held pressure for very many steps, everything measured now and then and restart files
written: memory stays flat, the ledger closed, the pressure held."""
from dataclasses import replace

import numpy as np

from case import main, require, require_close
from catalogue import everything
from deck import Deck, thermo
from grainscope.columns import outputs
from memory import NOTED, SANITIZED, require_flat, watched_run
from packing import dense_packing
from watch import Watched

C_E = outputs("energy/ledger").of("e")
C_FABRIC = outputs("fabric").of("fabric")
C_GRAIN = outputs("contact/grain").of("grain")
C_MOVING = outputs("fluctuation").of("moving")
C_ROWS = outputs("contact/local").of("rows")
C_STRESS = outputs("stress/contact").of("stress")
F_PRESS = outputs("press/strain").of("press")

RATE, TARGET = 0.02, 2e4
MORE = [
    Watched("stress", "stress/contact", True, 36),
    Watched("power", "dissipation", True, 10),
    Watched("step", "dissipation mode step", True, 10),
    Watched("booked", "dissipation mode ledger", True, 10),
    Watched("order", "nematic", True, 20),
    Watched("e", "energy/ledger", True, 37),
    Watched("solver", "contact/solver", True, 6),
]


def measures(packing):
    spheroids = packing.atom_style == "superquadric"
    computes = everything(packing) + (MORE if spheroids else [w for w in MORE if w.name not in ("order", "solver")])
    return [replace(w, command=w.command.replace(" strain v_strain", "")) for w in computes]


def soaked(packing, steps, chunk, every):
    """The deck: `steps` in runs of `chunk`, everything printed every `every` steps; memory noted after each run."""
    deck = Deck(packing, surface="ellipsoid", extra="ledger on tangential_damping off")
    if packing.atom_style == "superquadric":
        deck.body = ["unfix integrate", "fix integrate all nve/spheroid"]
    computes = measures(packing)
    asked = [q for w in computes for q in w.columns()]
    deck.body += [
        f"fix press all press/strain axis y target {TARGET} shear xy rate {RATE} every 1e-3",
        *(w.define("all") for w in computes),
        "compute rows all contact/local",
        f"compute largest all reduce max {C_ROWS['normal_z']} {C_GRAIN['N_c']}",
        *thermo(every, F_PRESS["strain"], "f_press", *asked, "c_largest[1]", "c_largest[2]"),
        f"fix means all ave/time {every // 20} 10 {every} f_press {C_E['residual']} {C_STRESS['P']} "
        f"{C_FABRIC['angle']} {C_MOVING['E_ratio']} file means.txt",
        f"fix curve all ave/time {every // 2} 1 {every} c_direct mode vector file curve.txt",
        f"dump rows all local {chunk} rows.dump {C_ROWS['id_i']} {C_ROWS['id_j']} {C_ROWS['overlap']}",
        f"dump grains all custom {chunk} grains.dump id x y z {C_GRAIN['N_c']} {C_GRAIN['P_t']}",
        f"restart {chunk // 2} soak.a.restart soak.b.restart",
    ]
    deck.body += [f"run {chunk}", NOTED] * (steps // chunk)
    return deck


def soak(packing, steps, chunk, every):
    def case(ranks):
        length = steps // 5 if SANITIZED else steps
        deck = soaked(packing, length, chunk, every)
        result, kilobytes = watched_run(deck, ranks)
        last = result.thermo()[-1]
        require(all(np.isfinite(v).all() for v in last.values()), "a measure is not finite")
        # Lists and the measures' bins have found their largest size in the first tenth.
        require_flat(kilobytes[len(kilobytes) // 10 :], 512.0, f"{len(packing.grains)} grains, {length} steps")
        require_close(last[F_PRESS["strain"]][-1], RATE * length * deck.dt(), 1e-9, "strain")
        # A residual is a sum of `steps` rounding errors of 1e-16 of energies up to 1e3 times what was lost in a step.
        require(last["c_e"][-1] < 1e-9, f"the ledger's residual is {last['c_e'][-1]} of the losses")
        means = result.averages("means.txt")["f_press"]
        # Some 100 grains: the pressure of an instant swings by a tenth or so, its mean over the second half does not.
        require_close(means[len(means) // 2 :].mean(), TARGET, 0.05, "mean pressure")
        print(
            f"residual {last['c_e'][-1]:.2e} of the losses; strain {last[F_PRESS['strain']][-1]:.3f}; mean pressure "
            f"{means[len(means) // 2:].mean():.0f}"
        )

    return case


SPHEROIDS = dense_packing(1.5, minimum=32)
SPHERES = dense_packing(atom_style="sphere", minimum=32)

CASES = {
    "spheroids-over-1e4-steps": soak(SPHEROIDS, 10000, 500, 100),
    "spheroids-over-1e5-steps": soak(SPHEROIDS, 100000, 5000, 500),
    "spheroids-over-1e6-steps": soak(SPHEROIDS, 1000000, 20000, 1000),
    "spheres-over-1e6-steps": soak(SPHERES, 1000000, 20000, 1000),
}

if __name__ == "__main__":
    main(CASES)
