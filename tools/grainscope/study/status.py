"""Tells how far a study is: what has ended, runs, was begun, failed and is left, group by group, in runs and hours, and
when all of it will have ended. Prints it, and writes status.md and status.html into the study's output folder."""
from collections import Counter
from dataclasses import dataclass
from datetime import timedelta
import html
from pathlib import Path

from grainscope.study.earlier import Earlier, earlier_of
from grainscope.study.plan import OTHERS, plan
from grainscope.study.planned import read_config
from grainscope.study.slices import now, read_slices
from grainscope.study.state import BEGUN, ENDED, FAILED_RUN, RUNNING, WAITING, Speed, state_of

STATES = (ENDED, RUNNING, BEGUN, WAITING, FAILED_RUN)
COLUMNS = ("group", "runs", *STATES, "core-hours spent", "core-hours left")
LAST_LINES = 3  # of the screen output of a failed run


@dataclass
class Group:
    name: str
    runs: int
    counts: Counter
    spent: float  # core-hours
    left: float

    def cells(self):
        counts = [str(self.counts[state]) for state in STATES]
        return [self.name, str(self.runs), *counts, f"{self.spent:.2f}", f"{self.left:.2f}"]


def group_of(name, runs, states, speed):
    found = [(run, states[run.name]) for run in runs]
    return Group(
        name,
        len(found),
        Counter(state.state for _, state in found),
        sum(run.ranks * state.seconds for run, state in found) / 3600,
        sum(run.ranks * speed.seconds_left(run, state) for run, state in found) / 3600,
    )


def groups_of(runs, states):
    """One Group for each name, and one of all."""
    speed = Speed(runs, states)
    names = list(dict.fromkeys(run.group for run in runs))
    found = [group_of(name, [run for run in runs if run.group == name], states, speed) for name in names]
    return found + ([group_of("together", runs, states, speed)] if len(found) > 1 else [])


def expected_end(whole, slices, at):
    """Sentences on when the study will have ended: with the jobs of the last slice, and at the rate since the first
    one."""
    if not whole.left:
        return ["All runs have ended."]
    if not slices:
        return [f"No slice has been run; {whole.left:.1f} core-hours are left."]
    jobs = int(slices[-1]["jobs"])
    found = [f"{whole.left:.1f} core-hours are left: {whole.left / jobs:.1f} hours of slices with {jobs} jobs."]
    days = (at - slices[0]["begin"]).total_seconds() / 86400
    if whole.spent and days > 0:
        rate = whole.spent / days
        end = at + timedelta(days=whole.left / rate) if whole.left / rate < 36500 else None
        when = f"on {end:%Y-%m-%d %H:%M} UTC" if end else "in more than a century"
        found.append(
            f"Since the first slice, on {slices[0]['begin']:%Y-%m-%d %H:%M} UTC, {rate:.1f} core-hours a day; at this "
            f"rate the study ends {when}."
        )
    return found


def last_lines(folder):
    try:
        return (folder / "screen.txt").read_text(errors="replace").splitlines()[-LAST_LINES:]
    except OSError:
        return []


@dataclass
class Status:
    at: object
    groups: list
    sentences: list
    running: list  # (name, strain reached, strain)
    failures: list  # (name, reason, last lines)


def status_of(runs, output, at, earlier=Earlier()):
    states = {run.name: state_of(run, output, earlier) for run in runs}
    groups = groups_of(runs, states)
    slices = read_slices(output)
    hours = sum((row["end"] - row["begin"]).total_seconds() for row in slices if row["end"]) / 3600
    sentences = [f"{len(slices)} slices so far, {hours:.2f} hours in those that ended in order."] if slices else []
    return Status(
        at,
        groups,
        sentences + expected_end(groups[-1], slices, at),
        [(run.name, states[run.name].strain, run.strain) for run in runs if states[run.name].state == RUNNING],
        [
            (run.name, states[run.name].failure, last_lines(run.folder(output)))
            for run in runs
            if states[run.name].state == FAILED_RUN
        ],
    )


def markdown(status):
    lines = [f"# The study at {status.at:%Y-%m-%d %H:%M} UTC", ""]
    rows = [COLUMNS, ["---"] * len(COLUMNS), *(group.cells() for group in status.groups)]
    lines += [f"| {' | '.join(row)} |" for row in rows]
    lines += ["", *status.sentences]
    if status.running:
        lines += ["", "## Running", ""]
        lines += [f"- {name}: strain {strain:.2f} of {end:g}" for name, strain, end in status.running]
    if status.failures:
        lines += ["", "## Failed", ""]
        for name, reason, last in status.failures:
            lines += [f"- {name}: {reason}", "", *(f"      {line}" for line in last), ""]
    return "\n".join(lines).rstrip() + "\n"


def row_of(cells, tag):
    return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>"


def page(status):
    title = f"The study at {status.at:%Y-%m-%d %H:%M} UTC"
    body = ["<table>", row_of(COLUMNS, "th"), *(row_of(group.cells(), "td") for group in status.groups), "</table>"]
    body += [f"<p>{html.escape(sentence)}</p>" for sentence in status.sentences]
    if status.running:
        rows = [row_of((name, f"{strain:.2f}", f"{end:g}"), "td") for name, strain, end in status.running]
        body += ["<h2>Running</h2>", "<table>", row_of(("run", "strain", "of"), "th"), *rows, "</table>"]
    if status.failures:
        body.append("<h2>Failed</h2>")
        for name, reason, last in status.failures:
            body += [
                f"<p>{html.escape(name)}: {html.escape(reason)}</p>",
                f"<pre>{html.escape(chr(10).join(last))}</pre>",
            ]
    style = "body{font-family:sans-serif}td,th{padding:.2em .8em;text-align:right}td:first-child{text-align:left}"
    return (
        f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{title}</title><style>{style}</style>'
        f"</head>\n<body><h1>{title}</h1>\n" + "\n".join(body) + "\n</body></html>\n"
    )


def add_arguments(parser):
    parser.add_argument("config", help="configuration of the study, such as examples/study/config.yaml")


def run(arguments):
    config = read_config(arguments.config)
    output = Path(config.get("output", OTHERS["output"]))
    runs = list(plan(config).values())
    status = status_of(runs, output, now(), earlier_of(config, runs))
    output.mkdir(parents=True, exist_ok=True)
    text = markdown(status)
    (output / "status.md").write_text(text)
    (output / "status.html").write_text(page(status))
    print(text, end="")
