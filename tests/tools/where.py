#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""What works where: of every measure in every scene the tests that hold its numbers, or its refusal, to be right.
Writes doc/what_works_where.md from that and from what ctest knows; suite tests hold both together.

usage: where.py BUILD [--write]
"""
from pathlib import Path
import re
import subprocess
import sys

PAGE = Path(__file__).resolve().parents[2] / "doc" / "what_works_where.md"
SCENES = (
    "two dimensions",
    "walls",
    "gravity",
    "several types",
    "clumps",
    "region, moving",
    "region, empty",
    "grains leave, come",
    "tilted box",
    "other plane",
    "units",
)
NOT = "-"  # means nothing there


def refused(tests):
    return ("refused", tests)


# Tests by regular expressions that find their names: those of most measures, then of each measure what differs.
MEASURED_AT_WALLS = r"wall/gran-measures-"
USUAL = {
    "walls": MEASURED_AT_WALLS,
    "gravity": MEASURED_AT_WALLS,
    "region, moving": r"region-places",
    "region, empty": r"region-nothing-there",
    "grains leave, come": r"every-style-changes-grains-(deleted|inserted|lost)",
    "tilted box": r"every-style-same-sphere|oracle-.*(flip|tilted)",
    "other plane": NOT,
    "units": r"every-style-units-",
}
TABLE = {
    "stress/contact": {
        "two dimensions": r"stress/contact-two-dimensions-",
        "gravity": r"wall/contact-weight|wall/gran-measures-box$",
        "several types": r"scope-(rows-by|chosen)-types",
        "clumps": r"clumps-(as-grains|between-walls)",
        "tilted box": r"stress/contact.*oracle-.*through-a-flip",
        "other plane": r"stress/contact-scope-planes-and-pressures",
    },
    "dissipation": {
        "two dimensions": r"dissipation.*two-dimensions-losses",
        "several types": r"scope-(rows-by|chosen)-types",
        "clumps": r"clumps-losses",
        "tilted box": r"dissipation.*oracle-.*through-a-flip",
    },
    "fabric": {
        "two dimensions": r"fabric.*two-dimensions-",
        "several types": r"scope-(rows-by|chosen)-types",
        "clumps": r"clumps-losses",
        "region, moving": r"region-(partition-of-a-sheared-box|places)",
        "tilted box": r"region-partition-of-a-sheared-box",
        "other plane": r"fabric.*analytic-three-of-four-along-z-in-xz",
    },
    "contact/direction": {
        "two dimensions": r"contact/direction.*two-dimensions-",
        "several types": r"region-bins-and-rows",
        "clumps": r"clumps-losses",
        "region, moving": r"region-bins-and-rows",
        "other plane": r"contact/direction.*(in-xz|analytic)",
    },
    "contact/surface": {
        "two dimensions": refused(r"two-dimensions-refused-"),
        "several types": r"region-bins-and-rows",
        "clumps": refused(r"clumps-refused"),
        "region, moving": r"region-bins-and-rows",
        "region, empty": r"region-bins-and-rows",
    },
    "contact/local": {
        "two dimensions": r"two-dimensions-(stress|any-depth)",
        "walls": r"wall/gran-measures-numbers|wall/gran.*measures",
        "several types": r"region-bins-and-rows",
        "clumps": r"clumps-as-grains",
        "region, moving": r"region-bins-and-rows",
        "region, empty": r"region-bins-and-rows",
    },
    "contact/grain": {
        "two dimensions": r"contact/grain.*two-dimensions-",
        "several types": r"scope-chosen-types",
        "clumps": r"clumps-as-grains",
        "other plane": r"nematic-scope-angles-in-planes",
    },
    "contact/force": {
        "two dimensions": r"contact/force-discs",
        "walls": r"contact/force-at-walls",
        "gravity": r"contact/force-at-walls",
        "several types": r"contact/force-of-types",
        "clumps": r"contact/force-clumps",
        "region, moving": r"contact/force-in-a-region",
        "region, empty": r"contact/force-empty-group",
        "tilted box": r"contact/force-(spheres|prolate)",
        "units": r"every-style-units-walls",
    },
    "packing": {
        "two dimensions": r"packing-discs",
        "walls": r"packing-at-walls",
        "gravity": r"packing-at-walls",
        "several types": NOT,
        "clumps": r"packing-clumps",
        "region, moving": r"packing-in-regions",
        "region, empty": r"packing-empty-group",
        "tilted box": r"packing-(spheres|prolate)",
        "other plane": r"packing-inertial-number",
        "units": r"every-style-units-walls",
    },
    "nematic": {
        "two dimensions": r"nematic.*two-dimensions-",
        "walls": NOT,
        "gravity": NOT,
        "several types": r"nematic-scope-mixtures-of-shapes",
        "clumps": refused(r"clumps-refused"),
        "other plane": r"nematic-scope-angles-in-planes",
    },
    "fluctuation": {
        "two dimensions": r"fluctuation.*two-dimensions-",
        "walls": r"fluctuation-flows-mean-flows",
        "gravity": r"fluctuation-flows-mean-flows",
        "several types": NOT,
        "clumps": r"clumps-as-grains",
        "region, moving": r"fluctuation-flows-mean-flows",
        "tilted box": r"fluctuation.*oracle-tilted-backward",
        "other plane": r"fluctuation.*oracle-sheared-in-(xz|yz)",
    },
    "velocity/correlation": {
        "two dimensions": r"velocity/correlation-two-dimensions-",
        "walls": r"velocity/correlation-oracle-not-periodic",
        "gravity": NOT,
        "several types": NOT,
        "clumps": r"clumps-as-grains",
        "region, moving": r"velocity/correlation-region-",
        "region, empty": r"velocity/correlation-region-",
        "tilted box": r"velocity/correlation-oracle-tilted-backward",
        "other plane": r"velocity/correlation-oracle-sheared-in-(xz|yz)",
    },
    "velocity/memory": {
        "two dimensions": r"two-dimensions-displacement|velocity/memory.*two-dimensions",
        "walls": r"flows-over-time",
        "gravity": NOT,
        "several types": NOT,
        "clumps": r"clumps-as-grains",
        "region, moving": r"flows-grains-that-come-and-go",
        "region, empty": r"flows-empty-start",
        "grains leave, come": r"flows-grains-that-come-and-go",
        "tilted box": r"velocity/memory-oracle-backward",
        "other plane": r"velocity/memory-oracle-sheared-in-yz",
    },
    "displacement/shear": {
        "two dimensions": r"displacement/shear-two-dimensions-displacement",
        "walls": r"displacement/shear-(faces-|flows-displacements)",
        "gravity": NOT,
        "several types": NOT,
        "clumps": r"clumps-crosses-faces",
        "region, moving": r"displacement/shear-flows-displacements-against-flows",
        "region, empty": r"flows-empty-start",
        "grains leave, come": r"flows-grains-that-come-and-go",
        "tilted box": r"displacement/shear.*oracle-backward",
        "other plane": r"displacement/shear.*oracle-sheared-in-yz",
    },
    "layering": {
        "two dimensions": r"layering.*two-dimensions-",
        "walls": r"layering-faces-top-layer",
        "gravity": NOT,
        "several types": NOT,
        "clumps": r"clumps-as-grains",
        "region, moving": NOT,
        "region, empty": NOT,
        "tilted box": r"layering.*oracle-tilted-backward",
        "other plane": r"layering.*oracle-sheared-in-",
    },
    "wall/contact": {
        "two dimensions": r"wall/contact.*two-dimensions-",
        "walls": r"wall/contact-balance",
        "gravity": r"wall/contact-weight",
        "several types": NOT,
        "clumps": r"clumps-between-walls",
        "region, moving": NOT,
        "region, empty": NOT,
        "grains leave, come": NOT,
        "tilted box": NOT,
        "units": r"every-style-units-walls",
    },
    "wall/triangle": {
        "two dimensions": refused(r"two-dimensions-refused-mesh-walls"),
        "walls": r"wall/triangle-",
        "gravity": r"wall/triangle-",
        "several types": NOT,
        "clumps": NOT,
        "region, moving": NOT,
        "region, empty": NOT,
        "grains leave, come": NOT,
        "tilted box": NOT,
        "units": r"every-style-units-walls",
    },
    "energy/ledger": {
        "two dimensions": r"energy/ledger-two-dimensions-ledger",
        "walls": r"energy/ledger-walls-",
        "gravity": r"energy/ledger-walls-(rained|pulls)",
        "several types": r"energy/ledger-closes-polydisperse-two-types",
        "clumps": refused(r"clumps-refused"),
        "region, moving": refused(r"stress/contact\+fabric-region-refused"),
        "region, empty": NOT,
        "grains leave, come": r"energy/ledger-walls-(rained|drained|drops-out)",
        "tilted box": r"energy/ledger-closes-flip",
    },
    "field": {
        "two dimensions": r"field-two-dimensions",
        "walls": r"field-(walls|which-walls)",
        "gravity": r"field-weight",
        "several types": r"field-types",
        "clumps": refused(r"field-clumps-refused"),
        "region, moving": refused(r"field-refused-bounds"),
        "region, empty": r"field-empty-cells",
        "grains leave, come": r"field-mass",
        "tilted box": r"field-flipping-box",
        "units": r"every-style-units-walls",
    },
    "press/strain": {
        "two dimensions": r"press/strain.*two-dimensions-",
        "walls": r"press/strain-refused-cylinder-across-the-axis",
        "gravity": NOT,
        "several types": NOT,
        "clumps": refused(r"clumps-refused"),
        "region, moving": NOT,
        "region, empty": NOT,
        "tilted box": r"press/strain-control-shears-as-fix-deform",
        "other plane": r"press/strain-control-shears-in-(xz|yz)",
    },
    "press/wall": {
        "two dimensions": r"press/wall-analytic-two-dimensions",
        "walls": r"press/wall-bed-holds-spheres",
        "gravity": r"press/wall-bed-holds-spheres",
        "several types": NOT,
        "clumps": NOT,
        "region, moving": NOT,
        "region, empty": NOT,
        "grains leave, come": NOT,
        "tilted box": refused(r"press/wall-refused-box"),
        "other plane": r"press/wall-analytic-(along-y|from-below-along-x)",
        "units": r"press/wall-analytic-in-cgs",
    },
}


def names_of_tests(build):
    listed = subprocess.run(["ctest", "-N", "--test-dir", build], stdout=subprocess.PIPE, text=True, check=True).stdout
    names = re.findall(r"Test +#\d+: (\S+)", listed)
    return sorted({re.sub(r"-on-\d+-ranks$", "", name) for name in names})


def cells():
    """(measure, scene, "right" or "refused" or None, regular expression)."""
    for measure, own in TABLE.items():
        row = {**USUAL, **own}
        assert sorted(row) == sorted(SCENES), measure
        for scene in SCENES:
            cell = row[scene]
            if cell == NOT:
                yield measure, scene, None, ""
            elif isinstance(cell, tuple):
                yield measure, scene, *cell
            else:
                yield measure, scene, "right", cell


TEXT = """\
Which measure can be used in which situation. *Right*: tests compare its numbers with numpy from dumps, a closed form or
a balance. *Refused*: by name, before anything is run. Empty: the measure has no meaning there or is not affected.

