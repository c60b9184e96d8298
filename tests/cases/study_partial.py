# SPDX-License-Identifier: GPL-2.0-or-later
"""A study of which only some runs have ended: its status, its tables and figures, and the data set made of it."""
from datetime import datetime, timedelta, timezone
import json
import os
import re
import shutil

from matplotlib.figure import Figure
import yaml

from case import main, require, require_close
from command import asked, require_refused
from grainscope.shear.quantities import MEASURED
from grainscope.study import export, status
from grainscope.study.compare import NOT_RUN
from grainscope.study.cost_model import steps_per_strain
from grainscope.study.earlier import earlier_of
from grainscope.study.plan import plan, write_plan
from grainscope.study.run_grid import Grid
from grainscope.study.slices import read_slices
from grainscope.study.state import RunState
from grainscope.study.table import all_headers, coverage, read_csv, read_study
from shear_runs import SMALL, SOURCE, ended, folder

NOW = datetime(2030, 5, 17, 9, tzinfo=timezone.utc)


def status_of_known_files(ranks):
    """Hours by hand: what ended took 40 ms a step; of the others, 12/16 of one and all of another are left."""
    groups = [{"name": "one", "points": [{"mu": [0.1, 0.4]}]}, {"name": "two", "points": [{"mu": [1, 10]}]}]
    config = {"alpha": [1], "mu": [0], "I": [0.1], "N": [2000], "groups": groups}
    runs, output = list(plan(config).values()), folder("study")
    whole, half, bad, none = runs
    for run in (whole, half, bad):
        run.folder(output).mkdir(parents=True)
    steps = 16 * steps_per_strain(1, 0.1)
    cost = (
        f"# header\n0 {steps / 2:.0f} 1 {0.04 * steps / 2} 1 1\n{steps / 2:.0f} {steps:.0f} 1 {0.04 * steps / 2} 1 1\n"
    )
    (whole.folder(output) / "cost.txt").write_text(cost)
    whole.marker(output).touch()
    (half.folder(output) / "parameters.txt").write_text("# header\n2000 1 0 500\n")
    (half.folder(output) / "from_500").mkdir()
    (half.folder(output) / "from_500" / "series.txt").write_text("# step strain[-]\n900 3.9 1\n1000 4.0 1\n1100 4.1")
    (bad.folder(output) / "failed.txt").write_text("exit status 1: ERROR: lost grains <all>\n")
    (bad.folder(output) / "screen.txt").write_text("one\ntwo\nthree\nERROR: lost grains <all>\n")
    (output / "slices.csv").write_text(
        "begin,end,hours,jobs\n2030-05-15T09:00:00+00:00,2030-05-15T12:00:00+00:00,3,2\n"
    )
    found = status.status_of(runs, output, NOW)

    one = 0.04 * steps / 3600
    for group, counts, spent, left in zip(
        found.groups, ([2, 1, 0, 1, 0, 0], [2, 0, 0, 0, 1, 1], [4, 1, 0, 1, 1, 1]), (1, 0, 1), (0.75, 2, 2.75)
    ):
        require([*map(int, group.cells()[1:7])] == counts, f"{group.name}: {group.cells()}")
        require_close([group.spent, group.left], [spent * one, left * one], 1e-5, group.name)  # steps are whole
    text = status.markdown(found)
    require(f"{2.75 * one:.1f} core-hours are left: {2.75 * one / 2:.1f} hours of slices with 2 jobs" in text, text)
    # spent in two days: what is left, 2.75 times as much, takes 5.5 days
    require(f"the study ends on {NOW + timedelta(days=5.5):%Y-%m-%d} " in text, text)
    require("1 slices so far, 3.00 hours" in text, text)
    require(f"- {bad.name}: exit status 1: ERROR: lost grains <all>" in text and "\n      three\n" in text, text)
    require("\n      one\n" not in text, "only the last lines")
    page = status.page(found)
    require("lost grains &lt;all&gt;" in page and page.count("<tr>") == 4, page)


def status_of_nothing(ranks):
    runs = list(plan({"alpha": [1], "mu": [0], "I": [0.1], "N": [2000]}).values())
    found = status.status_of(runs, folder("none"), NOW)
    require("No slice has been run" in found.sentences[0], f"{found.sentences}")
    done = status.groups_of(runs, {runs[0].name: RunState("ended", 16, 10, 1.0)})
    require(status.expected_end(done[-1], read_slices(folder("none")), NOW) == ["All runs have ended."], "an end")


