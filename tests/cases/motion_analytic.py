# SPDX-License-Identifier: GPL-2.0-or-later
"""fluctuation, layering and displacement/shear where the answer is known by hand."""
from dataclasses import replace
import math

import numpy as np

from case import main, require, require_close, require_equal
from deck import Deck, number, thermo
from grainscope.columns import outputs
from packing import DENSITY, Grain, Packing, dense_packing, numbers, tilted
from run import run
from watch import Flow, Watched, deforming, watch

C_MEMORY = outputs("velocity/memory").of("memory")
C_MOVED = outputs("displacement/shear").of("moved")

FLUCTUATION = Watched("moving", "fluctuation", True, 14, (10, 5))
MOVED = Watched("moved", "displacement/shear strain v_strain", True, 8)
RATE, STRETCH = 0.2, 0.1


def gas(**choices):
    """Spheres so far apart that they never touch, sheared by 1."""
    return dense_packing(atom_style="sphere", overlap=-0.8, speed=0.0, **choices)


def carried(packing, rate=RATE, stretch=STRETCH, drift=(0.0, 0.0, 0.0), plane=(0, 1)):
    """With the velocities of the affine flow, and a drift."""
    (a, b), middle = plane, 0.5 * np.array(packing.edges)

    def velocity(grain):
        y, v = grain.position[b] - middle[b], np.array(drift, dtype=float)
        v[a] += rate * y
        v[b] += stretch * y
        return tuple(v)

    return replace(packing, grains=[replace(g, velocity=velocity(g), omega=(0.1, -0.2, 0.3)) for g in packing.grains])


def affine_flow(packing, rate=RATE, stretch=STRETCH):
    """The host's fix: tilt grows by `rate` x (first L_y), L_y at `stretch` x (first L_y): straight lines in time, so
    that grains at constant velocities move affinely."""
    velocity = f"y vel {number(stretch * packing.edges[1])} " if stretch else ""
    return Flow(f"fix flow all deform 1 xy erate {number(rate)} {velocity}remap v", rate)


def observed(packing, ranks, computes, flow, steps=400, every=40):
    deck = Deck(packing, body=[f"variable strain equal step*dt*{number(flow.rate)}"])
    return watch(deck, computes, flow, ranks, steps=steps, every=every, thermo_every=every, contacts=False), deck.dt()


def affine(fraction, sign=1.0, stretch=STRETCH):
    """A cloud that follows the box: no fluctuations and no displacements, through a flip, wraps, and a moving L_y."""

    def case(ranks):
        rate = sign * RATE
        packing = carried(tilted(gas(), fraction), rate, stretch)
        computes = [
            FLUCTUATION,
            MOVED,
            Watched("fitted", "fluctuation flow fit", True, 14, (10, 5)),
            Watched("layered", "fluctuation flow layers 5", True, 14, (10, 5)),
            Watched("memory", "velocity/memory strain v_strain lags 4", True, 3, (5, 4)),
        ]
        moments, _ = observed(packing, ranks, computes, affine_flow(packing, rate, stretch))
        tilts = [m.box.edges[0, 1] for m in moments]
        require(np.abs(np.diff(tilts)).max() > 0.8 * packing.edges[0], f"no flip: {tilts}")
        speed = RATE * packing.edges[1]
        for moment in moments:
            still(moment, computes, speed)
            vector = moment.vector(FLUCTUATION)
            slope = rate * packing.edges[1] / moment.box.edges[1, 1]
            require_close(vector[10:12], [slope, slope], 1e-12, "rate of the box, measured rate")
            # Positions are sums of 400 steps.
            require_close(moment.vector(MOVED)[1:7], np.zeros(6), 1e-20, "displacements, D", 1.0)
            require(moment.vector(MOVED)[7] == len(packing.grains), "grains were lost")

    return case


