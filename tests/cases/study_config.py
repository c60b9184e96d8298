# SPDX-License-Identifier: GPL-2.0-or-later
"""A study's configuration: the runs that it means, and what is refused, with which words."""
import os
from pathlib import Path
import textwrap

import yaml

from case import main, require, require_close
from grainscope.study.cost_model import steps_per_strain
from grainscope.study.plan import PlanError, figures_of, plan
from grainscope.study.plot import ALL
from run import run

SOURCE = Path(os.environ["GRAINSCOPE_SOURCE"])
SMALL = {"alpha": [1, 2], "mu": [0, 0.4], "I": [0.1, 0.01], "N": [300], "strain": 10, "steady": 5}


def runs_of_lists(ranks):
    runs = plan({**SMALL, "seed": [15485863, 15485867]})
    require(len(runs) == 16, f"{len(runs)} runs, expected 2 x 2 x 2 x 2")
    first = next(iter(runs.values()))
    require(first.name == "alpha1_mu0_I0.1_N300_seed15485863", f"name {first.name}")
    require(
        first.variables
        == {
            "alpha": "1",
            "mu": "0",
            "I": "0.1",
            "N": "300",
            "seed": "15485863",
            "e": "0.1",
            "strain": "10",
            "steady": "5",
            "part": "0.125",
            "measure": "all",
        },
        f"variables {first.variables}",
    )
    require(set(plan({**SMALL, "e": 0.9})).isdisjoint(plan(SMALL)), "runs with another e need names of their own")


def exceptions(ranks):
    runs = plan(
        {
            **SMALL,
            "exceptions": [
                {"where": {"I": 0.01}, "use": {"strain": 4, "steady": 2}},
                {"where": {"I": 0.01, "alpha": 2}, "use": {"N": 350, "strain": 3}},
            ],
        }
    )
    found = {
        (float(run.variables["alpha"]), float(run.variables["I"])): tuple(
            float(run.variables[name]) for name in ("N", "strain", "steady")
        )
        for run in runs.values()
    }
    require(
        found == {(1, 0.1): (300, 10, 5), (2, 0.1): (300, 10, 5), (1, 0.01): (300, 4, 2), (2, 0.01): (350, 3, 2)},
        f"found {found}",
    )


def groups(ranks):
    """Group after group, in each the cheapest first; a run belongs to the first group that has it; what a group does
    not name is as it is for the study; exceptions hold for all."""
    points = [
        [{"I": [0.01, 0.1], "mu": 0.4}],
        [{"alpha": 1, "mu": "1e-3", "I": 0.1}, {"alpha": 1, "mu": 0.4}],
        [{"N": 600, "seed": [15485863, 15485867], "alpha": [2], "mu": [0], "I": [0.1]}],
    ]
    named = [{"name": name, "points": found} for name, found in zip(("first", "second", "third"), points)]
    runs = list(plan({**SMALL, "groups": named, "exceptions": [{"where": {"N": 600}, "use": {"strain": 7}}]}).values())
    found = [(run.group, *(run.variables[name] for name in ("alpha", "mu", "I", "N", "strain"))) for run in runs]
    require(
        found
        == [
            ("first", "1", "0.4", "0.1", "300", "10"),
            ("first", "2", "0.4", "0.1", "300", "10"),
            ("first", "1", "0.4", "0.01", "300", "10"),
            ("first", "2", "0.4", "0.01", "300", "10"),
            ("second", "1", "0.001", "0.1", "300", "10"),
            ("third", "2", "0", "0.1", "600", "7"),
            ("third", "2", "0", "0.1", "600", "7"),
        ],
        f"found {found}",
    )
    require({run.group for run in plan(SMALL).values()} == {"all"}, "a study without groups is one")
    alone = plan({"groups": [{"name": "one", "points": [{"alpha": 1, "mu": 0, "I": 0.1, "N": 300}]}]})
    require(len(alone) == 1, "groups that name everything need no lists of the study")


