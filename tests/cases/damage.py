# SPDX-License-Identifier: GPL-2.0-or-later
"""What happens to users: damaged files, full disks, numbers that are not finite, grains that get lost. An error that
says so, never a crash."""
from dataclasses import replace
import random
import resource

from case import main, require, require_same_snapshots
from deck import Deck, dump_grains, shear, thermo
from grainscope.columns import outputs
from packing import dense_packing
from run import Started, attempt, run, tail

C_S = outputs("stress/contact").of("s")

SPHERES, SPHEROIDS = dense_packing(atom_style="sphere"), dense_packing(1.5)


def saved(deck, ranks, name="half.restart"):
    return run(replace(deck, body=[shear(0.05), "run 30", f"write_restart {name}"]), ranks).folder / name


def refused(result, *words):
    """An error of ours or the host's, not a signal; reported once."""
    text = " ".join(result.output.split())
    require(result.code > 0, f"ended with code {result.code}:\n{tail(result.output)}")
    require("Signal: " not in text and "Segmentation" not in text, f"it crashed:\n{tail(result.output)}")
    for word in words:
        require(text.count(word) == 1, f"{word!r} is reported {text.count(word)} times:\n{tail(result.output)}")


def damaged(harm, tries, *words):
    """A restart file harmed in `tries` ways: always refused, before anything is run."""

    def case(ranks):
        deck = Deck(SPHEROIDS, surface="ellipsoid", extra="setup neutral ledger on")
        file = saved(deck, ranks)
        whole = file.read_bytes()
        dice = random.Random(11)
        resume = deck.restarted(file, ["run 1"])
        for k in range(tries):
            file.write_bytes(harm(whole, dice, k))
            refused(attempt(resume, ranks), "read_restart: ", *words)
        file.write_bytes(whole)
        run(resume, ranks)

    return case


def cut(whole, dice, k):
    """Short ends first: those are in the header and the fixes."""
    return whole[: dice.randrange(1, min(len(whole), 10 ** (2 + k % 4)))]


def flipped(whole, dice, k):
    bytes_ = bytearray(whole)
    for _ in range(dice.choice((1, 1, 3, 100))):
        bytes_[dice.randrange(10 ** (2 + k % 3) if k % 4 else len(whole))] ^= 1 << dice.randrange(8)
    return bytes(bytes_)


def newest_whole_one(ranks):
    """Of several files the newest that is whole; the others are named."""
    deck = Deck(SPHERES)
    folder = run(replace(deck, body=[shear(0.05), "restart 10 old new", "run 40"])).folder
    middle, last = folder / "old", folder / "new"  # of steps 30 and 40
    last.write_bytes(last.read_bytes()[:-100])
    result = run(deck.restarted(f"{last} {middle} {folder}/nowhere", ['print "at step $(step)"', "run 1"]), ranks)
    text = " ".join(result.output.split())
    require("at step 30" in text, "another file was taken")
    for word in (f"reading '{middle}', of step 30", f"'{last}' is truncated or damaged", "nowhere' cannot be opened"):
        require(word in text, f"{word!r} was not reported:\n{tail(result.output)}")
    refused(attempt(deck.restarted(f"{folder}/none*", ["run 1"]), ranks), "read_restart: no file matches")


def plain_gran_and_back(ranks):
    """Files of pair_style gran are read, and ours by pair_style gran: the same motion."""
    ours, host = Deck(SPHEROIDS), Deck(SPHEROIDS, pair="gran")
    rest = [shear(0.05), *dump_grains(SPHEROIDS, 20), "run 20"]
    for writer in (ours, host):
        file = saved(writer, ranks)
        found, expected = (run(reader.restarted(file, rest), ranks).dump("grains.dump") for reader in (ours, host))
        require_same_snapshots(found, expected, "read by gran/insitu against gran")