def still(moment, computes, speed):
    for watched in computes:
        if watched.command.startswith("fluctuation"):
            vector = moment.vector(watched)
            require_close(vector[:3], np.zeros(3), 1e-12, f"{watched.command}: rms dv", speed)
            require_close(vector[3:6], np.zeros(3), 1e-14, f"{watched.command}: rms dw", 1.0)
            require_close(vector[12:14], np.zeros(2), 1e-12, f"{watched.command}: profile, noise", 1.0)


def without_gain(rate):
    """fix press/strain as a mere shear."""
    line = f"fix flow all press/strain axis y target 1 shear xy rate {number(rate)} every 1e-3 gain 0 momentum no"
    return Flow(line, rate)


def drifting(sign, plane="xy", by=lambda rate, plane: deforming(rate, plane)):
    """Free flight with a drift u of all grains: d_x = u_x t - rate u_y t^2/2, d_y = u_y t, d_z = u_z t, through wraps
    of all faces and flips, however often it is asked."""
    a, b = axes = tuple("xyz".index(k) for k in plane)
    watched = Watched("moved", "displacement/shear strain v_strain", True, 8)

    def case(ranks):
        drift, rate = np.array([1.7, 2.6, -2.3]), sign * RATE
        packing = carried(tilted(gas(), sign * 0.43), rate, 0.0, drift, axes)
        for every in (10, 80):
            moments, dt = observed(packing, ranks, [watched], by(rate, axes), 800, every)
            for moment in moments:
                t = moment.step * dt
                square = drift * t
                square[a] -= 0.5 * rate * drift[b] * t * t
                square **= 2
                # Positions of 10 grains are sums of 800 steps; squares.
                require_close(
                    moment.vector(watched)[1:4], square, 1e-10, f"step {moment.step}: <d^2>", max(1.0, square.max())
                )
            require(all(moments[-1].columns[i].any() for i in ("ix", "iy", "iz")), "no wraps")
            tilts = [m.box.edges[a, b] for m in moments]
            require(np.abs(np.diff(tilts)).max() > 0.7 * packing.edges[a], f"no flip: {tilts}")

    return case


def rigid(ranks):
    """All grains alike: no fluctuations, whatever their drift and common spin."""
    packing = carried(gas(), 0.0, 0.0, (3.0, -2.0, 1.0))
    moment = watch(Deck(packing), [FLUCTUATION], ranks=ranks, steps=0, contacts=False)[0]
    still(moment, [FLUCTUATION], 3.0)
    require_equal(moment.vector(FLUCTUATION)[9:11], [0.0, 0.0], "lever and rate without shear")


def energies(ranks):
    """Two spheroids a = 1, c = 2, one tilted by 30 degrees: E_tr = 2 x m v^2/2, E_rot = w^2/2 (I_1 + I_2) with
    I = m (2 a^2 cos^2 t + (a^2 + c^2) sin^2 t)/5."""
    speed, spin, tilt = 0.3, 0.7, math.radians(30)
    turned = (math.cos(tilt / 2), math.sin(tilt / 2), 0.0, 0.0)
    grains = [
        Grain((5.0, 5.0, 5.0), (1.0, 1.0, 2.0), turned, (speed, 0.0, 0.0), (0.0, 0.0, spin)),
        Grain((15.0, 15.0, 15.0), (1.0, 1.0, 2.0), (1.0, 0.0, 0.0, 0.0), (-speed, 0.0, 0.0), (0.0, 0.0, -spin)),
    ]
    vector = watch(Deck(Packing((20.0,) * 3, grains)), [FLUCTUATION], ranks=ranks, steps=0, contacts=False)[0].vector(
        FLUCTUATION
    )
    m = DENSITY * 4.0 / 3.0 * math.pi * 2.0
    inertia = m / 5.0 * (2.0 * math.cos(tilt) ** 2 + 5.0 * math.sin(tilt) ** 2) + m / 5.0 * 2.0
    expected = [speed, 0.0, 0.0, 0.0, 0.0, spin, m * speed**2, 0.5 * inertia * spin**2]
    require_close(vector[:8], expected, 1e-13, "rms dv, rms dw, E_tr, E_rot")
    require_close(vector[8], expected[7] / expected[6], 1e-13, "E_rot/E_tr")


