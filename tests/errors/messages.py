# SPDX-License-Identifier: GPL-2.0-or-later
"""No message is lost: what ends a run is on the screen, in the log file and on stderr, once each, from any rank,
whatever the streams are. And a message about a wrong name, index or style says which, and what there is."""
from dataclasses import dataclass
import os
from pathlib import Path
import resource
import signal
import subprocess
import tempfile

from case import main, require
from deck import Deck
from packing import dense_packing
from refusal import require_refused
from run import TIME_LIMIT, Started, _command, binary, count_errors, environment, wait_for_steps

SPHERES = dense_packing(atom_style="sphere")
BEFORE = "said before the end"


def body(*lines):
    return Deck(SPHERES, body=list(lines))


def new_folder():
    return Path(tempfile.mkdtemp(prefix="case-", dir=os.environ.get("GRAINSCOPE_SCRATCH")))


@dataclass
class Ended:
    code: int
    screen: str
    stderr: str
    log: str


def read(path):
    return path.read_text(errors="replace") if path.exists() else ""


def end(deck, ranks, *arguments, folder=None, log="log.liggghts", screen="screen", limit=None):
    """Runs a deck with stdout and stderr in files of their own."""
    folder = folder or new_folder()
    if deck is not None:
        (folder / "in.deck").write_text(deck if isinstance(deck, str) else deck.text())
    command = [*_command(ranks, binary()), *(arguments or ("-in", "in.deck"))]
    with open(folder / "screen", "w") as out, open(folder / "stderr", "w") as err:
        done = subprocess.run(
            command,
            cwd=folder,
            env=environment(ranks),
            stdout=out,
            stderr=err,
            stdin=subprocess.DEVNULL,
            timeout=TIME_LIMIT,
            preexec_fn=limit,
        )
    return Ended(done.returncode, read(folder / screen), read(folder / "stderr"), read(folder / log))


def require_once(ended, words, **streams):
    """`words` once in each stream that is named with True, and not in one that is named with False."""
    require(ended.code > 0, f"ended with code {ended.code}")
    for name, wanted in streams.items():
        text = getattr(ended, name)
        require(
            text.count(words) == wanted,
            f"{name} has the message {text.count(words)} times, not {int(wanted)}; it ends:\n{text[-1500:]}",
        )


def last_rank_complains(ranks, *lines):
    """A folder where the dump file of the last rank cannot be opened, and the deck that opens it."""
    folder = new_folder()
    (folder / "d").mkdir()
    (folder / "d" / f"grains.{ranks - 1}").mkdir()
    return folder, body("dump grains all custom 10 d/grains.% id x", *lines, f'print "{BEFORE}"', "run 0")


def message_of(ranks):
    return f"ERROR on proc {ranks - 1}: Cannot open dump file"


def all_ranks(ranks):
    ended = end(body(f'print "{BEFORE}"', "nonsense of mine"), ranks)
    require_once(ended, "ERROR: Unknown command: nonsense of mine", screen=True, stderr=True, log=True)
    require_once(ended, BEFORE + "\n", screen=True, log=True)
    ended = end(body("fix c all property/global x scalarr 1.0"), ranks)
    require_once(ended, "ERROR: Fix property/global (id c): ", screen=True, stderr=True, log=True)


def one_rank(ranks):
    folder, deck = last_rank_complains(ranks)
    ended = end(deck, ranks, folder=folder)
    require_once(ended, message_of(ranks), screen=True, stderr=True, log=True)
    require_once(ended, BEFORE + "\n", screen=True, log=True)


def no_screen(ranks):
    arguments = ("-in", "in.deck", "-screen", "none")
    ended = end(body("nonsense"), ranks, *arguments)
    require_once(ended, "ERROR: Unknown command", screen=False, stderr=True, log=True)
    folder, deck = last_rank_complains(ranks)
    ended = end(deck, ranks, *arguments, folder=folder)
    require_once(ended, message_of(ranks), screen=False, stderr=True, log=True)