def one_of_two():
    """Folder of a study of which one run of two has ended, and the file of its configuration."""
    names = ("measure", "strain", "steady", "part")
    config = {**{name: SMALL[name] for name in names}, "alpha": [1], "mu": [0.4, 1], "I": [0.1], "N": [SMALL["N"]]}
    config.update(output=str(folder("study")), program=os.environ["GRAINSCOPE_BINARY"])
    runs = list(plan(config).values())
    ended(runs[0].folder(folder("study")), mu=0.4, e=0.1, seed=runs[0].variables["seed"])
    runs[0].marker(folder("study")).touch()
    folder("study.yaml").write_text(yaml.safe_dump(config))
    write_plan(runs, folder("plan.csv"))
    return runs, folder("study.yaml")


def texts_of_figures(*words):
    """The texts on the figures that a command saves, one list for each."""
    found, save = [], Figure.savefig
    Figure.savefig = lambda figure, path, **_: found.append([text.get_text() for text in figure.texts])
    try:
        code, said = asked(*words)
    finally:
        Figure.savefig = save
    require(code == 0, said)
    return found


def partial_is_marked(ranks):
    """In the table, the fits, the comparison and on every picture; and not where nothing is missing."""
    runs, _ = one_of_two()
    words = ["study", "table", f"{runs[0].folder(folder('study'))}:0.2"]
    for output, plan_words, covered in (
        ("part", ["--plan", folder("plan.csv")], "partial: 1 of 2 points"),
        ("whole", [], "1 of 1 points"),
    ):
        code, said = asked(*words, *plan_words, "--output", folder(output))
        require(code == 0 and str(coverage(folder(output))) == covered, f"{said}: {coverage(folder(output))}")
        require(len(read_study(folder(output))) == 1, "only what has ended is a run")
        for command in ("fit", "compare"):
            code, said = asked("study", command, folder(output), "--output", folder(output))
            require(code == 0, said)
        for row in read_csv(folder(output) / "comparison.csv"):
            require(row["coverage"] == covered, f"{row}")
        figures = ["fig02.png", "fig03.png", "fig11.png"]
        texts = texts_of_figures("study", "plot", folder(output), *figures, "--output", folder("figures"))
        require([covered in found for found in texts] == 3 * [output == "part"], f"{output}: {texts}")
        _, said = asked("study", "cost", folder(output))
        require(f"\n{covered}: " in said, said)
    rows = {row["run"]: row for row in read_csv(folder("part") / "table.csv")}
    require([rows[run.name]["state"] for run in runs] == ["ended", "not run"], f"{rows}")
    missing = rows[runs[1].name]
    require((missing["mu"], missing["mu_eff"]) == ("1", ""), f"{missing}")
    part, whole = ((folder(name) / "comparison.md").read_text() for name in ("part", "whole"))
    require(part.startswith("**partial: 1 of 2 points**") and NOT_RUN in part, part)
    require("These runs do not tell: " in whole and "artial" not in whole and NOT_RUN not in whole, whole)
    quantities = [row["quantity"] for row in read_csv(folder("part") / "comparison.csv") if row["agrees"] == NOT_RUN]
    require("I_c ~ mu^p, alpha = 1" in quantities and "largest Z of spheres" not in quantities, f"{quantities}")


def table_refusals(ranks):
    require_refused(["study", "table", "--output", folder("t")], "run must be at least one folder, got none")
    runs, _ = one_of_two()
    out = runs[0].folder(folder("study"))
    require_refused(["study", "table", out, "--plan", folder("none"), "--output", folder("t")], "none: No such file")
    folder("bad.csv").write_text("name\na\n")
    require_refused(
        ["study", "table", out, "--plan", folder("bad.csv"), "--output", folder("t")],
        "must have a column 'run', has name",
    )


