# SPDX-License-Identifier: GPL-2.0-or-later
"""The energy ledger closes: two grains of every kind, sheared packings, whatever happens to box, lists, ranks, runs and
restarts."""
from dataclasses import replace
import math

import numpy as np

from case import main, require, require_close, require_equal, require_same_snapshots
from collisions import kinetic_energy
from deck import Deck, Material, dump_grains, number, rayleigh_time, shear, thermo
from grainscope.columns import outputs
from oracle.ledger import AXES, ENTRIES, STORES
from packing import Grain, Packing, dense_packing, filled_packing, tilted
from run import run

C_E = outputs("energy/ledger").of("e")
C_LOSS = outputs("dissipation").of("loss")
C_S = outputs("stress/contact").of("s")

LATER = ("W_wall", "W_gravity", "W_in", "W_out")
SHARES = ("D_n_w", "D_t_w", "D_damp_w", "D_rolling_w", "G_w", "U_n_w", "U_t_w")
WORKS, LOSSES, STORED = (*ENTRIES[:4], *LATER), ENTRIES[4:], STORES
RATED = (*ENTRIES, *STORED, "residual", *LATER, *SHARES, *AXES)
NAMES = (*RATED, "residual_relative")
TOTALS = [C_E[name] for name in NAMES]
RATES = [C_E[f"{name}_rate"] for name in RATED]
LEDGER = "compute e all energy/ledger"
UNDAMPED = "tangential_damping off"
LEVEL = "time_level synchronized"
SYNCHRONIZED = f"{LEVEL} {UNDAMPED}"
# Every identity holds to rounding. Energies are sums of up to 1e3 grains and contacts over up to 1e4 steps, with
# velocities 10 times the peculiar ones: 1e-16 x 10 x sqrt(1e4), and a factor of 100 for the worst.
ROUNDING = 1e-11


def account(table, row=-1):
    return {name: float(table[q][row]) for name, q in zip(NAMES, TOTALS)}


def turnover(a):
    return sum(abs(a[name]) for name in (*WORKS, *LOSSES, *STORED))


def require_balance(a, tolerance=ROUNDING, what="the ledger"):
    print(f"{what}: " + ", ".join(f"{name} {a[name]:.4g}" for name in NAMES if a[name]))
    require(
        abs(a["residual"]) <= tolerance * turnover(a),
        f"{what}: residual {a['residual']:.3e} of a turnover of {turnover(a):.3e}",
    )
    require_close(sum(a[name] for name in AXES), a["W_box"], ROUNDING, f"{what}: W_box by axis", turnover(a))


def require_closed(a, tolerance=ROUNDING, what="the ledger"):
    require_balance(a, tolerance, what)
    require(a["D_n"] > 0.0, f"{what}: nothing was dissipated")


def with_ledger(deck):
    return replace(deck, extra=f"ledger on {deck.extra}".strip())


# Two grains

SHAPES = {
    "spheres": (1.0, 1.0, 1.0),
    "flat": (1.0, 1.0, 0.33),
    "long-1.5": (1.0, 1.0, 1.5),
    "long-3": (1.0, 1.0, 3.0),
    "triaxial": (1.0, 0.8, 1.4),
}
TURNED = (0.96, 0.1, 0.2, 0.16)


def meeting(shape, offset, spin, atom_style="superquadric"):
    turned = tuple(q / math.hypot(*TURNED) for q in TURNED)
    gap = max(shape) + 1e-3
    grains = [
        Grain(
            (side * gap, side * 0.5 * offset, 0.1 * side),
            shape,
            quaternion,
            (-0.5 * side, 0.0, 0.02),
            (0.1 * spin, side * spin, spin),
        )
        for side, quaternion in ((-1, (1.0, 0.0, 0.0, 0.0)), (1, turned))
    ]
    return Packing((30.0, 30.0, 30.0), grains, atom_style=atom_style, origin=(-15.0, -15.0, -15.0))


def collide(shape, offset, spin, e, mu, fraction, ranks=1, body=(), steps=None, **choices):
    """(account at the end, kinetic energy lost by the dumped velocities)."""
    surface = choices.pop("surface", "ellipsoid")
    packing = meeting(shape, offset, spin, "sphere" if surface == "default" else "superquadric")
    dt = fraction * rayleigh_time(min(shape))
    steps = steps or math.ceil((6.0 if min(shape) < 0.5 else 12.0 if max(shape) > 2.0 else 2.0 * max(shape)) / dt)
    deck = with_ledger(
        Deck(
            packing,
            material=Material(restitution=(e,), friction=(mu,)),
            timestep=dt,
            surface=surface,
            extra=choices.pop("extra", UNDAMPED),
            **choices,
        )
    )
    # The triaxial grains turn by the host's integrator, which keeps the energy of a free grain to second order in dt
    # only.
    turn = ["unfix integrate", "fix integrate all nve/spheroid"] if len(set(shape)) < 3 and surface != "default" else []
    deck.body = [*turn, *body, LEDGER, *dump_grains(packing, steps), *thermo(1, *TOTALS), f"run {steps}"]
    result = run(deck, ranks)
    (_, before), (_, after) = result.dump("grains.dump")
    return account(result.thermo()[0]), kinetic_energy(before) - kinetic_energy(after)


