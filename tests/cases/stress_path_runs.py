# SPDX-License-Identifier: GPL-2.0-or-later
"""Stress paths of fix press/strain: packings come to isotropic pressure, the energy ledger closes along every path and
its works are those of the stresses, and the critical state does not depend on how it is reached."""
import math
from pathlib import Path

import numpy as np

from case import main, require, require_close
from deck import Deck, number, rayleigh_time, thermo
from grainscope.columns import outputs
from ledger import LEDGER, TOTALS, UNDAMPED, account, require_closed, with_ledger
from packing import DENSITY, dense_packing
from run import run
from run_example import table

C_P = outputs("press/strain").of("press")
C_S = outputs("stress/contact").of("s")
EDGES, PLANES = "xyz", ("xy", "xz", "yz")
EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


# Isotropic pressure from a dilute start


def random_start(grains, alpha):
    """Lines of a deck: equal grains at random in a cube, at a solid fraction of 0.4, pushed apart and at rest."""
    edge = (4.0 / 3.0 * math.pi * alpha * grains / 0.4) ** (1.0 / 3.0)
    sphere = alpha == 1.0
    shape = "radius constant 1" if sphere else f"shape constant 1 1 {number(alpha)} blockiness constant 2 2"
    return [
        "atom_style " + ("sphere" if sphere else "superquadric"),
        "atom_modify map array",
        "boundary p p p",
        "newton off",
        "communicate single vel yes",
        "units si",
        f"region box block 0 {number(edge)} 0 {number(edge)} 0 {number(edge)} units box",
        "create_box 1 box",
        "neighbor 0.2 bin",
        "neigh_modify delay 0 contact_distance_factor 1.05",
        "fix young all property/global youngsModulus peratomtype 5e6",
        "fix poisson all property/global poissonsRatio peratomtype 0.3",
        "fix restitution all property/global coefficientRestitution peratomtypepair 1 0.3",
        "fix friction all property/global coefficientFriction peratomtypepair 1 0.3",
        "pair_style gran/insitu model hertz tangential history"
        + " surface ellipsoid" * (not sphere)
        + " setup neutral",
        "pair_coeff * *",
        f"timestep {number(0.15 * rayleigh_time())}",
        "fix integrate all nve/" + ("sphere" if sphere else "spheroid"),
        f"fix grain all particletemplate/{'sphere' if sphere else 'superquadric'} 10007 atom_type 1 density constant "
        f"{number(DENSITY)} {shape}",
        "fix sizes all particledistribution/discrete/numberbased 10141 1 grain 1.0",
        "fix insert all insert/pack seed 15485863 distributiontemplate sizes insert_every once overlapcheck no "
        f"all_in no {'' if sphere else 'orientation random '}region box particles_in_region {grains}",
        "fix slow all viscous 5e3",
        "thermo 1000",
        "run 1500",
        "unfix insert",
        "unfix slow",
        "velocity all set 0 0 0",
        "set group all omegax 0 omegay 0 omegaz 0",
    ]


def isotropic(grains, alpha, least_fraction):
    """All three edges have one target; over the last 2000 steps the stress of compute stress/contact is that in every
    direction to 0.1 %, and the packing is jammed."""

    def case(ranks):
        target, steps, last = 1000.0, 8000, 2000
        press = " ".join(f"{edge} target {number(target)}" for edge in EDGES)
        rate = 0.02 * math.sqrt(target / DENSITY) / 2.0
        lines = [
            *random_start(grains, alpha),
            "reset_timestep 0",
            f"fix press all press/strain {press} every/step 20 maxrate {number(rate)}",
            "compute s all stress/contact",
            "compute state all packing",
            f"variable s_xx equal {C_S['sxx']}",
            f"variable s_yy equal {C_S['syy']}",
            f"variable s_zz equal {C_S['szz']}",
            f"fix mean all ave/time 1 {last} {last} v_s_xx v_s_yy v_s_zz file mean.txt",
            *thermo(steps, *outputs("packing").of("state").vector(), "lx", "ly", "lz"),
            f"run {steps}",
        ]
        result = run("\n".join(lines) + "\n", ranks)
        means = result.averages("mean.txt")
        found = np.array([-means[f"v_s_{edge}{edge}"][-1] for edge in EDGES])
        names = outputs("packing").of("state")
        state = {name: result.thermo()[-1][names[name]][-1] for name in ("phi", "Z")}
        print(f"pressures {found / target}, phi {state['phi']:.4f}, Z {state['Z']:.3f}")
        require_close(found / target, np.ones(3), 1e-3, "pressures over the target")
        # With friction of 0.3 random packings of spheres jam between 0.59 and 0.62; Z is at least 4 there.
        require(least_fraction < state["phi"] < 0.72, f"solid fraction {state['phi']}")
        require(state["Z"] > 4.0, f"coordination number {state['Z']}")

    return case


