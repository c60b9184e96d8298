# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs that are split, killed, stopped and taken up again: the same as runs that were left alone."""
from dataclasses import replace
import os
import random
import signal

import numpy as np

from case import main, require, require_close, require_same_snapshots
from catalogue import DISPLACEMENT, MEMORY, strain_lines
from deck import Deck, dump_grains, shear, thermo
from grainscope.columns import outputs
from packing import dense_packing, tilted
from run import FLUSHED, Started, rows_so_far, run, wait_for_steps, wait_until
from watch import Watched

C_LEDGER = outputs("energy/ledger").of("ledger")
C_MEMORY = outputs("velocity/memory").of("memory")
C_STRESS = outputs("stress/contact").of("stress")
F_PRESS = outputs("press/strain").of("press")

RATE = 0.05
PRESS = f"fix press all press/strain axis y target 2e5 shear xy rate {RATE} every 7e-4"
STATE = ["f_press", *F_PRESS.vector()]
SPHERES, SPHEROIDS = dense_packing(atom_style="sphere"), dense_packing(1.5)
RUNNING = Watched("running", "velocity/correlation bins 6 average running", True, 5, (6, 4))
FILES = ("even.restart", "odd.restart")


def neutral(packing, surface="ellipsoid", **choices):
    return Deck(packing, surface=surface, extra="setup neutral ledger on", **choices)


def everything_with_state(deck):
    """Pressure control, what computes remember, the energy ledger: lines, and what thermo prints of them."""
    computes = [DISPLACEMENT, MEMORY, RUNNING]
    printed = [*STATE, *(q for w in computes for q in w.columns()), *C_LEDGER.vector()]
    return [
        *strain_lines(RATE),
        PRESS,
        *(w.define("all") for w in computes),
        "compute ledger all energy/ledger",
    ], printed


def same_tables(found, expected, tolerance, scale=None, skip=()):
    for name, values in expected.items():
        if name not in skip:
            require_close(
                found[name][-len(values) :], values, tolerance, name, scale or max(1e-9, np.abs(values).max())
            )


def same_motion(one, other, packing):
    """Lists that are built in other steps wrap grains in other steps: places are the same but for whole edges."""
    (_, expected), (_, found) = one.dump("grains.dump")[-1], other.dump("grains.dump")[-1]
    dx, dy, dz = (found[k] - expected[k] for k in "xyz")
    edges = np.array([np.abs(d) > 0.5 * e for d, e in zip((dx, dy, dz), packing.edges)])
    require(edges.any(axis=0).sum() <= 5, "many grains are elsewhere")
    same = ~edges.any(axis=0)
    for name in expected:
        if name not in ("id", "type", "fx", "fy", "fz", "tqx", "tqy", "tqz"):
            require_close(found[name][same], expected[name][same], 1e-8, name, max(1.0, np.abs(expected[name]).max()))


def split_is_neutral(packing, lines, surface="ellipsoid", **choices):
    """`run 400; run 400` against `run 800`: lists are built once more, so forces are summed in another order; the
    packings are chaotic."""

    def case(ranks):
        deck = neutral(packing, surface, **choices)
        dump = dump_grains(packing, 800)
        whole, parts = (
            run(replace(deck, body=[*lines, *dump, *runs]), ranks)
            for runs in (["run 800"], ["run 400", "run 100", "run 300"])
        )
        same_motion(whole, parts, packing)

    return case


def host_split_is_not(ranks):
    """The reason for all this."""
    deck = replace(neutral(SPHEROIDS), extra="")
    whole, parts = (
        run(replace(deck, body=[shear(RATE), *dump_grains(SPHEROIDS, 800), *runs]), ranks)
        for runs in (["run 800"], ["run 400", "run 400"])
    )
    difference = np.abs(whole.dump("grains.dump")[-1][1]["vx"] - parts.dump("grains.dump")[-1][1]["vx"]).max()
    require(difference > 1e-4, f"the host's own set-up is neutral to {difference}: setup neutral can go")


def measures_go_on(ranks):
    """All that has state, over a split run and over one that is not: totals of the ledger too."""
    deck = neutral(tilted(SPHEROIDS, 0.495))
    lines, printed = everything_with_state(deck)
    whole, parts = (
        run(replace(deck, body=[*lines, *thermo(10, *printed), *runs]), ranks).thermo()
        for runs in (["run 120"], ["run 60", "run 60"])
    )
    expected, found = whole[0], parts[1]
    for name, values in expected.items():
        # A scale for what is nearly nothing: the turnover of the ledger, the residual being its rounding.
        ledger = name.startswith("c_ledger[")
        scale = (
            max(np.abs(expected[word]).max() for word in C_LEDGER.vector()[: C_LEDGER.own.at("residual")])
            if ledger
            else max(1e-9, np.abs(values).max())
        )
        if name == C_LEDGER["residual_relative"]:
            scale = 1.0
        require_close(found[name], values[6:], 1e-9, name, scale)


