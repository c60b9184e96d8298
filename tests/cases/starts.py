# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs that start and end beside others: none fails because of what Open MPI shares between them, and none leaves
anything behind."""
from concurrent.futures import ThreadPoolExecutor
import os
from pathlib import Path
import re
import socket
import subprocess

from case import main, require
from grainscope.open_mpi import SHARED_MEMORY, Session, session
from run import ALONE, FLUSHED, Started, attempt, binary, count_errors, environment, rows_so_far, wait_for_steps

DECK = "units si\natom_style sphere\n"
GRAINS = """units si
atom_style sphere
atom_modify map array
boundary f f f
newton off
communicate single vel yes
region box block 0 9 0 9 0 9 units box
create_box 1 box
create_atoms 1 single 5 5 5 units box
neighbor 0.5 bin
pair_style gran/insitu model hertz tangential off
fix young all property/global youngsModulus peratomtype 5e6
fix poisson all property/global poissonsRatio peratomtype 0.3
fix restitution all property/global coefficientRestitution peratomtypepair 1 0.5
fix integrate all nve/sphere
pair_coeff * *
timestep 1e-5
thermo 1000
"""
LOOPS, STARTS = 6, 500


def shared_directory(folder):
    """What Open MPI 4 calls the directory that all processes of a user share."""
    return Path(folder) / f"ompi.{socket.gethostname().split('.')[0]}.{os.geteuid()}"


def open_mpi():
    """Its major version."""
    said = subprocess.run(["ompi_info", "--version"], capture_output=True, text=True, check=True).stdout
    return int(re.search(r"v(\d+)\.", said)[1])


def bare():
    """The environment of a user who has set nothing."""
    return {name: value for name, value in environment(1).items() if name not in ALONE}


def alone_shares_no_directory(ranks):
    """Started without mpirun, by a user who has set nothing: no directory that another process could use or remove."""
    scratch = Path(os.environ["GRAINSCOPE_SCRATCH"])
    (scratch / "in.deck").write_text(DECK + f"shell ls {scratch} > seen\n")
    done = subprocess.run(
        [binary(), "-in", "in.deck"],
        cwd=scratch,
        env={**bare(), "TMPDIR": str(scratch)},
        capture_output=True,
        text=True,
    )
    require(done.returncode == 0, f"ended with {done.returncode}: {done.stdout} {done.stderr}")
    seen = (scratch / "seen").read_text().split()
    require("in.deck" in seen, f"the deck saw {seen}")
    # Open MPI 5 makes one whatever the options, with a folder in it for each process: side-by-side is what counts.
    if open_mpi() < 5:
        require(shared_directory(scratch).name not in seen, f"Open MPI made a directory: {seen}")


def mpirun_has_its_own(ranks):
    """What two mpiruns use at one time are other directories, none of them the one in /tmp, and they go."""
    first, second = Session(), Session()
    try:
        require(not set(first.folders) & set(second.folders), "two sessions share a directory")
        scratch = Path(os.environ["GRAINSCOPE_SCRATCH"])
        (scratch / "in.deck").write_text(DECK + f"shell find {first.folders[0]} {SHARED_MEMORY} > seen\n")
        mpirun = os.environ.get("GRAINSCOPE_MPIEXEC", "mpirun")
        done = subprocess.run(
            [mpirun, "--oversubscribe", "-np", "2", binary(), "-in", "in.deck"],
            cwd=scratch,
            env=environment(2, first),
            capture_output=True,
            text=True,
        )
        require(done.returncode == 0, f"ended with {done.returncode}: {done.stdout} {done.stderr}")
        seen = (scratch / "seen").read_text().split()
        for folder in first.folders:
            require(any(path.startswith(folder + "/") for path in seen), f"Open MPI put nothing into {folder}: {seen}")
    finally:
        first.remove()
        second.remove()
    require(not any(os.path.exists(folder) for one in (first, second) for folder in one.folders), "directories stay")


def killed_leaves_nothing(ranks):
    under_way = Started(GRAINS + FLUSHED + "\nrun 1000000000\n", 2)
    wait_for_steps(under_way)
    folders = under_way._session.folders
    require(all(os.path.exists(folder) for folder in folders), "there is no session")
    under_way.kill()
    require(not under_way.ranks(), "ranks live on")
    require(under_way.end().code < 0, "it was not killed")
    require(not any(os.path.exists(folder) for folder in folders), "directories stay")


def note_of_a_killed_one(ranks):
    """A session whose owner was killed is removed by the next with the same note; nothing else is."""
    scratch = Path(os.environ["GRAINSCOPE_SCRATCH"])
    note = scratch / "session.txt"
    left = Session(note).folders  # its owner is gone
    (scratch / "kept").mkdir()
    with note.open("a") as file:
        file.write(f"{scratch / 'kept'}\n")
    with session(note=note) as variables:
        require(os.path.isdir(variables["TMPDIR"]) and variables["TMPDIR"] not in left, "no new directory")
        require(not any(os.path.exists(folder) for folder in left), "what a killed process left stays")
    require((scratch / "kept").exists(), "a directory that is not ours was removed")
    require(not note.exists(), "the note stays")


def only_our_errors_count(ranks):
    """Open MPI adds lines of its own when a rank aborts; what LIGGGHTS says counts, wherever it stands."""
    ours = "ERROR: compute fabric: 'bins' must be a whole number (arguments.cpp:12)\n"
    on_one = "ERROR on proc 0: Cannot open file (input.cpp:5)\n"
    five = "[vm:14622] PMIX ERROR: PMIX_ERR_UNREACH in file ../../../src/client/pmix_client.c at line 312\n"
    runtime = "[node-7.cluster:991] PRTE ERROR: Not found in file base/data.c at line 4\n"
    four = "[vm:15199] [[21984,0],0] ORTE_ERROR_LOG: Data unpack failed in file x.c at line 9\n"
    for text, expected in (
        (ours, 1),
        (on_one, 1),
        (ours + five, 1),
        (five + runtime + four, 0),
        (ours + four + on_one, 2),
        ("step 1 " + ours, 1),
        (ours.strip() + five, 1),
        (ours + five + ours, 2),
        ("nothing\n", 0),
    ):
        found = count_errors(text)
        require(found == expected, f"{found} errors counted, expected {expected}, in {text!r}")


def rows_are_counted_from_the_first_step(ranks):
    """Numbers in the log before that, of grains and settings, are no rows."""

    class Begun:
        folder = Path(os.environ["GRAINSCOPE_SCRATCH"])

    log = Begun.folder / "log.liggghts"
    require(rows_so_far(Begun) == 0, "rows without a log")
    for text, expected in (
        ("  1 settings made\n 2 by 1 by 1 MPI processor grid\n", 0),
        ("    Step    Atoms\n", 0),
        ("       0        1\n      10        1\nLoop time of 1 on 1 procs\n", 2),
    ):
        with log.open("a") as file:
            file.write(text)
        require(rows_so_far(Begun) == expected, f"{rows_so_far(Begun)} rows, expected {expected}, after {text!r}")


def side_by_side(ranks):
    """Loops of starts, five of six on one rank by a user who has set nothing, the sixth on two ranks: none fails."""
    scratch = Path(os.environ["GRAINSCOPE_SCRATCH"])
    (scratch / "in.deck").write_text(DECK)

    def loop(number):
        bad = []
        for k in range(STARTS):
            if number == 0:
                result = attempt(DECK, 2, folder=scratch / f"loop{number}")
                code, output = result.code, result.output
            else:
                done = subprocess.run(
                    [binary(), "-in", "in.deck", "-log", "none"],
                    cwd=scratch,
                    env=bare(),
                    capture_output=True,
                    text=True,
                )
                code, output = done.returncode, done.stdout + done.stderr
            if code:
                bad.append(f"start {k} of loop {number} ended with code {code}: {output[-500:]}")
        return bad

    with ThreadPoolExecutor(LOOPS) as pool:
        bad = [text for found in pool.map(loop, range(LOOPS)) for text in found]
    print(f"{LOOPS * STARTS} starts in {LOOPS} loops side by side: {len(bad)} failures")
    require(not bad, "\n".join(bad[:5]))


main(
    {
        "alone-shares-no-directory": alone_shares_no_directory,
        "mpirun-has-its-own": mpirun_has_its_own,
        "killed-leaves-nothing": killed_leaves_nothing,
        "note-of-a-killed-one": note_of_a_killed_one,
        "rows-are-counted-from-the-first-step": rows_are_counted_from_the_first_step,
        "only-our-errors-count": only_our_errors_count,
        "side-by-side": side_by_side,
    }
)