def paper_size(ranks):
    """The study of the paper's size: its own N and strain, the groups one after the other, I from large to small."""
    runs = list(plan(yaml.safe_load((SOURCE / "examples/study/paper_size.yaml").read_text())).values())
    groups = list(dict.fromkeys(run.group for run in runs))
    require(
        len(groups) == 5 and [run.group for run in runs] == sorted((run.group for run in runs), key=groups.index), ""
    )
    first = [run for run in runs if run.group == groups[0]]
    require(len(first) == 9 * 7 * 3 and {run.value("I") for run in first} == {0.1, 0.046, 0.022}, f"{len(first)} runs")
    require(sum(run.group == groups[1] for run in runs) == 9 * 7, "all of I = 0.01")
    require(all(run.strain == 16 for run in runs), "strain 16")
    require(sorted(run.value("N") for run in runs)[-3:] == [2000, 4000, 4000], "two of 4000 grains, all others of 2000")
    for one in runs:  # what howto_study.md says of the steady state and of the box
        require(one.value("steady") == (6 if one.value("I") >= 0.01 else 4), f"{one.name}: steady")
        require(one.value("N") >= 80 * max(one.value("alpha") ** 2, 1 / one.value("alpha")), f"{one.name}: N")
    longest = max(run.seconds * run.value("part") / run.strain for run in runs)
    require(longest < 900, f"a part takes {longest:.0f} s by the model, too long for a slice")


def numbers_that_yaml_takes_for_words(ranks):
    config = {**SMALL, "alpha": [1], "I": [0.1], "mu": yaml.safe_load("[1e-3]")}
    (run,) = plan({**config, "exceptions": [{"where": {"mu": "1e-3"}, "use": {"N": "5e2"}}]}).values()
    require((run.variables["mu"], run.variables["N"]) == ("0.001", "500"), f"variables {run.variables}")


def example_is_valid(ranks):
    runs = plan(yaml.safe_load((SOURCE / "examples/study/config.yaml").read_text()))
    require(len(runs) >= 120, f"{len(runs)} runs")


def every_figure_is_asked_for(ranks):
    require(set(figures_of("all")) == set(ALL), f"named {sorted(figures_of('all'))}, drawn {sorted(ALL)}")


def howto_has_the_grid_of_the_paper(ranks):
    page = (SOURCE / "doc/howto_study.md").read_text()
    block = page[page.index("    alpha: [0.33") :].split("\n\n")[0]
    runs = plan(yaml.safe_load(textwrap.dedent(block)))
    require(len(runs) == 637, f"{len(runs)} runs, the paper has 637")
    steady = {(run.variables["I"], run.variables["steady"]) for run in runs.values()}
    require(
        len(steady) == 7 and ("0.001", "4") in steady and ("0.01", "6") in steady, f"averages from {sorted(steady)}"
    )


def refused(words, **config):
    def case(ranks):
        try:
            plan({**SMALL, **config})
        except PlanError as error:
            for word in words:
                require(word in str(error), f"the message lacks {word!r}: {error}")
            return
        require(False, f"{config} was taken")

    return case


def steps_of_deck(ranks):
    """The cost model's time step is the deck's."""
    deck = (SOURCE / "examples/simple_shear/in.simple_shear").read_text()
    for alpha, inertial in ((0.5, 0.1), (1.5, 0.01)):
        short = 200 / steps_per_strain(alpha, inertial)
        variables = {"N": 150, "alpha": alpha, "I": inertial, "strain": short, "out": "out"}
        result = run(deck, arguments=[word for name, value in variables.items() for word in ("-var", name, str(value))])
        row = result.file("out/parameters.txt").read_text().splitlines()[-1].split()
        rate, dt = float(row[8]), float(row[11])
        require_close(
            steps_per_strain(alpha, inertial),
            1 / (rate * dt),
            1e-6,
            f"steps for a strain of 1, alpha = {alpha}, I = {inertial}",
        )


