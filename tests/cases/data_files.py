# SPDX-License-Identifier: GPL-2.0-or-later
"""Data files of superquadrics: write_data and read_data, files by hand; compute property/atom."""
from dataclasses import replace
import math
import os
from pathlib import Path
import tempfile

import numpy as np

from case import main, require, require_close, require_equal, require_same_snapshots
from deck import Deck, dump_grains
from packing import Grain, Packing, numbers
from run import run

INTEGERS = "id type ix iy iz"
GIVEN = "shapex shapey shapez blockiness1 blockiness2 density quat1 quat2 quat3 quat4 vx vy vz omegax omegay omegaz"
DERIVED = "mass radius inertiax inertiay inertiaz"
PLACES = "x y z"
SPINS = "angmomx angmomy angmomz"
ALL = f"{INTEGERS} {GIVEN} {DERIVED} {PLACES} {SPINS}"
VOLUME = "compute volume all property/atom volume"


def unit(quaternion):
    return tuple(float(q) for q in np.array(quaternion) / np.linalg.norm(quaternion))


def grains(seed=3):
    """Spheres, spheroids, ellipsoids and boxes, turned, thrown and spinning at random, far from each other."""
    random = np.random.default_rng(seed)
    shapes = ((1.0, 1.0, 1.0), (1.0, 1.0, 1.5), (1.0, 1.0, 0.4), (0.7, 0.9, 1.3), (0.1, 0.2, 1.7))
    blockiness = ((2.0, 2.0), (2.0, 2.0), (2.0, 2.0), (2.0, 2.0), (3.5, 2.7))

    def grain(k):
        place = (4.2 * (k % 3) + 2.1 + 0.1 * random.uniform(), 4.2 * (k // 3) + 2.1 + 0.1 / 3.0, 4.0 + random.uniform())
        turned, velocity, omega = (random.normal(size=n) for n in (4, 3, 3))
        motion = tuple(velocity), tuple(3.0 * omega)
        return Grain(place, shapes[k % 5], unit(turned), *motion, 1 + k % 2, blockiness[k % 5])

    return [grain(k) for k in range(9)]


def packing(tilt):
    def sheared(grain):
        x, y, z = grain.position
        return replace(grain, position=(x + tilt * y / 12.6, y, z))

    made = [sheared(grain) for grain in grains()]
    return Packing((12.6, 12.6, 12.6), made, tilt=tilt, types=2, triclinic=tilt != 0.0)


SETTINGS = ["set type 2 density 1234.5678901234567", "set atom 3 image 2 -1 0", "set atom 4 image -512 511 7", VOLUME]


def spins(deck):
    """Once more, now that the moments of inertia are what they will be: the host keeps the angular momentum."""
    return [f"set atom {k} {Packing._motion(grain)}" for k, grain in enumerate(deck.packing.grains, 1)]


def seen(deck, columns=ALL):
    return [*dump_grains(deck.packing, 1, columns=columns + " c_volume"), "run 0"]


def reading(deck, file, *body):
    """The deck that starts from a data file."""
    return "\n".join([*deck.header(), f"read_data {file}", *deck.physics(), VOLUME, *body]) + "\n"


def there_and_back(tilt, steps, place, spin):
    """write_data, read_data on as many ranks: the same grains, but for the rounding of `place` and of `spin`."""

    def case(ranks):
        deck = Deck(packing(tilt))
        moved = [f"run {steps}"] if steps else []
        deck.body = [*SETTINGS, *spins(deck), *moved, *seen(deck), "write_data grains.data"]
        first = run(deck, ranks)
        again = run(reading(deck, first.folder / "grains.data", *seen(deck)), ranks)
        step, written = first.dump("grains.dump")[-1]
        _, read = again.dump("grains.dump")[-1]
        require(step == steps and len(written["id"]) == 9, f"{len(written['id'])} grains in step {step}")
        for name in f"{INTEGERS} {GIVEN} {DERIVED} c_volume".split():
            require_equal(read[name], written[name], name)
        for name in PLACES.split():
            require_close(read[name], written[name], place, name, 12.6)
        scale = float(max(np.abs(written[name]).max() for name in SPINS.split()))
        for name in SPINS.split():
            require_close(read[name], written[name], spin, name, scale)
        require(np.ptp(written["ix"]) > 100 and float(np.abs(written["angmomx"]).min()) > 0.0, "nothing to lose")

    return case


def columns_of_file(ranks):
    """What write_data writes, against the grains as they were made: by hand, column by column."""
    deck = Deck(packing(0.0))
    deck.body = [*SETTINGS, *spins(deck), "write_data grains.data"]
    lines = run(deck, ranks).file("grains.data").read_text().splitlines()
    at, end = lines.index("Atoms"), lines.index("Velocities")
    atoms = {words[0]: words[1:] for words in (line.split() for line in lines[at + 2 : end - 1])}
    velocities = {words[0]: words[1:] for words in (line.split() for line in lines[end + 2 :]) if words}
    require(len(atoms) == len(velocities) == 9, f"{len(atoms)} grains, {len(velocities)} velocities")
    images = {"3": ["2", "-1", "0"], "4": ["-512", "511", "7"]}
    for k, grain in enumerate(deck.packing.grains, 1):
        words = atoms[str(k)]
        require(len(words) == 17 and words[0] == str(grain.type), f"grain {k}: {words}")
        require(words[14:] == images.get(str(k), ["0"] * 3), f"image flags of grain {k}: {words}")
        density = 1000.0 if grain.type == 1 else 1234.5678901234567
        expected = (density, *grain.semi_axes, *grain.blockiness, *grain.position)
        require_equal([float(w) for w in words[1:10]], expected, f"grain {k}")
        # `set quat_direct` divides a unit quaternion by its length once more: two roundings.
        require_close([float(w) for w in words[10:14]], grain.quaternion, 4e-16, f"quaternion of grain {k}", 1.0)
        require_equal([float(w) for w in velocities[str(k)]], (*grain.velocity, *grain.omega), f"velocity of grain {k}")


HEADER = """superquadrics: id type density shapex shapey shapez blockiness1 blockiness2 x y z

3 atoms
2 atom types

-6 6 xlo xhi
-6 6 ylo yhi
-6 6 zlo zhi
2 0 0 xy xz yz

Atoms

"""


def write_file(lines, header=HEADER):
    folder = Path(tempfile.mkdtemp(prefix="data-", dir=os.environ["GRAINSCOPE_SCRATCH"]))
    (folder / "hand.data").write_text(header + "\n".join(lines) + "\n")
    return folder / "hand.data"


def hand_deck():
    """The box of HEADER; three grains of it as create_atoms and set make them."""
    half = math.sqrt(0.5)
    made = [
        Grain((-1.99, 0.0, 0.0), (1.0, 1.0, 1.5)),
        Grain((0.25, 0.0, 0.0), (0.5, 0.75, 1.25), (half, 0.0, 0.0, half), type=2),
        Grain((3.0, 4.5, 0.0), (1.0, 1.0, 1.5), blockiness=(3.0, 4.0)),
    ]
    return Deck(Packing((12.0, 12.0, 12.0), made, tilt=2.0, types=2, origin=(-6.0, -6.0, -6.0)))


def by_hand(quaternions, images, comment=False):
    """11, 14, 15 or 18 columns: the grains that `create_atoms` and `set` make, to the last bit; mass and moments of the
    closed forms."""

    def case(ranks):
        deck = hand_deck()
        turned = quaternions
        if not turned:
            deck.packing.grains[1] = replace(deck.packing.grains[1], quaternion=(1.0, 0.0, 0.0, 0.0))
        flags = [(0, 0, 0), (3, -2, 1), (-1, 0, 0)]
        lines = []
        for k, grain in enumerate(deck.packing.grains):
            words = [str(k + 1), str(grain.type), "1000"]
            words += [numbers(values) for values in (grain.semi_axes, grain.blockiness, grain.position)]
            if turned:
                words.append(["1 0 0 0", "-2 0 0 -2", "1 0 0 0"][k])
            if images:
                words.append(" ".join(map(str, flags[k])))
            lines.append("  ".join(words) + ("\t# grain" if comment else ""))
        if turned:
            deck.packing.grains[1] = replace(deck.packing.grains[1], quaternion=(-2.0, 0.0, 0.0, -2.0))
        wrapped = [f"set atom {k + 1} image {' '.join(map(str, flags[k]))}" for k in range(3) if images]
        made = Deck(deck.packing, body=[VOLUME, *wrapped, *seen(deck)])
        expected = run(made, ranks).dump("grains.dump")
        found = run(reading(deck, write_file(lines), *seen(deck)), ranks).dump("grains.dump")
        require_same_snapshots(found, expected, "a file by hand against create_atoms and set")
        grain = found[0][1]
        a, b, c = 0.5, 0.75, 1.25
        mass = 1000.0 * 4.0 / 3.0 * math.pi * a * b * c
        # The host takes volumes and moments of superquadrics from beta functions: some roundings more.
        moments = [0.2 * mass * s for s in (b * b + c * c, a * a + c * c, a * a + b * b)]
        found_moments = [grain[n][1] for n in ("mass", "inertiax", "inertiay", "inertiaz")]
        require_close(found_moments, [mass, *moments], 1e-13, "closed forms")
        require_close([grain["radius"][1]], [c], 1.1e-4, "bounding sphere, which LIGGGHTS makes 1e-4 wider")
        half = math.sqrt(0.5)
        found = [grain[f"quat{k}"][1] for k in (1, 2, 3, 4)]
        require_close(found, [-half, 0, 0, -half] if turned else [1, 0, 0, 0], 2e-16, "quaternion")
        wanted = np.transpose(flags) if images else np.zeros((3, 3))
        require_equal([grain[n] for n in ("ix", "iy", "iz")], wanted, "image flags")

    return case


def by_the_other_name(ranks):
    """`atom_style granular_superquadric` is the same style."""
    deck = hand_deck()
    lines = [
        "1 1 1000 1 1 1 2 2 -1.99 0 0 1 0 0 0",
        "2 1 1000 1 1 1.5 2 2 1.5 0 0 2 0 2 0",
        "3 2 1000 1 1 1.5 2 2 3 4.5 0 1 0 0 0",
    ]
    text = reading(deck, write_file(lines), *seen(deck))
    other = text.replace("atom_style superquadric", "atom_style granular_superquadric")
    require(other != text, "the deck has no atom style to replace")
    found, expected = (run(one, ranks).dump("grains.dump") for one in (other, text))
    require_same_snapshots(found, expected, "by the other name")


def spin_of_file(ranks):
    """A sphere and a spheroid that spins about its own axis go on spinning as the section Velocities has it."""
    deck = hand_deck()
    lines = [
        "1 1 1000 1 1 1 2 2 -1.99 0 0 1 0 0 0",
        "2 1 1000 1 1 1.5 2 2 1.5 0 0 2 0 2 0",
        "3 2 1000 1 1 1.5 2 2 3 4.5 0 1 0 0 0",
        "",
        "Velocities",
        "",
        "3 0 0 0.5 0 0 -2",
        "1 0 0.25 0 1 2 3",
        "2 0 0 0 5 0 0",
    ]
    body = [*dump_grains(deck.packing, 10, columns=f"id {GIVEN} {SPINS}"), "run 10"]
    first, last = run(reading(deck, write_file(lines), *body), ranks).dump("grains.dump")

    def rows(snapshot, name):
        return [[snapshot[1][f"{name}{d}"][k] for d in "xyz"] for k in range(3)]

    expected = [[1, 2, 3], [5, 0, 0], [0, 0, -2]]
    # Ten steps of a free rotation, each with some roundings of a number of size one.
    require_close(rows(last, "omega"), expected, 1e-13, "angular velocities after 10 steps", 5.0)
    mass, about_axis = 1000.0 * 4.0 / 3.0 * math.pi, 0.4
    moments = [about_axis * mass, about_axis * 1.5 * mass, about_axis * 1.5 * mass]
    momenta = [[m * w for w in row] for m, row in zip(moments, expected)]
    require_close(rows(first, "angmom"), momenta, 1e-13, "angular momenta")
    require_equal([last[1]["vy"][0], last[1]["vz"][2]], [0.25, 0.5], "velocities")


def spin_of_other_moments(ranks):
    """`set density` after the spin keeps the angular momentum; the spin that belongs to it is written."""
    grain = Grain((5.0, 5.0, 5.0), (1.0, 1.0, 1.5), omega=(0.0, 0.0, 3.0))
    deck = Deck(Packing((10.0,) * 3, [grain], triclinic=False))
    deck.body = ["set atom 1 density 2000", "write_data grains.data"]
    result = run(deck, ranks)
    words = result.file("grains.data").read_text().split("Velocities")[1].split()
    require_close([float(w) for w in words[4:7]], [0.0, 0.0, 1.5], 4e-16, "half the spin for twice the density", 1.5)


def property_atom(ranks):
    """Every word, alone and among the host's, for some grains; zero for the others."""
    words = {name: name for name in ("shapex", "shapey", "shapez", "blockiness1", "blockiness2")}
    words.update(quatw="quat1", quati="quat2", quatj="quat3", quatk="quat4")
    named = dict(words, volume="c_volume")
    deck = Deck(packing(1.5))
    mixed = ["mass", *words, "volume", "x", "quatw"]
    computes = [f"compute {w} few property/atom {w}" for w in words]
    columns = f"id mass x {' '.join(words.values())} c_volume {' '.join('c_' + w for w in words)} " + " ".join(
        f"c_all[{k}]" for k in range(1, len(mixed) + 1)
    )
    deck.body = [
        VOLUME,
        "group few id 2:8",
        *computes,
        f"compute all few property/atom {' '.join(mixed)}",
        *dump_grains(deck.packing, 5, columns=columns),
        "run 5",
    ]
    for step, grain in run(deck, ranks).dump("grains.dump"):
        inside = (grain["id"] >= 2) & (grain["id"] <= 8)
        for word, name in words.items():
            require_equal(grain["c_" + word], grain[name] * inside, f"{word}, step {step}")
        for k, word in enumerate(mixed, 1):
            require_equal(grain[f"c_all[{k}]"], grain[named.get(word, word)] * inside, f"column {k}, {word}")
    require_equal(grain["shapez"][4], 1.7, "shapez of grain 5")
    require(bool((grain["quat1"] != 0.0).all()), "no orientation")


def spheres(ranks):
    """Files of atom style sphere are the host's: 7 columns and image flags."""
    made = [
        Grain(
            (2.0 + 3.0 * k, 2.0, 1.0 + 0.1 * k),
            (0.5 + 0.1 * k,) * 3,
            velocity=(0.1 * k, 0.2, 0.0),
            omega=(0.0, 1.0, 0.1 * k),
        )
        for k in range(3)
    ]
    deck = Deck(Packing((12.0, 12.0, 12.0), made, atom_style="sphere", triclinic=False))
    columns = "id type ix iy iz x y z vx vy vz omegax omegay omegaz radius mass density"
    deck.body = ["set atom 2 image 3 -2 0", VOLUME, *seen(deck, columns), "write_data grains.data"]
    first = run(deck, ranks)
    text = first.file("grains.data").read_text().splitlines()
    line = next(line.split() for line in text[text.index("Atoms") + 2 :] if line.split()[0] == "2")
    require(len(line) == 10 and line[7:] == ["3", "-2", "0"], f"{line}")
    require_equal([float(w) for w in line[2:7]], [1.2, 1000.0, 5.0, 2.0, 1.1], "a sphere's line")
    again = run(reading(deck, first.folder / "grains.data", *seen(deck, columns)), ranks)
    (_, found), (_, expected) = again.dump("grains.dump")[0], first.dump("grains.dump")[0]
    for name in columns.split():
        # The host writes the density that it takes from mass and radius.
        require_close(found[name], expected[name], 4e-16 if name in ("mass", "density") else 0.0, name)


CASES = {
    "there-and-back": there_and_back(0.0, 0, 0.0, 0.0),
    # Places in a triclinic box go to fractions of it and back, in writer, reader and run: roundings of an edge.
    "there-and-back-triclinic": there_and_back(3.1, 0, 1e-15, 0.0),
    # An integrator derives the angular velocity, which a file holds, from the angular momentum. Moments differ 70-fold.
    "there-and-back-after-steps": there_and_back(0.0, 50, 0.0, 1e-13),
    "columns-of-file": columns_of_file,
    "by-the-other-name": by_the_other_name,
    "by-hand-11-columns": by_hand(False, False),
    "by-hand-14-columns": by_hand(False, True),
    "by-hand-15-columns": by_hand(True, False),
    "by-hand-18-columns": by_hand(True, True),
    "by-hand-with-comments": by_hand(True, True, comment=True),
    "spin-of-file": spin_of_file,
    "spin-of-other-moments": spin_of_other_moments,
    "property-atom": property_atom,
    "spheres": spheres,
}

if __name__ == "__main__":
    main(CASES)
