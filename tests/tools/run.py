# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs a deck in a folder of its own and reads what it wrote."""
import atexit
from functools import lru_cache
import os
from pathlib import Path
import re
import signal
import subprocess
import tempfile
import time

import numpy as np

from grainscope.open_mpi import Session

# Seconds, against hangs alone: on a busy machine a run takes many times as long. tests/limits.cmake has it, and more
# for what is long.
TIME_LIMIT = float(os.environ.get("GRAINSCOPE_TIME_LIMIT", "1200"))
PAUSE = 0.01  # between looks at what is waited for
FINDINGS = ("ERROR: AddressSanitizer", "ERROR: LeakSanitizer", "runtime error: ", "AddressSanitizer:DEADLYSIGNAL")


# Lines of Open MPI's own when a rank aborts, such as "[host:123] PMIX ERROR: UNREACHABLE in file ...".
OTHERS_ERROR = re.compile(r"\[[^\]\s]+:\d+\] (?:\[\[\d+,\d+\],\d+\] )?(?:PMIX|PRTE|ORTE|OPAL|OMPI)[ _]ERROR[^\n]*")


class Failure(Exception):
    """What a test found wrong, in words for a person."""


class Skipped(Exception):
    """Why a test cannot be made with this build."""


SKIPPED = 77  # the exit code that says so to ctest
FFTW = os.environ.get("GRAINSCOPE_FFTW", "TRUE") == "TRUE"  # whether the program has it
WITHOUT_FFTW = "'method' must be direct in a program that was built without FFTW, got 'mesh'"


def binary():
    path = os.environ.get("GRAINSCOPE_BINARY")
    if not path:
        raise Failure("GRAINSCOPE_BINARY must name the grainscope executable")
    return path


# Open MPI starts a process of one rank four times as fast when it looks for no others.
ALONE = {"OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_pml": "ob1", "OMPI_MCA_btl": "self"}


@lru_cache
def session_of_this_test():
    session = Session()
    atexit.register(session.remove)
    return session


def environment(ranks, session=None):
    """Environment of a run on so many ranks, with the directories of an open_mpi.Session: one for all runs of this test
    that start one after the other and name none of their own."""
    env = dict(
        os.environ,
        OMP_NUM_THREADS="1",
        OMPI_MCA_btl="^tcp",  # ranks of one machine need no network, which Open MPI may complain of
        OMPI_MCA_btl_vader_single_copy_mechanism="none",
        OMPI_MCA_rmaps_base_oversubscribe="1",
        OMPI_MCA_mpi_yield_when_idle="1",
        # no word with X servers, which may come and go, and no look at caches and devices, which takes 50 ms a start
        HWLOC_COMPONENTS="-gl,-x86,-linuxio,-pci,-opencl,-cuda",
    )
    if ranks == 1:
        env.update(ALONE)
    if ranks > 1 or session:
        env.update((session or session_of_this_test()).variables())
    if os.geteuid() == 0:
        env.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    return env


def _command(ranks, program):
    if ranks == 1:
        return [program]
    mpiexec = os.environ.get("GRAINSCOPE_MPIEXEC", "mpirun")
    return [mpiexec, "--oversubscribe", "--bind-to", "none", "-np", str(ranks), program]


def tail(output):
    """The end of a run's output, without the host's lines about single grains and mpirun's about its processes."""
    output = (output or "").split("-" * 60)[0]
    noise = ("Created ", "Setting atom", "  1 settings made")
    return "\n".join(line for line in output.splitlines() if not line.startswith(noise))[-2500:]


def require_clean(output):
    """No sanitizer found anything, whatever the run was to end with."""
    at = min((k for k in map(output.find, FINDINGS) if k >= 0), default=-1)
    if at >= 0:
        raise Failure(f"a sanitizer complains:\n{output[max(0, output.rfind(chr(10), 0, at)):at + 6000]}")


def count_errors(output):
    """How often LIGGGHTS or grainscope says ERROR; what Open MPI adds is not counted."""
    return OTHERS_ERROR.sub("", output).count("ERROR")


class Result:
    """A finished run: exit code, output, and the files of its folder."""

    def __init__(self, folder, code, output):
        self.folder = Path(folder)
        self.code = code
        self.output = output

    def file(self, name):
        path = self.folder / name
        if not path.exists():
            raise Failure(f"the run wrote no {name}; its output ends:\n{tail(self.output)}")
        return path

    def thermo(self):
        """One dict of arrays per `run` command, columns named as in the deck's thermo_style (the host cuts its own
        headings)."""
        blocks, names, rows, inside = [], [], [], False
        for line in self.file("log.liggghts").read_text().splitlines():
            words = line.split()
            if words[:2] == ["thermo_style", "custom"]:
                names = words[2:]
            elif words[:1] == ["Step"]:
                rows, inside = [], True
            elif line.startswith("Loop time") and inside:
                blocks.append(columns_of(names, rows))
                inside = False
            elif inside and len(words) == len(names) and words[0].isdigit():
                rows.append([float(w) for w in words])
        return blocks

    def dump(self, name):
        """A list of (step, dict of arrays), one per snapshot."""
        snapshots, lines = [], iter(self.file(name).read_text().splitlines())
        for line in lines:
            if line == "ITEM: TIMESTEP":
                step = int(next(lines))
            elif line.startswith("ITEM: NUMBER OF"):
                count = int(next(lines))
            elif line.startswith(("ITEM: ATOMS", "ITEM: ENTRIES")):
                names = line.split()[2:]
                rows = [[float(w) for w in next(lines).split()] for _ in range(count)]
                snapshots.append((step, columns_of(names, rows)))
        return snapshots

    def averages(self, name):
        """A fix ave/time file of global values: one dict of arrays, columns named as in its header."""
        rows, names = [], None
        for line in self.file(name).read_text().splitlines():
            if line.startswith("# TimeStep"):
                names = line[2:].split()
            elif not line.startswith("#"):
                rows.append([float(w) for w in line.split()])
        return columns_of(names, rows)