def changes_are_noticed(change, **choices):
    """Between two runs something is changed: forces are recomputed, exactly as the host does."""

    def case(ranks):
        # Without tangential damping, which `neutral` keeps to the friction limit there (first_evaluation.py).
        deck = neutral(SPHEROIDS, **choices)
        deck = replace(deck, extra=f"{deck.extra} tangential_damping off")
        dump = dump_grains(SPHEROIDS, 60)
        found = run(replace(deck, body=["run 30", *change, *dump, "run 30"]), ranks)
        expected = run(
            replace(deck, extra="ledger on tangential_damping off", body=["run 30", *change, *dump, "run 30"]), ranks
        )
        require_same_snapshots(
            found.dump("grains.dump"), expected.dump("grains.dump"), "after a change, against setup host"
        )
        require("were changed since the last run" in found.output, "the run does not say so")

    return case


def restart_is_exact(packing, surface="ellipsoid", extra="setup neutral ledger on"):
    """write_restart and on, against read_restart and on, with everything that has state: to the last bit."""

    def case(ranks):
        deck = Deck(packing, surface=surface, extra=extra)
        lines, printed = everything_with_state(deck)
        rest = [*thermo(3, *printed), *dump_grains(packing, 60), "run 60"]
        through = run(
            replace(deck, body=[*lines, *thermo(1, *printed), "run 45", "write_restart half.restart", *rest]), ranks
        )
        again = run(deck.restarted(through.folder / "half.restart", [*lines, *rest]), ranks)
        expected, found = through.thermo()[-1], again.thermo()[-1]
        require(expected[C_MEMORY["samples"]][-1] > 5 and expected[F_PRESS["inputs"]][-1] > 2, "nothing was measured")
        first = 0 if "neutral" in extra else 1  # by the host's custom the first row of a run tells of recomputed forces
        same_tables({k: v[first:] for k, v in found.items()}, {k: v[first:] for k, v in expected.items()}, 0.0, 1.0)
        require_same_snapshots(
            again.dump("grains.dump")[-1:], through.dump("grains.dump")[-1:], "restarted against write and go on"
        )

    return case


def long_deck(packing, steps, every, ranks):
    deck = neutral(packing, processors=f"{ranks} 1 1")  # the host would choose a grid for the box that it finds
    lines, _ = everything_with_state(deck)
    end = [
        *dump_grains(packing, steps),
        f"restart {every} {' '.join(FILES)}",
        "thermo 10",
        FLUSHED,
        f"run {steps} upto",
    ]
    return replace(deck, body=[*lines, *end]), deck.restarted(" ".join(FILES), [*lines, *end])


def kill_after(under_way, rows):
    """At whatever it does just then, which may be writing a restart file."""
    wait_until(lambda: under_way.ended() or rows_so_far(under_way) > rows, f"{rows} rows of thermo output")
    under_way.kill()


