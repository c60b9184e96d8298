# SPDX-License-Identifier: GPL-2.0-or-later
"""Clumps of fix multisphere: what is of grains is of the clumps, against numpy from dumps of spheres, of contacts and
of the host's own properties of its bodies."""
from dataclasses import dataclass
import os
from pathlib import Path
import tempfile

import numpy as np

from case import main, require, require_close, require_equal
from deck import Deck, Material, dump_local, thermo
from grainscope.columns import outputs
from packing import dense_packing
from refusal import require_refused
from run import run

# The clump: three spheres of different sizes, not in a line.
CLUMP = [(-0.35, 0.0, 0.0, 0.5), (0.35, 0.1, 0.0, 0.4), (0.0, 0.45, 0.2, 0.3)]
FILE = "".join(" ".join(map(str, sphere)) + "\n" for sphere in CLUMP)
EDGE = 9.0
# Positions are exact, contacts have some hundred terms.
EXACT = 1e-9
PROPERTIES = {
    "id_multisphere": 1,
    "xcm": 3,
    "vcm": 3,
    "omega": 3,
    "inertia": 3,
    "ex_space": 3,
    "ey_space": 3,
    "ez_space": 3,
    "masstotal": 1,
}
STRESS, FLUCTUATION = outputs("stress/contact").of("s"), outputs("fluctuation").of("f")
MOVED = outputs("displacement/shear").of("d")
CORRELATION = outputs("velocity/correlation").of("c")
MEASURES = [
    "compute s all stress/contact volume auto",
    "compute f all fluctuation flow box",
    "variable strain equal step*1e-3",
    "compute d all displacement/shear strain v_strain",
    "compute c all velocity/correlation component vy bins 4 range 4.0",
    "compute m all velocity/memory component vy strain v_strain every 1e-3 lags 4",
    "compute z all contact/grain",
    "compute l all layering axis z layers 6",
]


def start(walls=False, singles=40, clumps=60, speed=2.0):
    yield from (
        "atom_style sphere",
        "atom_modify map array",
        "boundary p p " + ("f" if walls else "p"),
        "newton off",
        "communicate single vel yes",
        "units si",
        f"region box block 0 {EDGE} 0 {EDGE} 0 {EDGE} units box",
        "create_box 2 box",
        "neighbor 0.3 bin",
        "neigh_modify delay 0 contact_distance_factor 1.05",
        *Material().lines(2),
        "pair_style gran/insitu model hertz tangential history",
        "pair_coeff * *",
        "timestep 1e-4",
        "fix clump all particletemplate/multisphere 15485863 atom_type 1 density constant 1000 nspheres 3 ntry 100000 "
        "spheres file clump.txt scale 1.0 type 1",
        "fix single all particletemplate/sphere 10007 atom_type 2 density constant 1000 radius constant 0.45",
    )
    weights = (clumps / (clumps + singles), singles / (clumps + singles))
    yield from (
        f"fix dist all particledistribution/discrete/numberbased 32452843 2 clump {weights[0]!r} single {weights[1]!r}",
        f"region ins block 0.9 {EDGE - 0.9} 0.9 {EDGE - 0.9} 0.9 {EDGE - 0.9} units box",
        "fix insert all insert/pack seed 32452867 distributiontemplate dist maxattempt 100 insert_every once "
        f"overlapcheck no all_in no orientation random vel uniform 0 0 0 {speed} {speed} {speed} region ins "
        f"particles_in_region {clumps + singles}",
    )
    if walls:
        for side, place in (("low", 0.8), ("high", EDGE - 0.8)):
            yield f"fix {side} all wall/gran model hertz tangential history primitive type 1 zplane {place}"
        yield "fix gravity all gravity 9.81 vector 0 0 -1"
    yield "fix integrate all multisphere"
    yield "run 1"
    yield "group alone type 2"
    yield "fix alone alone nve/sphere"


def folder():
    made = Path(tempfile.mkdtemp(prefix="clumps-", dir=os.environ.get("GRAINSCOPE_SCRATCH")))
    (made / "clump.txt").write_text(FILE)
    return made