def two_grains(shape, **choices):
    """Head-on, oblique and spinning; e from 0.1 to 0.9, mu from 0 to 10, at dt = 0.1 T_R. The energy that the grains
    have lost, from their velocities, is what the ledger says was dissipated, in sum."""

    def case(ranks):
        tolerance = ROUNDING if len(set(shape)) < 3 else 1e-5
        for offset, spin in ((0.0, 0.0), (0.8, 0.0), (0.6, 0.3)):
            for e, mu in ((0.1, 0.4), (0.5, 0.0), (0.5, 10.0), (0.9, 0.4)):
                a, lost = collide(shape, offset, spin, e, mu, 0.1, ranks, **choices)
                require_closed(a, tolerance, f"offset {offset}, spin {spin}, e {e}, mu {mu}")
                require(
                    abs(a["residual"]) <= 1e-4 * (a["D_n"] + a["D_t"]),
                    f"residual {a['residual_relative']} of the dissipation",
                )
                require(a["U_n"] == 0.0 and a["U_t"] == 0.0, "the grains still touch")
                # A quarter of |F|^2 dt^2 / m is not in the velocities; there is no force at the ends.
                require_close(
                    sum(a[name] for name in LOSSES), lost, tolerance, "all losses against the energy lost", turnover(a)
                )

    return case


def order_of_the_integrator(shape):
    """G_dt, what the time step makes, falls as dt^2: between two halvings by 16, with room for where in a step contacts
    begin and end."""

    def case(ranks):
        found = []
        for fraction in (0.08, 0.04, 0.02):
            a, _ = collide(shape, 0.8, 0.2, 0.5, 0.4, fraction, ranks)
            found.append(abs(a["G_dt"]) / (a["D_n"] + a["D_t"]))
            print(f"dt = {fraction} T_R: |G_dt| = {found[-1]:.3e} of the dissipation")
        require(10.0 < found[0] / found[2] < 26.0, f"G_dt does not fall as dt^2: {found}")
        # A collision of 30 steps: the trapezium rule of d^(3/2) errs by about 1/30^2, as a share of what e = 0.5
        # leaves; five times that.
        require(found[0] < 5e-3, f"G_dt is {found[0]} at 0.08 T_R")

    return case


def known_collision(ranks):
    """Head-on spheres: nothing but damping, in closed form for Hooke: (1 - e^2) m_eff v^2/2 less what the last pull
    keeps. Here the exact loss is that of the velocities; D_t, G_k, G_p, G_open and everything of rotations are 0, and
    U_n, K_tr swing."""
    packing = Packing(
        (30.0, 30.0, 30.0),
        [Grain((side * 1.0005, 0.0, 0.0), velocity=(-0.5 * side, 0.0, 0.0)) for side in (-1, 1)],
        atom_style="sphere",
        origin=(-15.0, -15.0, -15.0),
    )
    deck = with_ledger(Deck(packing, timestep=0.02 * rayleigh_time(), extra=UNDAMPED))
    deck.body = [LEDGER, *thermo(1, *TOTALS), "run 250"]
    table = run(deck, ranks).thermo()[0]
    a = account(table)
    require_closed(a)
    start = packing.grains[0].mass() * 0.25
    require_close(
        [a["D_t"], a["G_k"], a["G_p"], a["G_open"], a["K_rot"], a["W_other"]],
        np.zeros(6),
        1e-13,
        "nothing but damping",
        start,
    )
    require_close(account(table, 0)["K_tr"], start, 1e-14, "kinetic energy before")
    require(table[C_E["U_n"]].max() > 0.5 * start, "the elastic energy does not take the kinetic one")


def models(choices):
    def case(ranks):
        for shape in (SHAPES["spheres"], SHAPES["long-1.5"]):
            a, lost = collide(shape, 0.6, 0.3, 0.3, 0.4, 0.1, ranks, **choices)
            require_closed(a, what=str(choices))
            require_close(
                sum(a[name] for name in LOSSES), lost, ROUNDING, "all losses against the energy lost", turnover(a)
            )
            if "rolling" in choices:
                require(a["D_rolling"] > 0.0, "nothing was lost to rolling")

    return case


# Packings


