# SPDX-License-Identifier: GPL-2.0-or-later
"""A SLURM of this machine alone (scripts/local-slurm), for tests that submit jobs; as root."""
from contextlib import contextmanager
import os
from pathlib import Path
import socket
import subprocess

from case import require
from run import TIME_LIMIT, Failure

LOCAL_SLURM = Path(os.environ["GRAINSCOPE_SOURCE"]) / "scripts" / "local-slurm"


def output_of(*command):
    done = subprocess.run(command, capture_output=True, text=True, timeout=TIME_LIMIT)
    require(done.returncode == 0, f"{' '.join(map(str, command))}: exit code {done.returncode}: {done.stderr}")
    return done.stdout


def free_port():
    """Of two free ones in a row."""
    for port in range(20000, 30000, 2):
        with socket.socket() as first, socket.socket() as second:
            try:
                first.bind(("127.0.0.1", port))
                second.bind(("127.0.0.1", port + 1))
                return port
            except OSError:
                continue
    raise Failure("no free port")


@contextmanager
def local_slurm(folder):
    """SLURM for as long as the block lasts, whatever ends it. stop has a session of its own: a Ctrl-C is not for it."""
    os.environ["LOCAL_SLURM_PORT"] = str(free_port())
    try:
        export = output_of(LOCAL_SLURM, "start", folder).split()[1]
        os.environ["SLURM_CONF"] = export.partition("=")[2]
        print(output_of("sinfo"), flush=True)
        yield
    finally:
        if (folder / "slurm.conf").exists():
            subprocess.run([LOCAL_SLURM, "stop", folder], check=True, start_new_session=True, timeout=TIME_LIMIT)


def job(number):
    """What SLURM says of a job."""
    return dict(word.partition("=")[::2] for word in output_of("scontrol", "--oneliner", "show", "job", number).split())