def measured(lines, ranks, steps, every, extra=()):
    asked = []
    for of in (STRESS, FLUCTUATION, MOVED, CORRELATION):
        asked += of.vector()
    body = [
        *lines,
        *MEASURES,
        *extra,
        "compute rows all contact/local id branch force point wall",
        *dump_local("rows", 12, every, "rows"),
        f"dump grains all custom {every} grains.dump id x y z vx vy vz omegax omegay omegaz mass radius c_z[1]",
        'dump_modify grains sort id format "%d ' + " ".join(["%.17g"] * 12) + '"',
    ]
    for name, width in PROPERTIES.items():
        words = [f"c_{name}"] if width == 1 else [f"c_{name}[{k}]" for k in range(1, width + 1)]
        body += [
            f"compute {name} all multisphere property {name}",
            f"dump {name} all local {every} {name}.dump {' '.join(words)}",
            f'dump_modify {name} format "{" ".join(["%.17g"] * width)}"',
        ]
    body += [f"dump_modify {name} first yes" for name in ("rows", "grains", *PROPERTIES)]
    body += [*thermo(every, "step", *asked), f"run {steps}"]
    result = run("\n".join(body) + "\n", ranks, folder=folder())
    return result, list(moments_of(result))


@dataclass
class Moment:
    step: int
    printed: dict
    grains: dict
    rows: dict
    bodies: dict
    body: np.ndarray  # of every sphere: number of its body, -1 for none

    def arm(self, index):
        """From the centre of the body to that of the sphere."""
        b = self.body[index]
        d = self.grains["x"][index] - self.bodies["xcm"][b]
        d -= EDGE * np.round(d / EDGE)
        return np.where(b[:, None] < 0, 0.0, d)


def table(columns):
    return np.stack(list(columns.values()), axis=1)


def moments_of(result):
    printed = result.thermo()[-1]
    dumps = [result.dump(f"{name}.dump") for name in ("grains", "rows", *PROPERTIES)]
    for found in zip(*dumps):
        step = found[0][0]
        at = list(printed["step"]).index(step)
        grains, rows = table(found[0][1]), table(found[1][1])
        bodies = {name: table(one[1]) for name, one in zip(PROPERTIES, found[2:])}
        order = np.argsort(bodies["id_multisphere"][:, 0])
        bodies = {name: values[order] for name, values in bodies.items()}
        moment = Moment(
            step,
            {name: values[at] for name, values in printed.items()},
            {
                "id": grains[:, 0].astype(int),
                "x": grains[:, 1:4],
                "v": grains[:, 4:7],
                "w": grains[:, 7:10],
                "m": grains[:, 10],
                "r": grains[:, 11],
                "contacts": grains[:, 12],
            },
            {"id": rows[:, :2].astype(int), "branch": rows[:, 2:5], "force": rows[:, 5:8], "wall": rows[:, 11]},
            bodies,
            np.full(len(grains), -1),
        )
        moment.body = bodies_of(moment)
        yield moment


def bodies_of(moment):
    """Spheres that spin and move as a body does, about its centre, are part of it."""
    found = np.full(len(moment.grains["id"]), -1)
    for b, (centre, v, w) in enumerate(zip(*(moment.bodies[n] for n in ("xcm", "vcm", "omega")))):
        d = moment.grains["x"] - centre
        d -= EDGE * np.round(d / EDGE)
        moves_alike = np.linalg.norm(v + np.cross(w, d) - moment.grains["v"], axis=1) < 1e-9
        mine = moves_alike & (np.abs(moment.grains["w"] - w).max(axis=1) < 1e-12) & (np.linalg.norm(d, axis=1) < 1.0)
        require_equal(mine.sum(), len(CLUMP), "spheres of a body")
        found[mine] = b
    return found


def own(moment):
    """Mass, velocity, centre of every grain: clumps, then spheres on their own."""
    alone = moment.body < 0
    return (
        np.concatenate([moment.bodies["masstotal"][:, 0], moment.grains["m"][alone]]),
        np.concatenate([moment.bodies["vcm"], moment.grains["v"][alone]]),
        np.concatenate([moment.bodies["xcm"], moment.grains["x"][alone]]),
    )