def other_settings(ranks):
    """Another surface, ledger, set-up or number of ranks: works, or is refused with the reason."""
    deck = Deck(SPHEROIDS, surface="ellipsoid", extra="setup neutral ledger on")
    file = saved(deck, ranks)
    steps = ["run 5"]
    run(deck.restarted(file, steps), 3 - ranks)
    run(replace(deck, extra="ledger on").restarted(file, steps), ranks)
    other = run(replace(deck, surface="superquadric").restarted(file, steps), ranks)
    require("the restart file was written with" in " ".join(other.output.split()), "another surface is not remarked on")
    refused(attempt(replace(deck, extra="").restarted(file, steps), ranks), "it was written with 'ledger on'")
    refused(attempt(replace(deck, tangential="no_history", extra="").restarted(file, steps), ranks))
    plain = saved(replace(deck, extra=""), ranks)
    run(replace(deck, extra="setup neutral").restarted(plain, steps), ranks)


def not_finite(lines, *words):
    def case(ranks):
        deck = Deck(SPHEROIDS, surface="ellipsoid", body=["run 5", *lines, "run 100"])
        refused(attempt(deck, ranks), *words)

    return case


def too_long_a_step(ranks):
    """Grains fly apart: something is said, by the host or by us, and the run does not go on."""
    deck = Deck(SPHERES, body=["timestep 50", "run 1000"])
    refused(attempt(deck, ranks))


def lost_from_a_periodic_box(ranks):
    """By the host's default (thermo_modify lost ignore) grains vanish without a word."""
    deck = Deck(SPHERES, body=["thermo_modify lost ignore", "set atom 3 vx 1e5", "set atom 40 vy -1e5", "run 2000"])
    refused(attempt(deck, ranks), "grains were lost though the box is periodic")


def lost_beside_an_open_face(ranks):
    """Along the axes that are periodic nothing may be lost, also where grains may leave along another."""
    deck = Deck(
        replace(SPHERES, triclinic=False),
        boundary="f p p",
        body=["thermo_modify lost ignore", "set atom 3 vy 1e5", "run 1500"],
    )
    refused(attempt(deck, ranks), "were lost though the box is periodic")


def may_leave_an_open_box(ranks):
    deck = Deck(
        replace(SPHERES, triclinic=False),
        boundary="f p p",
        body=["thermo_modify lost ignore", "set atom 3 vx 1e4", "run 1500"],
    )
    run(deck, ranks)


def disk_full(lines, *words, most=200_000):
    """No file may grow beyond `most` bytes, which takes some steps: what a full disk or a quota does."""

    def case(ranks):
        own = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (most, own[1]))  # for what is started
        under_way = Started(Deck(SPHEROIDS, body=[shear(0.05), *lines]), ranks)
        resource.setrlimit(resource.RLIMIT_FSIZE, own)
        refused(under_way.end(), *words)

    return case


CASES = {
    "restart-cut": damaged(cut, 12),
    "restart-flipped": damaged(flipped, 12),
    "restart-cut-often": damaged(cut, 300),
    "restart-flipped-often": damaged(flipped, 300),
    "newest-whole-one": newest_whole_one,
    "plain-gran-and-back": plain_gran_and_back,
    "other-settings": other_settings,
    "velocity-nan": not_finite(
        ["set atom 3 vx 1e999"], "the velocity of grains 3 is not finite: check the commands that set it"
    ),
    "force-inf": not_finite(
        ["group one id 17", "fix push one addforce 1e999 0 0"], "step 5: the force of grains 17 is not finite"
    ),
    "too-long-a-step": too_long_a_step,
    "lost-from-a-periodic-box": lost_from_a_periodic_box,
    "may-leave-an-open-box": may_leave_an_open_box,
    "lost-beside-an-open-face": lost_beside_an_open_face,
    "disk-full-snapshots": disk_full(
        [f"dump d all custom 10 d.*.txt id {'x y z vx vy vz ' * 24}", "run 100000"],
        "Output cannot be written",
        most=120_000,
    ),
    "disk-full-dump": disk_full([*dump_grains(SPHEROIDS, 1), "run 20000"], "Output cannot be written"),
    "disk-full-table": disk_full(
        [
            "compute s all stress/contact",
            f"fix t all ave/time 1 1 1 {C_S['sxx']} {C_S['syy']} {C_S['szz']} file t.txt",
            "run 100000",
        ],
        "Output cannot be written",
    ),
    "disk-full-log": disk_full([*thermo(1, "step"), "run 100000"], "cannot be written"),
    "disk-full-restart": disk_full(["restart 50 r.*", "run 100000"], "Output cannot be written"),
}

if __name__ == "__main__":
    main(CASES)
