# SPDX-License-Identifier: GPL-2.0-or-later
"""A deck that must be refused: with these words, a non-zero exit code, at once."""
from case import require
from run import attempt, tail

SECONDS = 20.0


def require_refused(deck, ranks, *words):
    result = attempt(deck, ranks, time_limit=SECONDS)
    require(result.code != 0, f"the run was not refused; its output ends:\n{tail(result.output)}")
    text = " ".join(result.output.split())
    for word in words:
        require(word in text, f"the message lacks {word!r}; the output ends:\n{tail(result.output)}")


def refusal(make_deck, *words):
    """A case: `make_deck()` gives the deck, all `words` must be in the message."""
    return lambda ranks: require_refused(make_deck(), ranks, *words)
