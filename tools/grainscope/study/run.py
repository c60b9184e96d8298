"""Runs examples/simple_shear, or takes up what an earlier attempt left in the output folder: one that was killed, or
one that ended at a smaller strain. Screen output goes to screen.txt there, one attempt after the other, the variables
to variables.txt, what each attempt cost to cost.txt, and where it came from to attempts.jsonl. Ends with an error, and
the reason that the run gave, if the run failed; failed.txt has the reason, too. With --hours the run is stopped at the
end of the last part that fits, with exit status 3 unless it is at its end."""
import argparse
import fcntl
import os
from pathlib import Path
import sys
import time

from grainscope.errors import InputError, warn
from grainscope.open_mpi import session
from grainscope.program import find_program
from grainscope.progress import duration, followed
from grainscope.study.part_clock import PartClock
from grainscope.study.program_process import ProgramProcess
from grainscope.study.provenance import note_attempt

DECK = Path(__file__).resolve().parents[3] / "examples" / "simple_shear" / "in.simple_shear"
NONE_WHOLE = "ERROR: read_restart: '"
STOPPED = 3  # also the exit status of a run whose time is over
RESTARTS = ("even.restart", "odd.restart")  # of the ends of parts
FAILED = "failed.txt"
MAY_CHANGE = ("strain", "steady")
COLUMNS = 11  # of the deck's thermo output: step, strain, time left ...
COST = "# from[step] to[step] ranks wall[s] cpu[s] memory[B]\n"