def killed_and_resumed(packing, times, steps=3000, every=150):
    """SIGKILL at `times` random moments, each run resumed from the newer of its two restart files that is whole: the
    same final state, to the last bit, as a run that was left alone and wrote the same files."""

    def case(ranks):
        fresh, resumed = long_deck(packing, steps, every, ranks)
        reference = run(fresh, ranks).dump("grains.dump")[-1:]
        dice = random.Random(7)
        kills = resumptions = 0
        while kills < times or not resumptions:
            deck, folder, result = fresh, None, None
            while result is None:
                under_way = Started(deck, ranks, folder)
                folder = under_way.folder
                files = [folder / name for name in FILES]
                if kills < times or not resumptions:
                    kill_after(under_way, dice.randrange(steps // 20))
                result = under_way.end()
                resumptions += deck is resumed and rows_so_far(under_way) > 0
                if result.code < 0 or result.code == 128 + signal.SIGKILL:
                    kills += 1
                    deck, result = resumed if any(file.exists() for file in files) else fresh, None
                elif "ERROR: read_restart: '" in result.output and not all(file.exists() for file in files):
                    deck, result = fresh, None  # killed while it wrote its first restart file: there is no other
            require(result.code == 0, f"the run ended with code {result.code}: {result.output[-1000:]}")
            require_same_snapshots(result.dump("grains.dump")[-1:], reference, f"after {kills} kills")

    return case


def stopped_by(number, to_one_rank=False):
    """A cluster's time limit: all ranks stop in the same step, files end with a whole line, and the restart that is
    left goes on to the same state."""

    def case(ranks):
        steps = 100_000_000  # the signal is what ends it
        deck = neutral(SPHERES)
        lines, printed = everything_with_state(deck)
        body = [
            *lines,
            *thermo(10, *printed),
            FLUSHED,
            f"fix means all ave/time 1 1 1 {F_PRESS['strain']} {C_STRESS['sxx']} file means.txt",
            f"run {steps} upto",
            "print 'went on'",
        ]
        body.insert(len(lines), "compute stress all stress/contact")
        under_way = Started(replace(deck, body=body), ranks)
        wait_for_steps(under_way)
        if to_one_rank:
            os.kill(under_way.ranks()[-1], number)
        else:
            for pid in under_way.ranks():  # as a cluster does; mpirun alone would wait a second and kill
                os.kill(pid, number)
        result = under_way.end()
        require("ERROR" not in result.output, result.output[-2000:])
        require("went on" not in result.output, "the run was not stopped")
        left = list(result.folder.glob("restart_forced_liggghts_*.data"))
        require(len(left) == 1, f"restart files: {left}")
        at = int(left[0].name.split("_")[-1].split(".")[0])
        require(0 < at < steps, f"stopped at step {at}")
        means = (result.folder / "means.txt").read_text()
        require(
            means.endswith("\n") and int(means.splitlines()[-1].split()[0]) == at,
            f"the table of means ends: {means[-200:]}",
        )
        rest = [*lines, *dump_grains(SPHERES, at + 20), f"run {at + 20} upto"]
        again = run(deck.restarted(left[0], rest), ranks)
        whole = run(replace(deck, body=[*lines, *dump_grains(SPHERES, at + 20), f"run {at + 20} upto"]), ranks)
        same_motion(again, whole, SPHERES)  # the forced restart builds a list that the other run does not

    return case


def stopped_between_short_runs(ranks):
    """A deck that loops over `run 1`: the last step of each is as good as any."""
    deck = replace(
        neutral(SPHERES),
        body=[FLUSHED, "variable i loop 100000000", "label again", "run 1 post no", "next i", "jump SELF again"],
    )
    under_way = Started(deck, ranks)
    wait_for_steps(under_way)
    for pid in under_way.ranks():
        os.kill(pid, signal.SIGTERM)
    result = under_way.end()
    require(
        result.code == 0 and len(list(result.folder.glob("restart_forced_liggghts_*.data"))) == 1, result.output[-1000:]
    )


GRAVITY = "fix gravity all gravity 9.81 vector 0 -1 0"
CASES = {
    "split-spheres": split_is_neutral(SPHERES, [shear(RATE)]),
    "split-spheroids": split_is_neutral(SPHEROIDS, [shear(RATE)]),
    "split-superquadrics": split_is_neutral(SPHEROIDS, [PRESS], "superquadric"),
    "split-through-a-flip": split_is_neutral(tilted(SPHEROIDS, 0.495), [PRESS]),
    "split-of-spheres-through-a-flip": split_is_neutral(tilted(SPHERES, 0.495), [PRESS]),
    "split-with-rolling": split_is_neutral(SPHERES, [shear(RATE)], rolling="epsd2"),
    "split-without-history": split_is_neutral(SPHERES, [shear(RATE)], tangential="no_history"),
    "split-with-gravity": split_is_neutral(SPHERES, [GRAVITY]),
    "split-by-the-host": host_split_is_not,
    "measures-go-on": measures_go_on,
    "split-after-no-step": split_is_neutral(SPHEROIDS, [shear(RATE), "run 0"]),
    "sigterm-between-short-runs": stopped_between_short_runs,
    "noticed-freezing": changes_are_noticed(["group low id 1:40", "fix fr low freeze"]),
    "noticed-velocities": changes_are_noticed(["velocity all set 0 0 0"]),
    "noticed-spins": changes_are_noticed(["set atom 3 omegax 1.5"]),
    "noticed-places": changes_are_noticed(["displace_atoms all random 0.001 0.001 0.001 24571"]),
    "noticed-box": changes_are_noticed(["change_box all x scale 0.999 remap"]),
    "noticed-time-step": changes_are_noticed(["timestep 0.005"]),
    "noticed-deletion": changes_are_noticed(["group some id 5:9", "delete_atoms group some"]),
    "exact-spheres": restart_is_exact(tilted(SPHERES, 0.495)),
    "exact-spheroids": restart_is_exact(tilted(SPHEROIDS, 0.495)),
    "exact-superquadrics": restart_is_exact(tilted(SPHEROIDS, 0.495), "superquadric"),
    "exact-by-the-host": restart_is_exact(tilted(SPHEROIDS, 0.495), extra="ledger on"),
    "killed-spheroids": killed_and_resumed(SPHEROIDS, 20),
    "killed-spheres": killed_and_resumed(SPHERES, 20, 6000, 250),
    "killed-a-few-times": killed_and_resumed(SPHERES, 6, 4000, 200),
    "killed-twice": killed_and_resumed(SPHERES, 2, 800, 50),
    "sigterm": stopped_by(signal.SIGTERM),
    "sigint": stopped_by(signal.SIGINT),
    "sigterm-to-one-rank": stopped_by(signal.SIGTERM, True),
}

if __name__ == "__main__":
    main(CASES)
