# SPDX-License-Identifier: GPL-2.0-or-later
"""What is said when a run leaves its safe range: once, with the number and the limit; and nothing where all is well."""
from dataclasses import replace
import math
import re

from case import main, require, require_close, require_same_snapshots
from deck import POISSON, YOUNG, Deck, Material, dump_grains, rayleigh_time, shear, thermo
from grainscope.columns import outputs
from packing import Grain, Packing, dense_packing
from run import run

C_F = outputs("fluctuation").of("f")

SPHERES = dense_packing(atom_style="sphere", speed=0.05)
TIME_STEP = "pair_style gran/insitu: the time step"
OTHERS = (TIME_STEP, "the stiffness number kappa is", "inputs were clipped", "the velocity profile deviates")


def said(deck, words, ranks):
    """The one warning with these words."""
    output = run(deck, ranks).output
    lines = [line for line in output.splitlines() if words in line]
    require(len(lines) == 1 and "WARNING" in lines[0], f"{words!r} was said {len(lines)} times")
    for other in OTHERS:
        require(other in words or words in other or other not in output, f"{other!r} was said as well")
    return lines[0]


def soft(fraction, restitution, steps, body=(), extra=""):
    """Dense spheres with overlaps of 2 %, which the time step may be too long for."""
    return Deck(
        SPHERES,
        material=Material(restitution=(restitution,)),
        timestep=fraction * rayleigh_time(),
        extra=extra,
        body=[*body, f"run {steps}"],
    )


def time_step(ranks):
    """Overlaps of 2 %, e = 0.1, tangential damping: unstable from 0.1 T_R on. The step given is safe: nothing is said
    at it."""
    line = said(soft(0.15, 0.1, 1100), TIME_STEP, ranks)
    number, limit, safe = (
        float(x) for x in re.search(r"over the mass is (\S+), limit (\S+):.*below ([^\s,]+)", line).groups()
    )
    require("tangential damping hides it in the motion" in line and "or 'tangential_damping off'" in line, line)
    require(number > limit == 4.0 and 0.0 < safe < 0.15 * rayleigh_time(), f"the numbers are {number}, {limit}, {safe}")
    quiet = run(soft(0.95 * safe / rayleigh_time(), 0.1, 1100), ranks).output
    require(TIME_STEP not in quiet, "the step that was said to be safe was warned of")


def time_step_in_short_runs(ranks):
    """Steps are counted through runs; without tangential damping there is no advice to switch it off."""
    deck = soft(0.25, 0.1, 400, ["run 400", "run 400"], "tangential_damping off")
    line = said(deck, TIME_STEP, ranks)
    require("tangential" not in line, line)


def rolling_limit(mass, overlap, restitution):
    """Of a ball of radius 1 between two walls, with tangential damping: 2 a^2 (dt^2 k_t + 2 dt gamma_t)/I = 4, with
    a = 1 - overlap/2, the arm of LIGGGHTS's spheres."""
    stiffness = 8.0 * YOUNG / (4.0 * (2.0 - POISSON) * (1.0 + POISSON)) * math.sqrt(overlap)
    log = math.log(restitution)
    damping = 2.0 * math.sqrt(5.0 / 6.0) * -log / math.hypot(log, math.pi) * math.sqrt(stiffness * mass)
    part = 2.0 * 0.4 * mass / (1.0 - 0.5 * overlap) ** 2  # dt^2 k_t + 2 dt gamma_t at the limit
    return part / (damping + math.sqrt(damping**2 + stiffness * part))


def time_step_at_walls(ranks):
    """A ball that nobody moves, held between two walls. Its fastest motion is to roll against both tangential springs
    and dashpots, and walls do not give way: the step given is the closed form's."""
    packing = Packing((8.0,) * 3, [Grain((0.0, 0.0, 0.98))], atom_style="sphere", origin=(-4.0,) * 3, triclinic=False)
    deck = Deck(packing, boundary="f f f", material=Material(restitution=(0.1,)))
    wall = f"wall/gran {deck.model()} primitive type 1 zplane"
    deck.body = ["unfix integrate", f"fix floor all {wall} 0.0", f"fix ceiling all {wall} 1.96", "run 1100"]
    line = said(replace(deck, timestep=0.4 * rayleigh_time()), TIME_STEP, ranks)
    number, safe = (float(x) for x in re.search(r"over the mass is (\S+), limit.*below (\S+), or", line).groups())
    require(number > 4.0 and 0.0 < safe < 0.4 * rayleigh_time(), f"the numbers are {number}, {safe}")
    require_close(safe, rolling_limit(Grain((0.0, 0.0, 0.0)).mass(), 0.02, 0.1), 5e-3, "safe time step")
    quiet = run(replace(deck, timestep=0.95 * safe), ranks).output
    require(TIME_STEP not in quiet, "the step that was said to be safe was warned of")


