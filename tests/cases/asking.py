# SPDX-License-Identifier: GPL-2.0-or-later
"""Every way to ask for the measures gives the same numbers: thermo, variables, fix ave/time (scalars and vectors),
dumps; computes come and go; and the host's own list of contacts agrees with ours."""
from dataclasses import replace

import numpy as np

from case import main, require, require_close
from catalogue import DIRECT, DISPLACEMENT, FABRIC, FLUCTUATION, GRAIN, LAYERING, MEMORY, SURFACE, strain_lines
from deck import Deck, dump_local, shear, thermo
from grainscope.columns import outputs
from oracle.state import ROW_WIDTH, rows_of
from packing import dense_packing
from run import run

C_FABRIC = outputs("fabric").of("fabric")
C_GRAIN = outputs("contact/grain").of("grain")
C_MEMORY = outputs("velocity/memory").of("memory")
C_MOVED = outputs("displacement/shear").of("moved")
C_MOVING = outputs("fluctuation").of("moving")
C_SURFACE = outputs("contact/surface").of("surface")

# fix ave/time prints six digits.
PRINTED = 1e-5
RATE, STEPS, EVERY = 0.05, 20, 5
GLOBAL = [FABRIC, SURFACE, FLUCTUATION, LAYERING, DIRECT, DISPLACEMENT, MEMORY]


def asked(*lines):
    deck = Deck(dense_packing(1.5))
    computes = [*strain_lines(RATE), shear(RATE), *(w.define("all") for w in [*GLOBAL, GRAIN])]
    return replace(deck, body=[*computes, *lines, f"run {STEPS}"])


def blocks(path):
    """A file of fix ave/time mode vector: {step: array}."""
    found, lines = {}, iter(path.read_text().splitlines())
    for line in lines:
        if line.startswith("#"):
            continue
        step, count = map(int, line.split())
        found[step] = np.array([[float(w) for w in next(lines).split()[1:]] for _ in range(count)])
    return found


def every(watched, entries):
    """Thermo printed in every step, and what fix ave/time says in a run of its own, by step."""
    table = run(asked(*thermo(1, *entries))).thermo()[-1]
    return {int(s): np.array([table[e][k] for e in entries]) for k, s in enumerate(table["step"])}


def scalars(ranks):
    """fix ave/time mode scalar, once every 5 steps, where nothing else asks: the compute is announced by the fix
    alone."""
    entries = (
        [f"c_{w.name}" for w in GLOBAL if w.scalar] + [f"c_{w.name}[{w.vector}]" for w in GLOBAL] + [C_FABRIC["angle"]]
    )
    # What adds up over calls is asked at other steps here, and left out.
    entries = [e for e in entries if not e.startswith(("c_moved", "c_memory"))]
    expected = every(GLOBAL, entries)
    result = run(
        asked(f"fix mean all ave/time {EVERY} 1 {EVERY} {' '.join(entries)} file mean.txt", "thermo_style custom step"),
        ranks,
    )
    table = result.averages("mean.txt")
    require(list(table["TimeStep"]) == list(range(0, STEPS + 1, EVERY)), f"steps {table['TimeStep']}")
    for k, step in enumerate(table["TimeStep"]):
        found = np.array([table[e][k] for e in entries])
        # On several ranks the host's solver sees contacts between them from either side.
        size = max(1e-300, np.abs(expected[int(step)]).max())
        require_close(found, expected[int(step)], PRINTED if ranks == 1 else 1e-4, f"step {step}", size)


def means(ranks):
    """The mean over five steps that nothing else asks for."""
    entries = [C_FABRIC["F_xx"], "c_fabric", C_MOVING["dw_x"], C_SURFACE["P"]]
    expected = every(GLOBAL, entries)
    result = run(
        asked(f"fix mean all ave/time 1 {EVERY} {EVERY} {' '.join(entries)} file mean.txt", "thermo_style custom step"),
        ranks,
    )
    table = result.averages("mean.txt")
    for k, step in enumerate(table["TimeStep"]):
        if step == 0:
            continue
        mean = np.mean([expected[s] for s in range(int(step) - EVERY + 1, int(step) + 1)], axis=0)
        for name, value in zip(entries, mean):
            require_close(table[name][k], value, PRINTED if ranks == 1 else 1e-4, f"step {step}, {name}", abs(value))


