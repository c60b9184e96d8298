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


def not_announced(style, value):
    """A region moved by a variable: the host evaluates it without announcing the compute in it."""
    return refusal(lambda: deck(f"compute c all {style}", f"variable now equal {value}",
                                "region moved block INF INF INF INF INF INF move v_now NULL NULL units box",
                                "compute m all reduce/region moved sum vx", *thermo(2, "c_m"), "run 3"),
                   f"compute {style} c: not tallied on this step", "fix ave/time")


CASES = {
    "stress-contact-takes-no-keywords": command("stress/contact virial", "compute stress/contact: takes no keywords, got 'virial'"),
    "nematic-takes-no-keywords": command("nematic axis", "compute nematic: takes no keywords, got 'axis'"),
    "dissipation-unknown-keyword": command("dissipation fashion step",
                                           "compute dissipation: the only keyword is 'mode', got 'fashion'"),
    "dissipation-mode": command("dissipation mode fast", "compute dissipation: 'mode' must be instantaneous or step, got 'fast'"),
    "dissipation-mode-missing": command("dissipation mode", "instantaneous or step after 'mode', got the end of the command"),
    "contact-local-column": command("contact/local id forse", "compute contact/local: 'column' must be id, image,", "got 'forse'"),
    "stress-contact-not-announced": not_announced("stress/contact", "c_c"),
    "dissipation-not-announced": not_announced("dissipation", "c_c[1]"),
}

if __name__ == "__main__":
    main(CASES)