def sheared(packing, strain=0.1, rate=0.05, motion=None, rows=20, spheroid=True, **choices):
    """A deck that shears, with the ledger in every row of thermo."""
    deck = with_ledger(
        Deck(packing, extra=choices.pop("extra", UNDAMPED), surface=choices.pop("surface", "ellipsoid"), **choices)
    )
    steps = math.ceil(strain / (rate * deck.dt()) / rows) * rows
    turn = ["unfix integrate", "fix integrate all nve/spheroid"] if spheroid and packing.atom_style != "sphere" else []
    deck.body = [*turn, *(motion or [shear(rate)]), LEDGER, *thermo(steps // rows, *TOTALS, "xy"), f"run {steps}"]
    return deck


def press(target, rate=0.05, every=1e-3, rest=""):
    return [f"fix press all press/strain axis y target {number(target)} shear xy rate {rate} every {every} {rest}"]


def packing_closes(packing, tolerance=ROUNDING, **choices):
    def case(ranks):
        table = run(sheared(packing, **choices), ranks).thermo()[0]
        for row in range(1, len(table["step"])):
            require(
                abs(table[C_E["residual"]][row]) <= tolerance * turnover(account(table, row)),
                f"step {table['step'][row]}: residual {table[C_E['residual']][row]:.3e}",
            )
        require_closed(account(table), tolerance)

    return case


def flip(ranks):
    """Through two box flips of a box that is also compressed, with grains that cross faces."""
    packing = tilted(dense_packing(1.5, speed=0.3), 0.45)
    strain = 1.2 * packing.edges[0] / packing.edges[1]
    table = run(sheared(packing, strain, 0.5, press(2e5, 0.5)), ranks).thermo()[0]
    require((np.diff(table["xy"]) < 0.0).sum() >= 1, "no flip")
    require_closed(account(table))


def wraps(ranks):
    """One grain that flies freely through the faces of a box that shears and stretches: nothing touches, and what its
    peculiar energy gains is what the flow does to it."""
    packing = Packing((10.0, 10.0, 10.0), [Grain((5.0, 9.0, 5.0), velocity=(0.7, 2.0, 0.3))], atom_style="sphere")
    deck = with_ledger(Deck(packing, timestep=0.01))
    deck.body = [
        "fix press all press/strain axis y target 0 shear xy rate 0.3 every 0.01 gain 0 momentum no",
        LEDGER,
        *thermo(1, *TOTALS),
        *dump_grains(packing, 1),
        "run 3000",
    ]
    result = run(deck, ranks)
    a, start = account(result.thermo()[0]), account(result.thermo()[0], 0)
    crossings = (np.abs(np.diff([columns["y"][0] for _, columns in result.dump("grains.dump")])) > 5.0).sum()
    require(crossings >= 5, f"only {crossings} crossings of the sheared face")
    require_close(a["residual"], 0.0, ROUNDING, "residual", turnover(a))
    # p_y, p_z stay; p_x falls by gd p_y t: v is constant and the flow grows with y.
    mass, time = packing.grains[0].mass(), 30.0
    p = np.array([0.7 - 0.3 * 4.0, 2.0, 0.3])
    require_close(start["K_tr"], 0.5 * mass * p @ p, 1e-12, "peculiar energy at the start")
    p[0] -= 0.3 * 2.0 * time
    require_close(a["K_tr"], 0.5 * mass * p @ p, 1e-10, "peculiar energy at the end")
    require_close(a["W_shear"], a["K_tr"] - start["K_tr"], 1e-10, "work of the shear")


def lists(ranks):
    """Rebuilding the neighbour list in every step changes nothing."""
    accounts = []
    for every in ("neigh_modify delay 0", "neigh_modify every 1 delay 0 check no"):
        deck = sheared(dense_packing(1.5, speed=0.3), 0.02)
        deck.body.insert(0, every)
        accounts.append(account(run(deck, ranks).thermo()[0]))
        require_closed(accounts[-1], what=every)
    a, b = accounts
    # Chaotic, and pairs are added in another order: a few hundred steps take 1e-16 to 1e-9 or so.
    require_close(
        [b[name] for name in NAMES[:17]], [a[name] for name in NAMES[:17]], 1e-6, "rebuilt in every step", turnover(a)
    )


def reopening(surface, factor):
    """Two grains driven together bounce many times within the life of one neighbour list, rubbing: springs end loaded,
    or are kept by the host and come back (spheres at contact distance factor 1.0)."""

    def case(ranks):
        # Pole to pole, so that they stay in line; spinning alike, so that they rub.
        style = "sphere" if surface == "default" else "superquadric"
        pole = SHAPES["spheres"] if surface == "default" else (1.2, 1.0, 1.0)
        packing = Packing(
            (30.0, 30.0, 30.0),
            [
                Grain(
                    (side * (pole[0] + 1e-3), 0.0, 0.0), pole, velocity=(-0.2 * side, 0.0, 0.0), omega=(0.0, 0.0, 0.02)
                )
                for side in (-1, 1)
            ],
            atom_style=style,
            origin=(-15.0, -15.0, -15.0),
        )
        deck = with_ledger(
            Deck(
                packing,
                material=Material(restitution=(0.98,), friction=(3.0,)),
                timestep=0.05 * rayleigh_time(),
                surface=surface,
                extra=UNDAMPED,
                contact_distance_factor=factor,
            )
        )
        turn = [] if surface == "default" else ["unfix integrate", "fix integrate all nve/spheroid"]
        deck.body = [
            *turn,
            "neighbor 3.0 bin",
            "group left id 1",
            "group right id 2",
            "fix push left addforce 20000 0 0",
            "fix pull right addforce -20000 0 0",
            LEDGER,
            "compute s all stress/contact",
            *thermo(1, *TOTALS, C_S["N_c"]),
            "run 400",
        ]
        result = run(deck, ranks)
        table = result.thermo()[0]
        openings = (np.diff(table[C_S["N_c"]]) < 0).sum()
        require(openings >= 3, f"only {openings} openings")
        builds = int(
            next(line for line in result.output.splitlines() if line.startswith("Neighbor list builds")).split()[-1]
        )
        require(builds == 0, f"{builds} neighbour lists were built")
        a = account(table)
        require_closed(a)
        require(a["W_other"] > 0.0 and a["G_open"] != 0.0, "no work of the push, or no loaded spring")

    return case


# Ranks, runs, restarts, groups, surroundings


def state_for(deck, steps=300):
    return (
        run(replace(deck, body=[shear(0.05), f"run {steps}", "write_restart state.restart"])).folder / "state.restart"
    )


def same_on_ranks(packing, extra=UNDAMPED):
    """10 steps from one restart: every total within 1e-8 of that on one rank."""

    def case(ranks):
        deck = with_ledger(Deck(packing, surface="ellipsoid", extra=extra))
        state = state_for(deck)
        body = [shear(0.05), LEDGER, *thermo(10, *TOTALS), "run 10"]
        one, many = (account(run(deck.restarted(state, body), n).thermo()[0]) for n in (1, ranks))
        require_closed(many)
        require_close(
            [many[n] for n in NAMES[:17]], [one[n] for n in NAMES[:17]], 1e-8, f"{ranks} ranks against 1", turnover(one)
        )

    return case


def restart_continues(packing, extra=UNDAMPED, **choices):
    """Totals and all go on to the last bit (the run that goes on has written the same file)."""

    def case(ranks):
        deck = with_ledger(Deck(packing, extra=extra, **choices))
        start = [*press(2e5), LEDGER]
        rest = [*thermo(1, *TOTALS), *dump_grains(deck.packing, 200), "run 200"]
        through = run(replace(deck, body=[*start, "run 200", "write_restart half.restart", *rest]), ranks)
        again = run(deck.restarted(through.folder / "half.restart", [*start, *rest]), ranks)
        require_same_snapshots(
            again.dump("grains.dump")[-1:], through.dump("grains.dump")[-1:], "restarted against write-and-continue"
        )
        a, b = account(through.thermo()[-1]), account(again.thermo()[-1])
        # Free spheroids keep their energy under the host's integrator to second order in dt only.
        require_closed(b, ROUNDING if packing.atom_style == "sphere" else 1e-6)
        require_equal([b[n] for n in NAMES], [a[n] for n in NAMES], "the ledger, restarted")

    return case


def restart_in_a_box_of_three_rates(ranks):
    """W_box by axis goes on from what the file says to the last bit. Under LIGGGHTS's fix deform the two runs part in
    the last digits after it."""
    deck = with_ledger(Deck(dense_packing(atom_style="sphere", speed=0.4), extra=UNDAMPED))
    start = ["fix stretch all deform 1 x erate 0.05 y erate -0.08 z erate 0.02 remap v", LEDGER]
    rest = [*thermo(1, *TOTALS), "run 200"]
    through = run(replace(deck, body=[*start, "run 200", "write_restart half.restart", *rest]), ranks)
    again = run(deck.restarted(through.folder / "half.restart", [*start, *rest]), ranks)
    whole, resumed = through.thermo()[-1], again.thermo()[-1]
    first, begun, a, b = (account(table, row) for row in (0, -1) for table in (whole, resumed))
    for name in ("W_box", *AXES):
        require_equal(begun[name], first[name], f"{name} where the file is read")
        require(0.0 != first[name] != a[name], f"{name} is {first[name]}, then {a[name]}")
    require_closed(b)
    require_close([b[n] for n in NAMES], [a[n] for n in NAMES], 1e-8, "the ledger, restarted", turnover(a))


def restart_before_the_first_step(ranks):
    """A restart file with a ledger in it that has not begun: it begins where the file is read."""
    deck = with_ledger(Deck(dense_packing(atom_style="sphere", speed=0.4), extra=UNDAMPED))
    state = (
        run(replace(deck, body=[shear(0.05), "run 100", LEDGER, "write_restart early.restart"]), ranks).folder
        / "early.restart"
    )
    a = account(run(deck.restarted(state, [shear(0.05), LEDGER, *thermo(50, *TOTALS), "run 50"]), ranks).thermo()[0])
    require_closed(a)
    require(abs(a["W_other"]) <= ROUNDING * turnover(a), f"work from nowhere: {a['W_other']}")


def asked_within_a_step(ranks):
    """A force that is a ten-millionth of W_other, asked for in the middle of the step, as the step before left it: it
    stays what it is."""
    deck = sheared(dense_packing(atom_style="sphere", speed=0.3), 0.01)
    deck.body.insert(-4, f"variable push equal {C_E['W_other']}*1e-7")
    deck.body[-4:-4] = ["fix push all addforce v_push 0 0"]
    a = account(run(deck, ranks).thermo()[0])
    require_closed(a)
    require(abs(a["W_other"]) <= 1e-9 * turnover(a), f"W_other grew from nothing: {a['W_other']}")


def overlap_of_nothing(ranks):
    """Spheres that the host takes for touching with an overlap of exactly 0."""
    grains = [
        Grain((0.0, 0.0, 0.0), (0.7, 0.7, 0.7)),
        Grain((1.0241907186343104, 0.24420736878011862, -0.9227112944452481), (0.7, 0.7, 0.7)),
    ]
    deck = with_ledger(
        Deck(
            Packing((24.0, 24.0, 24.0), grains, atom_style="sphere", origin=(-12.0, -12.0, -12.0)),
            normal="hooke",
            extra=UNDAMPED,
        )
    )
    deck.body = [LEDGER, *thermo(1, *TOTALS), "run 5"]
    a = account(run(deck, ranks).thermo()[0])
    require_close([a[name] for name in NAMES], np.zeros(len(NAMES)), 1e-15, "two spheres that just touch", 1.0)


def elastic_energy(choices):
    """U_n of each law is the work of its force: in no step of a fine collision differ the two by more than a thousandth
    of the largest energy. (With 2/5 in place of 1/2, say, by a fifth of the change.)"""

    def case(ranks):
        packing = meeting(SHAPES["long-1.5"], 0.3, 0.0)
        deck = with_ledger(
            Deck(
                packing,
                timestep=0.01 * rayleigh_time(),
                surface="ellipsoid",
                extra=choices.pop("extra", UNDAMPED),
                **choices,
            )
        )
        deck.body = [
            "unfix integrate",
            "fix integrate all nve/spheroid",
            LEDGER,
            *thermo(1, *TOTALS, C_E["G_dt_rate"]),
            "run 2500",
        ]
        table = run(deck, ranks).thermo()[0]
        largest, step = table[C_E["U_n"]].max(), np.abs(table[C_E["G_dt_rate"]]).max() * deck.dt()
        changes = np.abs(np.diff(table[C_E["U_n"]])).max()
        print(f"U_n up to {largest:.4g}, changes in a step up to {changes:.3g}, G_dt in a step up to {step:.3g}")
        require(changes > 0.01 * largest > 0.0, "no collision, or too fine")
        require(step <= 1e-3 * largest, f"G_dt is {step} in a step, of an energy of {largest}")

    return case


def runs(ranks):
    """A run in two: what the host recomputes between them, and a `velocity` command, are work from outside."""
    deck = sheared(dense_packing(1.5, speed=0.3), 0.02)
    deck.body = [
        *deck.body[:-1],
        "run 100",
        "velocity all set 0.1 0 0 sum yes units box",
        "run 100",
        "run 50 pre no",
        "set group all omegaz 0.2",
        "run 50 pre no",
    ]
    first, second, third, fourth = run(deck, ranks).thermo()
    for table in (first, second, third, fourth):
        require_closed(account(table))
    require(
        abs(account(fourth)["W_other"] - account(third)["W_other"]) > 1e-4 * account(fourth)["K_rot"],
        "the new spins are not in W_other",
    )
    require(
        account(first)["W_other"] == 0.0 or abs(account(first)["W_other"]) < 1e-12 * turnover(account(first)),
        "work from nowhere",
    )
    require(abs(account(second)["W_other"]) > 1e-3 * account(second)["K_tr"], "the velocity command is not in W_other")


def groups(ranks):
    """Half of the grains: the others work on it from outside. A single grain and nobody, too."""
    deck = sheared(dense_packing(1.5, speed=0.3), 0.05)
    parts = ["group half id 1:60", "group one id 7", "group nobody id 99999"]
    computes = [f"compute {name} {name} energy/ledger" for name in ("half", "one", "nobody")]
    printed = {name: [outputs("energy/ledger").of(name)[n] for n in NAMES] for name in ("half", "one", "nobody")}
    columns = [word for words in printed.values() for word in words]
    deck.body = [*deck.body[:-4], *parts, *computes, *thermo(100, *TOTALS, *columns), "run 600"]
    table = run(deck, ranks).thermo()[0]
    everyone = account(table)
    require_closed(everyone)
    half = {n: table[word][-1] for n, word in zip(NAMES, printed["half"])}
    require_closed(half, what="half")
    require(0.0 < half["D_n"] < everyone["D_n"] and abs(half["W_other"]) > 0.0, "half of the grains")
    one = {n: table[word][-1] for n, word in zip(NAMES, printed["one"])}
    require_close(one["residual"], 0.0, ROUNDING, "one grain", turnover(everyone))
    require(one["D_n"] == 0.0 and one["W_other"] != 0.0, "one grain has no contact with itself")
    require_equal([table[word][-1] for word in printed["nobody"]], np.zeros(len(NAMES)), "nobody")


def falling(ranks):
    """Under gravity W_gravity is m g h, exactly, and grains that land on a wall lose it there."""
    grains = [Grain((5.0, 5.0, 9.0), (1.0, 1.0, 1.5)), Grain((5.2, 5.1, 5.0), (1.0, 1.0, 1.5), (0.8, 0.6, 0.0, 0.0))]
    packing = Packing((10.0, 10.0, 14.0), grains, triclinic=False)
    deck = with_ledger(Deck(packing, surface="ellipsoid", boundary="p p f", extra=UNDAMPED, timestep=0.002))
    deck.body = [
        "unfix integrate",
        "fix integrate all nve/spheroid",
        "fix pull all gravity 9.81 vector 0 0 -1",
        "fix floor all wall/gran model hertz tangential history surface ellipsoid primitive type 1 zplane 0",
        LEDGER,
        *dump_grains(packing, 200),
        *thermo(200, *TOTALS),
        "run 2000",
    ]
    result = run(deck, ranks)
    table, dumps = result.thermo()[0], result.dump("grains.dump")
    free, (_, before), (_, after) = account(table, 1), dumps[0], dumps[1]
    mass = packing.grains[0].mass()
    # The trapezium rule over the fall is exact for a constant force.
    require_close(free["W_gravity"], mass * 9.81 * (before["z"] - after["z"]).sum(), 1e-10, "m g h")
    require_close(free["W_other"], 0.0, ROUNDING, "nothing else pulls", turnover(free))
    require_close(free["residual"], 0.0, ROUNDING, "falling", turnover(free))
    a = account(table)
    require_closed(a)
    require(0.0 < a["D_n_w"] < a["D_n"] and 0.0 < a["D_t_w"] < a["D_t"], "the floor took nothing, or all")


def undisturbed(packing, extra=UNDAMPED, surface="ellipsoid"):
    """The trajectory with the ledger is that without it, to the last bit."""

    def case(ranks):
        dumps = []
        for words, lines in (
            (extra, []),
            (f"ledger on {extra}", []),
            (f"ledger on {extra}", [LEDGER, *thermo(7, *TOTALS)]),
            (f"ledger off {extra}", []),
        ):
            deck = Deck(packing, surface=surface, extra=words)
            deck.body = [*press(2e5), *lines, *dump_grains(packing, 300), "run 300"]
            dumps.append(run(deck, ranks).dump("grains.dump"))
        for dump in dumps[1:]:
            require_same_snapshots(dump, dumps[0], "with the ledger against without")

    return case


def lanes_as_one_by_one(packing, **choices):
    """A word that no lane knows, and that does nothing here, makes contacts go through the models of LIGGGHTS: the same
    motion to the last bit, and the same sums in another order."""

    def case(ranks):
        one, other = (
            run(sheared(packing, 0.02, extra=f"{SYNCHRONIZED} {more}", **choices), ranks).thermo()[0]
            for more in ("", "heating_tracking on")
        )
        require_equal(other["xy"], one["xy"], "tilt")
        a, b = account(one), account(other)
        for each in (a, b):
            require_closed(each)
        require_close([b[n] for n in NAMES], [a[n] for n in NAMES], 1e-12, "one by one against lanes", turnover(a))

    return case


def rates_add_up(ranks):
    """Totals are the sums of rates; compute dissipation mode ledger tells the same D_n, D_t, D_damp; the scalar is the
    relative residual."""
    deck = sheared(dense_packing(1.5, speed=0.3), 0.02, extra="", motion=press(2e5))
    loss = C_LOSS.vector()
    deck.body = [
        *deck.body[:-3],
        "compute loss all dissipation mode ledger",
        "compute s all stress/contact",
        *thermo(1, *TOTALS, *RATES, "c_e", *loss, "c_loss", C_S["N_c"]),
        "run 300",
    ]
    table, dt = run(deck, ranks).thermo()[0], deck.dt()
    a = account(table)
    require_closed(a)
    require_equal([table[rate][0] for rate in RATES], np.zeros(len(RATES)), "rates before the first step")
    for name, total, rate in zip(RATED, TOTALS, RATES):
        change = table[total] - table[total][0]
        require_close(np.cumsum(table[rate][1:]) * dt, change[1:], 1e-10, f"rate of {name}", turnover(a))
    require_close(
        table[C_LOSS["P_n"]][1:], table[C_E["D_n_rate"]][1:], 1e-13, "P_n", np.abs(table[C_E["D_n_rate"]]).max()
    )
    require_close(
        table[C_LOSS["P_t"]][1:], table[C_E["D_t_rate"]][1:], 1e-13, "P_t", np.abs(table[C_E["D_n_rate"]]).max()
    )
    require_close(
        table[C_LOSS["P_t_damp"]][1:],
        table[C_E["D_damp_rate"]][1:],
        1e-13,
        "P_t,damp",
        np.abs(table[C_E["D_n_rate"]]).max(),
    )
    require_close(
        table["c_loss"],
        table[C_LOSS["P_n"]] + table[C_LOSS["P_t"]] + table[C_LOSS["P_t_damp"]],
        1e-13,
        "sum",
        np.abs(table["c_loss"]).max(),
    )
    require_equal(table[C_LOSS["N_c"]], table[C_S["N_c"]], "contacts")
    require_equal(table["c_e"], np.abs(table[C_E["residual_relative"]]), "scalar")


def step_mode_is_the_trapezium(ranks):
    """compute dissipation mode step tells F.v at the ends of steps; D_n of the ledger is its trapezium rule, up to
    terms of the ends."""
    deck = sheared(dense_packing(atom_style="sphere", speed=0.4), 0.05)
    deck.body = [
        *deck.body[:-3],
        "compute loss all dissipation mode step",
        *thermo(1, *TOTALS, C_LOSS["P_n"]),
        "run 500",
    ]
    table, dt = run(deck, ranks).thermo()[0], deck.dt()
    power = table[C_LOSS["P_n"]][200:]
    rule = dt * (power.sum() - 0.5 * (power[0] + power[-1]))
    found = account(table)["D_n"] - account(table, 200)["D_n"]
    # Each end differs by dt^2/4m (F_damping . F): some percents of one step's loss, of 300 steps.
    require_close(rule, found, 1e-3, "D_n")


GAS = dict(overlap=-0.05, speed=0.8)
CASES = {
    **{f"two-{name}": two_grains(shape) for name, shape in SHAPES.items()},
    "two-spheres-default": two_grains(SHAPES["spheres"], surface="default"),
    "two-long-1.5-superquadric": two_grains(SHAPES["long-1.5"], surface="superquadric"),
    "two-spheres-default-synchronized": two_grains(SHAPES["spheres"], surface="default", extra=SYNCHRONIZED),
    "two-superquadric-synchronized": two_grains(SHAPES["long-1.5"], surface="superquadric", extra=SYNCHRONIZED),
    **{
        f"two-{name}-synchronized": two_grains(SHAPES[name], extra=SYNCHRONIZED)
        for name in ("spheres", "long-1.5", "flat")
    },
    **{f"order-{name}": order_of_the_integrator(SHAPES[name]) for name in ("spheres", "flat", "long-1.5", "long-3")},
    "known-collision": known_collision,
    "hooke": models(dict(normal="hooke")),
    "no-history": models(dict(tangential="no_history", extra="")),
    "tangential-damping": models(dict(extra="")),
    "tangential-off": models(dict(tangential="off", extra="")),
    "limit-force": models(dict(extra="limitForce on")),
    "curvature": models(dict(extra=f"{UNDAMPED} gaussianCurvature yes curvatureLimitFactor 100")),
    "hooke-synchronized": models(dict(normal="hooke", extra=SYNCHRONIZED)),
    "no-history-synchronized": models(dict(tangential="no_history", extra=LEVEL)),
    "damped-synchronized": models(dict(extra=LEVEL)),
    "rolling-cdt": models(dict(rolling="cdt")),
    "rolling-epsd": models(
        dict(
            rolling="epsd",
            body=["fix viscous all property/global coefficientRollingViscousDamping peratomtypepair 1 0.5"],
        )
    ),
    "rolling-epsd2": models(dict(rolling="epsd2")),
    "rolling-superquadric": models(dict(rolling="cdt", surface="superquadric")),
    **{
        f"sheared-{alpha:g}-mu-{mu:g}": packing_closes(
            dense_packing(alpha, speed=0.3), material=Material(restitution=(0.1,), friction=(mu,))
        )
        for alpha in (0.33, 1.0, 1.5, 3.0)
        for mu in (0.0, 0.4, 10.0)
    },
    **{
        f"pressed-1.5-mu-{mu:g}": packing_closes(
            dense_packing(1.5, speed=0.3), motion=press(2e5), material=Material(restitution=(0.1,), friction=(mu,))
        )
        for mu in (0.0, 10.0)
    },
    **{
        f"pressed-{alpha:g}": packing_closes(
            dense_packing(alpha, speed=0.3), motion=press(2e5), strain=0.1 if alpha < 2.0 else 0.04
        )
        for alpha in (0.33, 1.0, 1.5, 3.0)
    },
    "pressed-spheres": packing_closes(dense_packing(atom_style="sphere", speed=0.3), motion=press(2e5)),
    "pressed-dilute": packing_closes(dense_packing(1.5, **GAS), motion=press(1e3), strain=0.5),
    "pressed-along-the-flow": packing_closes(
        dense_packing(1.5, speed=0.3),
        motion=["fix press all press/strain axis x target 2e5 shear xy rate 0.05 every 1e-3"],
    ),
    "polydisperse-two-types": packing_closes(
        dense_packing(1.5, sizes=(0.8, 1.0, 1.2), types=2, speed=0.3),
        material=Material(young=(5e6, 2e7), restitution=(0.3,), friction=(0.4, 0.1, 0.1, 0.8)),
    ),
    # Two owners see a contact from two sides, 1e-7 apart, and the host's rotations keep energy to second order in dt.
    "superquadric": packing_closes(dense_packing(1.5, speed=0.3), 1e-6, surface="superquadric", spheroid=False),
    "sheared-synchronized": packing_closes(dense_packing(1.5, speed=0.3), extra=SYNCHRONIZED),
    "pressed-spheres-synchronized": packing_closes(
        dense_packing(atom_style="sphere", sizes=(0.6, 1.0), speed=0.3), motion=press(2e5), extra=SYNCHRONIZED
    ),
    "types-synchronized": packing_closes(
        dense_packing(1.5, sizes=(0.6, 0.8, 1.0), types=2, speed=0.3),
        material=Material(young=(5e6, 2e7), restitution=(0.3,), friction=(0.4, 0.1, 0.1, 0.8)),
        extra=LEVEL,
    ),
    "mixture-synchronized": packing_closes(
        filled_packing(),
        rate=0.3,
        surface="default",
        material=Material(restitution=(0.5,), friction=(1.0,)),
        timestep=0.15 * rayleigh_time(0.1),
        extra=SYNCHRONIZED,
    ),
    "superquadric-synchronized": packing_closes(
        dense_packing(1.5, speed=0.3), 1e-6, surface="superquadric", spheroid=False, extra=SYNCHRONIZED
    ),
    "lanes-synchronized-spheres": lanes_as_one_by_one(
        dense_packing(atom_style="sphere", sizes=(0.6, 1.0), speed=0.3), surface="default"
    ),
    "lanes-synchronized-round": lanes_as_one_by_one(dense_packing(1.0, speed=0.3)),
    "lanes-synchronized-spheroids": lanes_as_one_by_one(dense_packing(1.5, speed=0.3)),
    "flip": flip,
    "wraps": wraps,
    "lists": lists,
    "reopening-spheres": reopening("default", 1.05),
    "reopening-stale-springs": reopening("default", 1.0),
    "reopening-spheroids": reopening("ellipsoid", 1.05),
    "same-spheres": same_on_ranks(dense_packing(atom_style="sphere", speed=0.4)),
    "same-spheroids": same_on_ranks(dense_packing(1.5, speed=0.4)),
    "same-synchronized-spheres": same_on_ranks(dense_packing(atom_style="sphere", speed=0.4), SYNCHRONIZED),
    "same-synchronized-spheroids": same_on_ranks(dense_packing(1.5, speed=0.4), SYNCHRONIZED),
    "energy-of-hertz": elastic_energy({}),
    "energy-of-hooke": elastic_energy(dict(normal="hooke")),
    "energy-with-curvature": elastic_energy(dict(extra=f"{UNDAMPED} gaussianCurvature yes curvatureLimitFactor 100")),
    "restart-before-the-first-step": restart_before_the_first_step,
    "asked-within-a-step": asked_within_a_step,
    "overlap-of-nothing": overlap_of_nothing,
    "restart-continues": restart_continues(dense_packing(atom_style="sphere", speed=0.4)),
    "restart-synchronized-spheres": restart_continues(dense_packing(atom_style="sphere", speed=0.4), SYNCHRONIZED),
    "restart-synchronized-spheroids": restart_continues(
        dense_packing(1.5, speed=0.4), f"{SYNCHRONIZED} setup neutral", surface="ellipsoid"
    ),
    "restart-synchronized-superquadrics": restart_continues(
        dense_packing(1.5, speed=0.4), SYNCHRONIZED, surface="superquadric"
    ),
    "restart-in-a-box-of-three-rates": restart_in_a_box_of_three_rates,
    "runs": runs,
    "groups": groups,
    "falling": falling,
    "undisturbed": undisturbed(dense_packing(1.5, speed=0.3)),
    "undisturbed-synchronized-spheres": undisturbed(
        dense_packing(atom_style="sphere", speed=0.3), SYNCHRONIZED, "default"
    ),
    "undisturbed-synchronized-spheroids": undisturbed(dense_packing(1.5, speed=0.3), SYNCHRONIZED),
    "undisturbed-synchronized-superquadrics": undisturbed(dense_packing(1.5, speed=0.3), SYNCHRONIZED, "superquadric"),
    "rates-add-up": rates_add_up,
    "step-mode-is-the-trapezium": step_mode_is_the_trapezium,
}

if __name__ == "__main__":
    main(CASES)
