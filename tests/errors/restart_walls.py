# SPDX-License-Identifier: GPL-2.0-or-later
"""Restart files with walls: what they hold of contacts with a wall is read by the same models and settings alone, and a
wall, fix or compute that has another ID than in the file is named."""
from dataclasses import replace
import os

from case import main, require
from catalogue import DISPLACEMENT, strain_lines
from deck import Deck, thermo
from packing import dense_packing
from plates import bed, plate_of
from refusal import require_refused
from run import run, tail

FLOOR = "zplane 0.0"
SPRINGS, ROLLING = "tangential history", "tangential no_history rolling_friction epsd2"
PAST = "ledger_stamp"
REMEDY = "use the contact models, the 'time_level', and the 'ledger' of the pair style that it was written with"


def wall(words, kind="primitive", name="floor"):
    """A floor under the bed, of one plane or of a mesh of the same place."""
    at = f"primitive type 1 {FLOOR}" if kind == "primitive" else "mesh n_meshes 1 meshes ground"
    models, _, settings = words.partition(" time_level")
    settings = f" time_level{settings}" if settings else ""
    return f"fix {name} all wall/gran model hertz {models} {at} allow_special_domain_periodic yes{settings}"


def ground(packing):
    """The mesh: a plate that stands where the floor is."""
    return [f"fix ground all mesh/surface file {plate_of(packing)} type 1 move 0. 0. {0.0 - top(packing):.17g}"]


def top(packing):
    return packing.origin[2] + packing.edges[2] - 3.0 + 0.05


def written(ranks, words, kind, extra="", surface="default", **options):
    """A restart file of a bed that touches its floor."""
    packing = bed(across=3, layers=2, style="sphere" if surface == "default" else "superquadric")
    rolling = "epsd2" if "epsd2" in words else "off"
    deck = Deck(packing, boundary="p p f", rolling=rolling, surface=surface, extra=extra)
    lines = [*(ground(packing) if kind == "mesh" else []), wall(words, kind)]
    deck.body = [*lines, "fix pull all gravity 9.81 vector 0 0 -1", "run 200", "write_restart now.restart"]
    return deck, run(deck, ranks, **options).folder / "now.restart"


def resumed(deck, file, words, kind, name="floor"):
    mesh = ground(deck.packing) if kind == "mesh" else []
    return deck.restarted(file, [*mesh, wall(words, kind, name), "fix pull all gravity 9.81 vector 0 0 -1", "run 1"])


def other_columns(kind, words, others, message, extra="", now=""):
    """Written with `words`, read with `others`."""

    def case(ranks):
        deck, file = written(ranks, words, kind, extra)
        run(resumed(deck, file, words, kind), ranks)
        deck = replace(deck, extra=now)
        require_refused(
            resumed(deck, file, others, kind), ranks, "fix floor (wall/gran): the restart file holds", message, REMEDY
        )

    return case


def of_liggghts(kind):
    """A file that LIGGGHTS's own fix wall/gran wrote says how many numbers it holds: their number is compared."""

    def case(ranks):
        deck, file = written(ranks, SPRINGS, kind, program=os.environ["GRAINSCOPE_HOST_WALLS"])
        run(resumed(deck, file, SPRINGS, kind), ranks)
        synchronized = SPRINGS + " time_level synchronized"
        words = "holds 3 numbers for each contact with this wall, this fix has 12"
        require_refused(resumed(deck, file, synchronized, kind), ranks, "fix floor (wall/gran)", words, REMEDY)

    return case


def of_the_other_surface(kind):
    """Files of both surfaces of superquadrics hold the same numbers."""

    def case(ranks):
        for surface, other in (("ellipsoid", "superquadric"), ("superquadric", "ellipsoid")):
            deck, file = written(ranks, f"{SPRINGS} surface {surface}", kind, surface=surface)
            run(resumed(replace(deck, surface=other), file, f"{SPRINGS} surface {other}", kind), ranks)

    return case


