# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs a deck in a folder of its own and reads what it wrote."""
import os
from pathlib import Path
import signal
import subprocess
import tempfile
import time

import numpy as np

TIME_LIMIT = 120.0
TIME_SCALE = float(os.environ.get("GRAINSCOPE_TIME_SCALE", "1"))  # a build that looks over its own shoulder takes longer
FINDINGS = ("ERROR: AddressSanitizer", "ERROR: LeakSanitizer", "runtime error: ", "AddressSanitizer:DEADLYSIGNAL")


class Failure(Exception):
    """What a test found wrong, in words for a person."""


def binary():
    path = os.environ.get("GRAINSCOPE_BINARY")
    if not path:
        raise Failure("GRAINSCOPE_BINARY must name the grainscope executable")
    return path


# Open MPI starts a process of one rank four times as fast when it looks for no others.
ALONE = {"OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_pml": "ob1", "OMPI_MCA_btl": "self"}


def environment(ranks):
    """Environment of a run on so many ranks."""
    env = dict(os.environ, OMP_NUM_THREADS="1", OMPI_MCA_btl_vader_single_copy_mechanism="none",
               OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_mpi_yield_when_idle="1")
    if ranks == 1:
        env.update(ALONE)
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
        """One dict of arrays per `run` command, columns named as in the deck's thermo_style (the host cuts its own headings)."""
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


class Started:
    """A run under way, in a folder of its own, for tests that do not let it end in peace."""

    def __init__(self, deck, ranks=1, folder=None):
        self.folder = Path(folder or tempfile.mkdtemp(prefix="case-", dir=os.environ.get("GRAINSCOPE_SCRATCH")))
        self.folder.mkdir(parents=True, exist_ok=True)
        (self.folder / "in.deck").write_text(_deck_text(deck))
        command = [*_command(ranks, binary()), "-in", "in.deck", "-log", "log.liggghts"]
        self._output = open(self.folder / "output", "w")
        self._process = subprocess.Popen(command, cwd=self.folder, env=environment(ranks), stdout=self._output, stderr=subprocess.STDOUT,
                                         stdin=subprocess.DEVNULL, start_new_session=True, restore_signals=False)

    def kill(self):
        """SIGKILL to all ranks, and to mpirun."""
        for pid in (*self.ranks(), self._process.pid):
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass

    def ranks(self):
        """The processes of the ranks, of which each may be sent a signal of its own."""
        found = []
        for stat in Path("/proc").glob("[0-9]*/stat"):
            try:
                pid, _, rest = stat.read_text().partition(" (")
            except OSError:  # it has ended
                continue
            name, _, rest = rest.rpartition(") ")
            if name == Path(binary()).name[:15] and int(rest.split()[1]) == self._process.pid:
                found.append(int(pid))
        return found or [self._process.pid]

    def ended(self):
        return self._process.poll() is not None

    def end(self, time_limit=TIME_LIMIT):
        """Waits for it; its Result."""
        try:
            code = self._process.wait(time_limit * TIME_SCALE)
        except subprocess.TimeoutExpired:
            self.kill()
            raise Failure(f"the run in {self.folder} did not end within {time_limit * TIME_SCALE} s")
        self._output.close()
        return Result(self.folder, code, (self.folder / "output").read_text(errors="replace"))


def wait_for_steps(started):
    """Until it has begun its steps."""
    log = started.folder / "log.liggghts"
    while not log.exists() or "Step" not in log.read_text(errors="replace"):
        if started.ended():
            raise Failure(f"the run in {started.folder} ended before its first step")
        time.sleep(0.05)
    time.sleep(0.3)


def attempt(deck, ranks=1, folder=None, arguments=(), time_limit=TIME_LIMIT, program=None):
    """Runs a deck (a Deck or its text) and returns the Result, whatever its exit code. `program`: what to start in place of the binary."""
    folder = Path(folder or tempfile.mkdtemp(prefix="case-", dir=os.environ.get("GRAINSCOPE_SCRATCH")))
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "in.deck").write_text(_deck_text(deck))
    command = [*_command(ranks, program or binary()), "-in", "in.deck", "-log", "log.liggghts", *arguments]
    try:
        done = subprocess.run(command, cwd=folder, env=environment(ranks), stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              stdin=subprocess.DEVNULL, timeout=time_limit * TIME_SCALE, text=True, errors="replace")
    except subprocess.TimeoutExpired:
        raise Failure(f"{' '.join(command)} in {folder} did not end within {time_limit * TIME_SCALE} s")
    require_clean(done.stdout)
    return Result(folder, done.returncode, done.stdout)


def run(deck, ranks=1, **options):
    """Runs a deck that must succeed."""
    result = attempt(deck, ranks, **options)
    if result.code != 0 or "ERROR" in result.output:
        raise Failure(f"the run in {result.folder} ended with code {result.code}:\n{tail(result.output)}")
    return result
