# SPDX-License-Identifier: GPL-2.0-or-later
"""What the computes refuse: keyword, requirement, value received."""
from case import main
from deck import Deck, thermo
from packing import dense_packing
from refusal import refusal


def deck(*body):
    return Deck(dense_packing(1.5), body=body)


def command(line, *words):
    return refusal(lambda: deck(f"compute c all {line}", "run 1"), *words)


def between_runs(style, value):
    """Asked on a step that nobody announced: the host itself refuses."""
    return refusal(lambda: deck(f"compute c all {style}", f"variable now equal {value}", *thermo(100, "step"), "run 3",
                                'print "${now}"'), "Compute used in variable between runs is not current")


CASES = {
    "stress-contact-takes-no-keywords": command("stress/contact virial", "compute stress/contact: takes no keywords, got 'virial'"),
    "nematic-takes-no-keywords": command("nematic axis", "compute nematic: takes no keywords, got 'axis'"),
    "dissipation-unknown-keyword": command("dissipation fashion step",
                                           "compute dissipation: the only keyword is 'mode', got 'fashion'"),
    "dissipation-mode": command("dissipation mode fast", "compute dissipation: 'mode' must be instantaneous, step or ledger, got 'fast'"),
    "dissipation-mode-missing": command("dissipation mode", "instantaneous, step or ledger after 'mode', got the end of the command"),
    "contact-local-column": command("contact/local id forse", "compute contact/local: 'column' must be id, image,", "got 'forse'"),
    "stress-contact-between-runs": between_runs("stress/contact", "c_c"),
    "dissipation-between-runs": between_runs("dissipation", "c_c[1]"),
}

if __name__ == "__main__":
    main(CASES)