def screen_in_a_file(ranks):
    """Which the host opens on the first rank only."""
    arguments = ("-in", "in.deck", "-screen", "its.screen")
    ended = end(body("nonsense"), ranks, *arguments, screen="its.screen")
    require_once(ended, "ERROR: Unknown command", screen=True, stderr=True, log=True)
    folder, deck = last_rank_complains(ranks)
    ended = end(deck, ranks, *arguments, folder=folder, screen="its.screen")
    require_once(ended, message_of(ranks), screen=True, stderr=True, log=True)


def no_log(ranks):
    arguments = ("-in", "in.deck", "-log", "none")
    ended = end(body("nonsense"), ranks, *arguments)
    require_once(ended, "ERROR: Unknown command", screen=True, stderr=True, log=False)
    folder, deck = last_rank_complains(ranks)
    ended = end(deck, ranks, *arguments, folder=folder)
    require_once(ended, message_of(ranks), screen=True, stderr=True, log=False)
    require(not list(folder.glob("log*")) and not (folder / "none").exists(), "a log file, which nobody wants")


def log_by_a_command(ranks):
    """The log file that a command names, from another folder."""
    commands = ["log other.log", "shell mkdir elsewhere", "shell cd elsewhere", "shell ln -s ../d d"]
    folder, deck = last_rank_complains(ranks, *commands)
    ended = end(deck, ranks, folder=folder, log="other.log")
    require_once(ended, message_of(ranks), screen=True, stderr=True, log=True)
    require_once(ended, BEFORE + "\n", screen=True, log=True)
    require("ERROR" not in read(folder / "log.liggghts"), "the log file before it has it too")


def once_where_both_are_one(ranks):
    """A person at a terminal, or a file of both streams, has it once."""
    for place in ("file", "terminal"):
        for make in (lambda: (new_folder(), body("nonsense")), lambda: last_rank_complains(ranks)):
            folder, deck = make()
            (folder / "in.deck").write_text(deck.text())
            text = merged(folder, ranks, place == "terminal")
            require(count_errors(text) == 1, f"{place}: {count_errors(text)} times; it ends:\n{text[-1500:]}")


def merged(folder, ranks, terminal):
    command = [*_command(ranks, binary()), "-in", "in.deck"]
    if not terminal:
        with open(folder / "both", "w") as both:
            subprocess.run(
                command,
                cwd=folder,
                env=environment(ranks),
                stdout=both,
                stderr=both,
                stdin=subprocess.DEVNULL,
                timeout=TIME_LIMIT,
            )
        return read(folder / "both")
    ours, theirs = os.openpty()
    process = subprocess.Popen(
        command, cwd=folder, env=environment(ranks), stdout=theirs, stderr=theirs, stdin=subprocess.DEVNULL
    )
    os.close(theirs)
    text = b""
    try:
        while part := os.read(ours, 4096):
            text += part
    except OSError:  # the terminal is gone: the program has ended
        pass
    os.close(ours)
    process.wait(TIME_LIMIT)
    return text.decode(errors="replace")


def when_the_program_starts(ranks):
    ended = end(None, ranks, "-in", "no.such.deck")
    require_once(ended, "ERROR on proc 0: Cannot open input script no.such.deck", screen=True, stderr=True, log=True)
    ended = end(None, ranks, "-nonsense")
    require_once(ended, "ERROR: Invalid command-line argument", screen=True, stderr=True)
    ended = end(None, ranks, "-in", "no.such.deck", "-log", "no/such/folder/log")
    require_once(ended, "ERROR on proc 0: Cannot open universe log file", screen=True, stderr=True)


def second_signal(ranks):
    """Both arrive while the program is stopped, so that no step is made in between."""
    started = Started(body("thermo 1", "run 100000000"))
    wait_for_steps(started)
    (pid,) = started.ranks()
    for number in (signal.SIGSTOP, signal.SIGTERM, signal.SIGINT, signal.SIGCONT):
        os.kill(pid, number)
    result = started.end()
    require(result.code == 1, f"ended with code {result.code}")
    words = "ERROR: the run ends at once, at a second SIGINT or SIGTERM"
    require(result.output.count(words) == 1, result.output[-1500:])
    log = result.file("log.liggghts").read_text()
    require(log.endswith("\n") and log.count("\n") > 50, "lines of the log file are missing")
    require(log.count(words) == 1, f"the log file has the line {log.count(words)} times")


