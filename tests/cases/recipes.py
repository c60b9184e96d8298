# SPDX-License-Identifier: GPL-2.0-or-later
"""What pages show of going on with a run, taken from them word by word: a first run, killed; the second goes on; both
together are the uninterrupted run, to the bit where the page says so."""
import os
from pathlib import Path
import re
import shlex
import shutil
import signal
import subprocess

import numpy as np

from case import main, require, require_close, require_equal
from grainscope.columns import outputs
from run import TIME_LIMIT, Failure, Result, Started, binary, environment, kill_session, wait_until

SOURCE = Path(os.environ["GRAINSCOPE_SOURCE"])
EXAMPLE = SOURCE / "examples" / "long_run"
DECK = (EXAMPLE / "in.long_run").read_text()
PAGE = (SOURCE / "doc" / "read_restart.md").read_text()
STEPS, SHORT = 40000, 800
FIRST = ["grainscope", "-in", "in.long_run"]


def section(text, heading):
    return re.split(r"^#", f"\n{text}".split(f"\n{heading}\n")[1], flags=re.M)[0]


def recipe():
    """The input script under `## Recipe`."""
    return re.search(r"^```\n(.*?)^```", section(PAGE, "## Recipe"), flags=re.M | re.S)[1]


def commands(page, heading):
    """The commands of the first run and of the one that goes on, in the first two indented lines that have any."""
    found = re.findall(r"^    ((?:mpirun .*)?grainscope .*)", section(page.read_text(), heading), flags=re.M)
    return [shlex.split(line, comments=True) for line in found]


class Run:
    """A command in a folder, as a user gives it: the program is on PATH."""

    def __init__(self, words, folder):
        ranks = 2 if words[0] == "mpirun" else 1
        env = environment(ranks)
        env["PATH"] = f"{Path(binary()).parent}{os.pathsep}{env['PATH']}"
        env.update(OMPI_MCA_hwloc_base_binding_policy="none", PRTE_MCA_hwloc_default_binding_policy="none")
        self.folder = folder
        with (folder / "output").open("w") as output:
            self._process = subprocess.Popen(
                words, cwd=folder, env=env, stdout=output, stderr=subprocess.STDOUT, start_new_session=True
            )

    def killed_when(self, condition):
        """SIGKILL, as soon as the condition holds; false when the run ended before."""
        wait_until(lambda: condition() or self._process.poll() is not None, "what a run is killed at")
        kill_session(self._process.pid)
        return self._process.wait() != 0

    def end(self):
        code = self._process.wait(TIME_LIMIT)
        result = Result(self.folder, code, (self.folder / "output").read_text())
        require(code == 0, f"code {code}: {result.output[-2000:]}")
        return result


def folder_with_deck(name, deck=DECK):
    folder = Path(os.environ["GRAINSCOPE_SCRATCH"]) / name
    folder.mkdir()
    (folder / "in.long_run").write_text(deck)
    return folder


def rows(folder, end):
    """Rows of all its tables as text, by step: of tables that follow one another the later one counts."""
    tables = sorted(folder.glob("flow.*.txt"), key=lambda file: int(file.name.split(".")[1]))
    found = {}
    for table in tables:
        begun = int(table.name.split(".")[1])
        found = {step: row for step, row in found.items() if step <= begun}
        for line in table.read_text().splitlines():
            if not line.startswith("#"):
                found[int(line.split()[0])] = line
    require(max(found) == end, f"the last row is of step {max(found)}")
    return found


def require_same_end(folder, expected, steps=STEPS):
    require(
        (folder / "grains.dump").read_bytes() == (expected / "grains.dump").read_bytes(),
        "the grains are not those of the uninterrupted run",
    )
    require(rows(folder, steps) == rows(expected, steps), "the tables are not those of the uninterrupted run")


def both_restart_files(folder):
    return lambda: (folder / "odd.restart").exists()


def killed_half_way(words, deck=DECK):
    """The folder of a run that was killed when it had begun its second restart file. On a busy machine one may end
    before that is seen: then the next is."""
    for attempt in range(100):
        folder = folder_with_deck(f"killed-{attempt}", deck)
        if Run(words, folder).killed_when(both_restart_files(folder)):
            return folder
    raise Failure("no run could be killed")


