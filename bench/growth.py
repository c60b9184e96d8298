#!/usr/bin/python3
"""How the cost of each measurement grows with the number of grains N: instructions per sample and per grain, counted by
callgrind in the functions of each compute, on a sheared lattice of spheroids in contact. A Markdown table. 256,000
grains take a quarter of an hour.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "tools"))
from grainscope.columns import outputs  # noqa: E402

STEPS = 2

# What each compute spends, as functions that do not call each other.
PARTS = {
    "stress/contact": ("ContactSums<StressSums>::add", "ComputeStressContact::answer"),
    "dissipation": (
        "ContactSums<LossSums>::add",
        "DampingForces::reset",
        "DampingForces::add",
        "ComputeDissipation::answer",
    ),
    "nematic": ("ComputeNematic::compute_vector",),
    "fabric": ("ContactSums<FabricSums>::add", "ComputeFabric::answer"),
    "contact/surface": (
        "ComputeContactSurface::begin_contacts",
        "ContactSums<SurfaceSums>::add",
        "ComputeContactSurface::answer",
    ),
    "contact/direction": ("ContactSums<DirectionSums>::add", "ComputeContactDirection::answer"),
    "contact/grain": (
        "ComputeContactGrain::begin_contacts",
        "ComputeContactGrain::add_contacts",
        "ComputeContactGrain::compute_peratom",
    ),
    "fluctuation": ("ComputeFluctuation::compute_vector",),
    "displacement/shear": ("ComputeDisplacementShear::compute_vector",),
    "velocity/memory": ("ComputeVelocityMemory::compute_array",),
    "velocity/correlation mesh": ("ComputeVelocityCorrelation::compute_scalar",),
    "layering": ("ComputeLayering::compute_array",),
    "the whole step": ("Verlet::run",),
}
OBSERVERS = (
    """variable strain equal 0.00977*0.009*step
compute a all stress/contact
compute b all dissipation
compute c all nematic
compute d all fabric
compute e all contact/surface
compute f all contact/direction
compute g all contact/grain
compute h all fluctuation
compute i all displacement/shear strain v_strain
compute j all velocity/memory strain v_strain every 8e-5
compute k all velocity/correlation method mesh
compute l all layering
compute m all reduce max """
    + outputs("contact/grain").word("g", "N_c")
    + """
fix scalars all ave/time 1 1 1 c_a c_b c_c c_d c_h c_i c_m c_k c_l file /dev/null
fix surface all ave/time 1 1 1 c_e mode vector file /dev/null
fix direction all ave/time 1 1 1 c_f mode vector file /dev/null
fix memory all ave/time 1 1 1 c_j mode vector file /dev/null
"""
)


def costs(binary, cells):
    """Instructions per sample by compute."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "observers").write_text(OBSERVERS)
        counts = folder / "callgrind.out"
        command = [
            "valgrind",
            "--tool=callgrind",
            f"--callgrind-out-file={counts}",
            "--collect-atstart=no",
            "--toggle-collect=LAMMPS_NS::Verlet::run(int)",
            str(binary),
            "-in",
            str(HERE / "in.growth"),
            "-log",
            "none",
            "-var",
            "cells",
            str(cells),
            "-var",
            "steps",
            str(STEPS),
            "-var",
            "observers",
            str(folder / "observers"),
        ]
        subprocess.run(command, cwd=folder, check=True, capture_output=True)
        listing = subprocess.run(
            ["callgrind_annotate", "--inclusive=yes", "--threshold=100", str(counts)],
            check=True,
            capture_output=True,
            text=True,
        ).stdout
    found = {}
    plain = re.sub(r"LAMMPS_NS::|grainscope::|\(anonymous namespace\)::|non-virtual thunk to ", "", listing)
    for count, function in re.findall(r"^ *([\d,]+) \([ \d.]+%\)\s+\S*?:(\w+(?:<\w+>)?::\w+)\(", plain, re.M):
        found[function] = max(found.get(function, 0), int(count.replace(",", "")))
    missing = sorted({part for parts in PARTS.values() for part in parts} - found.keys())
    if missing:
        sys.exit(f"not among the functions that callgrind counted: {', '.join(missing)}: renamed or inlined?")
    return {name: sum(found[part] for part in parts) / STEPS for name, parts in PARTS.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=pathlib.Path, help="the grainscope binary")
    parser.add_argument(
        "--cells",
        type=int,
        nargs="+",
        default=[8, 16, 32, 40],
        help="lattice cells per edge, N = 4 cells^3 (default %(default)s)",
    )
    arguments = parser.parse_args()
    results = [costs(arguments.binary.resolve(), cells) for cells in arguments.cells]
    grains = [4 * cells**3 for cells in arguments.cells]
    print(
        "Instructions per sample and grain\n\n| measurement | "
        + " | ".join(f"N = {n:,}" for n in grains)
        + " |\n|---|"
        + "---|" * len(grains)
    )
    for name in PARTS:
        print(f"| {name} | " + " | ".join(f"{result[name] / n:.0f}" for result, n in zip(results, grains)) + " |")


if __name__ == "__main__":
    main()