def vectors(ranks):
    """fix ave/time mode vector: the columns of an array, and a vector."""
    rows, columns = SURFACE.array
    entries = [f"c_surface[{r}][{c}]" for r in range(1, rows + 1) for c in range(1, columns + 1)]
    fabric = [f"c_fabric[{k}]" for k in range(1, FABRIC.vector + 1)]
    expected = every(GLOBAL, entries + fabric)
    bins = " ".join(f"c_surface[{c}]" for c in range(1, columns + 1))
    result = run(
        asked(
            f"fix bins all ave/time {EVERY} 1 {EVERY} {bins} mode vector file bins.txt",
            f"fix axes all ave/time {EVERY} 1 {EVERY} c_fabric mode vector file axes.txt",
            "thermo_style custom step",
        ),
        ranks,
    )
    tables, lists = blocks(result.file("bins.txt")), blocks(result.file("axes.txt"))
    require(sorted(tables) == sorted(lists) == list(range(0, STEPS + 1, EVERY)), f"steps {sorted(tables)}")
    for step, table in tables.items():
        printed = expected[step][: rows * columns].reshape(rows, columns)
        for c in range(columns):
            require_close(
                table[:, c],
                printed[:, c],
                PRINTED,
                f"step {step}, column {c + 1}",
                max(np.abs(printed[:, c]).max(), 1e-300),
            )
        require_close(lists[step][:, 0], expected[step][rows * columns :], PRINTED, f"step {step}, c_fabric", 1.0)


def variables(ranks):
    """Equal-style variables of a scalar, an entry of a vector and one of an array; a per-grain column summed by compute
    reduce."""
    lines = [
        "variable scalar equal 2*c_fabric",
        f"variable entry equal {C_MOVING['E_tr']}+{C_MOVING['E_rot']}",
        f"variable bin equal 3*{C_SURFACE[10, 'N_c']}",
        f"compute contacts all reduce sum {C_GRAIN['N_c']}",
        *thermo(
            5,
            "c_fabric",
            C_FABRIC["N_c"],
            C_MOVING["E_tr"],
            C_MOVING["E_rot"],
            C_SURFACE[10, "N_c"],
            "v_scalar",
            "v_entry",
            "v_bin",
            "c_contacts",
        ),
    ]
    table = run(asked(*lines), ranks).thermo()[-1]
    require_close(table["v_scalar"], 2.0 * table["c_fabric"], 1e-15, "variable of a scalar")
    require_close(table["v_entry"], table[C_MOVING["E_tr"]] + table[C_MOVING["E_rot"]], 1e-15, "variable of a vector")
    require_close(table["v_bin"], 3.0 * table[C_SURFACE[10, "N_c"]], 0.0, "variable of an array", 1.0)
    require_close(table["c_contacts"], 2.0 * table[C_FABRIC["N_c"]], 1e-14, "contacts of all grains")


def dumped(ranks):
    """dump custom alone announces contact/grain."""
    columns = " ".join(GRAIN.atom_columns())
    result = run(asked(f"dump grains all custom {EVERY} grains.dump id {columns}", "thermo_style custom step"), ranks)
    printed = run(asked(*thermo(EVERY, C_FABRIC["N_c"])), ranks).thermo()[-1][C_FABRIC["N_c"]]
    for (step, grains), contacts in zip(result.dump("grains.dump"), printed):
        require_close(grains[C_GRAIN["N_c"]].sum(), 2.0 * contacts, 0.0, f"step {step}: contacts", 1.0)


def come_and_go(ranks):
    """Computes deleted between runs, defined again, and all of them in `clear`; what they kept of grains starts
    again."""
    quantities = [q for w in GLOBAL for q in w.columns()]
    deck = Deck(dense_packing(1.5))
    define = [w.define("all") for w in [*GLOBAL, GRAIN]]
    deck.body = [
        *strain_lines(RATE),
        shear(RATE),
        *define,
        *thermo(5, *quantities),
        "run 10",
        "thermo_style custom step",
        *(f"uncompute {w.name}" for w in [*GLOBAL, GRAIN]),
        "run 10",
        *define,
        *thermo(5, *quantities),
        "run 10",
        "clear",
    ]
    blocks_of_thermo = run(deck, ranks).thermo()
    require(len(blocks_of_thermo) == 3, "runs are missing")
    again = blocks_of_thermo[2]
    require(
        again[C_MEMORY["samples"]][0] == 1.0 and again[C_MOVED["strain"]][0] == 0.0,
        "the new computes did not start again",
    )
    require(all(np.isfinite(values).all() for values in again.values()), "not finite")