def killed_as_shown(page, heading, at=0, shorter=()):
    """A page's two commands, the first killed when it has begun its second restart file. `shorter`: words for two
    ranks, which wait for one another on a busy machine."""

    def case(ranks):
        first, second = ([*words, *shorter] for words in commands(page, heading)[at : at + 2])
        whole, killed = folder_with_deck("whole"), killed_half_way(first)
        Run(first, whole).end()
        result = Run(second, killed).end()
        require("read_restart: reading" in result.output, "no restart file was read")
        require(len(list(killed.glob("flow.*.txt"))) == 2, "the run did not begin a table of its own")
        require_same_end(killed, whole, SHORT if shorter else STEPS)

    return case


def written_out(ranks):
    """The script of read_restart's page, on the files of the example; its first row of thermo output, too."""
    whole, killed = folder_with_deck("whole"), killed_half_way(FIRST)
    expected = Run(FIRST, whole).end().thermo()[-1]
    (killed / "in.resumed").write_text(recipe())
    found = Run(["grainscope", "-in", "in.resumed"], killed).end().thermo()[-1]
    require_same_end(killed, whole)
    shared = expected["step"] >= found["step"][0]
    require(2 <= len(found["step"]) < len(expected["step"]), "the run did not go on half-way")
    for name, values in found.items():
        require_equal(values, expected[name][shared], name)


def prolonged_as_shown(ranks):
    """simple_shear's two commands, with less strain and fewer grains: the second prolongs what the first has ended."""
    example = SOURCE / "examples" / "simple_shear"
    first, second = commands(example / "README.md", "## Going on")
    smaller = {"8": "0.2", "16": "0.4", "0.125": "0.1"}
    first, second = ([smaller.get(word, word) for word in words] + ["-var", "N", "100"] for words in (first, second))
    require(second[-5:-3] == ["resume", "1"] and "0.2" in first and "0.4" in second, f"the page shows {second}")
    scratch = Path(os.environ["GRAINSCOPE_SCRATCH"])
    whole, parts = (shutil.copytree(example, scratch / name) for name in ("whole", "parts"))
    Run([word if word != "0.2" else "0.4" for word in first], whole).end()
    for words in (first, second):
        Run(words, parts).end()
    found, expected = ((folder / "out" / "grains.dump").read_bytes() for folder in (parts, whole))
    require(found == expected, "the grains are not those of the uninterrupted run")


def stopped_in_order(ranks):
    """By SIGTERM without `write_restart_on_signal no`, and on with the page's line: from the very step."""
    line = re.search(r"^    (read_restart .*)$", section(PAGE, "## Recipe"), flags=re.M)[1]
    without = re.sub(r"^write_restart_on_signal no.*\n", "", DECK, flags=re.M)
    require(without != DECK and "read_restart    even.restart odd.restart\n" in DECK, "the example is another")
    deck = without.replace("read_restart    even.restart odd.restart\n", line + "\n")
    first = Started(deck)
    wait_until(both_restart_files(first.folder), "its second restart file")
    for pid in first.ranks():
        os.kill(pid, signal.SIGTERM)
    result = first.end()
    left = list(result.folder.glob("restart_forced_liggghts_*.data"))
    require(result.code == 0 and len(left) == 1, f"code {result.code}, restart files: {left}")
    again = Started(deck, folder=first.folder, arguments=["-var", "resume", "1"]).end()
    require(f"read_restart: reading '{left[0].name}'" in again.output and again.code == 0, again.output[-2000:])
    step = int(left[0].name.split("_")[-1].split(".")[0])
    require(again.thermo()[-1]["step"][[0, -1]].tolist() == [step, STEPS], "it did not go on from there to the end")


def first_rows(ranks):
    """What the page says of them: a row whose samples began before is left out, P_t is 0 at first, and with tangential
    damping so are other tangential forces, while the motion is the same."""
    loss, stress = outputs("dissipation").of("power"), outputs("stress/contact").of("stress")
    names = [stress["P"], stress["syy_normal"], stress["Z"], loss["P_n"], loss["P_t"]]
    for damping in ("off", "on"):
        deck = DECK.replace("tangential_damping off", f"tangential_damping {damping}")
        deck = re.sub(r"^thermo_style.*", f"thermo_style custom step {' '.join(names)}", deck, flags=re.M)
        deck = deck.replace("thermo_modify   flush yes", "thermo_modify   flush yes format float %.17g\nthermo 50")
        words = [*FIRST, "-var", "part", "550"]
        whole, parts = folder_with_deck(f"whole-{damping}", deck), folder_with_deck(f"parts-{damping}", deck)
        expected = Run([*words, "-var", "steps", "3000"], whole).end().thermo()[-1]
        Run([*words, "-var", "steps", "1650"], parts).end()
        found = Run([*words, "-var", "steps", "3000", "-var", "resume", "1"], parts).end().thermo()[-1]
        shared = expected["step"] >= 1650
        for name in names:
            require_equal(found[name][1:], expected[name][shared][1:], f"{name} after the first row")
        first = {name: (found[name][0], expected[name][shared][0]) for name in names}
        require(first[loss["P_t"]][0] == 0.0 < first[loss["P_t"]][1], f"P_t at first: {first[loss['P_t']]}")
        same = [stress["syy_normal"], stress["Z"], *([stress["P"]] if damping == "off" else [])]
        for name in same:
            require_close(*first[name], 1e-12, f"{name} in the first row")  # sums in another order
        change = abs(np.subtract(*first[stress["P"]])) / first[stress["P"]][1]
        require(damping == "off" or 1e-5 < change < 0.05, f"the first P is off by {change}, the page says up to 2 %")
        require(set(rows(whole, 3000)) - set(rows(parts, 3000)) == {1700}, "another row than that of 1700 is missing")
        require((whole / "grains.dump").read_bytes() == (parts / "grains.dump").read_bytes(), "the motion differs")


