"""Runs of Open MPI side by side on one machine. Processes that start and end at the same moment share a session
directory in /tmp, and one can remove it under another: "mkdir: File exists", exit code 1. Here each mpirun gets
directories of its own."""

from contextlib import contextmanager
import os
from pathlib import Path
import shutil
import tempfile

# Sockets in a session directory have names of at most 107 bytes, of which Open MPI adds some 60.
LONGEST = 30
SHARED_MEMORY = "/dev/shm"


def _base():
    folder = tempfile.gettempdir()
    return folder if len(folder) <= LONGEST else "/tmp"


def _several_nodes(environment):
    """A directory in the shared memory of this node is none on another."""
    return environment.get("SLURM_JOB_NUM_NODES", "1") != "1" or any(
        name in environment for name in ("PBS_NODEFILE", "PE_HOSTFILE", "LSB_HOSTS")
    )


class Session:
    """Directories of one group of processes. `note`: a file that names them for as long as they are there, so that the
    next session with the same note removes what a killed process left."""

    def __init__(self, note=None):
        self.note = note and Path(note)
        self._remove_left()
        self.folders = [tempfile.mkdtemp(prefix="gs-", dir=_base())]
        if os.access(SHARED_MEMORY, os.W_OK) and not _several_nodes(os.environ):
            self.folders.append(tempfile.mkdtemp(prefix="gs-", dir=SHARED_MEMORY))
        if self.note:
            self.note.write_text("\n".join(self.folders) + "\n")

    def _remove_left(self):
        for line in self.note.read_text().splitlines() if self.note and self.note.exists() else []:
            if Path(line).name.startswith("gs-"):
                shutil.rmtree(line, ignore_errors=True)

    def variables(self):
        """What Open MPI 4 (orte, vader) and 5 (prte, sm) read from the environment."""
        names = {"TMPDIR": 0, "OMPI_MCA_orte_tmpdir_base": 0, "PRTE_MCA_prte_tmpdir_base": 0}
        if len(self.folders) > 1:
            names.update(OMPI_MCA_btl_vader_backing_directory=1, OMPI_MCA_btl_sm_backing_directory=1)
        return {name: self.folders[k] for name, k in names.items()}

    def remove(self):
        for folder in self.folders:
            shutil.rmtree(folder, ignore_errors=True)
        if self.note:
            self.note.unlink(missing_ok=True)


@contextmanager
def session(environment=os.environ, note=None):
    """The environment with a session of its own, for one mpirun after another; its directories go at the end of the
    block."""
    own = Session(note)
    try:
        yield {**environment, **own.variables()}
    finally:
        own.remove()