def exception(ranks):
    """An array that no memory can hold, which the host asks for in a way that it does not check."""

    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))

    box = "region box block 0 1 0 1 0 1 units box"
    deck = f'atom_style atomic\n{box}\nprint "{BEFORE}"\ncreate_box 2000000000 box\n'
    ended = end(deck, 1, limit=None if "asan" in binary() else limit)
    words = "ERROR on proc 0: an exception ended the program: std::bad_alloc"
    require_once(ended, words, screen=True, stderr=True, log=True)
    require_once(ended, BEFORE + "\n", screen=True, log=True)


def listed(text, ID, page):
    return f"{text}, listed by 'outputs {ID}' and in doc/{page}.md"


STRESS = listed("compute stress (stress/contact) gives a scalar and a vector of 36", "stress", "compute_stress_contact")
MEMORY = listed(
    "compute memory (velocity/memory) gives a scalar, a vector of 6 and an array of 5 rows and 4 columns",
    "memory",
    "compute_velocity_memory",
)
GRAIN = listed("compute grain (contact/grain) gives 7 columns per grain", "grain", "compute_contact_grain")
ROWS = listed("compute rows (contact/local) gives 3 columns per local row", "rows", "compute_contact_local")
PRESS = listed("fix press (press/strain) gives a scalar and a vector of 44", "press", "fix_press_strain")
COMPUTES = [
    "compute stress all stress/contact",
    "variable s equal step",
    "compute memory all velocity/memory strain v_s lags 4",
    "compute grain all contact/grain",
    "compute rows all contact/local branch",
]
# How an index is used, in lines with {}; the reference, what there is.
PLACES = {
    "thermo": ("thermo_style custom step {}", "run 0"),
    "print": ('print "$({})"',),
    "variable": ("variable v equal 2*{}+1", "variable w equal v_v", "thermo_style custom step v_w", "run 0"),
    "ave-time": ("fix mean all ave/time 1 1 1 {} file mean.txt",),
    "ave-correlate": ("fix mean all ave/correlate 1 5 5 c_stress[1] {} file mean.txt",),
    "ave-histo": ("fix mean all ave/histo 1 1 1 0 1 10 {} file mean.txt",),
}
SLICE = ("compute few all slice 1 2 1 {}",)  # of columns
GRAIN_PLACES = {
    "dump": ("dump d all custom 1 d.dump id {}",),
    "reduce": ("compute few all reduce sum {}",),
    "ave-atom": ("fix mean all ave/atom 1 1 1 {}",),
    "store-state": ("fix kept all store/state 0 {}",),
    "dump-modify": ("dump d all custom 1 d.dump id", "dump_modify d thresh {} > 1"),
}
LOCAL_PLACES = {"dump": ("dump d all local 1 d.dump {}",), "reduce": ("compute few all reduce sum {}",)}


def lines_with(place, reference):
    return body(*COMPUTES, *(line.replace("{}", reference) for line in place))


def beyond_the_end(ranks):
    for place in PLACES.values():
        require_refused(lines_with(place, "c_stress[99]"), ranks, "out-of-range", f"c_stress[99]: {STRESS}")
    for place in GRAIN_PLACES.values():
        require_refused(lines_with(place, "c_grain[8]"), ranks, f"c_grain[8]: {GRAIN}")
    for place in LOCAL_PLACES.values():
        require_refused(lines_with(place, "c_rows[4]"), ranks, "out-of-range", f"c_rows[4]: {ROWS}")
    require_refused(lines_with(SLICE, "c_memory[7]"), ranks, f"c_memory[7]: {MEMORY}")
    for place in (PLACES["thermo"], PLACES["print"]):
        require_refused(lines_with(place, "c_memory[6][1]"), ranks, "out-of-range", f"c_memory[6][1]: {MEMORY}")


def of_another_kind(ranks):
    """An index that something has, but not what is asked for."""
    require_refused(lines_with(PLACES["thermo"], "c_memory[7]"), ranks, "out-of-range", f"c_memory[7]: {MEMORY}")
    for place, reference, words, what in (
        (PLACES["thermo"], "c_grain[1]", "does not compute vector", GRAIN),
        (PLACES["print"], "c_stress[1][1]", "Mismatched compute in variable formula", STRESS),
        (PLACES["ave-time"], "c_grain", "does not calculate a scalar", GRAIN),
        (GRAIN_PLACES["dump"], "c_stress", "does not compute per-atom info", STRESS),
    ):
        require_refused(lines_with(place, reference), ranks, words, f"{reference}: {what}")


