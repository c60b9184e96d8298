# SPDX-License-Identifier: GPL-2.0-or-later
"""grainscope-tools, in the process of the test."""
from contextlib import redirect_stderr, redirect_stdout
from io import StringIO

from case import require
from grainscope import commands


def asked(*words):
    """Exit code, and what is printed."""
    said, code = StringIO(), 0
    with redirect_stdout(said), redirect_stderr(said):
        try:
            commands.main([*map(str, words)])
        except SystemExit as end:
            code = end.code or 0
    if isinstance(code, str):  # as Python itself does
        return 1, said.getvalue() + code
    return code, said.getvalue()


def require_refused(words, *expected):
    """An error that has all of what is expected."""
    code, said = asked(*words)
    missing = [one for one in expected if one not in said]
    require(code in (1, 2) and not missing, f"{' '.join(map(str, words))}: exit code {code}, '{said}' lacks {missing}")