LOST = "which is not in this run, and not the"


def warnings_of(deck_text, ranks):
    output = " ".join(run(deck_text, ranks).output.split())
    return output.count(LOST), output


def wall_of_another_id(kind):
    """Its springs begin at zero, which is said; nothing is said of a wall that was taken away or is new."""

    def case(ranks):
        deck, file = written(ranks, SPRINGS, kind)
        count, output = warnings_of(resumed(deck, file, SPRINGS, kind), ranks)
        require(count == 0, f"a warning of the same wall: {tail(output)}")
        changed = resumed(deck, file, SPRINGS, kind, "bottom")
        there, here = "floor", "bottom"
        if kind == "mesh":
            changed = changed.replace(" ground ", " plane ").replace("meshes ground", "meshes plane")
            there, here = "ground", "plane"
        count, output = warnings_of(changed, ranks)
        words = f"holds the springs at wall '{there}', {LOST} springs at wall '{here}': if one is to continue"
        require(count == 1 and words in output, f"{count} warnings: {output[-2500:]}")
        none = [line for line in changed.splitlines() if "wall/gran" not in line]
        count, output = warnings_of("\n".join(none) + "\n", ranks)
        require(count == 0, f"a warning of a wall that was taken away: {output[-2500:]}")

    return case


def state_of_another_id(ranks):
    """Strain, memory and ledger of styles that are called otherwise."""
    deck = Deck(dense_packing(1.5), surface="ellipsoid", extra="ledger on")
    press_strain = "fix press all press/strain axis y target 2e5 shear xy rate 0.05 every 7e-4"
    lines = [*strain_lines(0.05), press_strain, DISPLACEMENT.define("all"), "compute ledger all energy/ledger"]
    lines += thermo(5, "c_ledger[1]")
    file = run(replace(deck, body=[*lines, "run 5", "write_restart now.restart"]), ranks).folder / "now.restart"
    same = deck.restarted(file, [*lines, "run 1"])
    require(warnings_of(same, ranks)[0] == 0, "a warning of the same IDs")
    renamed = same.replace("fix press all", "fix held all").replace("compute moved", "compute moves")
    renamed = renamed.replace("compute ledger", "compute account").replace("c_ledger", "c_account")
    count, output = warnings_of(renamed.replace("f_press", "f_held"), ranks)
    for words in (
        f"the state of fix press/strain 'press', {LOST} state of fix press/strain 'held'",
        f"the memory of compute 'moved', {LOST} memory of compute 'moves'",
        f"the ledger of compute 'ledger', {LOST} ledger of compute 'account'",
    ):
        require(words in output, f"no '{words}' in {output[-3000:]}")
    require(count == 3, f"{count} warnings")


SPRING = "'shearx sheary shearz'"
CASES = {"state-of-another-id": state_of_another_id}
for kind in ("primitive", "mesh"):
    CASES[f"{kind}-other-models"] = other_columns(
        kind, ROLLING, SPRINGS, f"for each contact with this wall, this fix has {SPRING}"
    )
    CASES[f"{kind}-other-time-level"] = other_columns(
        kind, SPRINGS, SPRINGS + " time_level synchronized", f"{SPRING} for each contact with this wall, this fix has"
    )
    CASES[f"{kind}-without-the-time-level"] = other_columns(
        kind, SPRINGS + " time_level synchronized", SPRINGS, f"this fix has {SPRING}"
    )
    CASES[f"{kind}-without-the-ledger"] = other_columns(kind, SPRINGS, SPRINGS, f"this fix has {SPRING}", "ledger on")
    CASES[f"{kind}-of-liggghts"] = of_liggghts(kind)
    CASES[f"{kind}-of-the-other-surface"] = of_the_other_surface(kind)
    CASES[f"{kind}-of-another-id"] = wall_of_another_id(kind)

if __name__ == "__main__":
    main(CASES)
