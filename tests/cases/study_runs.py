# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of a study by `grainscope-tools study run`: killed, prolonged, damaged, refused; and what `study table` makes of
them."""
import os
import signal
import shutil
import subprocess

import numpy as np

from case import main, require, require_close
from grainscope.means import mean_and_error
from grainscope.shear.measures import steady_run
from grainscope.shear.output import read_run
from grainscope.study import table as study_table
from run import environment, kill_session, wait_until
from shear_runs import (
    ROWS,
    SOURCE,
    TABLES,
    attempts_of,
    end_of,
    ended,
    folder,
    last_step,
    ranks_of,
    run_to_end,
    same_tables,
    start,
)


def stopped_half_way(name, ranks, stop, **variables):
    """A run to which `stop(process)` is done as soon as it has written its second restart file; another, where it ended
    before that."""
    while True:
        process = start(name, ranks, **variables)
        wait_until(
            lambda: process.poll() is not None or (folder(name) / "odd.restart").exists(),
            f"a second restart file of {name}",
        )
        result = stop(process)
        if not (folder(name) / "final.restart").exists():
            return result
        shutil.rmtree(folder(name))


def killed(name, ranks=1, **variables):
    """All ranks at once."""

    def kill(process):
        kill_session(process.pid)
        process.communicate()

    stopped_half_way(name, ranks, kill, **variables)
    return folder(name)


def stopped_run_has_not_ended(ranks):
    """SIGTERM ends a run in order, with exit code 0: for all that it is not at its end, and goes on."""

    def terminate(process):
        for pid in ranks_of(process):
            os.kill(pid, signal.SIGTERM)
        return end_of(process)

    whole = ended("whole", ranks)
    status, output = stopped_half_way("stopped", ranks, terminate)
    require(status == 1 and "stopped by a signal" in output, f"ended with {status}: {output}")
    stopped = ended("stopped", ranks)
    require(len(attempts_of(stopped)) == 2, "the second attempt did not go on")
    same_tables(stopped, whole)


def one_at_a_time(ranks):
    """A second attempt waits for one that still runs, and has nothing to do then."""

    def pause(process):
        paused = [process.pid, *ranks_of(process)]
        for pid in paused:
            os.kill(pid, signal.SIGSTOP)
        return process, paused

    whole = ended("whole", ranks)
    first, paused = stopped_half_way("busy", ranks, pause)
    second = start("busy", ranks)
    said = second.stdout.readline()
    for pid in paused:
        os.kill(pid, signal.SIGCONT)
    require("another attempt writes to this folder" in said, f"it said {said}")
    for attempt in (first, second):
        status, output = end_of(attempt)
        require(status == 0, f"ended with {status}: {output}")
    require(len(attempts_of(folder("busy"))) == 1, "the second attempt ran too")
    same_tables(folder("busy"), whole)


def killed_run_continues(ranks):
    whole, broken = ended("whole", ranks), killed("broken", ranks)
    ended("broken", ranks)
    begins = attempts_of(broken)
    require(len(begins) == 2 and begins[1] > 0, f"attempts began at {begins}, expected 0 and a later step")
    same_tables(broken, whole)


def longer_strain_continues(ranks, measure="all", names=ROWS + TABLES):
    whole = ended("whole", ranks, measure=measure)
    end = last_step(ended("longer", ranks, measure=measure, strain=0.4))
    longer = ended("longer", ranks, measure=measure)
    same_tables(longer, whole, names)
    require((longer / "grains.dump").read_bytes() == (whole / "grains.dump").read_bytes(), "grains.dump: other grains")
    begin = attempts_of(longer)[1]
    require(begin > 0, "the second attempt began again")
    require(
        measure == "all" or begin < end,
        f"the first attempt ended with a part, at step {end}: another strain is needed here",
    )
    status, output = run_to_end("longer", ranks, measure=measure, strain=0.4)
    require(status == 0 and "nothing to do" in output, f"the strain was reached, but: {output}")
    same_tables(longer, whole, names)


def longer_strain_continues_basic(ranks):
    """Here a run ends within a part, where an uninterrupted run builds no neighbour lists."""
    longer_strain_continues(ranks, "basic", ["series.txt"])


def first_restart_cut(ranks):
    out = ended("cut", ranks, strain=0.3, steady=0.1)
    for name in ("final.restart", "odd.restart"):
        (out / name).unlink()
    whole = (out / "even.restart").read_bytes()
    (out / "even.restart").write_bytes(whole[: len(whole) // 2])
    (out / "cost.txt").unlink()
    status, output = run_to_end("cut", ranks, strain=0.3, steady=0.1)
    require(status == 0 and "starting again" in output, f"ended with {status}: {output}")
    require(attempts_of(out) == [0], "the run did not start again")


def out_of_time(ranks):
    """Without time for anything a run ends in order, with a status of its own, and the next attempt gives the bits of
    the run that was left alone."""
    whole = ended("whole", ranks)
    status, output = end_of(start("short", ranks, options=("--hours", "1e-9")))
    require(status == 3 and "out of time" in output, f"ended with {status}: {output}")
    same_tables(ended("short", ranks), whole)


def hours_refused(ranks):
    for value in ("0", "-1", "nan", "inf", "soon"):
        status, output = end_of(start("hours", ranks, options=(f"--hours={value}",)))
        require(
            status == 2 and f"--hours: must be a number above 0, got '{value}'" in output,
            f"{value}: {status}, {output}",
        )
    require(not folder("hours").exists(), "something was run")


def no_restart_whole(ranks):
    """Of several files none is whole: not for the tool to throw away what there is."""
    out = ended("damaged", ranks, strain=0.3, steady=0.1)
    series = (out / "series.txt").read_bytes()
    for path in out.glob("*.restart"):
        path.write_bytes(path.read_bytes()[:1000])
    status, output = run_to_end("damaged", ranks)
    require(status == 1 and "is truncated or damaged" in output, f"ended with {status}: {output}")
    require((out / "series.txt").read_bytes() == series, "series.txt was touched")


def other_variables_refused(ranks):
    ended("other", ranks, strain=0.3, steady=0.1)
    status, output = run_to_end("other", ranks, mu=0.5)
    require(
        status == 1 and "mu must stay what the run began with, 0.4, got 0.5" in output, f"ended with {status}: {output}"
    )


def part_must_be_named(ranks):
    """Its default is a share of the strain, so that a larger strain would cut the run into other parts."""
    words = ["N=150", "alpha=1", "--binary", os.environ["GRAINSCOPE_BINARY"]]
    for strain, expected in ((0.3, 0), (0.4, 1)):
        done = subprocess.run(
            [SOURCE / "tools" / "grainscope-tools", "study", "run", folder("parts"), f"strain={strain}", *words],
            env=environment(1),
            capture_output=True,
            text=True,
        )
        require(done.returncode == expected, f"strain {strain} ended with {done.returncode}: {done.stderr}")
    require("part must be named" in done.stderr and "from 0.3 to 0.4" in done.stderr, f"it said {done.stderr}")


def reason_is_given(ranks):
    status, output = run_to_end("bad", ranks, part=0.7)
    require(status == 1 and "part must be more than 0 and at most strain" in output, f"ended with {status}: {output}")
    status, output = run_to_end("flat", ranks, N=20, alpha=3)
    require(status == 1 and "ERROR" in output and "periodic box" in output, f"ended with {status}: {output}")


def means_of_files(ranks):
    """The table against the files, read by hand."""
    out = ended("means", ranks, strain=1.4)
    run, begin = read_run(out), 0.3
    steady = steady_run(run, begin)
    series = np.loadtxt(out / "series.txt")
    mean, error = mean_and_error(series[series[:, 1] > begin + 1e-3, 4])
    require_close(steady["mu_eff"], (mean, error), 1e-12, "mu_eff")
    micro = np.loadtxt(out / "micro.txt")
    header = [word.split("[")[0] for word in (out / "micro.txt").read_text().splitlines()[1][2:].split()]
    rows = micro[micro[:, 1] > begin + 0.1 - 1e-3]
    require(len(rows) == 11, f"{len(rows)} parts, expected 11")
    require_close(steady["lever"][0], rows[:, header.index("lever")].mean(), 1e-12, "lever")
    pressure = -(rows[:, header.index("n_yy")] + rows[:, header.index("t_yy")])
    require_close(steady["n_xy"][0], (rows[:, header.index("n_xy")] / pressure).mean(), 1e-12, "n_xy")
    require_close(steady["n_yy"][0] + steady["t_yy"][0], -1, 1e-12, "sigma_yy over P")
    displacement = np.loadtxt(out / "displacement.txt")
    whole = steady_run(run, 0.2)
    slope = displacement[-1, 6] / run.parameters["d_eq"] ** 2
    require_close(whole["D_y"][0], slope, 1e-4, "D_y, against the compute's own")  # the file has six digits
    require_close(run.parameters["steps"], displacement[-1, 0], 0, "last step")


def table_holds_everything(ranks):
    """What is read back from the tables is what was measured; runs off their inertial number are flagged."""
    runs = [read_run(ended(f"run{seed}", ranks, seed=seed, strain=0.8)) for seed in (15485863, 15485867)]
    for run, pressure in zip(runs, (1.15, 0.76)):
        run.columns["P"] = run.columns["P"] * pressure / run.columns["P"][run.steady(0.2)].mean()
    study_table.write_tables([(run, 0.2) for run in runs], folder("tables"))
    found = study_table.read_study(folder("tables"))
    for run, steady in zip(runs, found):
        expected = steady_run(run, 0.2)
        require(steady.means.keys() == expected.means.keys(), "other means")
        for name, pair in expected.means.items():
            require_close(steady[name], pair, 1e-9, name, max(1e-300, *map(abs, pair)))
        for curve, columns in expected.curves.items():
            for name, values in columns.items():
                require_close(
                    steady.curves[curve][name],
                    values,
                    5e-4,
                    f"{curve}, {name}, of four digits",
                    max(1e-12, np.abs(values).max()),
                )
    require(
        [run.parameters["flagged"] for run in found] == [0, 1],
        "only the second run is more than 10 % off its I, and must be flagged",
    )
    require(found[0].parameters["core_time"] > 0 and found[0].parameters["memory"] > 1e6, "no cost")
    (one,) = study_table.over_seeds(found)
    values = [run["phi"][0] for run in found]
    require_close(one["phi"][0], np.mean(values), 1e-12, "mean over seeds")
    require(
        one["phi"][1] >= np.std(values, ddof=1) / np.sqrt(2) * 0.999999,
        "the error is less than the spread over the seeds tells",
    )
    header = {(row["file"], row["column"]): row for row in study_table.read_csv(folder("tables") / "columns.csv")}
    for name in ("table.csv", "curves/surface.csv"):
        for column in (folder("tables") / name).read_text().splitlines()[0].split(","):
            require((name, column) in header, f"columns.csv does not tell of {column} in {name}")


main(
    {
        "one-at-a-time": one_at_a_time,
        "stopped-run-has-not-ended": stopped_run_has_not_ended,
        "killed-run-continues": killed_run_continues,
        "longer-strain-continues": longer_strain_continues,
        "longer-strain-continues-basic": longer_strain_continues_basic,
        "out-of-time": out_of_time,
        "hours-refused": hours_refused,
        "first-restart-cut": first_restart_cut,
        "no-restart-whole": no_restart_whole,
        "other-variables-refused": other_variables_refused,
        "part-must-be-named": part_must_be_named,
        "reason-is-given": reason_is_given,
        "means-of-files": means_of_files,
        "table-holds-everything": table_holds_everything,
    }
)
