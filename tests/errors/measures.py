# SPDX-License-Identifier: GPL-2.0-or-later
"""What the computes of surface, displacement and correlation refuse because of grains, box, fixes and variables."""
from dataclasses import replace

from case import main, require
from deck import Deck, thermo
from packing import dense_packing
from refusal import refusal
from run import WITHOUT_FFTW, Started, tail

SPHEROIDS, SPHERES = dense_packing(1.5), dense_packing(atom_style="sphere")


def line(command, *words, packing=SPHEROIDS, before=(), after=(), **choices):
    """`compute c all <command>`, refused when it is read, when the run begins, or when it is asked."""
    return refusal(
        lambda: Deck(packing, body=[*before, f"compute c all {command}", *after, "run 1"], **choices), *words
    )


def mesh_without_fftw(ranks):
    """Of a build that has none."""
    result = Started(Deck(SPHERES, body=["compute c all velocity/correlation method mesh"]), ranks).end()
    words = f"compute velocity/correlation: {WITHOUT_FFTW}"
    require(result.code > 0 and words in result.output, f"code {result.code}: {tail(result.output)}")


def strain(requirement, got, **choices):
    return line(
        f"displacement/shear strain {got}",
        f"compute displacement/shear: 'strain' must be {requirement}, got '{got}'",
        **choices,
    )


def squashed(shape, packing=SPHEROIDS):
    """The first grain has another shape."""
    first, *rest = packing.grains
    return replace(packing, grains=[replace(first, semi_axes=shape), *rest])


def all_shaped(shape):
    return replace(SPHEROIDS, grains=[replace(g, semi_axes=shape) for g in SPHEROIDS.grains])


KNOWN = "strain v_strain "
VARIABLE = ["variable strain equal step"]
NO_STRAIN = "needs a strain: use fix press/strain, or the keyword 'strain' with f_ID[n], v_name or time"
PRESS = "fix {} all press/strain axis y target 1e5 shear xy rate 0.05 every 1e-3"

CASES = {
    "surface-of-spheres": line(
        "contact/surface", "compute contact/surface: needs atom_style superquadric", packing=SPHERES
    ),
    "surface-two-shapes": line(
        "contact/surface",
        "compute contact/surface: needs grains of one shape in group 'all'",
        packing=squashed((1.0, 1.0, 1.4)),
    ),
    "surface-sphere-among-spheroids": line(
        "contact/surface", "needs grains of one shape", packing=squashed((1.0, 1.0, 1.0))
    ),
    "surface-triaxial": line(
        "contact/surface",
        "compute contact/surface: 'axis' must be x, y or z for triaxial grains, got 'auto'",
        packing=all_shaped((1.0, 1.2, 1.5)),
    ),
    "surface-boxy": line(
        "contact/surface",
        "compute contact/surface: needs ellipsoids, blockiness 2 2",
        packing=dense_packing(1.5, blockiness=(4.0, 3.0), overlap=-0.12),
    ),
    "correlation-mesh-not-periodic": line(
        "velocity/correlation method mesh",
        "compute velocity/correlation: 'method' must be direct in a box",
        packing=replace(SPHERES, triclinic=False),
        boundary="p p f",
    ),
    "correlation-mesh-too-fine": line(
        "velocity/correlation method mesh mesh 100 bins 1000",
        "must give fewer than 1e9 cells, got",
        after=thermo(1, "c_c"),
    ),
    "mesh-without-fftw": mesh_without_fftw,
    "memory-without-strain": line("velocity/memory", f"compute velocity/memory: {NO_STRAIN}"),
    "displacement-record-taken": line(
        "displacement/shear",
        "needs the fix ID 'c_record' for its memory, but it is taken",
        before=["fix c_record all print 10 hello"],
    ),
    "displacement-record-gone": line(
        "displacement/shear " + KNOWN,
        "fix c_record, which holds the memory of compute c, no longer exists",
        before=VARIABLE,
        after=["run 0", "unfix c_record"],
    ),
    "record-by-hand": line(
        "displacement/shear",
        "fix grain/record: is made by the computes that need it",
        before=["fix x all grain/record 5 0 1.0"],
    ),
    "memory-too-much": line(
        "velocity/memory lags 400 " + KNOWN,
        "must remember at most 800 numbers per grain, got 802",
        before=[*VARIABLE, "compute d all velocity/memory lags 400 strain v_strain"],
    ),
    "displacement-strain-no-such-variable": strain("an equal-style variable that is defined", "v_nothing"),
    "displacement-strain-not-an-equal-variable": strain(
        "an equal-style variable that is defined", "v_each", before=["variable each atom x"]
    ),
    "displacement-strain-no-such-fix": strain("the element of a fix that is defined", "f_nothing[1]"),
    "displacement-strain-beyond-the-vector": strain(
        "an element of the fix's vector", "f_press[99]", before=[PRESS.format("press")]
    ),
    "displacement-without-strain": line("displacement/shear", f"compute displacement/shear: {NO_STRAIN}"),
}

if __name__ == "__main__":
    main(CASES)