[What is measured](scope.md) explains types, walls, regions and clumps; see also [two dimensions](two_dimensions.md).
The table is made from the names of the tests; `tests/tools/where.py BUILD` prints them.""".splitlines()


def page():
    lines = [
        "# What works where",
        "",
        *TEXT,
        "",
        "| | " + " | ".join(SCENES) + " |",
        "|" + "---|" * (len(SCENES) + 1),
    ]
    words = {}
    for measure, scene, verdict, _ in cells():
        words.setdefault(measure, []).append(verdict or "")
    lines += [f"| {measure} | " + " | ".join(row) + " |" for measure, row in words.items()]
    return "\n".join(lines) + "\n"


def missing(build):
    """Cells whose tests are not there."""
    names = names_of_tests(build)
    return [
        f"{measure}, {scene}: no test {pattern}"
        for measure, scene, verdict, pattern in cells()
        if verdict and not any(re.search(pattern, name) for name in names)
    ]


def main():
    build = sys.argv[1]
    names = names_of_tests(build)
    for measure, scene, verdict, pattern in cells():
        if verdict:
            print(f"{measure}, {scene}: {verdict}: {', '.join(n for n in names if re.search(pattern, n))}")
    if "--write" in sys.argv:
        PAGE.write_text(page())
    print("\n".join(missing(build)))


if __name__ == "__main__":
    main()
