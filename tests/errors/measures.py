# SPDX-License-Identifier: GPL-2.0-or-later
"""What the computes of fabric, surface, direction, fluctuation, displacement and correlation refuse: keyword, requirement, value."""
from dataclasses import replace

from case import main
from deck import Deck, thermo
from packing import dense_packing
from refusal import refusal

SPHEROIDS, SPHERES = dense_packing(1.5), dense_packing(atom_style="sphere")


def line(command, *words, packing=SPHEROIDS, before=(), after=(), **choices):
    """`compute c all <command>`, refused when it is read, when the run begins, or when it is asked."""
    return refusal(lambda: Deck(packing, body=[*before, f"compute c all {command}", *after, "run 1"], **choices), *words)


def value(style, keyword, requirement, got, rest="", **choices):
    """'keyword' must be ..., got '...'."""
    return line(f"{style} {rest}{keyword} {got}", f"compute {style}: '{keyword}' must be {requirement}, got '{got}'", **choices)


def ends(style, keyword, wanted):
    return line(f"{style} {keyword}", f"compute {style}: expected {wanted} after '{keyword}', got the end of the command")


def unknown(style, keywords):
    return line(f"{style} spin", f"compute {style}: 'keyword' must be {keywords}, got 'spin'")


def between_runs(style, element):
    """Asked on a step that nobody announced: the host itself refuses."""
    return refusal(lambda: Deck(SPHEROIDS, body=[f"compute c all {style}", f"variable now equal {element}", *thermo(100, "step"), "run 3",
                                                 'print "${now}"']), "Compute used in variable between runs is not current")


def squashed(shape, packing=SPHEROIDS):
    """The first grain has another shape."""
    first, *rest = packing.grains
    return replace(packing, grains=[replace(first, semi_axes=shape), *rest])


def all_shaped(shape):
    return replace(SPHEROIDS, grains=[replace(g, semi_axes=shape) for g in SPHEROIDS.grains])


STRAIN = "f_ID[n] or v_name"
EVEN_TO_10000, EVEN_TO_1000 = (f"an even whole number from 2 to {most}" for most in (10000, 1000))
PLANE, COMPONENT = "xy, xz or yz", "vx, vy, vz, wx, wy or wz"
TO_10000, TO_1000, TO_400 = (f"a whole number from 1 to {most}" for most in (10000, 1000, 400))
KNOWN = "strain v_strain "
VARIABLE = ["variable strain equal step"]
NO_STRAIN = "needs to know the strain: use fix press/strain, or the keyword 'strain' with f_ID[n] or v_name"
PRESS = "fix {} all press/strain axis y target 1e5 shear xy rate 0.05 every 1e-3"

