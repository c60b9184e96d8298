# SPDX-License-Identifier: GPL-2.0-or-later
"""Configuring with forks of the host that lack what our styles need: refused in one sentence that names it. The forks
are made here: the host's files by symlink, and some of them changed."""
import os
from pathlib import Path
import tempfile

from build import HOST, configure, configured
from case import main, require

# What a fork has in place of the host's lines, and what must then be said.
LACKS = [
    (
        "contact_interface.h",
        "SurfacesIntersectData",
        "CollisionData",
        "contact_interface.h has no SurfacesIntersectData",
    ),
    ("pair_gran.h", "virtual void compute_pgl(int eflag, int vflag);", "", "pair_gran.h has no compute_pgl"),
    (
        "pair_gran.h",
        "ComputePairGranLocal * cpl() const",
        "ComputePairGranLocal * other() const",
        "pair_gran.h has no public cpl() const",
    ),
    (
        "granular_pair_style.h",
        "int vflag, int addflag)",
        "int vflag)",
        "granular_pair_style.h: compute_force does not take addflag",
    ),
    ("fix.h", "restart(char *) {}", "restart(char *, int = 0) {}", "fix.h: restart does not take (char *) alone"),
    (
        "pair.h",
        "read_restart_settings(FILE *, const int major, const int minor)",
        "read_restart_settings(FILE *)",
        "pair.h: read_restart_settings does not take (FILE *, int, int)",
    ),
    (
        "irregular.h",
        "  void migrate_atoms();",
        " private:\n  void migrate_atoms();\n public:",
        "irregular.h has no public migrate_atoms()",
    ),
    (
        "utils.h",
        "char ** & argv,Custom_contact_models ccm) {",
        "char ** & argv) {\n      Custom_contact_models ccm;",
        "utils.h: selectVariant does not take custom_contact_models",
    ),
]
UNFORESEEN = "its headers do not compile with ours: "


def fork_of_host(*changes, branch="LIGGGHTS-FORK", version="9.9"):
    """A checkout whose src/ is the host's but for (file, old, new)."""
    source = Path(tempfile.mkdtemp(dir=os.environ["GRAINSCOPE_SCRATCH"])) / "fork" / "src"
    source.mkdir(parents=True)
    for file in HOST.iterdir():
        if file.suffix in (".h", ".cpp", ".txt"):
            (source / file.name).symlink_to(file)
    for file, old, new in changes:
        change(source / file, old, new)
    replace_link(source / "version_liggghts_branch.txt", branch + "\n")
    replace_link(source / "version_liggghts.txt", version + "\n")
    return source


def fork_lacking(changes):
    return fork_of_host(*(change[:3] for change in changes))


def change(file, old, new):
    text = file.read_text(errors="surrogateescape")
    require(old in text, f"{file.name} of the host has no '{old}' to be changed")
    replace_link(file, text.replace(old, new))


def replace_link(file, text):
    file.unlink(missing_ok=True)
    file.write_text(text, errors="surrogateescape")


def refusal(source, lacking):
    return (
        f"LIGGGHTS_SOURCE_DIR: '{source}' (LIGGGHTS-FORK 9.9) is not supported: {lacking}. "
        "doc/hosts.md lists the hosts that are."
    )


def require_refused(source, lacking, build=None):
    code, output, build = configure(source, build=build)
    require(code != 0, f"accepted, though {lacking}")
    # A wrapped line may end within a path or a name that has a hyphen or a blank.
    said = refusal(source, lacking).replace(" ", "") in output.replace(" ", "")
    require(said, f"not said: '{lacking}', but {output}")
    return build


def what_is_missing_is_named(ranks):
    """Every other one, and then the rest; of what is there nothing is said. (SurfacesIntersectData, which other headers
    of the host name, is one of all at once.)"""
    build = None
    for changes in (LACKS[1::2], LACKS[2::2]):
        build = require_refused(fork_lacking(changes), "; ".join(change[3] for change in changes), build)


def all_of_it_at_once(ranks):
    require_refused(fork_lacking(LACKS), "; ".join(change[3] for change in LACKS))


def what_was_not_foreseen(ranks):
    """Another member that one of ours overrides has gone: the compiler's own words."""
    source = fork_of_host(("fix.h", "virtual void post_run() {}", "virtual void after_run() {}"))
    code, output, _ = configure(source)
    require(code != 0, "accepted without Fix::post_run, which would never be called")
    require(f"is not supported: {UNFORESEEN}fix_" in output and "override" in output and "post_run" in output, output)


def a_header_that_is_not_there(ranks):
    source = fork_of_host()
    (source / "irregular.h").unlink()
    code, output, _ = configure(source)
    require(code != 0 and f"is not supported: {UNFORESEEN}" in output and "irregular.h" in output, output)


def checked_again_when_a_header_changes(ranks):
    """A fork that is taken, and is updated to what is not supported."""
    source = fork_of_host()
    _, build = configured(source)
    file, old, new, lacking = LACKS[4]
    change(source / file, old, new)
    require_refused(source, lacking, build)


CASES = {
    "what-is-missing-is-named": what_is_missing_is_named,
    "all-of-it-at-once": all_of_it_at_once,
    "what-was-not-foreseen": what_was_not_foreseen,
    "a-header-that-is-not-there": a_header_that_is_not_there,
    "checked-again-when-a-header-changes": checked_again_when_a_header_changes,
}

if __name__ == "__main__":
    main(CASES)
