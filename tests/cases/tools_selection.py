# SPDX-License-Identifier: GPL-2.0-or-later
"""Conditions of grainscope-tools render --where: against Python's own reading of the same words, and what is
refused."""
import math

import numpy as np

from case import main, require, require_equal
from grainscope.errors import InputError
from grainscope.selection import Condition

ROWS = 200


def columns():
    random = np.random.default_rng(7)
    found = {name: random.uniform(-2.0, 2.0, ROWS) for name in ("x", "y", "z", "vx", "c_grain[3]")}
    return found | {"type": random.integers(1, 4, ROWS).astype(float), "id": np.arange(1.0, ROWS + 1)}


def same_as_python(ranks):
    """Row by row; Python has the same order of signs. A column in brackets has another name there."""
    data = columns()
    for text in (
        "type == 2",
        "type != 2 and z > 0.5",
        "type == 1 or type == 3 and x < 0",
        "(type == 1 or type == 3) and x < 0",
        "not x < 0 and not (y > 1 or z > 1)",
        "x*x + y*y < 1e0",
        "x + y * z - 1 >= .5 - vx/3",
        "(x + y) * z - (1 - vx) / (2 + id) <= 0",
        "-x < --y",
        "x - y - z > 0",
        "abs(x - y) < abs(-0.7)",
        "c_grain[3] > 2.5e-1",
        "((x)) > ((0))",
        "1 < 2",
        "id>100and id<=1.2E2",
        "x/(type - 1) > 0.5",
    ):
        found = Condition(text).holds(data, ROWS)
        words = text.replace("c_grain[3]", "c_grain_3").replace("100and", "100 and")
        expected = []
        for k in range(ROWS):
            row = {name.replace("[3]", "_3"): np.float64(values[k]) for name, values in data.items()}
            with np.errstate(divide="ignore"):
                expected.append(bool(eval(words, {"abs": math.fabs}, row)))
        require_equal(found, np.array(expected, dtype=float), text)
        require(text == "1 < 2" or 0 < found.sum() < ROWS, f"'{text}' tells nothing apart: {found.sum()} rows")


def refused(ranks):
    for text, words in (
        ("", "expected a column or a number at the end"),
        ("type = 2", "'=' has no meaning"),
        ("type == 2 and", "expected a column or a number at the end of 'type == 2 and'"),
        ("type == 2 or or x > 0", "expected a column or a number at 'or'"),
        ("type == 2 x > 0", "expected 'and', 'or' or the end at 'x'"),
        ("(type == 2", "expected ')' at the end"),
        ("type == 2)", "expected 'and', 'or' or the end at ')'"),
        ("type", "a condition such as 'type == 2' is needed, got 'type'"),
        ("x + 1", "a condition such as"),
        ("(x > 0) + 1 > 0", "'+' is for numbers"),
        ("x and y > 0", "'and' is for conditions"),
        ("not x", "'not' is for conditions"),
        ("0 < x < 1", "expected 'and', 'or' or the end at '<'"),
        ("abs x > 0", "expected '(' at 'x'"),
        ("abs(x > 0) > 0", "'abs' is for numbers"),
        ("__import__('os')", "has no meaning"),
        ("x.y > 0", "'.' has no meaning"),
        ("x ** 2 > 1", "expected a column or a number at '*'"),
    ):
        try:
            Condition(text)
        except InputError as error:
            require(words in str(error) and str(error).startswith("--where: "), f"'{text}': {error}")
        else:
            require(False, f"'{text}' was not refused")


main({"same-as-python": same_as_python, "refused": refused})