def time_step_unseen(ranks):
    """Looking changes nothing: the trajectory is that of plain gran, to the last bit."""
    deck = soft(0.15, 0.1, 1100, dump_grains(SPHERES, 1100))
    ours, host = (run(replace(deck, pair=pair), ranks).dump("grains.dump") for pair in ("gran/insitu", "gran"))
    require_same_snapshots(ours, host, "watched against not")


def quiet(ranks):
    """Hard grains at 0.05 T_R under control, and a gas in the linear flow of its box: nothing is said."""
    body = ["fix press all press/strain axis y target 50 shear xy rate 0.05 every 1e-3", "run 1005"]
    dense = Deck(
        dense_packing(atom_style="sphere", overlap=-0.05, speed=0.02), timestep=0.05 * rayleigh_time(), body=body
    )
    gas = dense_packing(atom_style="sphere", overlap=-0.3, speed=0.0)
    half = 0.5 * 0.05 * gas.edges[1]
    body = [
        shear(0.05),
        f"velocity all ramp vx {-half} {half} y 0 {gas.edges[1]} units box",
        "compute f all fluctuation",
        *thermo(1, C_F["deviation"]),
        "run 15",
    ]
    for deck in (dense, Deck(gas, timestep=0.02 * rayleigh_time(), body=body)):
        output = run(deck, ranks).output
        for words in OTHERS:
            require(words not in output, f"{words!r} was said")


def kappa(ranks):
    line = said(
        soft(0.02, 0.9, 30, ["compute s all stress/contact", *thermo(1, "c_s")], "tangential_damping off"),
        OTHERS[1],
        ranks,
    )
    number, limit = (
        float(x) for x in re.search(r"kappa is (\S+), below the hard-grain limit of (\S+):", line).groups()
    )
    require(0.0 < number < limit == 1100.0, f"the numbers are {number}, {limit}")


def clipping(ranks):
    """Nothing resists and nothing is asked for 350 inputs; then a pressure that no gas gives: every input is
    clipped."""
    body = [
        "variable target equal 1e3*(step>350)",
        "fix press all press/strain axis y target v_target shear xy rate 0.05 every/step 1 gain 1e-3 limit 1e-6",
        "run 460",
    ]
    deck = Deck(dense_packing(atom_style="sphere", overlap=-0.3, speed=0.0), timestep=0.02 * rayleigh_time(), body=body)
    line = said(deck, OTHERS[2], ranks)
    number, limit = (
        float(x)
        for x in re.search(r"strain: (\S+) of the last hundred inputs were clipped \(limit (\S+)\)", line).groups()
    )
    require(number > limit == 0.2, f"the numbers are {number}, {limit}")


def unstable_from_the_start(ranks):
    """A gain far too large: clipped one way and the other from the first contact on."""
    body = [
        "fix press all press/strain axis y target 1e5 shear xy rate 0.05 every 1e-3 gain 1e-2 limit 0.003",
        "run 3000",
    ]
    said(
        Deck(
            dense_packing(atom_style="sphere", speed=0.1),
            timestep=0.05 * rayleigh_time(),
            body=body,
            extra="tangential_damping off",
        ),
        OTHERS[2],
        ranks,
    )


def profile(ranks):
    """Grains at rest in a box that shears: the flow is not the box's."""
    body = [shear(0.05), "velocity all set 0 0 0", "compute f all fluctuation", *thermo(1, C_F["deviation"]), "run 15"]
    line = said(
        Deck(dense_packing(atom_style="sphere", overlap=-0.3, speed=0.0), timestep=0.02 * rayleigh_time(), body=body),
        OTHERS[3],
        ranks,
    )
    number, limit = (
        float(x) for x in re.search(r"flow by (\S+) of rate x L \(rms over layers; limit ([^;]+);", line).groups()
    )
    require(
        0.25 < number < 0.33 and 0.1 <= limit < 0.2, f"the numbers are {number}, {limit}"
    )  # 1/(2 sqrt 3) = 0.289 for even layers; twice the noise of 10 layers of 100 grains


CASES = {
    "time-step": time_step,
    "time-step-in-short-runs": time_step_in_short_runs,
    "time-step-at-walls": time_step_at_walls,
    "time-step-unseen": time_step_unseen,
    "quiet": quiet,
    "kappa": kappa,
    "clipping": clipping,
    "unstable-from-the-start": unstable_from_the_start,
    "profile": profile,
}

if __name__ == "__main__":
    main(CASES)