def data_set(ranks):
    """Everything is there, described and dated; the figures can be made of it alone."""
    runs, config = one_of_two()
    code, said = asked("study", "export", config, "--output", folder("data"), "--title", "Two runs")
    require(code == 0 and "partial: 1 of 2 points" in said, said)
    data = folder("data")
    described = {(row["file"], row["column"]): row for row in read_csv(data / "columns.csv")}
    for path in [data / "table.csv", *(data / "curves").iterdir()]:
        file = str(path.relative_to(data))
        for column in path.read_text().splitlines()[0].split(","):
            row = described.get((file, column), {})
            require(row.get("meaning") and row.get("source"), f"{file}, {column}: {row}")
            page = re.match(r"(doc|examples)/[\w/.]+", row["source"])
            require(not page or (SOURCE / page[0]).exists(), f"no such file: {row['source']}")
    require(described["table.csv", "instant_n"]["source"] == "Eq. (4)", "source of the powers of Eq. 4")
    found = json.loads((data / "provenance.json").read_text())
    one = found["runs"][runs[0].name]
    require(one["seed"] == "15485863" and " mu=0.4 " in one["command"] and len(one["attempts"]) == 1, f"{one}")
    require("grainscope" in one["programs"][0], f"{one}")
    attempt = one["attempts"][0]
    require(len(found["programs"][attempt["program"]]["sha256"]) == 64, f"{found['programs']}")
    require(found["machines"][attempt["machine"]]["cores"] == os.cpu_count(), f"{found['machines']}")
    require(found["tools"]["versions"]["numpy"] and found["coverage"] == "partial: 1 of 2 points", f"{found}")
    text = "".join(path.read_text() for path in data.iterdir() if path.is_file())
    require(str(folder("")) not in text and str(SOURCE) not in text, "paths of this machine are no part of the data")
    for name in re.findall(r"^\| `([^`]+)` ", (data / "README.md").read_text(), re.M):
        require((data / name).exists(), f"README.md names {name}")
    shutil.rmtree(folder("study"))
    code, said = asked("study", "plot", data, "fig11.png", "--output", folder("again"))
    require(code == 0 and (folder("again") / "fig11.png").exists(), said)


def without_figures(*_):
    """In place of export.draw_all, which takes most of the time."""


def lines_of(path, name):
    return [line for line in path.read_text().splitlines() if line.startswith(name)]


def earlier_runs(ranks):
    """Of two runs one ended elsewhere, and is known by its data set: it is not made again, and the tables and the data
    set of both have its rows to the letter, also where the data set is written over its own."""
    export.draw_all = without_figures
    runs, first = one_of_two()
    one, other = (run.name for run in runs)
    asked("study", "export", first, "--output", folder("data"))
    before = {path: lines_of(path, one) for path in (folder("data") / "curves").iterdir()}
    row = lines_of(folder("data") / "table.csv", one)
    attempts = json.loads((folder("data") / "provenance.json").read_text())["runs"][one]
    shutil.rmtree(folder("study"))

    config = {**yaml.safe_load(first.read_text()), "earlier": str(folder("data"))}
    folder("study.yaml").write_text(yaml.safe_dump(config))
    known = earlier_of(config, runs)
    grid = Grid(runs, folder("study"), "program", 1, 1e9, earlier=known)
    require(grid.next_run().name == other, f"{grid.next_run().name} is made again")
    require(grid.states[one].seconds == float(read_csv(folder("data") / "table.csv")[0]["core_time"]), "its time")
    code, said = asked("study", "status", folder("study.yaml"))
    require(code == 0 and "| all | 2 | 1 | 0 | 0 | 1 | 0 |" in said, said)
    write_plan(runs, folder("plan.csv"))
    words = ["--plan", folder("plan.csv"), "--earlier", folder("data"), "--output", folder("tables")]
    code, said = asked("study", "table", *words)
    require(code == 0 and str(coverage(folder("tables"))) == "partial: 1 of 2 points", said)

    ended(runs[1].folder(folder("study")), mu=1, e=0.1, seed=runs[1].variables["seed"])
    runs[1].marker(folder("study")).touch()
    for _ in range(2):  # the second time both are in the data set, and one of them in the folder too
        code, said = asked("study", "export", folder("study.yaml"), "--output", folder("data"))
        require(code == 0 and "2 of 2 points" in said and "partial" not in said, said)
        require(sorted(run.name for run in read_study(folder("data"))) == sorted((one, other)), "two runs")
        require(lines_of(folder("data") / "table.csv", one) == row, "its row")
        for path, lines in before.items():
            require(lines and lines_of(path, one) == lines, f"{path.name}: its lines")
            require(len(lines_of(path, other)) > 5, f"{path.name}: the other's lines")
        found = json.loads((folder("data") / "provenance.json").read_text())
        require(found["runs"][one] == attempts and len(found["runs"][other]["attempts"]) == 1, f"{found['runs']}")
        for attempt in (found["runs"][name]["attempts"][0] for name in (one, other)):
            require(len(found["programs"][attempt["program"]]["sha256"]) == 64, f"{found['programs']}")
        require(str(folder("")) not in (folder("data") / "provenance.json").read_text(), "a path of this machine")


