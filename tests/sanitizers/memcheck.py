# SPDX-License-Identifier: GPL-2.0-or-later
"""One small deck per style under valgrind: no invalid access and no use of what was never written with one of our
functions on the stack, and nothing of ours lost. What the host and the libraries do among themselves is counted, and
not judged."""
from collections import Counter
from dataclasses import replace
from pathlib import Path
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests" / folder) for folder in ("tools", "cases", ".", "../tools")]

from deck import Deck, dump_grains, thermo  # noqa: E402
from lifetimes import COMPUTES, PAIRS, asked  # noqa: E402
from packing import dense_packing  # noqa: E402
from plates import bed, plated, press  # noqa: E402
from run import binary, count_errors, environment  # noqa: E402

VALGRIND = [
    "valgrind",
    "--leak-check=full",
    "--show-leak-kinds=definite",
    "--errors-for-leak-kinds=definite",
    "--num-callers=60",
    "--track-origins=yes",
    "--error-limit=no",
    f"--suppressions={ROOT / 'tests/sanitizers/valgrind.supp'}",
    "--xml=yes",
]
OPEN_MPI = Path("/usr/share/openmpi/openmpi-valgrind.supp")
LEDGER = "ledger on tangential_damping off"
PRESS = "fix press all press/strain axis y target 2e4 shear xy rate 0.02 every 1e-4"


def ours():
    """What names a function of ours: the namespace, and the classes of styles."""
    headers = "\n".join(header.read_text() for header in (ROOT / "src").rglob("*.h"))
    classes = re.findall(r"^(?:Compute|Fix|Pair|Command)Style\([^,]+,\s*(\w+)\)", headers, re.M)
    return re.compile(r"grainscope::|\b(?:" + "|".join(classes) + r")\b")


def measured(compute):
    deck = Deck(dense_packing(1.5), surface="ellipsoid", extra=LEDGER)
    use, leave = asked("compute", compute)
    deck.body = [
        "variable strain equal 0.02*step*dt",
        PRESS,
        f"compute it all {compute}",
        *use[:-1],
        "thermo 2",
        "run 8",
        *leave,
        "uncompute it",
        "run 1",
    ]
    return deck


def moved(*lines, packing=None, **choices):
    packing = packing or dense_packing(1.5)
    return Deck(packing, body=[*lines, *dump_grains(packing, 5), "run 10"], **{"surface": "ellipsoid", **choices})


def triaxial():
    packing = dense_packing(1.5)
    return replace(packing, grains=[replace(grain, semi_axes=(1.0, 0.9, 1.5)) for grain in packing.grains])


def modelled(words):
    """The model that the words of a pair_style name, in the order that a Deck gives them."""
    surface = re.search(r"surface (\w+)", words)[1]
    rolling = re.search(r"rolling_friction (\w+)", words)
    return moved(
        surface=surface, rolling=rolling[1] if rolling else "off", extra=LEDGER if "ledger on" in words else ""
    )


def continued():
    """All that is in restart files, written and read by one process."""
    deck = measured("energy/ledger")
    state = [
        "variable strain equal 0.02*step*dt",
        PRESS,
        "compute ledger all energy/ledger",
        "compute walk all displacement/shear",
        "compute memory all velocity/memory every 1e-4 lags 3",
        *thermo(2, "c_ledger", "c_walk", "c_memory", "f_press"),
    ]
    deck.body = [*state, "run 4", "write_restart half.restart", "run 4", "clear"]
    return deck.text() + deck.restarted("half.restart", [*state, "run 4"])


def walled():
    wall = "fix floor all wall/gran model hertz tangential history surface ellipsoid primitive type 1 yplane 0.0"
    return moved(wall, packing=replace(dense_packing(1.5), triclinic=False), boundary="p f p", pair="gran")


def under_a_plate():
    deck = plated(bed(across=3, layers=2))
    deck.body += [press(1e4, "every/step 2"), *dump_grains(deck.packing, 5), "run 10"]
    return deck


DECKS = {
    **{f"compute {style}": measured(style) for style in COMPUTES},
    "fix nve/spheroid": moved("unfix integrate", "fix integrate all nve/spheroid"),
    "fix press/strain": moved(PRESS + " kinetic yes"),
    "fix press/strain of spheres": moved(PRESS, packing=dense_packing(atom_style="sphere")),
    "fix press/wall": under_a_plate(),
    **{f"pair_style gran/insitu {words}": modelled(words) for words in PAIRS},
    "pair_style gran/insitu, oblate grains": moved(packing=dense_packing(0.5)),
    "pair_style gran/insitu, two sizes and types": moved(packing=dense_packing(1.5, sizes=(1.0, 1.2), types=2)),
    "pair_style gran/insitu, triaxial grains": moved(packing=triaxial()),
    "pair_style gran surface ellipsoid": moved(pair="gran"),
    "compute pair/gran/local": moved(
        "compute pairs all pair/gran/local pos id force contactPoint delta",
        "dump pairs all local 5 pairs.dump c_pairs[1] c_pairs[9]",
    ),
    "fix wall/gran surface ellipsoid": walled(),
    "restart": continued(),
}


def errors_of(report):
    """(kind, function names from the innermost on, text) of each error."""
    for error in ElementTree.parse(report).getroot().iter("error"):
        stacks = [[f"{frame.findtext('fn', '?')}" for frame in stack.iter("frame")] for stack in error.iter("stack")]
        what = error.findtext("what") or error.findtext("xwhat/text") or ""
        yield error.findtext("kind"), [name for stack in stacks for name in stack], what


def check(name, deck, mine, folder):
    """(errors of ours, counts of the others')."""
    where = Path(tempfile.mkdtemp(dir=folder))
    (where / "in.deck").write_text(deck if isinstance(deck, str) else deck.text())
    suppressions = [f"--suppressions={OPEN_MPI}"] if OPEN_MPI.exists() else []
    command = [
        *VALGRIND,
        *suppressions,
        f"--xml-file={where / 'valgrind.xml'}",
        binary(),
        "-in",
        "in.deck",
        "-log",
        "log.liggghts",
    ]
    done = subprocess.run(
        command,
        cwd=where,
        env=environment(1),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
    )
    if done.returncode != 0 or count_errors(done.stdout):
        return [f"{name}: ended with code {done.returncode}: {done.stdout[-1500:]}"], Counter()
    found, others = [], Counter()
    for kind, frames, what in errors_of(where / "valgrind.xml"):
        if any(mine.search(frame) for frame in frames):
            found.append(f"{name}: {kind}: {what}\n    " + "\n    ".join(frames[:25]))
        else:
            host = next(
                (frame for frame in frames if "LAMMPS_NS::" in frame or "LIGGGHTS::" in frame),
                frames[0] if frames else "?",
            )
            others[f"{kind} in {host}"] += 1
    return found, others


def main(words):
    mine, bad, others = ours(), 0, Counter()
    with tempfile.TemporaryDirectory(prefix="grainscope-memcheck-") as folder:
        for name, deck in DECKS.items():
            if words and not any(word in name for word in words):
                continue
            found, theirs = check(name, deck, mine, folder)
            others += theirs
            bad += len(found)
            print(f"{'ok  ' if not found else 'BAD '} {name}" + "".join("\n  " + text for text in found), flush=True)
    for what, count in others.most_common():
        print(f"not ours, {count} times: {what}")
    return bad


if __name__ == "__main__":
    sys.exit(1 if main(sys.argv[1:]) else 0)
