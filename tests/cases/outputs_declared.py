# SPDX-License-Identifier: GPL-2.0-or-later
"""What the styles declare: each number by its name is that by its index, to the last bit, of every style; columns.json
and the tables of the pages are what the program says."""
import json
import os
from pathlib import Path
import re

import numpy as np

from case import main, require, require_equal
from deck import thermo
from grainscope.columns import outputs
from make_columns import ALL, FILE, decks, kind_of, made
from run import run

SOURCE = Path(os.environ.get("GRAINSCOPE_SOURCE", Path(__file__).resolve().parents[2]))


def everything(norm="no"):
    """Decks with all styles, their outputs named, and thermo of every number both ways."""
    for deck, commands in decks():
        both = []
        for k, (style, keywords) in enumerate(commands.items()):
            deck.body += [f"{kind_of(style)} it{k} all {style} {keywords}", f"outputs it{k}"]
            own = outputs(style)
            names = own.names("vector") + [
                one["name"] for one in own.outputs("scalar") if one["name"] not in own.names("vector")
            ]
            both += [(f"v_it{k}_{name}", own.word(f"it{k}", name), style, name) for name in names]
        words = [word for named, counted, *_ in both for word in (named, counted)]
        deck.body += [*thermo(2, *words), f"thermo_modify norm {norm}", "run 4"]
        yield deck, both


def every_number(ranks):
    """Of every style, by name and by index."""
    numbers = moved = 0
    for deck, both in everything():
        table = run(deck, ranks).thermo()[-1]
        for named, counted, *_ in both:
            require_equal(table[named], table[counted], named)
            numbers += 1
            moved += bool(np.any(table[named] != 0.0))
    require(numbers > 150, f"only {numbers} numbers")
    require(moved > 100, f"only {moved} of them are not 0")


def norm(ranks):
    """What LIGGGHTS divides by the number of grains is what is declared extensive; what is whole stays."""
    for (deck, both), (by_number, _) in zip(everything(), everything("yes")):
        plain, divided = run(deck, ranks).thermo()[-1], run(by_number, ranks).thermo()[-1]
        grains = len(deck.packing.grains)
        for _, counted, style, name in both:
            own = outputs(style)
            one = next(o for o in own.outputs("vector") + own.outputs("scalar") if o["name"] == name)
            by = grains if one["extensive"] and not one["whole"] and kind_of(style) == "compute" else 1
            require_equal(divided[counted] * 1.0, plain[counted] / by, f"{style} {name}")


def json_is_made(ranks):
    require(
        json.loads(FILE.read_text()) == made(),
        f"{FILE.name} is not what the program says: tests/tools/make_columns.py --write",
    )


def expanded(cell):
    """1-3 and 5, 7: all numbers of a cell."""
    found = []
    for part in re.findall(r"\d+(?:-\d+)?", cell):
        first, _, last = part.partition("-")
        found += range(int(first), int(last or first) + 1)
    return found


def rows_of_page(page):
    """(kind, index, name, unit, extent) of every row of the tables under Output info."""
    text = re.search(r"^## Output info\n(.*?)(?=^## )", page.read_text(), flags=re.M | re.S)[1]
    kinds = {"index": "vector", "column": "array", "grain's column": "per grain", "row's column": "local"}
    head = None
    for line in text.splitlines():
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
        if not cells or set(cells[0]) == {"-"}:
            continue
        if cells[0] in kinds:
            head = cells
            continue
        row = dict(zip(head, cells))
        names, first = row["name"].split(), row[head[0]]
        numbers = ["-"] if first == "scalar" else expanded(first)
        require(len(names) == len(numbers), f"{page.name}: {len(names)} names for {first}")
        for number, name in zip(numbers, names):
            yield "scalar" if first == "scalar" else kinds[head[0]], number, name, row["unit"], row["int/extensive"]


def page_of(style):
    return SOURCE / "doc" / f"{kind_of(style)}_{style.replace('/', '_')}.md"


def extent(one):
    return "extensive, whole" if one["whole"] else "extensive" if one["extensive"] else "intensive"


def pages(ranks):
    """The tables of the pages name what the program names, with its units, all of it."""
    bad = []
    for style in ALL:
        own = outputs(style)
        known = {
            (kind, one["index"], one["name"], one["unit"], extent(one))
            for kind in ("scalar", "vector", "array", "per grain", "local")
            for one in own.outputs(kind)
        }
        found = set(rows_of_page(page_of(style)))
        bad += [f"{page_of(style).name} lacks {row}" for row in sorted(known - found, key=str)]
        bad += [f"{page_of(style).name} has {row}, which is not so" for row in sorted(found - known, key=str)]
    require(not bad, "\n".join(bad))


def declared_in_words(ranks):
    """Every output has a name that a variable may have, a unit and a meaning."""
    for style in ALL:
        own = outputs(style)
        for kind in ("scalar", "vector", "array", "per grain", "local"):
            for one in own.outputs(kind):
                require(
                    re.fullmatch(r"\w+", one["name"]) and one["unit"] and len(one["meaning"]) > 1, f"{style}: {one}"
                )
        names = [name for kind in ("vector", "array", "per grain", "local") for name in own.names(kind)]
        require(len(set(names)) == len(names), f"{style}: names twice in {names}")


main(
    {
        "every-number": every_number,
        "norm": norm,
        "json-is-made": json_is_made,
        "pages": pages,
        "declared-in-words": declared_in_words,
    }
)
