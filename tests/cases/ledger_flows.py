# SPDX-License-Identifier: GPL-2.0-or-later
"""The energy ledger over flows of many grains under gravity, as examples/silo and examples/drum have them: it closes
while grains leave, and says of the walls what wall/contact and dissipation say."""
import math
import os
from pathlib import Path
import shutil
import tempfile

from case import main, require, require_close
from grainscope.grains import read_grains
from run import run
from run_example import arguments, table

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
# Of what was lost: sums of 1e5 steps and 1e4 contacts, whose terms are up to ten times what they add up to.
ROUNDING = 1e-12


def run_of(example, ranks, variables):
    folder = Path(tempfile.mkdtemp(dir=os.environ.get("GRAINSCOPE_SCRATCH"))) / example
    shutil.copytree(EXAMPLES / example, folder)
    deck = (folder / f"in.{example}").read_text()
    return run(deck, ranks, folder=folder, arguments=list(arguments(variables)))


def tables(result, *names):
    return [table(result.file(f"{name}.txt")) for name in names]


def require_closes(energy, supplies):
    """By its residual, and by the columns of the file, of six digits each."""
    require_close(energy["imbalance"], 0.0 * energy["imbalance"], ROUNDING, "residual over what was lost", 1.0)
    gone = sum(energy[name] for name in ("D_n", "D_t", "D_damp", "G", "stored"))
    came = sum(sign * energy[name] for name, sign in supplies.items())
    scale = sum(abs(energy[name][-1]) for name in supplies)
    require_close(gone - came, 0.0 * came + (gone - came)[0], 1e-5, "balance of the columns", scale)
    print({name: float(values[-1]) for name, values in energy.items()}, energy["imbalance"].max())


def silo(**variables):
    def case(ranks):
        result = run_of("silo", ranks, variables)
        energy, flow = tables(result, "energy", "discharge")
        require_closes(energy, {"W_gravity": 1.0, "W_wall": 1.0, "W_out": -1.0})
        require(energy["W_out"][-1] > 0.0 and flow["mass"][-1] < flow["mass"][0], "no grain left")
        require(energy["D_n"][-1] > energy["D_n_w"][-1] > 0.0 and energy["D_t_w"][-1] > 0.0, "nothing was lost")
        # What pictures are made of. Dumps have six digits.
        radii = read_grains(result.file("silo.dump")).semi_axes[:, 0]
        mass = 2500.0 * 4.0 / 3.0 * math.pi * (radii**3).sum()
        require_close(mass, result.thermo()[-1]["v_mass"][-1], 1e-5, "mass by the radii of the last dump")

    return case


def drum(dt=5e-5, **variables):
    def case(ranks):
        energy, power = tables(run_of("drum", ranks, variables), "energy", "power")
        require_closes(energy, {"W_gravity": 1.0, "W_wall": 1.0})
        time = dt * (power["step"][1] - power["step"][0])
        work, lost, lost_w = (time * power[name].sum() for name in ("power", "lost", "lost_w"))
        # From one step to the next the drum's velocity turns with the contact point, by 1e-4.
        require_close(energy["W_wall"][-1], work, 1e-3, "W_wall against the power of wall/contact")
        # The half overlap between the lever of a contact and the drum's radius.
        require_close(power["torque_rate"], power["power"], 1e-3, "torque times rate")
        # Friction by steps is right to 1 % at this coefficient of friction (doc/compute_dissipation.md).
        booked = {end: sum(energy[f"D_{name}{end}"][-1] for name in ("n", "t", "damp")) for end in ("", "_w")}
        require_close(lost_w, booked["_w"], 1e-2, "lost at the drum, by dissipation")
        require_close(lost, booked[""], 1e-2, "lost in all, by dissipation")
        print(
            f"W_wall {energy['W_wall'][-1] / work - 1.0:.1e}, lost {lost / booked[''] - 1.0:.1e}, at the drum "
            f"{lost_w / booked['_w'] - 1.0:.1e}"
        )

    return case


CASES = {
    "silo": silo(),
    "drum": drum(),
    "small-silo": silo(N=200, discharge=0.1),
    "small-drum": drum(N=150, turn=0.6),
}

if __name__ == "__main__":
    main(CASES)