def of_a_fix(ranks):
    define = "fix press all press/strain axis y target 1e5 every/step 5"
    for place in (PLACES["thermo"], PLACES["print"], PLACES["ave-time"]):
        deck = lines_with((define, *place), "f_press[99]")
        require_refused(deck, ranks, "out-of-range", f"f_press[99]: {PRESS}")


def only_the_wrong_one(ranks):
    """Of several references the one that is wrong."""
    deck = body(*COMPUTES, "thermo_style custom step c_stress[1] c_memory[2] c_stress[37]")
    output = require_refused(deck, ranks, f"c_stress[37]: {STRESS}").output
    require("c_memory[2]:" not in output and "c_stress[1]:" not in output, "a right one is described too")


NO_INDEX = ["[*]", "[0]", "[-1]", "[1][2]", "[2x]", "[]", "[1.5]", "[99999999999]"]


def index_that_is_none(ranks):
    words = "the index in brackets must be a whole number >= 1, got"
    for bad in NO_INDEX:
        require_refused(lines_with(PLACES["ave-time"], f"c_stress{bad}"), ranks, f"{words} '{bad}'", STRESS)
    for name in ("thermo", "print"):
        for bad in ("[*]", "[0]", "[-1]", "[2x]", "[1.5]"):
            require_refused(lines_with(PLACES[name], f"c_stress{bad}"), ranks, f"c_stress{bad}: {STRESS}")
        for bad in ("[4294967297]", "[4294967290]", "[99999999999999999999]"):  # 1 and -6 as an int, and no int
            deck = lines_with(PLACES[name], f"c_stress{bad}")
            require_refused(deck, ranks, "out-of-range", f"c_stress{bad}: {STRESS}")
    places = [("c_stress", place) for place in (PLACES["ave-correlate"], PLACES["ave-histo"], SLICE)]
    places += [("c_grain", place) for place in GRAIN_PLACES.values()]
    places += [("c_rows", place) for place in LOCAL_PLACES.values()]
    for name, place in places:
        require_refused(lines_with(place, f"{name}[*]"), ranks, f"{words} '[*]'", f"compute {name[2:]} (")


def name_that_is_none(ranks):
    for place in (*PLACES.values(), SLICE):
        require_refused(
            lines_with(place, "c_stres[1]"), ranks, "c_stres[1]: there is no compute 'stres': did you mean 'stress'?"
        )
    require_refused(
        lines_with(PLACES["print"], "f_fricton[1]"),
        ranks,
        "f_fricton[1]: there is no fix 'fricton': did you mean 'friction'?",
    )
    deck = lines_with(PLACES["print"], "c_quite_another")
    result = require_refused(deck, ranks, "there is no compute 'quite_another'")
    require("did you mean" not in result.output, "a guess from nowhere")


def names_of_files(ranks):
    """They are not taken for outputs, whatever they begin with."""
    for file in ("c_run.txt", "v_run.dump", "f_run-2.txt"):
        result = require_refused(lines_with((f"dump d all local 1 {file} {{}}",), "c_stress"), ranks, STRESS)
        require("there is no" not in result.output, "the file is described")


PAGE = "'outputs stress' defines variables for all its outputs (doc/compute_stress_contact.md)"