def earlier_refused(ranks):
    """What is not of this study, and what is no data set."""
    export.draw_all = without_figures
    runs, config = one_of_two()
    asked("study", "export", config, "--output", folder("data"))
    study = yaml.safe_load(config.read_text())
    export_it = ["study", "export", folder("other.yaml"), "--output", folder("again")]
    for change, expected in (
        ({"strain": 0.9}, f"table.csv: {runs[0].name}: strain must be 0.9 as in the study, is 0.6"),
        ({"steady": 0.3}, "steady must be 0.3 as in the study, is 0.2"),
        ({"earlier": str(folder("none"))}, "table.csv: No such file"),
        ({"earlier": "two words"}, "earlier must be the name of a folder without spaces, got 'two words'"),
        ({"earlier": 3}, "earlier must be the name of a folder without spaces, got 3"),
    ):
        folder("other.yaml").write_text(yaml.safe_dump({**study, "earlier": str(folder("data")), **change}))
        require_refused(export_it, expected)
    require_refused(["study", "table", "--earlier", folder("data")], "--earlier needs --plan")
    folder("other.yaml").write_text(
        yaml.safe_dump({**study, "earlier": str(folder("data")), "output": str(folder("new"))})
    )
    curve = folder("data") / "curves" / "direction.csv"
    kept = curve.read_text()
    curve.write_text(kept.replace("run,", "run,x", 1))
    require_refused(export_it, "direction.csv: must have a column")
    curve.write_text(kept)
    (folder("data") / "provenance.json").write_text('{"runs": {}}')
    require_refused(export_it, f"provenance.json: must name the run '{runs[0].name}'")
    table = folder("data") / "table.csv"
    names, *lines = (line.split(",") for line in table.read_text().splitlines())
    basic = [["" if name in MEASURED else word for name, word in zip(names, line)] for line in lines]
    table.write_text("".join(",".join(line) + "\n" for line in [names, *basic]))
    require_refused(export_it, "must have been run with measure all, was with basic")


def data_set_refused(ranks):
    """What is too large, and what has no runs."""
    folder("study.yaml").write_text(yaml.safe_dump({"alpha": [1], "mu": [0], "I": [0.1], "N": [100]}))
    require_refused(
        ["study", "export", folder("study.yaml"), "--output", folder("data")], "at least one run that has ended"
    )
    folder("large").mkdir()
    for name, size in (("small.csv", 300), ("picture.png", 800)):
        (folder("large") / name).write_bytes(size * b"x")
    require(export.size_of(folder("large"), 1100) == 1100, "1100 bytes are allowed")
    try:
        export.size_of(folder("large"), 1099)
    except export.InputError as error:
        require("must be at most 0.001099 MB" in str(error) and "picture.png" in str(error), str(error))
    else:
        require(False, "1100 bytes were taken")
    require(export.LIMIT == 20e6, "the limit is 20 MB")


def same_metadata(cff, zenodo, kind):
    """CITATION.cff and .zenodo.json say the same."""
    for name in ("title", "version"):
        require(cff[name] == zenodo[name], f"{name}: {cff[name]!r} and {zenodo[name]!r}")
    require((cff["type"], zenodo["upload_type"]) == (kind, kind), f"{cff['type']}, {zenodo['upload_type']}")
    require(cff["abstract"] == zenodo["description"], f"{cff['abstract']!r} and {zenodo['description']!r}")
    require(cff["license"].lower() == zenodo["license"].lower(), f"{cff['license']} and {zenodo['license']}")
    require(
        [author["name"] for author in cff["authors"]] == [creator["name"] for creator in zenodo["creators"]], "authors"
    )
    dois = [reference["doi"] for reference in cff["references"]]
    require(dois == [one["identifier"] for one in zenodo["related_identifiers"]], f"references {dois}")


def metadata(ranks):
    cff = yaml.safe_load((SOURCE / "CITATION.cff").read_text())
    same_metadata(cff, json.loads((SOURCE / ".zenodo.json").read_text()), "software")
    project = re.search(r"project\(grainscope VERSION (\S+)", (SOURCE / "CMakeLists.txt").read_text())
    require(project[1] == cff["version"], f"version {project[1]} in CMakeLists.txt, {cff['version']} in CITATION.cff")
    cff, zenodo = export.citation("Two runs", "1 of 2 points")
    same_metadata(yaml.safe_load(cff), json.loads(zenodo), "dataset")


def every_column_has_a_source(ranks):
    headers = list(all_headers())
    require(len(headers) > 100 and all(row[3] and row[4] for row in headers), "a column without a source")


main(
    {
        "status-of-known-files": status_of_known_files,
        "status-of-nothing": status_of_nothing,
        "partial-is-marked": partial_is_marked,
        "table-refusals": table_refusals,
        "data-set": data_set,
        "earlier-runs": earlier_runs,
        "earlier-refused": earlier_refused,
        "data-set-refused": data_set_refused,
        "metadata": metadata,
        "every-column-has-a-source": every_column_has_a_source,
    }
)
