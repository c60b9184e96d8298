# SPDX-License-Identifier: GPL-2.0-or-later
"""Right words in surroundings that are not: pair and atom style, box, groups, computes, fixes and variables that are
gone or become no number. Refused before anything runs, or at the step that shows it, with what to do. A case may hold
several decks."""
import re

from case import main, require
from deck import Deck, thermo
from packing import dense_packing
from refusal import require_refused
from run import run

SPHERES = dense_packing(atom_style="sphere")
CONTACTS = ["stress/contact", "dissipation", "fabric", "contact/direction", "contact/grain", "contact/local"]
LEDGERS = {"energy/ledger": "energy/ledger", "dissipation mode ledger": "dissipation mode ledger"}
STRAINED = ["displacement/shear", "velocity/memory"]
GRAINS = ["nematic", "fluctuation", "velocity/correlation", "velocity/memory strain v_s"]
PRESS = "fix press all press/strain axis y target 1e5 shear xy rate 0.05 every 1e-3"
NAN, INF = "(step>=3)*(exp(1e4)-exp(1e4))", "(step>=3)*exp((step>=3)*1e4)"


def body(*lines, extra="", **choices):
    return Deck(SPHERES, body=list(lines), extra=extra, **choices)


def refused(*pairs):
    """(deck or text, words...) each."""

    def case(ranks):
        for deck, *words in pairs:
            require_refused(deck, ranks, *words)

    return case


def without_pair(*lines):
    return re.sub("pair_style.*\npair_coeff.*\n", "", body(*lines, "run 1").text())


def watchers():
    """Everything that needs the pair style, with the name it complains in."""
    yield from ((f"compute c all {style}", f"compute {style}") for style in CONTACTS)
    yield from ((f"compute c all {style}", f"compute c ({name})") for style, name in LEDGERS.items())
    yield "compute c all contact/solver", "compute contact/solver"
    yield PRESS, "fix press/strain"


def before_a_box(line, *lines):
    return "\n".join(["atom_style sphere", "variable s equal step", line, *lines]) + "\n"


def of_a_variable(formula, line):
    asked = ["c_c"] if line.startswith("compute") else ["step"]
    return body(f"variable v equal {formula}", line, *thermo(1, *asked), "run 5")


def becoming(formula, got):
    """Strains, pressures and rates that are no number from the third step on."""
    for style in STRAINED:
        yield of_a_variable(
            f"1e-3*step+{formula}", f"compute c all {style} strain v_v"
        ), f"{style}: 'strain' must be finite, got 'v_v = {got}'"
    yield of_a_variable(
        f"1e5+{formula}", PRESS.replace("1e5", "v_v")
    ), f"'target' must be a pressure >= 0, got v_v = {got}"
    yield of_a_variable(
        f"0.05+{formula}", PRESS.replace("0.05", "v_v")
    ), f"'rate' must be a shear rate other than 0, got v_v = {got}"


def gone(word, *lines):
    """Deleted after a run, and between the runs of `run every`."""
    yield body(*lines, "run 2", word, "run 2")
    yield body(*lines, f'run 4 every 2 "{word}"')


def after_gone(word, lines, *words):
    return refused(*((deck, *words) for deck in gone(word, *lines)))


def boxes_that_changed():
    for change, words in {
        "boundary p f p": "cannot move box edges along 'y': the box must be periodic there",
        "boundary p s p": "cannot move box edges along 'y': the box must be periodic there",
        "boundary f p p": "'shear xy' needs a box periodic along both axes",
        "xz final 0.1 units box": "with 'shear xy' the tilt xz must be 0, got 0.1",
        "ortho": "Cannot change box to orthogonal when tilt is non-zero",
    }.items():
        yield body(PRESS, "run 2", f"change_box all {change}", "run 1"), words
    still = PRESS.replace("shear xy rate 0.05 every 1e-3", "every/step 5")
    yield body(
        still, "run 2", "change_box all ortho", "run 1"
    ), "Cannot change box ortho/triclinic with certain fixes defined"


def renumbered_warned(ranks):
    """Without a ledger the run goes on, as the host's does, and it is said once."""
    text = run(body("run 5", *RENUMBER, "run 1", "run 1"), ranks).output
    require(text.count("grains got new IDs") == 1, "no warning, or several")
    text = run(body("run 5", *RENUMBER[:-1], RENUMBER[-1] + " compress no", "run 1"), ranks).output
    require("other IDs" not in text, "a warning for nothing")