def rotational_energy(moment):
    spins, alone = moment.bodies["omega"], moment.body < 0
    mean = np.concatenate([spins, moment.grains["w"][alone]]).mean(axis=0)
    energy = 0.0
    for k, axis in enumerate(("ex_space", "ey_space", "ez_space")):
        energy += 0.5 * (moment.bodies["inertia"][:, k] * ((spins - mean) * moment.bodies[axis]).sum(axis=1) ** 2).sum()
    w, m, r = (moment.grains[n][alone] for n in ("w", "m", "r"))
    return energy + (0.2 * m * r**2 * ((w - mean) ** 2).sum(axis=1)).sum()


def told(moment, words):
    """By the names of the outputs."""
    return {name: moment.printed[word] for name, word in zip(words.own.names("vector"), words.vector())}


def check(moment, walls):
    rows, grains = moment.rows, moment.grains
    i = np.searchsorted(grains["id"], rows["id"][:, 0])
    at_wall = rows["wall"] > 0
    j = np.where(at_wall, i, np.searchsorted(grains["id"], np.maximum(rows["id"][:, 1], 1)))
    branch = rows["branch"] - moment.arm(i) + np.where(at_wall[:, None], 0.0, moment.arm(j))
    require(not (~at_wall & (moment.body[i] == moment.body[j]) & (moment.body[i] >= 0)).any(), "contacts in one clump")
    volume = EDGE**3
    sigma = -np.einsum("ca,cb->ab", rows["force"], branch) / volume
    found = told(moment, STRESS)
    size = np.abs(rows["force"]).max() * len(i) / volume
    for name, (a, b) in {"sxx": (0, 0), "syy": (1, 1), "szz": (2, 2), "sxy": (0, 1), "syx": (1, 0)}.items():
        require_close(found[name], sigma[a, b], EXACT, f"step {moment.step}, {name}", size)
    m, v, x = own(moment)
    require_equal([found["N_c"], found["N_w"]], [(~at_wall).sum(), at_wall.sum()], "contacts")
    require(at_wall.any() == walls, "contacts with walls")
    require_close(found["Z"], (2 * (~at_wall).sum() + at_wall.sum()) / len(m), 1e-14, "Z of the clumps")
    dv = v - np.average(v, axis=0, weights=m)
    kinetic = -np.einsum("i,ia,ib->ab", m, dv, dv) / volume
    require_close(found["sxy_kinetic"], kinetic[0, 1], EXACT, "kinetic stress", np.abs(kinetic).max())
    require_close(found["szz_kinetic"], kinetic[2, 2], EXACT, "kinetic stress", np.abs(kinetic).max())
    found = told(moment, FLUCTUATION)
    energy = 0.5 * (m * (dv**2).sum(axis=1)).sum()
    require_close(found["E_tr"], energy, EXACT, "E_tr")
    require_close(found["E_rot"], rotational_energy(moment), EXACT, "E_rot")
    rms = np.sqrt((dv**2).mean(axis=0))
    require_close([found[f"dv_{a}"] for a in "xyz"], rms, EXACT, "rms of velocities", rms.max())
    found = told(moment, CORRELATION)
    require_equal(found["N"], len(m), "grains in the correlation")
    require_close(found["dv2"], (dv[:, 1] ** 2).mean(), EXACT, "<dv^2>")
    require_equal(grains["contacts"].sum(), 2 * (~at_wall).sum() + at_wall.sum(), "contacts of all spheres")


def as_grains(walls):
    def case(ranks):
        result, moments = measured(start(walls), ranks, 60, 15)
        require(len(moments) == 5, f"{len(moments)} snapshots")
        require(all(len(m.rows["id"]) > 40 for m in moments), "contacts")
        for moment in moments:
            check(moment, walls)
        check_displacements(moments)

    return case