REFUSED = {
    "unknown-word": refused(("keywords must be among", "got 'alhpa'"), alhpa=[1]),
    "empty-list": refused(("mu must be a list of at least one number", "got []"), mu=[]),
    "no-list": refused(("I must be a list of at least one number", "got 0.1"), I=0.1),
    "word-for-number": refused(("alpha must be a number above 0", "got 'long'"), alpha=["long"]),
    "yes-for-number": refused(("alpha must be a number above 0", "got True"), alpha=[True]),
    "negative-friction": refused(("mu must be a number of at least 0", "got -0.1"), mu=[-0.1]),
    "half-a-grain": refused(("N must be a whole number above 0", "got 300.5"), N=[300.5]),
    "not-finite": refused(("alpha must be a number above 0", "got nan"), alpha=[float("nan")]),
    "twice": refused(("mu must not name a value twice", "[0.1, 0.1]"), mu=[0.1, 0.1]),
    "steady-beyond-strain": refused(
        ("steady must be less than strain = 10", "got 12", "mu = 0.4"), steady=12, mu=[0.4]
    ),
    "exception-steady": refused(
        ("steady must be less than strain = 4", "got 5", "I = 0.01"),
        exceptions=[{"where": {"I": 0.01}, "use": {"strain": 4}}],
    ),
    "measure": refused(("measure must be basic or all", "got 'everything'"), measure="everything"),
    "exception-shape": refused(("exceptions: entry 1 must be", "got {'I': 0.1}"), exceptions=[{"I": 0.1}]),
    "exceptions-no-list": refused(("exceptions must be a list", "got 3"), exceptions=3),
    "exception-where": refused(
        ("entry 1: where must name alpha", "got 'strain'"), exceptions=[{"where": {"strain": 3}, "use": {}}]
    ),
    "exception-use": refused(
        ("entry 2: use must name N", "got 'alpha'"),
        exceptions=[{"where": {}, "use": {}}, {"where": {}, "use": {"alpha": 3}}],
    ),
    "exception-value": refused(
        ("N must be a whole number above 0", "got -1"), exceptions=[{"where": {}, "use": {"N": -1}}]
    ),
    "groups-no-list": refused(("groups must be a list", "got 3"), groups=3),
    "group-words": refused(("groups: entry 1 must be", "got {'name': 'a'}"), groups=[{"name": "a"}]),
    "group-no-points": refused(("groups: entry 1 must be", "'points': []"), groups=[{"name": "a", "points": []}]),
    "group-keyword": refused(
        ("groups: entry 1 ('a'): points must name alpha", "got 'strain'"),
        groups=[{"name": "a", "points": [{"strain": 3}]}],
    ),
    "group-value": refused(
        ("groups: entry 2 ('b'): mu must be a number of at least 0, got -1",),
        groups=[{"name": "a", "points": [{}]}, {"name": "b", "points": [{}, {"mu": -1}]}],
    ),
    "group-twice": refused(
        ("groups must have different names, got 'a' twice",), groups=2 * [{"name": "a", "points": [{}]}]
    ),
    "output": refused(("output must be the name of a folder without spaces", "'my study'"), output="my study"),
    "ranks": refused(("ranks must be a whole number above 0", "got 0"), ranks=0),
}

main(
    {
        "runs-of-lists": runs_of_lists,
        "exceptions": exceptions,
        "groups": groups,
        "paper-size": paper_size,
        "numbers-that-yaml-takes-for-words": numbers_that_yaml_takes_for_words,
        "example-is-valid": example_is_valid,
        "every-figure-is-asked-for": every_figure_is_asked_for,
        "howto-has-the-grid-of-the-paper": howto_has_the_grid_of_the_paper,
        "steps-of-deck": steps_of_deck,
        **REFUSED,
    }
)