def lever(ranks):
    """lever = sqrt<|dv|^2> / (|rate| d_eq): speeds +-s, rate 0.2, d_eq = 2 (abc)^(1/3) or as given."""
    speed, shape = 0.5, (1.0, 1.0, 2.0)
    grains = [
        Grain((10.0, 10.0 + 0.0 * k, 10.0 * k + 5.0), shape, velocity=(0.0, 0.0, speed * (-1) ** k)) for k in range(2)
    ]
    given = Watched("given", "fluctuation diameter 4", True, 14, (10, 5))
    packing = Packing((20.0,) * 3, grains)
    moment = watch(
        Deck(packing), [FLUCTUATION, given], affine_flow(packing, stretch=0.0), ranks, steps=2, every=1, contacts=False
    )[1]
    require_close(moment.scalar(FLUCTUATION), speed / (RATE * 2.0 * 2.0 ** (1 / 3)), 1e-12, "lever")
    require_close(moment.scalar(given), speed / (RATE * 4.0), 1e-12, "lever with the diameter given")


def planes_of_grains(ranks):
    """N grains in 8 planes, 5 layers apart: dn/n = 4 in their layers and -1 elsewhere; C = A n/m (8 x 16 + 32) at
    multiples of 5 layers, A n/m (-2 x 8 x 4 + 24) elsewhere."""
    random, length = np.random.default_rng(5), 16.0
    grains = [
        Grain((random.uniform(0, length), (k % 8 + 0.5) * length / 8, random.uniform(0, length)), (0.1,) * 3)
        for k in range(80)
    ]
    watched = Watched("layers", "layering", True, 4, (21, 2))
    packing = Packing((length,) * 3, grains, atom_style="sphere")
    moment = watch(Deck(packing), [watched], ranks=ranks, steps=0, contacts=False)[0]
    unit = length**2 * (80 / length**3) / 40
    expected = unit * np.where(np.arange(21) % 5 == 0, 160.0, -40.0)
    require_close(moment.array(watched)[:, 1], expected, 1e-12, "C(y)")
    require_close(moment.array(watched)[:, 0], np.arange(21) * length / 40, 1e-14, "lags")
    require_close(
        moment.vector(watched), [160.0 * unit, length / 8, 160.0 * unit, 80.0], 1e-12, "peak, spacing, C(0), grains"
    )
    require_close(moment.scalar(watched), 1.0, 1e-12, "peak over C(0)")


def primes(count, first=10007):
    """The host wants primes beyond 10000 for seeds."""
    found, n = [], first
    while len(found) < count:
        if all(n % d for d in range(2, int(math.sqrt(n)) + 1)):
            found.append(n)
        n += 2
    return found


def random_walk(ranks):
    """Grains jump by uniform random steps within +-a between runs: <d^2> = a^2/3 per jump, so that D = a^2/6 per strain
    of a jump."""
    jump, strain, jumps = np.array([0.3, 0.5, 0.2]), 0.01, 60
    random = np.random.default_rng(2)
    grains = [Grain(tuple(random.uniform(0, 10, 3)), (0.05,) * 3) for _ in range(1000)]
    packing = Packing((10.0,) * 3, grains, atom_style="sphere")
    deck = Deck(
        packing,
        body=[
            "unfix integrate",
            f"variable strain equal step*{strain}",
            "compute moved all " + MOVED.command,
            *thermo(1, *MOVED.columns()),
            "run 0",
        ],
    )
    for seed in primes(jumps):
        deck.body += [f"displace_atoms all random {numbers(jump)} {seed} units box", "run 1"]
    table = run(deck, ranks).thermo()[-1]
    vector = np.array([table[c][-1] for c in MOVED.columns()[1:]])
    require_close(vector[[0, 7]], [jumps * strain, len(grains)], 1e-12, "strain, grains", 1.0)
    # <d^2> of 1000 Gaussian displacements scatters by sqrt(2/1000) = 4.5 %, a slope over correlated points by somewhat
    # more: 4 sigma.
    require_close(vector[1:4] / (jumps * jump**2 / 3.0), np.ones(3), 0.18, "<d^2>")
    require_close(vector[4:7] / (jump**2 / 6.0 / strain), np.ones(3), 0.24, "D")


