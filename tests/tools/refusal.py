# SPDX-License-Identifier: GPL-2.0-or-later
"""A deck that must be refused: with these words, once, and a non-zero exit code."""
from case import require
from run import attempt, count_errors, tail


def require_refused(deck, ranks, *words, **options):
    result = attempt(deck, ranks, **options)
    require(
        result.code > 0,
        f"the run was not refused but ended with code {result.code}; its output ends:\n{tail(result.output)}",
    )
    text = " ".join(result.output.split())
    for word in words:
        require(" ".join(word.split()) in text, f"the message lacks {word!r}; the output ends:\n{tail(result.output)}")
    errors = count_errors(result.output)
    require(errors == 1, f"not one error but {errors}; the output ends:\n{tail(result.output)}")
    return result


def refusal(make_deck, *words):
    """A case: `make_deck()` gives the deck, all `words` must be in the message."""
    return lambda ranks: require_refused(make_deck(), ranks, *words)
