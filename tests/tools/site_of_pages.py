# SPDX-License-Identifier: GPL-2.0-or-later
"""The documentation site, built as scripts/docs does, into a folder of a test."""
import os
from pathlib import Path
import shutil
import subprocess

from case import require

SOURCE = Path(os.environ["GRAINSCOPE_SOURCE"])


def scratch():
    return Path(os.environ["GRAINSCOPE_SCRATCH"])


def built(folder, source=SOURCE):
    """MkDocs's exit code and words."""
    require(shutil.which("mkdocs"), "mkdocs is missing: scripts/install-packages mkdocs mkdocs-material")
    command = ["mkdocs", "build", "--config-file", source / "mkdocs.yml", "--site-dir", folder]
    done = subprocess.run([*map(str, command)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.returncode, done.stdout
