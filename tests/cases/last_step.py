# SPDX-License-Identifier: GPL-2.0-or-later
"""The last step of every run can be asked for: by `update_on_run_end yes`, by `print` and variables after the run, in
loops and between the runs of `run every`. The values are those that thermo gives for that step, to the last bit, and
the grains move as without."""
from dataclasses import replace
import re

import numpy as np

from case import main, require, require_close, require_equal, require_same_snapshots
from catalogue import DIRECTION, DISPLACEMENT, FABRIC, MEMORY, SURFACE, strain_lines
from deck import Deck, dump_grains, shear, thermo
from grainscope.columns import outputs
from packing import dense_packing
from refusal import require_refused
from run import run
from watch import Watched

C_FABRIC = outputs("fabric").of("fabric")
C_GRAIN = outputs("contact/grain").of("grain")
C_LOSS = outputs("dissipation").of("loss")
C_STRESS = outputs("stress/contact").of("stress")

RATE = 0.05
STRESS = Watched("stress", "stress/contact", True, 36)
DISSIPATION = Watched("loss", "dissipation", True, 10)
INSTANTANEOUS = Watched("now", "dissipation mode instantaneous", True, 10)
LEDGER_LOSS = Watched("booked", "dissipation mode ledger", True, 10)
LEDGER = Watched("energy", "energy/ledger", True, 4)
SEEN = [STRESS, DISSIPATION, INSTANTANEOUS, FABRIC, SURFACE, DIRECTION]
PACKING = dense_packing(1.5)


def deck(*lines, computes=(), pair_extra=""):
    defined = [*strain_lines(RATE), shear(RATE), *(w.define("all") for w in computes)]
    return Deck(PACKING, body=[*defined, *lines], extra=pair_extra)


def at_run_end(watched):
    return [replace(w, command=re.sub(r"^(\S+)", r"\1 update_on_run_end yes", w.command)) for w in watched]


def columns(computes):
    return [q for w in computes for q in w.columns()]


def printing(quantities):
    """Lines that print a name and its value each; `print` cuts long lines."""
    return [f'print "ASKED $(step) {q} $({q})"' for q in quantities]


def printed(result, quantities):
    """{step: array}, or arrays one under the other where a step was asked for several times."""
    found = {}
    for step, name, value in re.findall(r"^ASKED (\d+) (\S+) (\S+)$", result.file("log.liggghts").read_text(), re.M):
        found.setdefault(int(step), {}).setdefault(name, []).append(float(value))
    return {step: np.array([values[q] for q in quantities]).T for step, values in found.items()}


def reference(runs, computes, ranks, every=1, pair_extra=""):
    """Thermo of every step, per run."""
    lines = [*thermo(every, *columns(computes)), *dump_grains(PACKING, 1), *(f"run {n}" for n in runs)]
    result = run(deck(*lines, computes=computes, pair_extra=pair_extra), ranks)
    return [np.array([table[q] for q in columns(computes)]).T for table in result.thermo()], result.dump("grains.dump")


def after_a_run(ranks):
    """Nobody asks during the runs; `run 0` is a run, whose last step is its first."""
    quantities = columns(SEEN)
    expected, _ = reference([7, 5, 0], SEEN, ranks)
    lines = []
    for n in (7, 5, 0):
        lines += [f"run {n}", *printing(quantities)]
    found = printed(run(deck(*lines, computes=SEEN), ranks), quantities)
    require(sorted(found) == [7, 12], f"steps {sorted(found)}")
    require_equal(found[7][0], expected[0][-1], "step 7")
    require_equal(found[12][0], expected[1][-1], "step 12")
    require_equal(found[12][1], expected[2][-1], "step 12, run 0")


def grains_move_as_without(ranks):
    dump = dump_grains(PACKING, 1)
    bare = run(deck(*dump, *["run 2"] * 3), ranks).dump("grains.dump")
    asked = run(deck(*dump, *["run 2", *printing(["c_stress", "c_loss"])] * 3, computes=SEEN), ranks)
    require_same_snapshots(asked.dump("grains.dump"), bare, "grains")