def later_grains(ranks):
    """Grains that come after the start are neither followed nor averaged over."""
    packing = carried(gas(), 0.0, 0.0)
    lone = replace(packing, grains=packing.grains[1:])
    x = packing.grains[0].position
    deck = Deck(
        lone,
        body=[
            "variable strain equal step*0.01",
            "compute moved all " + MOVED.command,
            *thermo(1, *MOVED.columns()),
            "velocity all set 0.5 0 0 units box",
            "run 5",
            f"create_atoms 1 single {numbers(x)} units box",
            f"set atom {len(packing.grains)} diameter 2 density 1000 vx 9",
            "run 5",
        ],
    )
    table = run(deck, ranks).thermo()[-1]
    require_equal(table[C_MOVED["N"]], np.full(6, len(lone.grains)), "grains tracked")
    require_close(table[C_MOVED["d2_x"]][-1], (0.5 * 10 * deck.dt()) ** 2, 1e-10, "<d_x^2>")


def replaced_grains(ranks):
    """A grain that takes the place of one that was deleted has no past."""
    packing = carried(gas(), 0.0, 0.0)
    last = len(packing.grains)
    deck = Deck(
        packing,
        body=[
            "variable strain equal step*0.01",
            "compute moved all " + MOVED.command,
            *thermo(1, *MOVED.columns()),
            "velocity all set 0.5 0 0 units box",
            "run 5",
            f"group gone id {last}",
            "delete_atoms group gone compress no",
            f"create_atoms 1 single {numbers(packing.grains[-1].position)} units box",
            f"set atom {last} diameter 0.2 density 1000 vx 9",
            "run 5",
        ],
    )
    table = run(deck, ranks).thermo()[-1]
    require_equal(table[C_MOVED["N"]][1:], np.full(5, last - 1), "grains tracked")
    require_close(table[C_MOVED["d2_x"]][-1], (0.5 * 10 * deck.dt()) ** 2, 1e-10, "<d_x^2>")


def rarely_asked(rate):
    """Affine flow through flips, asked twice per unit of strain only, with a strain that may start again: nothing
    moves."""

    def case(ranks):
        deck = Deck(carried(gas(), rate, 0.0))
        steps = round(0.5 / (abs(rate) * deck.dt()))
        deck.body = [
            deforming(rate).line,
            "variable strain equal step*0.01",
            "compute moved all " + MOVED.command,
            *thermo(steps, *MOVED.columns()),
            f"run {2 * steps}",
            "reset_timestep 0",
            f"run {2 * steps}",
        ]
        for table in run(deck, ranks).thermo():
            # X reaches 40, and its steps add up over thousands.
            require_close(
                [table[C_MOVED[square]] for square in ("d2_x", "d2_y", "d2_z")],
                np.zeros((3, 3)),
                1e-16,
                "<d^2>",
                40.0**2,
            )

    return case


def in_rows():
    """Spheres in rows along x, each row with a velocity of its own: they cross the box and never touch."""
    random = np.random.default_rng(8)
    packing = gas()
    speeds = {}
    for g in packing.grains:
        speeds.setdefault(tuple(np.round(g.position[1:], 6)), float(random.normal(scale=5.0)))
    return replace(
        packing,
        grains=[replace(g, velocity=(speeds[tuple(np.round(g.position[1:], 6))], 0.0, 0.0)) for g in packing.grains],
    )


