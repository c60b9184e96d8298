# SPDX-License-Identifier: GPL-2.0-or-later
"""Names for the columns of a dump local of compute contact/local, which LIGGGHTS calls c_ID[1], c_ID[2] ..."""
import re

import numpy as np

from grainscope.columns import outputs
from grainscope.errors import InputError

NAMES = [one["name"] for one in outputs("contact/local").outputs("local")]
KEYWORDS = (
    "id image point normal branch overlap force fn fn_damping ft un ut sliding slip mobilisation wall triangle strong "
    "cluster"
).split()
BY_DEFAULT = KEYWORDS[: KEYWORDS.index("wall")]


def names_of(keyword):
    """The columns that a keyword of compute contact/local gives: id_i and id_j for id."""
    if keyword not in KEYWORDS:
        raise InputError(f"--contact-columns must be of {' '.join(KEYWORDS)}, got '{keyword}'")
    several = [f"{keyword}_{end}" for end in ("i", "j", "x", "y", "z")]
    return [name for name in NAMES if name == keyword or name in several]


def dump_line(keywords):
    """The lines of an input script that dump these columns."""
    columns = [name for keyword in BY_DEFAULT for name in names_of(keyword)]
    wanted = [name for keyword in keywords for name in names_of(keyword)]
    words = " ".join(f"c_contacts[{columns.index(name) + 1}]" for name in wanted)
    return f"compute contacts all contact/local\n  dump contacts all local 1000 contacts.*.dump {words}"


def names_of_columns(path, words, keywords):
    """What the words of a dump's columns stand for. `keywords`: those that the compute was given."""
    names = [name for keyword in keywords or BY_DEFAULT for name in names_of(keyword)]
    found, computes = [], set()
    for word in words:
        match = re.fullmatch(r"(c_\w+)\[(\d+)\]", word)
        if match is None:
            found.append(word)
            continue
        computes.add(match[1])
        number = int(match[2])
        if number > len(names):
            raise InputError(
                f"{path}: there is a column {word}, but compute contact/local has {len(names)} columns with "
                f"'{' '.join(keywords or BY_DEFAULT)}'; give its words by --contact-columns"
            )
        found.append(names[number - 1])
    if len(computes) > 1:
        raise InputError(f"{path}: columns of one compute contact/local are needed, got {', '.join(sorted(computes))}")
    return found


def require_columns(path, names, needed, keywords):
    """An error about those of the `needed` columns that are not among the names. `keywords`: those that give them."""
    missing = [name for name in needed if name not in names]
    if missing:
        raise InputError(
            f"{path}: no column {', '.join(missing)}; it has {' '.join(names)}\nDump contacts by\n  "
            f"{dump_line(keywords)}\nor name the words of your compute contact/local by --contact-columns"
        )


def named(snapshot, keywords):
    """The columns of a snapshot by name."""
    names = names_of_columns(snapshot.path, snapshot.columns, keywords)
    found = dict(zip(names, snapshot.columns.values()))
    _check(snapshot, found)
    return found


def _check(snapshot, found):
    """Wrong names would go unnoticed: what has a known range is looked at."""
    whole = ("id_i", "id_j", "image_x", "image_y", "image_z")
    wrong = [name for name in whole if name in found and (found[name] % 1 != 0).any()]
    if all(f"normal_{end}" in found for end in "xyz"):
        lengths = np.linalg.norm([found[f"normal_{end}"] for end in "xyz"], axis=0)
        if (np.abs(lengths - 1) > 1e-3).any():
            wrong.append("normal")
    if wrong:
        raise InputError(
            f"{snapshot.path}: columns do not hold {', '.join(wrong)} where these should be; give the words of compute "
            "contact/local by --contact-columns"
        )
