# SPDX-License-Identifier: GPL-2.0-or-later
"""Conditions on the columns of a dump, such as `type == 2 and z > 0.01` or `not (vx*vx + vy*vy < 1e-4)`.

    condition = clause { 'or' clause }          clause  = term { 'and' term }
    term      = 'not' term | relation           relation = sum [ ( '==' | '!=' | '<' | '<=' | '>' | '>=' ) sum ]
    sum       = product { ( '+' | '-' ) product }   product = factor { ( '*' | '/' ) factor }
    factor    = '-' factor | 'abs' '(' sum ')' | '(' condition ')' | number | column

A part is a number or a truth; each sign wants parts of one of these kinds."""

from dataclasses import dataclass
import operator
import re

import numpy as np

from grainscope.errors import InputError

WORD = re.compile(
    r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|(?P<name>[A-Za-z_]\w*(?:\[\d+\])*)"
    r"|(?P<sign>==|!=|<=|>=|[-+*/()<>]))"
)
RELATIONS = {
    "==": operator.eq,
    "!=": operator.ne,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
}
SUMS = {"+": operator.add, "-": operator.sub}
PRODUCTS = {"*": operator.mul, "/": operator.truediv}
RESERVED = ("and", "or", "not", "abs")


@dataclass
class Part:
    """A part of a condition: whether it is true or false rather than a number, and its value from columns."""

    is_truth: bool
    value: object


class Condition:
    """A condition, read once; `holds(columns, rows)` says for which of so many rows it is true."""

    def __init__(self, text):
        self.text = text
        self._words = self._split()
        self._place = 0
        whole = self._condition()
        if self._place < len(self._words):
            self._refuse("'and', 'or' or the end")
        if not whole.is_truth:
            raise InputError(f"--where: a condition such as 'type == 2' is needed, got '{text}'")
        self._value = whole.value

    def holds(self, columns, rows):
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.broadcast_to(self._value(columns), rows)

    def _split(self):
        words, place, text = [], 0, self.text.rstrip()
        while place < len(text):
            found = WORD.match(text, place)
            if not found:
                unknown = text[place:].strip()[0]
                raise InputError(f"--where: '{unknown}' has no meaning in a condition, got '{self.text}'")
            words.append((found.lastgroup, found[found.lastgroup]))
            place = found.end()
        return words

    def _next(self):
        return self._words[self._place] if self._place < len(self._words) else (None, None)

    def _take(self, *words):
        """The next word if it is one of these, else None."""
        word = self._next()[1]
        if word not in words:
            return None
        self._place += 1
        return word

    def _refuse(self, expected):
        word = self._next()[1]
        place = "the end" if word is None else f"'{word}'"
        raise InputError(f"--where: expected {expected} at {place} of '{self.text}'")

    def _join(self, sign, call, parts, of_truths, gives_truth):
        """A part made of others, which must be truths or must be numbers."""
        for part in parts:
            if part.is_truth != of_truths:
                kind = "conditions" if of_truths else "numbers"
                raise InputError(f"--where: '{sign}' is for {kind}, got '{self.text}'")
        return Part(gives_truth, lambda columns: call(*(part.value(columns) for part in parts)))

    def _condition(self):
        part = self._clause()
        while self._take("or"):
            part = self._join("or", np.logical_or, (part, self._clause()), True, True)
        return part

    def _clause(self):
        part = self._term()
        while self._take("and"):
            part = self._join("and", np.logical_and, (part, self._term()), True, True)
        return part

    def _term(self):
        if self._take("not"):
            return self._join("not", np.logical_not, (self._term(),), True, True)
        part = self._sum()
        sign = self._take(*RELATIONS)
        return self._join(sign, RELATIONS[sign], (part, self._sum()), False, True) if sign else part

    def _sum(self):
        part = self._product()
        while sign := self._take(*SUMS):
            part = self._join(sign, SUMS[sign], (part, self._product()), False, False)
        return part

    def _product(self):
        part = self._factor()
        while sign := self._take(*PRODUCTS):
            part = self._join(sign, PRODUCTS[sign], (part, self._factor()), False, False)
        return part

    def _factor(self):
        if self._take("-"):
            return self._join("-", operator.neg, (self._factor(),), False, False)
        if self._take("abs"):
            if self._next()[1] != "(":
                self._refuse("'('")
            return self._join("abs", np.abs, (self._factor(),), False, False)
        if self._take("("):
            part = self._condition()
            if not self._take(")"):
                self._refuse("')'")
            return part
        kind, word = self._next()
        if kind not in ("number", "name") or word in RESERVED:
            self._refuse("a column or a number")
        self._place += 1
        if kind == "number":
            return Part(False, lambda columns: float(word))
        return Part(False, lambda columns: columns[word])
