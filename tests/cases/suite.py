# SPDX-License-Identifier: GPL-2.0-or-later
"""The tests themselves: every style has some, and they can be found by its name."""
import json
import os
from pathlib import Path
import re
import subprocess

from case import main, require
import where

SOURCE = Path(os.environ["GRAINSCOPE_SOURCE"])
KINDS = {"unit", "case", "mpi", "error", "example", "doc", "long", "hours"}
MANY = 5  # styles, from which on a name says every-style


def tests():
    """{name: labels}, as CTest has them."""
    found = subprocess.run(
        ["ctest", "--show-only=json-v1"], cwd=os.environ["GRAINSCOPE_BUILD"], capture_output=True, text=True, check=True
    ).stdout
    for test in json.loads(found)["tests"]:
        labels = [p["value"] for p in test.get("properties", []) if p["name"] == "LABELS"]
        yield test["name"], set(labels[0] if labels else ())


def styles():
    """Names of all styles of ours, from their headers."""
    text = "\n".join(header.read_text() for header in SOURCE.glob("src/*/*.h"))
    return {name for name in re.findall(r"^ *[A-Z][a-z]+Style\(([^,]+),", text, re.M)} | {
        f"surface/{name}" for name in re.findall(r"^ *SURFACE_MODEL\([^,]+, *([^,]+),", text, re.M)
    }


def every_style_has_tests(ranks):
    """Of its own, not only those of all styles; one of them a deck, for every day."""
    here = styles()
    require(len(here) >= 24, f"only {sorted(here)}")
    missing = set(here)
    for name, labels in tests():
        if labels & {"case", "error"} and not name.startswith("every-style-"):
            missing -= labels
    require(not missing, f"no test has the label of {sorted(missing)}: name it after STYLES in tests/cases.cmake")


def names_begin_with_a_style(ranks):
    bad = []
    for name, labels in tests():
        mine = labels - KINDS
        if not mine and not name.endswith("_NOT_BUILT"):
            bad.append(f"{name} has no style: {sorted(labels)}")
        elif "doc" in labels or name.startswith(("unit-", "example-")):
            continue
        elif name.startswith("every-style-"):
            if len(mine) < MANY:
                bad.append(f"{name} concerns {sorted(mine)} alone")
        elif not any(name.startswith((one + "-", one + "+")) for one in mine):
            bad.append(f"{name} does not begin with one of {sorted(mine)}")
    require(not bad, f"{len(bad)} tests: {'; '.join(bad[:20])}")


def what_works_where(ranks):
    """The page is what the table says, and the tests that it names are there."""
    require(where.PAGE.read_text() == where.page(), f"{where.PAGE.name} is old: tests/tools/where.py BUILD --write")
    require(not where.missing(os.environ["GRAINSCOPE_BUILD"]), where.missing(os.environ["GRAINSCOPE_BUILD"]))


def asked(*words):
    """Exit code and words of scripts/test, which only says what it would run."""
    done = subprocess.run(
        [SOURCE / "scripts" / "test", "--show", *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )
    return done.returncode, done.stdout


def unknown_word_refused(ranks):
    for word in ("fabrik", "ledge r", "stress/contacts", "("):
        code, said = asked(word)
        require(code == 1 and f"'{word}' is neither a style" in said, f"exit code {code}: {said}")
        for style in styles():
            require(style in said.split(), f"{style} is not among what there is: {said}")


def short_words(ranks):
    """A part of a name finds the styles, a style in full itself alone; options go on to ctest."""
    for words, expected in (
        (["fabric"], "-L ^(fabric)$ -LE long"),
        (["ledger"], "-L ^(energy/ledger|ledger/record)$ -LE long"),
        (["ellipsoid"], "-L ^(surface/ellipsoid)$ -LE long"),
        (["insitu"], "-L ^(gran/insitu)$ -LE long"),
        (["run/guard", "strain"], "-L ^(press/strain|run/guard)$ -LE long"),
        ([], "-LE long"),
        (["--long", "fabric"], "-L ^(fabric)$ -L long"),
        (["-R", "fabric"], "-R fabric"),
        (["fabric", "-R", "oracle"], "-L ^(fabric)$ -LE long -R oracle"),
        (["study"], "-L ^(study)$ -LE long"),
        (["-L", "unit"], "-L unit"),
        (["--long"], "-L long"),
    ):
        code, said = asked(*words)
        require(
            code == 0 and said.splitlines()[-1] == f"ctest {expected}",
            f"{words}: exit code {code}: {said}, expected {expected}",
        )


main(
    {
        "every-style-has-tests": every_style_has_tests,
        "names-begin-with-a-style": names_begin_with_a_style,
        "what-works-where": what_works_where,
        "unknown-word-refused": unknown_word_refused,
        "short-words": short_words,
    }
)
