# SPDX-License-Identifier: GPL-2.0-or-later
"""A deck that must be refused: with these words, once, a non-zero exit code, at once."""
import os

from case import require
from run import attempt, tail

SECONDS = 10.0


def patience():
    """Longer where others use the processors too."""
    return SECONDS * max(1.0, os.getloadavg()[0] / os.cpu_count())


def require_refused(deck, ranks, *words):
    result = attempt(deck, ranks, time_limit=patience())
    require(result.code > 0, f"the run was not refused but ended with code {result.code}; its output ends:\n{tail(result.output)}")
    text = " ".join(result.output.split())
    for word in words:
        require(" ".join(word.split()) in text, f"the message lacks {word!r}; the output ends:\n{tail(result.output)}")
    require(result.output.count("ERROR") == 1, f"not one error but {result.output.count('ERROR')}; the output ends:\n{tail(result.output)}")
    return result


def refusal(make_deck, *words):
    """A case: `make_deck()` gives the deck, all `words` must be in the message."""
    return lambda ranks: require_refused(make_deck(), ranks, *words)