def check_displacements(moments):
    """Mean squares of what the centres came along, put together from steps shorter than half the box."""
    path, last = 0.0, None
    for moment in moments:
        _, _, x = own(moment)
        if last is not None:
            d = x - last
            path = path + d - EDGE * np.round(d / EDGE)
        last = x
        found = [told(moment, MOVED)[f"d2_{a}"] for a in "xyz"]
        expected = (np.square(path) * np.ones_like(x)).mean(axis=0)
        require_close(found, expected, EXACT, "mean squared displacements", max(expected.max(), 1e-6))
    require(np.abs(path).max() > 0.01, "grains that moved")


def crosses_faces(ranks):
    """Fast clumps without contacts cross all faces, and the displacement knows it."""
    lines = [*start(singles=8, clumps=12, speed=60.0)]
    result, moments = measured(lines, ranks, 4000, 500)
    check_displacements(moments)
    crossed = 0
    for one, other in zip(moments, moments[1:]):
        crossed += (np.abs(other.bodies["xcm"] - one.bodies["xcm"]) > EDGE / 2).sum()
    require(crossed > 20, f"{crossed} faces crossed")


def losses(ranks):
    """What is of contacts, by rows of contacts between spheres and their velocities at the end of the step."""
    words = "id normal branch point fn_damping un ft ut"
    lines = [line + " tangential_damping off" if line.startswith("pair_style") else line for line in start()]
    now, step = (outputs("dissipation").of(ID) for ID in ("now", "step"))
    fabric, rose = outputs("fabric").of("fabric"), outputs("contact/direction").of("rose")
    asked = [*now.vector(), *step.vector(), fabric["F_xy"], *(rose[k, "N_c"] for k in range(1, 13))]
    lines += [
        "compute now all dissipation mode instantaneous",
        "compute step all dissipation mode step",
        "compute fabric all fabric",
        "compute rose all contact/direction bins 12",
        f"compute all all contact/local {words}",
        *dump_local("all", 19, 10, "all"),
        "dump grains all custom 10 grains.dump id x y z vx vy vz omegax omegay omegaz",
        'dump_modify grains sort id format "%d ' + " ".join(["%.17g"] * 9) + '"',
        *thermo(10, "step", *asked),
        "run 60",
    ]
    result = run("\n".join(lines) + "\n", ranks, folder=folder())
    printed = result.thermo()[-1]
    seen = 0
    for (step_number, rows), (_, grains) in zip(result.dump("all.dump"), result.dump("grains.dump")):
        at = list(printed["step"]).index(step_number)
        rows, grains = table(rows), table(grains)
        n, branch, point = rows[:, 2:5], rows[:, 5:8], rows[:, 8:11]
        damping, un, ft, ut = rows[:, 11], rows[:, 12], rows[:, 13:16], rows[:, 16:19]
        i, j = (np.searchsorted(grains[:, 0], rows[:, k]) for k in (0, 1))
        arm = point - grains[i, 1:4]
        u = grains[i, 4:7] + np.cross(grains[i, 7:10], arm)
        u -= grains[j, 4:7] + np.cross(grains[j, 7:10], arm + branch)
        size = np.abs(damping * un).sum() or 1.0
        require_close(printed[now["P_n"]][at], -(damping * un).sum(), EXACT, "P_n at this instant", size)
        expected = -(damping[:, None] * n * u).sum()
        require_close(printed[step["P_n"]][at], expected, EXACT, "P_n over the step", size)
        require_equal(printed[now["N_c"]][at], len(rows), "contacts")
        tensor = np.einsum("ca,cb->ab", n, n) / len(rows)
        require_close(printed[fabric["F_xy"]][at], tensor[0, 1], EXACT, "F_xy", 1.0)
        counted = sum(printed[rose[k, "N_c"]][at] for k in range(1, 13))
        require_equal(counted, 2 * len(rows), "contacts by direction")
        seen += np.abs(ft).sum() > 0.0 and np.abs(ut).sum() > 0.0
    require(seen > 3, "snapshots with friction")