def in_formulas(ranks):
    """A variable by its name, in a condition, and through another variable."""
    lines = [
        f"variable ratio equal {C_STRESS['mu_eff']}*2",
        f"variable twice equal v_ratio+{C_LOSS['P_n']}",
        "run 6",
        'print "ASKED $(step) twice $(v_twice)"',
        'print "ratio ${ratio}"',
        f'if "$({C_FABRIC["N_c"]}) > 10" then "print \'ASKED 6 many 1\'"',
    ]
    result = run(deck(*lines, computes=SEEN), ranks)
    found = printed(result, ["twice", "many"])
    expected, _ = reference([6], SEEN, ranks)
    names = columns(SEEN)
    ratio, loss = (expected[0][-1][names.index(q)] for q in (C_STRESS["mu_eff"], C_LOSS["P_n"]))
    require_close(found[6][0], [2.0 * ratio + loss, 1.0], 1e-14, "formulas, whose parts the host writes with 15 digits")
    named = float(re.search(r"^ratio (\S+)$", result.file("log.liggghts").read_text(), re.M).group(1))
    require_close(named, 2.0 * ratio, 1e-9, "ratio, which the host writes with ten digits")


def loops(ranks):
    """`run every` with commands, and loops over short runs without set-up: the steps of one run."""
    quantities = columns(SEEN)
    expected, _ = reference([6], SEEN, ranks)
    commands = " ".join('"' + line.replace('"', "'") + '"' for line in printing(quantities[:40]))
    every = printed(run(deck(f"run 6 every 2 {commands}", computes=SEEN), ranks), quantities[:40])
    require(sorted(every) == [2, 4, 6], f"steps {sorted(every)}")
    require_equal(every[2][0], expected[0][2][:40], "run every: step 2")
    # Fix deform, which is not set up again, moves the box from the first step to the last.
    whole = "post no start 0 stop 6"
    lines = [f"run 2 {whole}", *printing(quantities)]
    for _ in range(2):
        lines += [f"run 2 pre no {whole}", *printing(quantities)]
    found = printed(run(deck(*lines, computes=SEEN), ranks), quantities)
    for step in (2, 4, 6):
        require_equal(found[step][0], expected[0][step], f"pre no: step {step}")


def thermo_changed(ranks):
    """The first row of a run without set-up asks for what nobody announced in the run before."""
    expected, _ = reference([6], SEEN, ranks)
    result = run(deck("run 3 post no", *thermo(1, *columns(SEEN)), "run 3 pre no", computes=SEEN), ranks)
    row = result.thermo()[-1]
    require_equal([row[q][0] for q in columns(SEEN)], expected[0][3], "step 3")


def by_update_on_run_end(ranks):
    """LIGGGHTS's own way, of scalars, vectors and arrays, the ledger's too."""
    asked = [*SEEN, LEDGER_LOSS, LEDGER]
    quantities = columns(asked)
    expected, _ = reference([5, 3], asked, ranks, pair_extra="ledger on")
    lines = ["thermo 10", "run 5", *printing(quantities), "run 3", *printing(quantities)]
    found = printed(run(deck(*lines, computes=at_run_end(asked), pair_extra="ledger on"), ranks), quantities)
    require_equal(found[5][0], expected[0][-1], "step 5")
    require_equal(found[8][0], expected[1][-1], "step 8")


def stays_until_the_next_run(ranks):
    """Commands between runs change grains, not what was measured; the next run measures the grains as they are then."""
    quantities = columns([STRESS, DISSIPATION])
    expected, _ = reference([4], [STRESS, DISSIPATION], ranks)
    lines = [
        "run 4",
        "velocity all set 1.0 0.0 0.0",
        *printing(quantities),
        "run 0 pre no",
        *printing(quantities),
        "run 0",
        *printing(quantities),
    ]
    found = printed(run(deck(*lines, computes=[STRESS, DISSIPATION]), ranks), quantities)[4]
    require_equal(found[0], expected[0][-1], "after the run")
    require_equal(found[1], expected[0][-1], "after a run that evaluates nothing")
    found = found[1:]
    kinetic = [quantities.index(C_STRESS[f"s{ab}_kinetic"]) for ab in "xx yy zz xy xz yz".split()]
    # The mean velocity is 1: what is left of each grain's is the rounding of sums of 1.
    require(
        bool((np.abs(found[1][kinetic]) < 1e-12 * np.abs(found[0][kinetic]).max()).all()),
        f"of the next run: {found[1][kinetic]}",
    )