CASES = {
    "fabric-keyword": unknown("fabric", "plane, branch, force/normal or force/tangential"),
    "fabric-plane": value("fabric", "plane", PLANE, "yx"),
    "fabric-twice": line("fabric branch branch", "compute fabric: 'branch' is given twice"),
    "fabric-plane-missing": ends("fabric", "plane", PLANE),
    "fabric-needs-gran-insitu": line("fabric", "compute fabric requires pair_style gran/insitu, got 'gran'", pair="gran"),
    "fabric-between-runs": between_runs("fabric", "c_c[1]"),
    "surface-keyword": unknown("contact/surface", "bins, angle or axis"),
    "surface-bins": value("contact/surface", "bins", TO_1000, "0"),
    "surface-bins-too-many": value("contact/surface", "bins", TO_1000, "1001"),
    "surface-bins-fraction": value("contact/surface", "bins", TO_1000, "2.5"),
    "surface-bins-nan": value("contact/surface", "bins", TO_1000, "nan"),
    "surface-bins-missing": ends("contact/surface", "bins", TO_1000),
    "surface-angle": value("contact/surface", "angle", "polar or parametric", "flat"),
    "surface-axis": value("contact/surface", "axis", "auto, x, y or z", "q"),
    "surface-of-spheres": line("contact/surface", "compute contact/surface: needs atom_style superquadric", packing=SPHERES),
    "surface-two-shapes": line("contact/surface", "compute contact/surface: needs grains of one shape in group 'all'",
                               packing=squashed((1.0, 1.0, 1.4))),
    "surface-sphere-among-spheroids": line("contact/surface", "needs grains of one shape", packing=squashed((1.0, 1.0, 1.0))),
    "surface-triaxial": line("contact/surface", "compute contact/surface: 'axis' must be x, y or z for triaxial grains, got 'auto'",
                             packing=all_shaped((1.0, 1.2, 1.5))),
    "surface-boxy": line("contact/surface", "compute contact/surface: needs ellipsoids, blockiness 2 2",
                         packing=dense_packing(1.5, blockiness=(4.0, 3.0), overlap=-0.12)),
    "surface-needs-gran-insitu": line("contact/surface", "compute contact/surface requires pair_style gran/insitu, got 'gran'",
                                      pair="gran"),
    "direction-keyword": unknown("contact/direction", "plane or bins"),
    "direction-bins-odd": value("contact/direction", "bins", EVEN_TO_10000, "7"),
    "direction-bins-zero": value("contact/direction", "bins", EVEN_TO_10000, "0"),
    "direction-bins-missing": ends("contact/direction", "bins", EVEN_TO_10000),
    "direction-plane": value("contact/direction", "plane", PLANE, "zx"),
    "grain-takes-no-keywords": line("contact/grain theta", "compute contact/grain: takes no keywords, got 'theta'"),
    "grain-needs-gran-insitu": line("contact/grain", "compute contact/grain requires pair_style gran/insitu, got 'gran'", pair="gran"),
    "fluctuation-keyword": unknown("fluctuation", "plane, layers, diameter or flow"),
    "fluctuation-layers": value("fluctuation", "layers", TO_10000, "-4"),
    "fluctuation-diameter": value("fluctuation", "diameter", "a positive length", "0"),
    "fluctuation-diameter-nan": value("fluctuation", "diameter", "a positive length", "nan"),
    "fluctuation-plane": value("fluctuation", "plane", PLANE, "x"),
    "fluctuation-flow": value("fluctuation", "flow", "box, rate, fit or layers", "none"),
    "fluctuation-flow-missing": ends("fluctuation", "flow", "box, rate, fit or layers"),
    "fluctuation-flow-rate": line("fluctuation flow rate fast", "compute fluctuation: 'flow rate' must be a shear rate, got 'fast'"),
    "fluctuation-flow-rate-infinite": line("fluctuation flow rate inf", "'flow rate' must be a shear rate, got 'inf'"),
    "fluctuation-flow-layers": line("fluctuation flow layers 0", f"'flow layers' must be {TO_10000}, got '0'"),
    "layering-keyword": unknown("layering", "axis or layers"),
    "layering-axis": value("layering", "axis", "x, y or z", "xy"),
    "layering-layers-odd": value("layering", "layers", EVEN_TO_1000, "41"),
    "layering-layers-missing": ends("layering", "layers", EVEN_TO_1000),
    "correlation-keyword": unknown("velocity/correlation", "component, bins, range, method, mesh, flow, plane or average"),
    "correlation-component": value("velocity/correlation", "component", COMPONENT, "y"),
    "correlation-component-missing": ends("velocity/correlation", "component", COMPONENT),
    "correlation-bins": value("velocity/correlation", "bins", TO_10000, "0"),
    "correlation-range": value("velocity/correlation", "range", "a positive length", "-1"),
    "correlation-method": value("velocity/correlation", "method", "direct or mesh", "fft"),
    "correlation-mesh": value("velocity/correlation", "mesh", "a whole number from 1 to 100", "0.5", rest="method mesh "),
    "correlation-mesh-not-asked": line("velocity/correlation mesh 4", "compute velocity/correlation: 'mesh' needs 'method mesh'"),
    "correlation-mesh-not-periodic": line("velocity/correlation method mesh",
                                          "compute velocity/correlation: 'method' must be direct in a box",
                                          packing=replace(SPHERES, triclinic=False), boundary="p p f"),
    "correlation-mesh-too-fine": line("velocity/correlation method mesh mesh 100 bins 1000", "must ask for less than 1e9 cells, got",
                                      after=thermo(1, "c_c")),
    "correlation-average": value("velocity/correlation", "average", "one or running", "all"),
    "correlation-flow": value("velocity/correlation", "flow", "box, rate, fit or layers", "slow"),
    "correlation-plane": value("velocity/correlation", "plane", PLANE, "zy"),
    "memory-keyword": unknown("velocity/memory", "component, every, lags, strain, flow or plane"),
    "memory-component": value("velocity/memory", "component", COMPONENT, "v"),
    "memory-every": value("velocity/memory", "every", "a positive strain", "0"),
    "memory-every-nan": value("velocity/memory", "every", "a positive strain", "nan"),
    "memory-lags": value("velocity/memory", "lags", TO_400, "401"),
    "memory-lags-missing": ends("velocity/memory", "lags", TO_400),
    "memory-flow": value("velocity/memory", "flow", "box, rate, fit or layers", "line"),
    "memory-plane": value("velocity/memory", "plane", PLANE, "zz"),
    "memory-without-strain": line("velocity/memory", f"compute velocity/memory: {NO_STRAIN}"),
    "displacement-keyword": unknown("displacement/shear", "start or strain"),
    "displacement-start": value("displacement/shear", "start", "a strain", "now", rest=KNOWN, before=VARIABLE),
    "displacement-start-nan": value("displacement/shear", "start", "a strain", "nan", rest=KNOWN, before=VARIABLE),
    "displacement-record-taken": line("displacement/shear", "needs the fix ID 'c_record' for its memory, but it is taken",
                                      before=["fix c_record all print 10 hello"]),
    "displacement-record-gone": line("displacement/shear " + KNOWN, "fix c_record, which holds the memory of compute c, is gone",
                                     before=VARIABLE, after=["run 0", "unfix c_record"]),
    "record-by-hand": line("displacement/shear", "fix grain/record: is made by the computes that need it",
                           before=["fix x all grain/record -1 5 0"]),
    "memory-too-much": line("velocity/memory lags 400 " + KNOWN, "must remember at most 800 numbers per grain, got 802",
                            before=[*VARIABLE, "compute d all velocity/memory lags 400 strain v_strain"]),
    "displacement-strain": value("displacement/shear", "strain", STRAIN, "c_x"),
    "displacement-strain-of-a-fix": value("displacement/shear", "strain", STRAIN, "f_press"),
    "displacement-strain-element": value("displacement/shear", "strain", STRAIN, "f_press[0]"),
    "displacement-strain-missing": ends("displacement/shear", "strain", STRAIN),
    "displacement-strain-no-such-variable": value("displacement/shear", "strain", "an equal-style variable that is defined", "v_nothing"),
    "displacement-strain-not-an-equal-variable": value("displacement/shear", "strain", "an equal-style variable that is defined", "v_each",
                                                       before=["variable each atom x"]),
    "displacement-strain-no-such-fix": value("displacement/shear", "strain", "the element of a fix that is defined", "f_nothing[1]"),
    "displacement-strain-beyond-the-vector": value("displacement/shear", "strain", "an element of the fix's vector", "f_press[99]",
                                                   before=[PRESS.format("press")]),
    "displacement-without-strain": line("displacement/shear", f"compute displacement/shear: {NO_STRAIN}"),
}

if __name__ == "__main__":
    main(CASES)