def remembers(ranks):
    """Grains in free flight keep their velocities: C is 1 at every lag, wherever they went."""
    packing, samples = in_rows(), 9
    watched = Watched("memory", "velocity/memory component vx strain v_strain every 0.5 lags 4", True, 3, (5, 4))
    deck = Deck(packing, body=["variable strain equal step*0.01"])
    moment = watch(
        deck,
        [watched],
        ranks=ranks,
        steps=50 * (samples - 1),
        every=50 * (samples - 1),
        thermo_every=10,
        contacts=False,
    )[-1]
    require(np.ptp(moment.columns["ix"]) > 1, "the grains did not cross the box")
    count = len(packing.grains)
    expected = [[0.5 * k, 1.0, count * (samples - k)] for k in range(5)]
    require_close(moment.array(watched)[:, [0, 1, 3]], expected, 1e-12, "strain, C, pairs")
    require_close(moment.vector(watched)[2], samples, 0.0, "samples", 1.0)


def remembers_later_grains(ranks):
    """A grain that comes later counts from its first sample on."""
    packing = in_rows()
    first, *rest = packing.grains
    watched = Watched("memory", "velocity/memory component vx strain v_strain every 0.01 lags 2", True, 3, (3, 4))
    deck = Deck(replace(packing, grains=rest))
    deck.body = [
        "variable strain equal step*0.01",
        watched.define("all"),
        *thermo(1, *watched.columns()),
        "run 3",
        f"create_atoms 1 single {numbers(first.position)} units box",
        f"set atom {len(packing.grains)} diameter 2 density 1000",
        "run 3",
    ]
    table, old = run(deck, ranks).thermo()[-1], len(rest)
    # Seven samples, steps 0 to 6; the new grain is in the last three (run 2 begins without a sample at its first step).
    require_equal(
        [table[C_MEMORY[row, "pairs"]][-1] for row in (1, 2, 3)], [7 * old + 3, 6 * old + 2, 5 * old + 1], "pairs"
    )


def starts_late(ranks):
    """With `start`, nothing before that strain; the strain counts from the first call at or beyond it."""
    packing = carried(gas(), 0.0, 0.0, (0.5, 0.0, 0.0))
    watched = Watched("moved", "displacement/shear strain v_strain start 0.095", True, 8)
    deck = Deck(packing, body=["variable strain equal step*0.01"])
    moments = watch(deck, [watched], ranks=ranks, steps=20, every=1, contacts=False)
    for moment in moments:
        vector, since = moment.vector(watched), moment.step - 10
        expected = [0.01 * since, (0.5 * since * deck.dt()) ** 2] if since >= 0 else [0.0, 0.0]
        require_close(vector[:2], expected, 1e-10, f"step {moment.step}: strain, <d_x^2>", 1.0)
        require(vector[7] == (len(packing.grains) if since >= 0 else 0), f"step {moment.step}: {vector[7]} grains")


CASES = {
    "affine": affine(0.43),
    "affine-backward": affine(-0.43, -1.0),
    "affine-without-stretch": affine(0.43, stretch=0.0),
    "drifting": drifting(1.0),
    "drifting-backward": drifting(-1.0),
    "drifting-in-xz": drifting(1.0, "xz"),
    "drifting-in-yz": drifting(-1.0, "yz"),
    "drifting-under-press-strain": drifting(1.0, by=lambda rate, _: without_gain(rate)),
    "rigid": rigid,
    "energies": energies,
    "lever": lever,
    "planes-of-grains": planes_of_grains,
    "random-walk": random_walk,
    "replaced-grains": replaced_grains,
    "rarely-asked": rarely_asked(RATE),
    "rarely-asked-backward": rarely_asked(-RATE),
    "later-grains": later_grains,
    "starts-late": starts_late,
    "remembers": remembers,
    "remembers-later-grains": remembers_later_grains,
}

if __name__ == "__main__":
    main(CASES)
