# SPDX-License-Identifier: GPL-2.0-or-later
"""The command outputs: what it prints and defines. Everything that reads one of its variables gets the number of
c_ID[k] to the last bit."""
import re

import numpy as np

from case import main, require, require_close, require_equal
from deck import Deck, shear, thermo
from grainscope.columns import outputs
from make_columns import tables
from packing import dense_packing
from run import run

PACKING = dense_packing(1.5)
FLOW = ["variable strain equal 0.05*step*dt", shear(0.05)]
STRESS = ["compute stress all stress/contact", "outputs stress"]
# LIGGGHTS hands the value of one variable on to another in 15 digits.
HANDED_ON = 1e-14
ASKED = ("P", "mu_eff", "Z", "N_c", "sxy_kinetic", "kappa")


def deck(*lines, **choices):
    return Deck(PACKING, body=[*FLOW, *lines], **choices)


def pairs(ID, style, names):
    """(v_ID_name, c_ID[k]) of each."""
    return [(f"v_{ID}_{name}", outputs(style).word(ID, name)) for name in names]


def require_same(table, both, what):
    for named, counted in both:
        require_equal(table[named], table[counted], f"{what}: {named}")


def read_everywhere(ranks):
    """thermo, fix ave/time (to its six digits), print, other variables and ${} read the names; headings and headers
    carry them."""
    both = pairs("stress", "stress/contact", ASKED)
    p = outputs("stress/contact").word("stress", "P")
    result = run(
        deck(
            *STRESS,
            "variable twice equal 2*v_stress_P",
            f"variable counted equal 2*{p}",
            "fix named all ave/time 5 1 5 v_stress_P v_stress_mu_eff v_twice file named.txt",
            f"fix counted all ave/time 5 1 5 {p} {both[1][1]} v_counted file counted.txt",
            *thermo(5, *(word for pair in both for word in pair), "v_twice", "v_counted"),
            "run 20",
            f'print "ASKED ${{stress_P}} $(v_stress_P) $({p})"',
        ),
        ranks,
    )
    table = result.thermo()[-1]
    require_same(table, both, "thermo")
    require_close(table["v_twice"], table["v_counted"], HANDED_ON, "a variable of a variable")
    named, counted = result.averages("named.txt"), result.averages("counted.txt")
    require(list(named)[1:] == ["v_stress_P", "v_stress_mu_eff", "v_twice"], f"header {list(named)}")
    for (left, one), (right, other) in zip(named.items(), counted.items()):
        require_equal(one, other, f"fix ave/time: {left}, {right}")
    log = result.file("log.liggghts").read_text()
    heading = next(line.split() for line in log.splitlines() if line.split()[:1] == ["Step"])
    require(
        heading[1] == "stress_P" and heading[3] == "stress_mu_eff" and heading[9] == "stress_sxy_kinetic",
        f"headings {heading}",
    )
    said = re.findall(r"^ASKED (\S+) (\S+) (\S+)$", log, flags=re.M)[-1]
    require(float(said[0]) == float(said[1]) == float(f"{float(said[2]):.15g}"), f"print: {said}")


def announced(ranks):
    """A compute that is reached by names alone is ready on the steps that need it."""
    body = [
        *STRESS,
        "compute power all dissipation mode instantaneous",
        "outputs power",
        "compute fabric all fabric",
        "outputs fabric",
        "fix named all ave/time 3 2 6 v_power_P_n v_fabric_deviator file named.txt",
        *thermo(4, "v_stress_P", "v_fabric_N_c"),
        "run 21",
    ]
    result = run(deck(*body), ranks)
    require(list(result.thermo()[-1]["step"]) == [0, 4, 8, 12, 16, 20, 21], "steps of thermo")
    counted = [
        line.replace("v_power_P_n", outputs("dissipation").word("power", "P_n")).replace(
            "v_fabric_deviator", outputs("fabric").word("fabric", "deviator")
        )
        for line in body
    ]
    other = run(deck(*counted), ranks)
    for (name, one), (_, another) in zip(result.averages("named.txt").items(), other.averages("named.txt").items()):
        require_equal(one, another, name)


def lasting(ranks):
    """In a loop of runs, after another `outputs`, after a restart and after clear."""
    both = pairs("stress", "stress/contact", ASKED)
    asked = thermo(1, *(word for pair in both for word in pair))
    first = deck(
        *STRESS,
        *asked,
        "write_restart state.restart",
        "variable k loop 3",
        "label more",
        "outputs stress",
        "run 2",
        "next k",
        "jump SELF more",
    )
    result = run(first, ranks)
    tables_of_runs = result.thermo()
    require(len(tables_of_runs) == 3, f"{len(tables_of_runs)} runs")
    for table in tables_of_runs:
        require_same(table, both, "loop")
    body = [*FLOW, *STRESS, *asked, "run 2"]
    restarted = run(first.restarted("state.restart", body), ranks, folder=result.folder)
    require_same(restarted.thermo()[-1], both, "restart")
    cleared = first.text().split("write_restart")[0] + "run 1\nclear\n" + deck(*STRESS, *asked, "run 2").text()
    again = run(cleared, ranks).thermo()
    require(len(again) == 2, "two runs")
    for table in again:
        require_same(table, both, "clear")
    for named, _ in both:
        require_equal(again[1][named][:1], again[0][named][:1], f"clear: {named}")


def said(result, ID):
    return tables(result.file("log.liggghts").read_text())[ID]


