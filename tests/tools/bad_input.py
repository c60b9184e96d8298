# SPDX-License-Identifier: GPL-2.0-or-later
"""From a description of a style's command line, the inputs that must be refused, each with the message that must say
so."""
from dataclasses import dataclass, field
import re

from case import require
from refusal import require_refused

NOT_NUMBERS = ("many", "5x", "1 2", "", "nan", "inf", "-inf", "1e999", "0x10", "v_")


def listed(words):
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} or {words[-1]}"


@dataclass
class Kind:
    """What may follow a keyword: the requirement that messages give, values that are taken (the limits, where there are
    any), and values that are not; `never`: those that keywords of one way to read them share."""

    requirement: str
    good: tuple
    bad: tuple
    never: tuple = ()

    def some_bad(self, turn):
        """All of `bad` and one of `never`, by turns."""
        return self.bad + ((self.never[turn % len(self.never)],) if self.never else ())


def choice(*words):
    never = ("q", "", "nan", "1e999", words[0].upper(), words[0] + "s", words[0] + " ")
    return Kind(listed(words), words, (), never)


def number(requirement, good, bad):
    return Kind(requirement, good, bad, NOT_NUMBERS)


def whole(low, high):
    return number(
        f"a whole number from {low} to {high}",
        (str(low), str(high), *(("1e1",) if low <= 10 <= high else ())),
        (str(low - 1), str(high + 1), "-3", "2.5", "1e99"),
    )


def even(low, high):
    return number(
        f"an even whole number from {low} to {high}",
        (str(low), str(high)),
        (str(low - 2), str(high + 2), "-4", "2.5", str(high - 1)),
    )


@dataclass
class Keyword:
    """`text` is what stands before the value; `label` is its name in messages."""

    text: str
    kind: Kind
    label: str = ""
    ends: str = ""  # the message when nothing follows, where it is not the usual one

    def complaint(self, got):
        return f"'{self.label or self.text}' must be {self.kind.requirement}, got '{got}'"

    def first(self):
        return self.text.split()[0]

    def end(self):
        return (
            self.ends or f"expected {self.kind.requirement} after '{self.text.split()[-1]}', got the end of the command"
        )


@dataclass
class Style:
    """`line` is the command up to its first keyword, `needed` are keywords that it must have, `flags` those without a
    value; `more` are lines and messages of its own."""

    name: str
    line: str
    keywords: list = field(default_factory=list)
    flags: tuple = ()
    sort: str = "keyword"
    needed: dict = field(default_factory=dict)
    more: list = field(default_factory=list)
    order: tuple = ()  # of the keywords in messages, where it is not that above
    before: tuple = ()  # lines of the deck that the host insists on
    others: bool = False  # other keywords are the host's

    def command(self, *words, leave_out=""):
        needed = [f"{k} {v}" for k, v in self.needed.items() if k.split("/")[0] != leave_out.split("/")[0]]
        return " ".join([self.line, *needed, *words])

    def names(self):
        own = [k.text for k in self.keywords if " " not in k.text]
        return list(self.order) or [*own, *self.flags]

    def refused(self, every):
        """(command, message) of every bad input, or of some."""
        if self.others:
            pass
        elif self.names():
            for word in ("spin", "", "nan", "1e999", self.names()[0].upper()):
                yield self.command(quoted(word)), f"'{self.sort}' must be {listed(self.names())}, got '{word}'"
        else:
            for word in ("spin", "", "nan", "0"):
                yield self.command(quoted(word)), f"takes no keywords, got '{word}'"
        for turn, keyword in enumerate(self.keywords):
            first, kind = keyword.first(), keyword.kind
            for value in (*kind.bad, *kind.never) if every else kind.some_bad(turn):
                yield self.command(keyword.text, quoted(value), leave_out=first), keyword.complaint(value)
            yield self.command(keyword.text, leave_out=first), keyword.end()
            twice = [f"{keyword.text} {value}" for value in (keyword.kind.good[0], keyword.kind.good[-1])]
            yield self.command(*twice, leave_out=first), f"'{first}' is given twice"
        for flag in self.flags:
            yield self.command(flag, flag), f"'{flag}' is given twice"
        for command, message in self.more:
            yield command, message

    def taken(self):
        """Commands that are right: every good value of every keyword."""
        yield self.command()
        yield self.command(*self.flags)
        for keyword in self.keywords:
            for value in keyword.kind.good:
                yield self.command(f"{keyword.text} {value}", leave_out=keyword.first())


def quoted(word):
    return f'"{word}"' if not word or " " in word else word


def require_all_refused(style, inputs, ranks):
    """Each in a process of its own, where nothing else is right either: the words come first."""
    for command, message in inputs:
        deck = "\n".join([*style.before, command, 'print "the line was taken"', "run 1"]) + "\n"
        result = require_refused(deck, ranks, f"ERROR: {style.name}: {message}")
        whole = re.escape(message) + r"(: did you mean '[^']+'\?)? \("  # no more than a guess follows
        require(re.search(whole, " ".join(result.output.split())), f"the message goes on: {result.output[-500:]}")
        require("the line was taken" not in result.output, f"refused too late: {command}")
    print(f"{len(inputs)} inputs tried and refused on {ranks} rank(s)")
