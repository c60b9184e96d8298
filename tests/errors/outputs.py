# SPDX-License-Identifier: GPL-2.0-or-later
"""What the command outputs refuses, and that it has defined nothing then."""
from case import main
from deck import Deck
from packing import dense_packing
from refusal import refusal

PACKING = dense_packing(1.5)
STRESS = "compute stress all stress/contact"
WANTED = "outputs: 'ID' must be the ID of a compute or fix with named outputs, got "


def body(*lines, **choices):
    return Deck(PACKING, body=[*lines, 'print "the line was taken"'], **choices)


def lines(*all_lines, words):
    return refusal(lambda: body(*all_lines), *words)


def words_of(command, message):
    return lines(STRESS, command, words=[f"ERROR: outputs: {message} ("])


def clash(define, what):
    return lines(
        STRESS,
        define,
        "outputs stress",
        words=[
            f"ERROR: outputs: the variable 'stress_Z' for 'c_stress[31]' exists already and is {what}: "
            "delete it first, or give another 'prefix' ("
        ],
    )


NAME = "letters, digits and underscores"
main(
    {
        "no-words": words_of("outputs", "expected the ID of a compute or fix, got the end of the command"),
        "other-keyword": words_of("outputs stress as s", "'keyword' must be prefix, got 'as'"),
        "surplus-word": words_of("outputs stress prefix s t", "'keyword' must be prefix, got 't'"),
        "two-prefixes": words_of("outputs stress prefix s prefix t", "'prefix' is given twice"),
        "no-prefix": words_of("outputs stress prefix", f"expected {NAME} after 'prefix', got the end of the command"),
        "prefix-with-a-slash": words_of("outputs stress prefix a/b", f"'prefix' must be {NAME}, got 'a/b'"),
        "prefix-with-a-dash": words_of("outputs stress prefix a-b", f"'prefix' must be {NAME}, got 'a-b'"),
        "empty-prefix": words_of('outputs stress prefix ""', f"'prefix' must be {NAME}, got ''"),
        "misspelt": lines(
            STRESS, "outputs strss", words=[WANTED + "'strss': did you mean 'stress'? (doc/outputs.md) ("]
        ),
        "nothing-like-it": lines(STRESS, "outputs temperature", words=[WANTED + "'temperature' (doc/outputs.md) ("]),
        "host-compute": lines(
            "compute energy all ke",
            "outputs energy",
            words=[WANTED + "'energy': the outputs of compute energy (ke) have no names (doc/outputs.md) ("],
        ),
        "host-fix": lines(
            "outputs integrate",
            words=[
                WANTED + "'integrate': the outputs of fix integrate (nve/superquadric) have no names (doc/outputs.md) ("
            ],
        ),
        "compute-and-fix": lines(
            "compute press all nematic",
            "fix press all press/strain axis y target 1e5 every/step 10",
            "outputs press",
            words=[
                WANTED
                + "'press', which is the ID of both compute press (nematic) and fix press (press/strain): rename one ("
            ],
        ),
        "before-the-box": refusal(lambda: "outputs stress\n", WANTED + "'stress' (doc/outputs.md) ("),
        "clash-equal": clash("variable stress_Z equal 3*step", "equal to 3*step"),
        "clash-string": clash("variable stress_Z string four", "not of style equal"),
        "clash-index": clash("variable stress_Z index 1 2", "not of style equal"),
        "clash-atom": clash("variable stress_Z atom x", "not of style equal"),
        "compute-that-is-gone": lines(
            STRESS,
            "outputs stress",
            "uncompute stress",
            "variable twice equal 2*v_stress_P",
            "thermo_style custom step v_twice",
            "run 1",
            words=["Invalid compute ID in variable formula"],
        ),
    }
)