def printed_once(ranks):
    """On the screen and in the log file, by one rank."""
    result = run(deck(*STRESS, "run 0"), ranks)
    for text in (result.output, result.file("log.liggghts").read_text()):
        text = re.sub(" +", " ", text)
        require(text.count("Outputs of compute stress (stress/contact)") == 1, "the table is not there once")
        require(text.count("| v_stress_mu_eff = c_stress[27] |") == 1, "no line of mu_eff, or several")
        require(text.count("| c_stress, the same as c_stress[26] |") == 1, "no line of the scalar, or several")


def prefixes(ranks):
    """The same numbers under another name, for a compute and a fix; and the scalar that no element is."""
    result = run(
        deck(
            "compute stress all stress/contact",
            "outputs stress prefix s1",
            "outputs stress",
            "compute power all dissipation",
            "outputs power prefix _",
            *thermo(1, "v_s1_P", "v_stress_P", "c_stress", "v___P_total", "c_power"),
            "run 2",
        ),
        ranks,
    )
    require_same(
        result.thermo()[-1], [("v_s1_P", "c_stress"), ("v_stress_P", "c_stress"), ("v___P_total", "c_power")], "prefix"
    )
    press = Deck(
        PACKING,
        body=[
            "fix press all press/strain axis y target 1e5 shear xy rate 0.05 every 1e-4",
            "outputs press prefix box",
            *thermo(1, "v_box_P_mean", "f_press", "v_box_L", outputs("press/strain").word("press", "L")),
            "run 3",
        ],
    )
    require_same(
        run(press, ranks).thermo()[-1],
        [("v_box_P_mean", "f_press"), ("v_box_L", outputs("press/strain").word("press", "L"))],
        "fix",
    )


def chosen(ranks):
    """What keywords choose is named, in the order asked for."""
    result = run(
        deck(
            "compute fabric all fabric force/tangential branch",
            "outputs fabric",
            "compute rows all contact/local fn id",
            "outputs rows",
            "compute one all contact/local fn",
            "outputs one",
            "compute shapes all property/atom mass shapey",
            "outputs shapes",
            "run 0",
        )
    )
    vector = [one["name"] for one in said(result, "fabric")["vector"]]
    require(
        vector[22:]
        == [f"{tensor}_{ab}" for tensor in ("force_tangential", "branch") for ab in "xx yy zz xy xz yz".split()],
        f"{vector}",
    )
    log = result.file("log.liggghts").read_text()
    for words in (
        "| fn | force | intensive | c_rows[1] |",
        "| id_i | - | intensive | c_rows[2] |",
        "| fn | force | intensive | c_one |",
        "| mass | as in LIGGGHTS | intensive | c_shapes[1] |",
        "| shapey | distance | intensive | c_shapes[2] |",
    ):
        require(words in re.sub(" +", " ", log), f"no {words!r}")


def listed_only(ranks):
    """Columns are no variables; they are listed with the words that read them, which do."""
    result = run(
        deck(
            "compute beta all contact/direction bins 12",
            "outputs beta",
            "fix bins all ave/time 5 1 5 c_beta[2] mode vector file bins.txt",
            *thermo(5, "c_beta[7][2]"),
            "run 5",
        ),
        ranks,
    )
    text = re.sub(" +", " ", result.file("log.liggghts").read_text())
    require("array | 2 | N_c | - | extensive, whole | c_beta[i][2] |" in text, "no line of N_c")
    require("array: i from 1 to 12, one row per bin of beta" in text, "no word about rows")
    require("v_beta_" not in text, "a variable of a column")
    require(outputs("contact/direction").word("beta", "N_c", 7) == "c_beta[7][2]", "grainscope.columns")


def users_own(ranks):
    """A variable that reads the same already is as good."""
    p = outputs("stress/contact").word("stress", "P")
    result = run(
        deck(
            "compute stress all stress/contact",
            f"variable stress_P equal {p}",
            "outputs stress",
            *thermo(1, "v_stress_P", p),
            "run 1",
        ),
        ranks,
    )
    require_same(result.thermo()[-1], [("v_stress_P", p)], "own")


def given_again(ranks):
    """Names follow a compute whose keywords, and with them its indices, have changed, and another compute of the ID."""
    tensor = outputs("fabric").index("branch_xx")
    moved = [("v_it_branch_xx", f"c_it[{tensor + 6}]"), ("v_it_force_normal_xx", f"c_it[{tensor}]")]
    stress = outputs("stress/contact").of("it")
    after = [("v_it_N_c", stress["N_c"]), ("v_it_P", stress["P"])]
    result = run(
        deck(
            "compute it all fabric branch force/normal",
            "outputs it",
            "uncompute it",
            "compute it all fabric force/normal branch",
            "outputs it",
            *thermo(1, *(word for pair in moved for word in pair)),
            "run 1",
            "thermo_style custom step",
            "uncompute it",
            "compute it all stress/contact",
            "outputs it",
            *thermo(1, *(word for pair in after for word in pair)),
            "run 1",
        ),
        ranks,
    )
    tables = result.thermo()
    require_same(tables[0], moved, "other keywords")
    require_same(tables[1], after, "another compute")
    require(np.all(tables[0]["v_it_branch_xx"] != tables[0]["v_it_force_normal_xx"]), "the two tensors are equal")


main(
    {
        "read-everywhere": read_everywhere,
        "announced": announced,
        "lasting": lasting,
        "printed-once": printed_once,
        "prefixes": prefixes,
        "chosen": chosen,
        "listed-only": listed_only,
        "users-own": users_own,
        "given-again": given_again,
    }
)