# Energy along stress paths

PATHS = {
    "triaxial": "x target 2e5 y target 2e5 z rate -0.05 every 1e-3 maxrate 0.2",
    "isotropic": "x target 2e5 y target 2e5 z target 2e5 every/step 10 maxrate 0.05",
    "mean": "mean target 2e5 ratio 1 2 0 z rate -0.05 every 1e-3 maxrate 0.2",
    "constant-volume": "x rate 0.025 y rate 0.025 z rate -0.05 every 1e-3",
    "two-planes": "y target 2e5 shear xy rate 0.05 shear yz rate 0.03 every 1e-3",
    "two-planes-one-held": "y target 2e5 shear xy rate 0.05 shear xz target 2e4 every 1e-3 maxrate 0.2",
}
STEPS = 500  # to a strain of 0.17 at a rate of 0.05
RATES = [C_P[f"rate_{mode}"] for mode in (*EDGES, *PLANES)]
STRESSES = [C_S[name] for name in ("sxx", "syy", "szz", "sxy", "sxz", "syz")]
KINETIC = [C_S[f"{name}_kinetic"] for name in ("sxx", "syy", "szz", "sxy", "sxz", "syz")]


def works_of_stresses(rows, dt):
    """Works of edges and of tilts: stress of both ends of each step times its strain. The volume of a row is that of
    the step to come."""
    volume = np.concatenate([rows["vol"][:1], rows["vol"][:-1]])
    works = []
    for rate, s, k in zip(RATES, STRESSES, KINETIC):
        stress = volume * (rows[s] + rows[k])
        works.append(dt * np.sum(rows[rate][:-1] * 0.5 * (stress[:-1] + stress[1:])))
    return sum(works[:3]), sum(works[3:])


def ledger_closes(path, alpha=1.5):
    """residual_relative is rounding. W_box and W_shear are the sums of stress x volume x strain, which compute
    stress/contact and the fix know. A rate is told over the length to which its step leads, off by the strain of half a
    step: 1e-3 at most, where an edge is far from its target; all in all 4e-5 of the work."""

    def case(ranks):
        packing = dense_packing(alpha, speed=0.1, atom_style="sphere" if alpha == 1.0 else "superquadric")
        deck = with_ledger(Deck(packing, extra=UNDAMPED, surface="ellipsoid"))
        turn = [] if alpha == 1.0 else ["unfix integrate", "fix integrate all nve/spheroid"]
        columns = [*TOTALS, *RATES, *STRESSES, *KINETIC, "vol", "xz", "yz"]
        deck.body = [
            *turn,
            f"fix press all press/strain {PATHS[path]}",
            LEDGER,
            "compute s all stress/contact",
            *thermo(1, *columns),
            f"run {STEPS}",
        ]
        rows = run(deck, ranks).thermo()[0]
        a = account(rows)
        require_closed(a)
        require(abs(a["residual_relative"]) < 1e-10, f"residual_relative {a['residual_relative']}")
        box, shear = works_of_stresses(rows, deck.dt())
        scale = abs(a["W_box"]) + abs(a["W_shear"])
        print(f"W_box {a['W_box']:.8g} and {box:.8g}, W_shear {a['W_shear']:.8g} and {shear:.8g}")
        require(scale > 0.0, "no work")
        require_close([a["W_box"], a["W_shear"]], [box, shear], 2e-4, "works, ledger against stresses", scale)
        if path == "constant-volume":
            # The edges' rates are those at the end of each step: 3/4 (rate dt)^2 a step.
            drift = STEPS * 0.75 * (0.05 * deck.dt()) ** 2
            require_close(rows["vol"][-1] / rows["vol"][0], 1.0, 2.0 * drift, "volume")
        if path == "two-planes":
            require(abs(rows["yz"][-1]) > 0.1, "no tilt yz")

    return case


