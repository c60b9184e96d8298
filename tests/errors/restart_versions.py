# SPDX-License-Identifier: GPL-2.0-or-later
"""Restart files of other versions of grainscope: each fix refuses a state that it cannot read, with both versions.
And fixes that no input script makes."""
from dataclasses import replace
import struct
import zlib

from case import main, require
from catalogue import DISPLACEMENT, strain_lines
from deck import Deck, thermo
from grainscope.columns import outputs
from packing import dense_packing
from plates import bed, plated, press
from refusal import require_refused
from run import run

PRESS = "fix press all press/strain axis y target 2e5 shear xy rate 0.05 every 7e-4"
FIXES = {
    "run/guard": "gran_insitu_guard",
    "setup/memory": "gran_insitu_setup",
    "grain/record": "moved_record",
    "ledger/record": "ledger_ledger",
    "press/strain": "press",
    "press/wall": "press",
    "wall/gran": "floor",
}
WITH_WALLS = ("press/wall", "wall/gran")
# of the states that have changed since they have versions
VERSIONS = {"grain/record": 2, "ledger/record": 3, "press/strain": 2, "press/wall": 2, "wall/gran": 2}
MARK = b"grs stat"
SEAL = struct.Struct("<16sQII")  # mark, length, checksum, format


def measured(style=""):
    if style in WITH_WALLS:
        return plated(bed(across=3, layers=2)), [press(1e4)]
    deck = Deck(dense_packing(1.5), surface="ellipsoid", extra="setup neutral ledger on")
    lines = [*strain_lines(0.05), PRESS, DISPLACEMENT.define("all"), "compute ledger all energy/ledger"]
    balance = outputs("energy/ledger").word("ledger", "residual_relative")
    return deck, [*lines, *thermo(5, *DISPLACEMENT.columns(), balance)]


def resealed(body, whole, **changes):
    """`body` with the seal that fits it."""
    mark, _, _, form = SEAL.unpack(whole[-SEAL.size :])
    return body + SEAL.pack(mark, len(body), zlib.crc32(body), changes.get("format", form))


def with_number(whole, style, offset, value):
    """Another number `offset` bytes after the mark of the state of the style's fix, which follows its ID and style."""
    body = bytearray(whole[: -SEAL.size])
    name = body.index(FIXES[style].encode() + b"\0")
    at = body.index(MARK, name)
    require(at - name < 60, f"fix {style} keeps no state with a version")
    struct.pack_into("<I", body, at + offset, value)
    return resealed(bytes(body), whole)


def written(ranks, style=""):
    deck, lines = measured(style)
    lines = [*deck.body, *lines]
    file = run(replace(deck, body=[*lines, "run 5", "write_restart now.restart"]), ranks).folder / "now.restart"
    return file, file.read_bytes(), deck.restarted(file, [*lines, "run 1"])


def refused(style, offset, value, words):
    def case(ranks):
        file, whole, resume = written(ranks, style)
        file.write_bytes(with_number(whole, style, offset, value))
        require_refused(resume, ranks, f"fix {FIXES[style]} ({style}): the restart file {words}")

    return case


def same_file_is_read(ranks):
    """What the other cases change is read when it is written again with the number that it had."""
    for scene, styles in (("", [style for style in FIXES if style not in WITH_WALLS]), ("press/wall", WITH_WALLS)):
        file, whole, resume = written(ranks, scene)
        for style in styles:
            file.write_bytes(with_number(whole, style, 8, VERSIONS.get(style, 1)))
            require(file.read_bytes() == whole, f"the file has another version of {style}, or another seal")
        run(resume, ranks)


def former_seal_refused(ranks):
    """Files from before states had versions."""
    file, whole, resume = written(ranks)
    file.write_bytes(resealed(whole[: -SEAL.size], whole, format=1))
    require_refused(resume, ranks, "was written by a version of grainscope with format 1, this one has format 2")


def not_by_an_input_script(ranks):
    deck, lines = measured()
    for style, words in (
        ("run/guard", "pair_style gran/insitu"),
        ("setup/memory", "pair_style gran/insitu"),
        ("grain/record", "the computes that need it"),
        ("ledger/record", "the computes that need it"),
    ):
        body = [*lines, f"fix mine all {style}", "run 1"]
        require_refused(replace(deck, body=body), ranks, f"fix {style}: is made by {words}, not by an input script")


OTHER = "was written by another version of grainscope: it holds {} of its state, and this program reads version {}"
CASES = {
    "same-file-is-read": same_file_is_read,
    "former-seal": former_seal_refused,
    "not-by-an-input-script": not_by_an_input_script,
}
for one in FIXES:
    version = VERSIONS.get(one, 1)
    CASES[f"{one}-version"] = refused(one, 8, 9, OTHER.format("version 9", version))
    CASES[f"{one}-size"] = refused(one, 12, 4, OTHER.format("4 bytes", version))
    CASES[f"{one}-without-a-version"] = refused(
        one,
        0,
        0,
        "holds its state without a version, as earlier versions of grainscope wrote it, and this program "
        f"reads version {version}",
    )

if __name__ == "__main__":
    main(CASES)