def with_ledger(ranks):
    """The two words that compute energy/ledger's page adds to the recipe: totals go on."""
    page = (SOURCE / "doc" / "compute_energy_ledger.md").read_text()
    words, line = re.search(
        r"needs `(.*?)` in its pair_style line and the line `(.*?)`", " ".join(page.split())
    ).groups()
    printed = " ".join(outputs("energy/ledger").of("ledger").vector()[:8])

    def ledgered(deck):
        deck, count = re.subn(r"^(pair_style .*)", rf"\1 {words}", deck, flags=re.M)
        deck, also = re.subn(r"^(outputs +power)", rf"\1\n{line}", deck, flags=re.M)
        require(count == also == 1, "the recipe has no such lines")
        return re.sub(r"^thermo_style.*", f"thermo_style custom step {printed}", deck, flags=re.M)

    whole, killed = folder_with_deck("whole", ledgered(DECK)), killed_half_way(FIRST, ledgered(DECK))
    expected = Run(FIRST, whole).end().thermo()[-1]
    (killed / "in.resumed").write_text(ledgered(recipe()))
    found = Run(["grainscope", "-in", "in.resumed"], killed).end().thermo()[-1]
    for name, values in found.items():
        require_equal(values, expected[name][-len(values) :], name)


def complete_wherever_shown(ranks):
    """A block of several lines that reads a restart file says what LIGGGHTS wants before."""
    pages = [*SOURCE.glob("*.md"), *(SOURCE / "doc").glob("*.md"), *(SOURCE / "examples").rglob("*.md")]
    shown = 0
    for page in pages:
        for block in re.findall(r"(?:^```\n.*?^```|(?:^    .*\n)+)", page.read_text(), flags=re.M | re.S):
            lines = [line for line in block.splitlines() if line.strip() and not line.startswith("```")]
            if len(lines) < 2 or not any(line.split()[0] == "read_restart" for line in lines):
                continue
            shown += 1
            for needed in ("atom_style", "newton off", "communicate single vel yes", "pair_style gran/insitu"):
                require(needed in " ".join(block.split()), f"{page.name} reads a restart file without '{needed}'")
    require(shown >= 1, "no page shows how to go on")


def files_to_copy(ranks):
    """The example's own scripts are named on its page, and what its page names is there."""
    text = (EXAMPLE / "README.md").read_text()
    named = set(re.findall(r"`((?:job|array)\.\w+)`", text))
    there = {file.name for file in EXAMPLE.iterdir() if file.name.startswith(("job.", "array."))}
    require(named == there, f"named: {named}, there: {there}")
    require(shutil.which("bash"), "bash is missing")
    for name in there:
        done = subprocess.run(["bash", "-n", EXAMPLE / name], capture_output=True, text=True)
        require(done.returncode == 0, done.stderr)


main(
    {
        "running": killed_as_shown(SOURCE / "doc" / "running.md", "## Long runs"),
        "example": killed_as_shown(EXAMPLE / "README.md", "# A long run"),
        "example-with-mpirun": killed_as_shown(
            EXAMPLE / "README.md", "# A long run", 2, ["-var", "steps", str(SHORT), "-var", "part", "200"]
        ),
        "written-out": written_out,
        "prolonged-as-shown": prolonged_as_shown,
        "stopped-in-order": stopped_in_order,
        "first-rows": first_rows,
        "with-ledger": with_ledger,
        "complete-wherever-shown": complete_wherever_shown,
        "job-scripts-are-named": files_to_copy,
    }
)