def grid(ranks):
    """The grid of ranks that cuts a cube into the most compact parts. It is named since LIGGGHTS would choose one for
    the box that it finds: another for the flat box of a resumed run, and with it other bits."""
    grids = [(x, y, ranks // (x * y)) for x in range(1, ranks + 1) for y in range(1, ranks + 1) if ranks % (x * y) == 0]
    return " ".join(map(str, min(grids, key=sum)))


def command(arguments, resume):
    launcher = ["mpirun", "-np", str(arguments.ranks)] if arguments.ranks > 1 else []
    values = {"grid": grid(arguments.ranks), **dict(arguments.variables), "out": arguments.out, "resume": int(resume)}
    variables = [f"{name}={value}" for name, value in values.items()]
    options = [word for variable in variables for word in ("-var", *variable.split("=", 1))]
    return [*launcher, arguments.binary, "-in", str(DECK), "-log", "none", *options]


def plain(value):
    """A number, if it is one, so that 0.1 is .1."""
    try:
        return float(value)
    except (TypeError, ValueError):
        return value


def check_variables(arguments):
    """Refuses to take up a run with other variables than it began with; only the strain and the start of the averages
    may change."""
    path = arguments.out / "variables.txt"
    if not path.exists():  # begun by hand
        return
    begun, asked = dict(line.split("=", 1) for line in path.read_text().splitlines()), dict(arguments.variables)
    if "part" not in asked and plain(begun.get("strain")) != plain(asked.get("strain")):
        raise InputError(
            f"part must be named from the first attempt on for strain to change, from "
            f"{begun.get('strain', 'the default')} to {asked.get('strain', 'the default')} here: its default "
            "depends on strain"
        )
    for name in sorted((begun.keys() | asked.keys()) - set(MAY_CHANGE)):
        if plain(begun.get(name)) != plain(asked.get(name)):
            raise InputError(
                f"{name} must stay what the run began with, "
                f"{begun.get(name, 'the default')}, "
                f"got {asked.get(name, 'the default')}; use another folder, or remove this one to start again"
            )


def write_variables(arguments):
    """At once: a file that a kill left half-written would be taken for what the run began with."""
    path = arguments.out / "variables.txt"
    path.with_suffix(".new").write_text("".join(f"{name}={value}\n" for name, value in arguments.variables))
    path.with_suffix(".new").replace(path)


def last_row(path):
    """Words of a file's last line; none of a file that is missing or empty."""
    lines = path.read_text().splitlines() if path.exists() else []
    return lines[-1].split() if lines else []


def strain_reached(out):
    """Strain at which the last attempt ended; 0 when it did not end."""
    parameters, cost = last_row(out / "parameters.txt"), last_row(out / "cost.txt")
    return float(parameters[5]) if cost and parameters and parameters[-2:] == cost[1::-1] else 0.0


def time_of(path):
    """When a file was last written to, or None."""
    return path.stat().st_mtime_ns if path.exists() else None


def begun_at(out):
    """The step at which the last attempt began, and that at which it is to end."""
    row = last_row(out / "parameters.txt")
    return int(row[-1]), int(row[-2])


def step_reached(out, begun):
    """The last step of the tables of the attempt that began at this step."""
    row = last_row((out / f"from_{begun}" if begun else out) / "series.txt")
    return int(row[0]) if row and row[0].isdigit() else begun


def write_cost(arguments, wall, usage, ended):
    """Adds an attempt to cost.txt: the cpu time of all ranks, and the memory of the largest."""
    begun, end = begun_at(arguments.out)
    reached = end if ended else step_reached(arguments.out, begun)
    if not ended and reached == end:  # strain_reached takes such a row for the run's end
        return
    path = arguments.out / "cost.txt"
    header = COST if begun == 0 or not path.exists() else ""
    with path.open("w" if begun == 0 else "a") as table:
        cpu = usage.ru_utime + usage.ru_stime
        table.write(f"{header}{begun} {reached} {arguments.ranks} {wall:.2f} {cpu:.2f} {1024 * usage.ru_maxrss}\n")


def lock(out, may_wait):
    """A file that is locked for as long as this process, or the run that it begins, is there. May wait for an earlier
    attempt that still runs, as one does whose Snakemake was killed."""
    file = (out / "lock").open("w")
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        if not may_wait:
            raise InputError("another attempt writes to this folder") from None
        warn(f"{out}: another attempt writes to this folder, waiting for its end")
        fcntl.flock(file, fcntl.LOCK_EX)
    return file


def how_far(screen):
    """The strain that a run has reached and the time that it still takes, by the last row of thermo output."""
    with screen.open("rb") as text:
        text.seek(max(0, text.seek(0, os.SEEK_END) - 4096))
        lines = text.read().decode(errors="replace").splitlines()[:-1]
    rows = [words for words in map(str.split, lines) if len(words) == COLUMNS and words[0].isdigit()]
    return f"strain {float(rows[-1][1]):.2f}, {duration(float(rows[-1][2]))} left" if rows else "begins"


def attempt(arguments, resume, locked, clock):
    """Exit status of one attempt, and what it printed. A run that a signal ends is content with itself, but writes no
    final.restart."""
    out = arguments.out
    screen, final, parameters = out / "screen.txt", out / "final.restart", out / "parameters.txt"
    earlier, earlier_parameters = time_of(final), time_of(parameters)
    note_attempt(out, arguments.binary, arguments.ranks, arguments.variables)
    begin = time.monotonic()
    with screen.open("ab") as output:
        end_of_earlier = output.tell()
        with session(note=out / "session.txt") as environment:
            run = ProgramProcess(command(arguments, resume), stdout=output, pass_fds=[locked.fileno()], env=environment)
            with followed(lambda: f"{out}: {how_far(screen)}"):
                code, usage = run.wait(lambda: clock.must_end([time_of(out / name) for name in RESTARTS]))
    ended = code == 0 and time_of(final) != earlier
    if time_of(parameters) != earlier_parameters:
        write_cost(arguments, time.monotonic() - begin, usage, ended)
    if not ended and (code == 0 or run.asked_to_end):
        return STOPPED, "it was stopped by a signal before its end"
    with screen.open("rb") as text:
        text.seek(end_of_earlier)
        return code, text.read().decode(errors="replace")


def variable(text):
    name, equals, value = text.partition("=")
    if not (name and equals and value):
        raise argparse.ArgumentTypeError(f"a variable must be name=value, got '{text}'")
    return name, value


def positive(text):
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"must be a number above 0, got '{text}'")
    return value


def add_arguments(parser):
    parser.add_argument("out", type=Path, help="output folder of the run")
    parser.add_argument(
        "variables", nargs="+", type=variable, metavar="name=value", help="variables of the deck, such as alpha=1.5"
    )
    parser.add_argument(
        "--binary", help="the program (default: grainscope of this source tree, beside the installed tools, or on PATH)"
    )
    parser.add_argument("--ranks", type=int, default=1, help="MPI ranks (default: 1, without mpirun)")
    parser.add_argument(
        "--hours", type=positive, help="wall time: stop at the end of the last part that fits (default: no end)"
    )


def run(arguments):
    try:
        begin_or_go_on(arguments)
    except (InputError, ValueError) as error:
        raise InputError(f"{arguments.out}: {error}") from None


def begin_or_go_on(arguments):
    clock = PartClock(arguments.hours and 3600 * arguments.hours)
    arguments.binary = arguments.binary or str(find_program())
    arguments.out.mkdir(parents=True, exist_ok=True)
    locked = lock(arguments.out, may_wait=arguments.hours is None)
    (arguments.out / FAILED).unlink(missing_ok=True)
    files = list(arguments.out.glob("*.restart"))
    if files:
        check_variables(arguments)
        reached = strain_reached(arguments.out)
        if reached >= float(dict(arguments.variables).get("strain", "inf")):
            print(f"{arguments.out}: ended at strain {reached:g} before, nothing to do")
            return
    write_variables(arguments)
    status, output = attempt(arguments, bool(files), locked, clock)
    if status and len(files) == 1 and NONE_WHOLE in output:
        warn(f"{arguments.out}: the first restart file was not whole yet, starting again")
        status, output = attempt(arguments, False, locked, clock)
    if status == STOPPED and clock.ended:
        print(f"{arguments.out}: out of time at {how_far(arguments.out / 'screen.txt')}; the same command goes on")
        sys.exit(STOPPED)
    if status == STOPPED:
        raise InputError(output)
    if status:
        reason = [line for line in output.splitlines() if line.startswith("ERROR")] or output.splitlines()[-1:]
        how = f"killed by signal {-status}" if status < 0 else f"exit status {status}"
        failure = f"{how}: {' '.join(reason)}"
        (arguments.out / FAILED).write_text(f"{failure}\n")
        raise InputError(failure)
