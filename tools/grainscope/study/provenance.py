"""What a run came from: the commit of the tools, the program, the command, the machine and the time. Each attempt adds
a line of JSON to attempts.jsonl in the folder of the run."""

import hashlib
import json
import os
from pathlib import Path
import platform
import subprocess

from grainscope.program import TOP
from grainscope.study.slices import now

FILE = "attempts.jsonl"


def git(*words):
    """What git says of the source tree; None where there is none."""
    if not (TOP / ".git").exists():
        return None
    try:
        return subprocess.run(
            ["git", "-C", str(TOP), *words], capture_output=True, text=True, check=True, stdin=subprocess.DEVNULL
        ).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return None


def source():
    """The commit of the source tree, and whether files differ from it; nothing of installed tools."""
    commit = git("rev-parse", "HEAD")
    return {"commit": commit, "changed": bool(git("status", "--porcelain", "--untracked-files=no"))} if commit else {}


def processor():
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        lines = []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()


def machine():
    system = " ".join((platform.system(), platform.machine(), *platform.libc_ver()))
    return {"processor": processor(), "cores": os.cpu_count(), "system": system}


def note_attempt(folder, binary, ranks, variables):
    """Adds an attempt that begins."""
    attempt = {
        "time": now().isoformat(),
        "command": ["study", "run", folder.name, *(f"{name}={value}" for name, value in variables)],
        "ranks": ranks,
        "program": {"sha256": hashlib.sha256(Path(binary).read_bytes()).hexdigest()},
        "source": source(),
        "machine": machine(),
    }
    with (folder / FILE).open("a") as lines:
        lines.write(json.dumps(attempt) + "\n")


def attempts_of(folder):
    """What note_attempt wrote, first attempt first; a line that a kill cut short is left out."""
    path = folder / FILE
    found = []
    for line in path.read_text().splitlines() if path.exists() else []:
        try:
            found.append(json.loads(line))
        except ValueError:
            continue
    return found