def variable_that_is_none(ranks):
    """Of an output: the command outputs would define it, or its name is misspelt."""
    for place in PLACES.values():
        require_refused(
            lines_with(place, "v_stress_P"), ranks, f"v_stress_P: there is no variable 'stress_P': {PAGE} ("
        )
    misspelt = "v_stress_mu_ef: there is no variable 'stress_mu_ef': did you mean 'stress_mu_eff'?"
    for name in ("thermo", "print", "ave-time"):
        place = ("outputs stress", *PLACES[name])
        require_refused(lines_with(place, "v_stress_mu_ef"), ranks, f"{misspelt} {PAGE} (")
    for text in ('print "P = ${}"', 'if "${} > 1" then "print large"', "velocity all set ${} 0 0"):
        deck = lines_with((text.replace("{}", "{stress_P}"),), "")
        words = f"v_stress_P: there is no variable 'stress_P': {PAGE} ("
        require_refused(deck, ranks, "Substitution for illegal variable; ", words)
    deck = lines_with(("variable all atom vx", 'print "${all}"'), "")
    require_refused(deck, ranks, "Substitution for illegal variable; variable 'all' has no value here (")
    deck = lines_with(PLACES["print"], "v_quite_another")
    require_refused(deck, ranks, "v_quite_another: there is no variable 'quite_another' (")


STYLES = [
    ("compute c all stress/contacts", "Invalid compute style", "stress/contacts", "stress/contact"),
    ("compute c all dissipations", "Invalid compute style", "dissipations", "dissipation"),
    ("compute c all ke/atomm", "Invalid compute style", "ke/atomm", "ke/atom"),
    ("fix f all press/stain axis y", "Invalid fix style", "press/stain", "press/strain"),
    ("fix f all nve/spheriod", "Invalid fix style", "nve/spheriod", "nve/spheroid"),
    ("pair_style gran/in-situ model hertz", "Invalid pair style", "gran/in-situ", "gran/insitu"),
    ("dump d all costum 1 d.dump id", "Invalid dump style", "costum", "custom"),
    ("region r sphre 0 0 0 1", "Invalid region style", "sphre", "sphere"),
]


def misspelt_style(ranks):
    for line, complaint, wrong, right in STYLES:
        require_refused(body(line), ranks, complaint, f"\"{wrong}\": did you mean '{right}'?")
    require_refused(
        "atom_style supperquadric\n", ranks, "Invalid atom style", "\"supperquadric\": did you mean 'superquadric'?"
    )
    result = require_refused(body("compute c all of/nothing/known"), ranks, 'Invalid compute style: "of/nothing/known"')
    require("did you mean" not in result.output, "a guess from nowhere")


def dumps_that_need_vtk(ranks):
    """Of a build without VTK: what it takes, and what does without."""
    words = [f"{style} 10 d*.vtk id type x y z" for style in ("custom/vtk", "custom/vtm", "atom/vtk", "mesh/gran/VTK")]
    words += [f"{style} 10 d*.vtk" for style in ("mesh/vtk", "mesh/vtm", "euler/vtk", "decomposition/vtk")]
    lines = [f"dump d all {one}" for one in (*words, "local/gran/vtk 10 d*.vtk contacts")]
    for line in (*lines, "write_dump all custom/vtk d.vtk id type x y z"):
        style = next(word for word in line.split() if word.endswith(("/vtk", "/VTK", "/vtm")))
        require_refused(body(line), ranks, f'Invalid dump style: "{style}" needs', "-DGRAINSCOPE_VTK=ON", "convert")
    result = require_refused(body("dump d all custom/vtu 10 d*.vtu id"), ranks, 'Invalid dump style: "custom/vtu"')
    require("VTK" not in result.output, "a style that there is not, with VTK or without")
    require_refused(body("write_dump all costum d.dump id"), ranks, "\"costum\": did you mean 'custom'?")


CASES = {
    "all-ranks": all_ranks,
    "one-rank": one_rank,
    "no-screen": no_screen,
    "screen-in-a-file": screen_in_a_file,
    "no-log": no_log,
    "log-by-a-command": log_by_a_command,
    "once-where-both-are-one": once_where_both_are_one,
    "when-the-program-starts": when_the_program_starts,
    "second-signal": second_signal,
    "exception": exception,
    "beyond-the-end": beyond_the_end,
    "of-another-kind": of_another_kind,
    "of-a-fix": of_a_fix,
    "only-the-wrong-one": only_the_wrong_one,
    "index-that-is-none": index_that_is_none,
    "name-that-is-none": name_that_is_none,
    "names-of-files": names_of_files,
    "variable-that-is-none": variable_that_is_none,
    "misspelt-style": misspelt_style,
    "dumps-that-need-vtk": dumps_that_need_vtk,
}

if __name__ == "__main__":
    main(CASES)