# The critical state


def late_part(path, column, begin, blocks=6):
    """Means and errors of all columns from `begin` of `column` on."""
    data = table(path)
    late = data[column] >= begin
    answer = {}
    for name, values in data.items():
        parts = [part.mean() for part in np.array_split(values[late], blocks)]
        answer[name] = (np.mean(parts), np.std(parts, ddof=1) / math.sqrt(blocks))
    return answer


def require_alike(one, other, what):
    """Two means with their errors, of six blocks each: Student's t of ten degrees of freedom is beyond 5 once in
    2000."""
    (a, error_a), (b, error_b) = one, other
    error = math.hypot(error_a, error_b)
    print(f"{what}: {a:.5g} +- {error_a:.2g}, {b:.5g} +- {error_b:.2g}: {abs(a - b) / error:.1f} errors apart")
    require(abs(a - b) <= 5.0 * error, f"{what}: {a} +- {error_a} against {b} +- {error_b}")


def example(name, deck, ranks, **variables):
    arguments = [word for key, value in variables.items() for word in ("-var", key, str(value))]
    return run((EXAMPLES / name / deck).read_text(), ranks, arguments=arguments)


def dense_and_loose(ranks):
    """A dense and a loose sample end in one critical state; only the dense one has a peak, and dilates."""
    ends, tables = [], []
    for friction in ("0.05", "10"):
        result = example("triaxial", "in.triaxial", ranks, N=600, I=2e-3, mu0=friction)
        path = result.file("triaxial.txt")
        ends.append(late_part(path, "eps_1", 0.3))
        tables.append(table(path))
    # Such means of other seeds scatter by 0.03, 0.0015 and 0.05, slowly along a run: five of that, of a difference.
    for name, tolerance in (("q_p", 0.21), ("phi", 0.0105), ("Z", 0.35)):
        values = [end[name][0] for end in ends]
        print(f"{name}: dense {values[0]:.5g}, loose {values[1]:.5g}")
        require_close(values[0], values[1], tolerance, f"{name} of dense and loose", 1.0)
    dense, loose = tables
    require(dense["phi"][0] > loose["phi"][0] + 0.03, "starts differ")
    require(dense["q_p"].max() > ends[0]["q_p"][0] + 0.2, "peak of the dense sample")
    require(dense["eps_v"].min() < -0.04, "dilatancy of the dense sample")


def pressure_and_volume(ranks):
    """Sheared at constant pressure, and from another start at the solid fraction of that: the same stresses."""
    held = late_part(example("triaxial", "in.shear", ranks).file("shear.txt"), "strain", 1.5)
    phi, error = held["phi"]
    kept = late_part(
        example("triaxial", "in.shear", ranks, phi=f"{phi:.6f}", seed=49979687).file("shear.txt"), "strain", 1.5
    )
    require_close(kept["phi"][0], phi, 2e-5, "solid fraction that is kept")
    for name in ("mu_eff", "Z"):
        require_alike(held[name], kept[name], f"{name}, pressure and volume held")
    # Here ln P grows by 47 phi (flows at 0.6132 and 0.6182), so that the error of phi is one of the pressure.
    pressure = held["P_y"][0]
    require_alike((pressure, 47.0 * error * pressure), kept["P_y"], "P_y, pressure and volume held")


CASES = {
    "isotropic-spheres": isotropic(500, 1.0, 0.58),
    "isotropic-spheroids": isotropic(500, 1.5, 0.60),
    **{f"ledger-{path}": ledger_closes(path) for path in PATHS},
    "ledger-triaxial-spheres": ledger_closes("triaxial", 1.0),
    "critical-dense-and-loose": dense_and_loose,
    "critical-pressure-and-volume": pressure_and_volume,
}


if __name__ == "__main__":
    main(CASES)