NO_STRAIN = "needs a strain: use fix press/strain, or the keyword 'strain' with f_ID[n], v_name or time"
FOLLOW = [PRESS, "compute c all displacement/shear", "compute d all velocity/memory", *thermo(1, "c_c", "c_d")]
NAMED = [PRESS, "compute c all displacement/shear strain f_press[1]", *thermo(1, "c_c")]
VARIABLE = ["variable v equal step*1e-3", "compute c all velocity/memory strain v_v", *thermo(1, "c_c")]
RENUMBER = ["group few id 3:9", "delete_atoms group few"]
AVERAGE = ["compute c all fluctuation", "fix mean all ave/time 1 1 1 c_c file mean.txt"]
MOVING_REGION = "region r block 0 1 0 1 0 1 move v_p NULL NULL units box"  # LIGGGHTS announces nothing for it
CASES = {
    "no-pair-style": refused(
        *(
            (without_pair(line), f"{name} requires pair_style gran/insitu, got 'no pair style'")
            for line, name in watchers()
        )
    ),
    "pair-style-gran": refused(
        *(
            (body(line, "run 1", pair="gran"), f"{name} requires pair_style gran/insitu, got 'gran'")
            for line, name in watchers()
        )
    ),
    "words-before-hybrid": refused(
        (
            body("run 1").text().replace("pair_style gran/insitu", "pair_style hybrid gran/insitu ledger maybe"),
            "pair_style gran/insitu: 'ledger' must be on or off, got 'maybe'",
        )
    ),
    "memory-before-box": refused(
        *(
            (
                before_a_box(f"compute c all {line}"),
                f"compute {line.split()[0]}: keeps data of each grain: define it after the simulation box",
            )
            for line in [*LEDGERS, *(f"{style} strain v_s" for style in STRAINED)]
        )
    ),
    "atom-style": refused(
        *(
            (
                f"variable s equal step\ncompute c all {line}\n",
                f"compute {line.split()[0]}: needs atom_style superquadric or sphere, " "got 'atomic'",
            )
            for line in GRAINS
        )
    ),
    "atom-style-changed-later": refused(
        *(
            (
                before_a_box(
                    f"compute c all {line}",
                    "atom_style atomic",
                    "region box block 0 9 0 9 0 9 units box",
                    "create_box 1 box",
                    "mass 1 1.0",
                    "atom_modify sort 0 0",
                    "neighbor 1.0 bin",
                    "run 0",
                ),
                f"compute {line}: needs atom_style superquadric or sphere, got 'atomic'",
            )
            for line in GRAINS[:3]
        )
    ),
    "group-deleted": refused(
        *(
            (
                body("variable s equal step", "group few id 1:9", f"compute c few {line}", "group few delete"),
                "Cannot delete group currently used by a",
            )
            for line in (CONTACTS[0], GRAINS[-1], "energy/ledger")
        ),
        *(
            (
                body("group few id 1:9", PRESS.replace("all", "few"), *lines, "run 1"),
                "its group 'few' was deleted: define the group and the fix again",
            )
            for lines in (["group few delete"], ["run 3", "group few delete", "group other id 3:5"])
        ),
    ),
    "compute-deleted": refused(
        (body(*AVERAGE, "run 2", "uncompute c", "run 1"), "Compute ID for fix ave/time does not exist"),
        (body(*FOLLOW, "run 2", "uncompute c", "run 1"), "Could not find thermo compute ID"),
    ),
    "strain-fix-deleted": after_gone("unfix press", FOLLOW, NO_STRAIN),
    "named-strain-fix-deleted": after_gone(
        "unfix press", NAMED, "'strain' must be the element of a fix that is defined, got 'f_press[1]'"
    ),
    "strain-variable-deleted": after_gone(
        "variable v delete", VARIABLE, "'strain' must be an equal-style variable that is defined, got 'v_v'"
    ),
    "target-variable-deleted": after_gone(
        "variable v delete",
        ["variable v equal 1e5", PRESS.replace("1e5", "v_v")],
        "'target' must name an equal-style variable, got 'v_v', which does not exist",
    ),
    "variable-becomes-nan": refused(*becoming(NAN, "nan")),
    "variable-becomes-infinite": refused(*becoming(INF, "inf")),
    "variable-becomes-negative": refused(
        (of_a_variable("2e-9-1e-9*step", PRESS.replace("1e5", "v_v")), "must be a pressure >= 0, got v_v = -1e-09"),
        (of_a_variable("0.05*(3-step)", PRESS.replace("0.05", "v_v")), "a shear rate other than 0, got v_v = 0"),
    ),
    "box-changed": refused(*boxes_that_changed()),
    "grains-renumbered": refused(
        (
            body("compute c all energy/ledger", "run 5", *RENUMBER, "run 1", extra="ledger on"),
            "compute c (energy/ledger): grains got new IDs",
            "use 'delete_atoms ... compress no'",
        )
    ),
    "grains-renumbered-warned": renumbered_warned,
    "memory-replaced-by-hand": refused(
        (
            body("variable v equal step", VARIABLE[1], "run 1", "fix c_record all grain/record 3 5 0", "run 1"),
            "fix grain/record: is made by the computes that need it",
        )
    ),
    "asked-between-runs": refused(
        *(
            (
                body(*lines, 'print "$(c_c[1])"', extra="ledger on"),
                "Compute used in variable between runs is not current",
            )
            for lines in (
                ["run 3", "compute c all stress/contact"],
                ["compute c all fabric", "run 3", "reset_timestep 7"],
                ["compute c all dissipation mode ledger", "run 3"],
            )
        )
    ),
    "asked-on-a-step-of-no-one": refused(
        (
            body(
                "compute c all stress/contact",
                "variable p equal 0*c_c",
                MOVING_REGION,
                "fix push all addforce 0.0 0.0 0.0 region r",
                *thermo(100, "step"),
                "run 5",
            ),
            "compute stress/contact c: not evaluated on this step, because nothing requested it in advance",
        )
    ),
    "strain-not-set-up": refused(
        (body("run 1", *VARIABLE, "run 2 pre no"), "compute velocity/memory: was not set up: do not use 'pre no'")
    ),
}

if __name__ == "__main__":
    main(CASES)