def trajectory_untouched(ranks):
    grains = "dump after all custom 40 after.dump id x y z vx vy vz omegax omegay omegaz fx fy fz"
    wanted = [grains, 'dump_modify after sort id format "%d ' + " ".join(["%.17g"] * 12) + '"']
    asked = [*MEASURES, *thermo(1, "step", *STRESS.vector(), *FLUCTUATION.vector(), *MOVED.vector())]
    seen = run("\n".join([*start(), *asked, *wanted, "run 40"]) + "\n", ranks, folder=folder())
    plain = run("\n".join([*start(), *wanted, "run 40"]) + "\n", ranks, folder=folder())
    for (_, found), (_, expected) in zip(seen.dump("after.dump"), plain.dump("after.dump")):
        for name in expected:
            require_equal(found[name], expected[name], name)


FOLLOWED = ("displacement/shear strain v_strain", "velocity/memory component vy strain v_strain every 1e-3 lags 4")
OF_GRAINS = (
    "fluctuation flow box",
    "velocity/correlation component vy bins 4 range 4.0",
    "layering axis z layers 6",
    *FOLLOWED,
)


def refused_of_a_part(ranks):
    """A group that has one sphere of a clump."""
    for measure in OF_GRAINS:
        asked = ["variable strain equal step*1e-3", "group part id 1 2", f"compute it part {measure}"]
        text = "\n".join([*start(), *asked, "thermo_style custom step c_it[1]", "run 1"]) + "\n"
        if measure.startswith("layering"):
            text = text.replace("c_it[1]", "c_it")
        require_refused(
            text, ranks, f"compute {measure.split()[0]}", "its group must hold all spheres of a clump", folder=folder()
        )


def refused_bodies(ranks):
    """Before the run, by the name of the measure: bodies that are not known, that may break, that are too large."""
    for measure in OF_GRAINS:
        deck = Deck(dense_packing(atom_style="sphere", minimum=30))
        asked = ["variable strain equal step*1e-3", f"compute it all {measure}", "run 0"]
        deck.body = ["unfix integrate", "fix body all rigid single", *asked]
        name = f"compute {measure.split()[0]}"
        require_refused(deck, ranks, name, "not with the bodies of fix body (rigid)")
        if measure not in FOLLOWED:
            continue
        breaking = "fix integrate all multisphere/break trigger_name v_never trigger_threshold 1e30"
        lines = [breaking if line == "fix integrate all multisphere" else line for line in start()]
        lines = lines[: lines.index("run 1")]  # the first run is refused: what would break is not there yet
        lines = ["variable never atom 0", asked[0], *lines, f"compute it all {measure}", "run 1"]
        require_refused("\n".join(lines) + "\n", ranks, name, "may break", folder=folder())
    lines = [line.replace("scale 1.0", "scale 3.0") for line in start(singles=2, clumps=2)]
    lines += ["compute it all fluctuation", "thermo_style custom step c_it", "run 0"]
    require_refused("\n".join(lines) + "\n", ranks, "half as large as the box", "4.5 along x", folder=folder())


GROUP = "its group must hold all spheres of a clump"
REFUSED = {
    "group part id 1 2\ncompute s part stress/contact volume auto\nthermo_style custom step c_s": GROUP,
    "pair_style gran/insitu model hertz tangential history setup neutral": "setup neutral: does not work with clumps",
    "compute n all nematic": "compute nematic: does not work with clumps (fix integrate, multisphere)",
    "compute l all energy/ledger": "multisphere",
    "fix p all press/strain axis y target 1e4 every/step 10": "does not work with rigid bodies",
}


def refused(ranks):
    for line, message in REFUSED.items():
        lines = [one.replace("history", "history ledger on") if "pair_style" in one else one for one in start()]
        if line.startswith("pair_style"):
            lines = [line if "pair_style" in one else one for one in start()]
        text = "\n".join([*lines, "" if line.startswith("pair_style") else line, "run 1"]) + "\n"
        require_refused(text, ranks, message, folder=folder())


CASES = {
    "as-grains": as_grains(False),
    "between-walls": as_grains(True),
    "crosses-faces": crosses_faces,
    "losses": losses,
    "trajectory-untouched": trajectory_untouched,
    "refused": refused,
    "refused-of-a-part": refused_of_a_part,
    "refused-bodies": refused_bodies,
}

if __name__ == "__main__":
    main(CASES)