def orthogonal_box(ranks):
    """A box that is not triclinic, and the same one as a triclinic box without tilt, at rest: the same measures."""
    random = np.random.default_rng(4)
    packing = dense_packing(1.5)
    # Off the lattice, whose distances fall on the edges of bins.
    packing = replace(
        packing, grains=[replace(g, position=tuple(g.position + 0.01 * random.normal(size=3))) for g in packing.grains]
    )
    quantities = [q for w in GLOBAL for q in w.columns()]
    body = [*strain_lines(RATE), *(w.define("all") for w in GLOBAL), *thermo(1, *quantities), "run 3"]
    upright, triclinic = (
        run(Deck(replace(packing, triclinic=t), body=body), ranks).thermo()[-1] for t in (False, True)
    )
    for name in quantities:
        # Contacts across faces see their ghosts in another order; the host's solver stops at about 1e-7.
        require_close(upright[name], triclinic[name], 1e-5, name, max(np.abs(triclinic[name]).max(), 1e-3))


def as_pair_gran_local(packing, surface="superquadric"):
    """After a run, `run 0`: the same contacts with the same forces and points in the host's list, which evaluates them
    again."""
    # The solver starts from another guess: the host's is then off by as much as 1e-5.
    solver = 1e-5 if surface == "superquadric" else 1e-10

    def case(ranks):
        deck = Deck(packing, extra="tangential_damping off", surface=surface)
        deck.body = [
            shear(RATE),
            "run 100",
            "unfix shear",
            "compute pairs all pair/gran/local id force delta contactPoint",
            "compute rows all contact/local",
            "thermo_style custom step",
            *dump_local("pairs", 10, 1, "pairs"),
            *dump_local("rows", ROW_WIDTH, 1, "rows"),
            "run 0",
        ]
        # The host wants this compute before the first run.
        deck.body.insert(0, deck.body.pop(3))
        result = run(deck, ranks)
        rows = rows_of(result.dump("rows.dump")[0][1], "rows")
        ((_, pairs),) = result.dump("pairs.dump")
        pairs = np.stack([pairs[f"c_pairs[{k}]"] for k in range(1, 11)], axis=1)
        inside = pairs[pairs[:, 2] == 0.0]
        theirs = {
            tuple(sorted((int(a), int(b)))): (force if a < b else -force, point, overlap)
            for (a, b, _), force, point, overlap in zip(inside[:, :3], inside[:, 3:6], inside[:, 7:10], inside[:, 6])
        }
        size = np.abs(rows["force"]).max()
        compared = 0
        for k in np.flatnonzero(~rows["image"].any(axis=1)):
            pair = tuple(int(i) for i in rows["id"][k])
            require(pair in theirs, f"pair/gran/local has no contact {pair}")
            force, point, overlap = theirs[pair]
            require_close(rows["force"][k], force, solver, f"force of {pair}", size)
            require_close(rows["point"][k], point, solver, f"point of {pair}", 1.0)
            require_close(rows["overlap"][k], overlap, solver, f"overlap of {pair}", 1.0)
            compared += 1
        require(compared == len(theirs) > 100, f"{compared} contacts, {len(theirs)} in the host's list")

    return case


CASES = {
    "scalars": scalars,
    "means": means,
    "vectors": vectors,
    "variables": variables,
    "dumped": dumped,
    "come-and-go": come_and_go,
    "orthogonal-box": orthogonal_box,
    "as-pair-gran-local-spheres": as_pair_gran_local(dense_packing(atom_style="sphere")),
    "as-pair-gran-local-spheroids": as_pair_gran_local(dense_packing(1.5)),
    "as-pair-gran-local-oblate": as_pair_gran_local(dense_packing(0.5)),
    "as-pair-gran-local-ellipsoids": as_pair_gran_local(dense_packing(1.5), "ellipsoid"),
    "as-pair-gran-local-oblate-ellipsoids": as_pair_gran_local(dense_packing(0.5), "ellipsoid"),
}

if __name__ == "__main__":
    main(CASES)