def grains_change_between_runs(ranks):
    """Numbers of single grains: not of a step that nobody asked for, and not when grains are others than then."""
    grain, dumped = "compute grain all contact/grain", f"write_dump all custom grains.dump id {C_GRAIN['N_c']}"
    asked = [*thermo(5, "c_most"), "run 5"]
    most = f"compute most all reduce max {C_GRAIN['N_c']}"
    within = run(deck(grain, f"dump d all custom 5 grains.dump id {C_GRAIN['N_c']}", "run 5"), ranks).dump(
        "grains.dump"
    )[-1]
    after = run(deck(grain, most, *asked, dumped), ranks).dump("grains.dump")[-1]
    for found, expected in zip(*(np.array(list(s[1].values()))[:, np.argsort(s[1]["id"])] for s in (after, within))):
        require_equal(found, expected, "asked within the run, and once more after it")
    require_refused(deck(grain, "run 5", dumped), ranks, "compute contact/grain grain: not evaluated on this step")
    for change in (
        ["group gone id 2", "delete_atoms group gone compress no"],
        ["create_atoms 1 single 0.1 0.1 0.1 units box"],
    ):
        require_refused(
            deck(grain, most, *asked, *change, dumped),
            ranks,
            "compute contact/grain grain: grains were sorted, added or removed after the last step",
        )


def rows_after_a_run(ranks):
    """contact/local by write_dump: the rows of the last step."""
    rows = ["compute rows all contact/local id overlap fn"]
    names = " ".join(outputs("contact/local", ("id_i", "id_j", "overlap", "fn")).of("rows").all("local"))
    expected = run(deck(*rows, f"dump d all local 5 rows.dump {names}", "run 5"), ranks).dump("rows.dump")[-1]
    found = run(deck(*rows, "run 5", f"write_dump all local rows.dump {names}"), ranks).dump("rows.dump")[-1]

    def sorted_rows(snapshot):
        table = np.array(list(snapshot[1].values())).T
        return table[np.lexsort(table.T[::-1])]

    require(len(sorted_rows(expected)) > 100, "few contacts")
    require_equal(sorted_rows(found), sorted_rows(expected), "rows")


def sums_are_not_asked_twice(ranks):
    """What adds up over calls: the same series whether or not it is asked for again at the end of each run."""
    watched = [DISPLACEMENT, MEMORY, DISSIPATION, LEDGER_LOSS, LEDGER]
    quantities = columns(watched)
    asking = printing(quantities[:20])
    lines = [*thermo(2, *quantities), "run 6", *asking, *asking, "run 6", *asking]
    bare = deck(*thermo(2, *quantities), "run 6", "run 6", computes=watched, pair_extra="ledger on")
    once = run(bare, ranks).thermo()
    twice = run(deck(*lines, computes=at_run_end(watched), pair_extra="ledger on"), ranks).thermo()
    for k in range(2):
        for q in quantities:
            require_equal(twice[k][q], once[k][q], f"run {k + 1}, {q}")


CASES = {
    "after-a-run": after_a_run,
    "grains-move-as-without": grains_move_as_without,
    "in-formulas": in_formulas,
    "loops": loops,
    "thermo-changed": thermo_changed,
    "by-update-on-run-end": by_update_on_run_end,
    "stays-until-the-next-run": stays_until_the_next_run,
    "grains-change-between-runs": grains_change_between_runs,
    "rows-after-a-run": rows_after_a_run,
    "sums-are-not-asked-twice": sums_are_not_asked_twice,
}

if __name__ == "__main__":
    main(CASES)