def columns_of(names, rows):
    table = np.array(rows, dtype=float).reshape(len(rows), len(names))
    return {name: table[:, k] for k, name in enumerate(names)}


def _deck_text(deck):
    return deck if isinstance(deck, str) else deck.text()


def processes_of(session):
    """(process number, name) of what runs in a session, as its leader's number names it."""
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            pid, _, rest = stat.read_text(errors="replace").partition(" (")
        except OSError:  # it has ended
            continue
        name, _, rest = rest.rpartition(") ")
        state, _, _, its_session = rest.split()[:4]
        if int(its_session) == session and state not in "ZX":
            yield int(pid), name


def kill_session(session):
    """SIGKILL to all processes of a session, first the one that leads it, until none is left: each rank has a process
    group of its own."""
    while left := [pid for pid, _ in processes_of(session)]:
        for pid in sorted(left, key=lambda pid: pid != session):
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        time.sleep(PAUSE)


def wait_until(condition, what):
    until = time.monotonic() + TIME_LIMIT
    while not condition():
        if time.monotonic() > until:
            raise Failure(f"waited {TIME_LIMIT:g} s in vain: {what}")
        time.sleep(PAUSE)


class Started:
    """A run under way, in a folder of its own, for tests that do not let it end in peace. `program`: what to start in
    place of the binary. Without `restore_signals` a file that may not grow is an error of writing, not a signal."""

    def __init__(self, deck, ranks=1, folder=None, arguments=(), program=None, restore_signals=False):
        self.folder = Path(folder or tempfile.mkdtemp(prefix="case-", dir=os.environ.get("GRAINSCOPE_SCRATCH")))
        self.folder.mkdir(parents=True, exist_ok=True)
        (self.folder / "in.deck").write_text(_deck_text(deck))
        (self.folder / "log.liggghts").unlink(missing_ok=True)
        self._command = [*_command(ranks, program or binary()), "-in", "in.deck", "-log", "log.liggghts", *arguments]
        self._session = Session()
        self._output = open(self.folder / "output", "w")
        self._process = subprocess.Popen(
            self._command,
            cwd=self.folder,
            env=environment(ranks, self._session),
            stdin=subprocess.DEVNULL,
            stdout=self._output,
            stderr=subprocess.STDOUT,
            start_new_session=True,
            restore_signals=restore_signals,
        )

    def kill(self):
        """SIGKILL to all ranks, and to mpirun."""
        kill_session(self._process.pid)

    def ranks(self):
        """The processes of the ranks, of which each may be sent a signal of its own."""
        program = Path(binary()).name[:15]
        return sorted(pid for pid, name in processes_of(self._process.pid) if name == program)

    def ended(self):
        return self._process.poll() is not None

    def end(self):
        """Waits for it; its Result."""
        try:
            code = self._process.wait(TIME_LIMIT)
        except BaseException as reason:  # a Ctrl-C is not for the run, which has a session of its own
            self.kill()
            if not isinstance(reason, subprocess.TimeoutExpired):
                raise
            raise Failure(f"{' '.join(self._command)} in {self.folder} did not end within {TIME_LIMIT:g} s") from None
        finally:
            self._session.remove()
            self._output.close()
        return Result(self.folder, code, (self.folder / "output").read_text(errors="replace"))


FLUSHED = "thermo_modify flush yes"


def rows_so_far(started):
    """Rows of thermo output in the log, which the deck must flush: FLUSHED."""
    log = started.folder / "log.liggghts"
    text = log.read_text(errors="replace") if log.exists() else ""
    begun = re.search(r"^ *Step .*$", text, flags=re.M)
    return len(re.findall(r"^ *\d+( |$)", text[begun.end() :], flags=re.M)) if begun else 0


def wait_for_steps(started, rows=2):
    """Until it has written so many rows of thermo output: the first is that of the state before the first step."""

    def begun():
        if started.ended():
            raise Failure(f"the run in {started.folder} ended before its first steps")
        return rows_so_far(started) >= rows

    wait_until(begun, f"{rows} rows of thermo output in {started.folder}")


def attempt(deck, ranks=1, folder=None, arguments=(), program=None):
    """Runs a deck (a Deck or its text) and returns the Result, whatever its exit code."""
    result = Started(deck, ranks, folder, arguments, program, restore_signals=True).end()
    require_clean(result.output)
    if not FFTW and WITHOUT_FFTW in result.output:
        raise Skipped(WITHOUT_FFTW)
    return result


def run(deck, ranks=1, **options):
    """Runs a deck that must succeed."""
    result = attempt(deck, ranks, **options)
    if result.code != 0 or count_errors(result.output):
        raise Failure(f"the run in {result.folder} ended with code {result.code}:\n{tail(result.output)}")
    return result
