"""The runs of a study, in the order in which they are worth their time: reads its configuration
(examples/study/config.yaml) and tells every run's name, variables and cost."""

import csv
from dataclasses import dataclass
from itertools import product
from pathlib import Path

from grainscope.errors import InputError
from grainscope.program import NAME
from grainscope.study.cost_model import memory_of, seconds_of

LISTS = ("alpha", "mu", "I", "N", "seed")
NUMBERS = {"e": 0.1, "strain": 16.0, "steady": 6.0, "part": 0.125, "ranks": 1, "speed": 1.0}
OTHERS = {
    "measure": "all",
    "groups": (),
    "exceptions": (),
    "output": "study-output",
    "earlier": "",
    "program": NAME,
    "partial": 0,
}
ONLY_GROUP = "all"  # of a study without `groups`
WHOLE = ("N", "seed", "ranks")
MAY_BE_ZERO = ("mu", "steady")


class PlanError(InputError):
    """A configuration that is not what it should be; the message names the keyword, the requirement and the value."""


@dataclass
class PlannedRun:
    name: str
    group: str
    variables: dict  # of the deck
    ranks: int
    speed: float  # of a core over that of the cost model
    seconds: float  # wall time that the cost model expects, on all ranks
    memory: float  # bytes, all ranks

    def value(self, name):
        """A variable of the deck as a number."""
        return float(self.variables[name])

    @property
    def strain(self):
        return self.value("strain")

    def folder(self, output):
        return Path(output) / "runs" / self.name

    def marker(self, output):
        """A file that is there when the run has ended."""
        return self.folder(output) / f"ended_at_{self.variables['strain']}"


def figures_of(measure):
    """File names of the figures that runs with this `measure` can give: the paper's numbers, and two that it tells in
    words."""
    basic = ["fig02", "fig03", "fig04", "fig07", "fig08", "fig14"]
    more = [
        "fig05",
        "fig06",
        "fig09",
        "fig10",
        "fig11",
        "fig12",
        "fig15",
        "fig16",
        "fig17",
        "fig18",
        "memory",
        "layering",
    ]
    return [f"{name}.png" for name in basic + (more if measure == "all" else [])]


def checked(name, value):
    """The value of a keyword, if it is a number that the keyword may have."""
    if isinstance(value, str):  # YAML takes 1e-3 for a word, and only 1.0e-3 for a number
        try:
            value = float(value)
        except ValueError:
            pass
    requirement = ("a whole number" if name in WHOLE else "a number") + (
        " of at least 0" if name in MAY_BE_ZERO else " above 0"
    )
    if (
        isinstance(value, bool)
        or not isinstance(value, (int, float))
        or value < 0
        or (value == 0 and name not in MAY_BE_ZERO)
        or (name in WHOLE and value != int(value))
        or value != value
        or value == float("inf")
    ):
        raise PlanError(f"{name} must be {requirement}, got {value!r}")
    return int(value) if name in WHOLE else value


def checked_list(name, values):
    if not isinstance(values, (list, tuple)) or not values:
        raise PlanError(f"{name} must be a list of at least one number, got {values!r}")
    found = [checked(name, value) for value in values]
    if len(set(found)) < len(found):
        raise PlanError(f"{name} must not name a value twice, got {values!r}")
    return found


def checked_exception(number, exception):
    """The conditions and the values of an entry of `exceptions`."""
    if (
        not isinstance(exception, dict)
        or set(exception) != {"where", "use"}
        or not all(isinstance(part, dict) for part in exception.values())
    ):
        raise PlanError(f"exceptions: entry {number} must be {{where: {{...}}, use: {{...}}}}, got {exception!r}")
    for name in exception["where"]:
        if name not in LISTS:
            raise PlanError(f"exceptions: entry {number}: where must name {', '.join(LISTS)}, got '{name}'")
    allowed = ("N", "e", "strain", "steady", "part", "ranks")
    for name in exception["use"]:
        if name not in allowed:
            raise PlanError(f"exceptions: entry {number}: use must name {', '.join(allowed)}, got '{name}'")
    return tuple({name: checked(name, value) for name, value in exception[part].items()} for part in ("where", "use"))


def planned_run(values, measure, group):
    if values["steady"] >= values["strain"]:
        raise PlanError(
            f"steady must be less than strain = {values['strain']:g}, got {values['steady']:g}, for "
            + ", ".join(f"{name} = {values[name]:g}" for name in LISTS)
        )
    name = "_".join(f"{name}{values[name]:.10g}" for name in LISTS) + (
        f"_e{values['e']:g}" if values["e"] != 0.1 else ""
    )
    variables = {name: f"{values[name]:.10g}" for name in (*LISTS, "e", "strain", "steady", "part")}
    seconds = seconds_of(values["alpha"], values["I"], values["N"], values["strain"], values["ranks"], values["speed"])
    return PlannedRun(
        name,
        group,
        {**variables, "measure": measure},
        values["ranks"],
        values["speed"],
        seconds,
        memory_of(values["N"], values["ranks"]),
    )


def lists_of(config, where=""):
    """The five lists of numbers, one after the other."""
    found = []
    for name in LISTS:
        if name not in config and name != "seed":
            raise PlanError(f"{where}{name} must be a list of at least one number, got nothing")
        try:
            found.append(checked_list(name, config.get(name, [15485863])))
        except PlanError as error:
            raise PlanError(f"{where}{error}") from None
    return found


def lists_of_group(config, number, group):
    """Name and lists of numbers of an entry of `groups`; what its points do not name is as it is for the whole
    study."""
    if (
        not isinstance(group, dict)
        or set(group) != {"name", "points"}
        or not isinstance(group["points"], list)
        or not group["points"]
        or not all(isinstance(points, dict) for points in group["points"])
    ):
        raise PlanError(f"groups: entry {number} must be {{name: ..., points: [{{...}}, ...]}}, got {group!r}")
    found = []
    for points in group["points"]:
        where = f"groups: entry {number} ('{group['name']}'): "
        for name in points:
            if name not in LISTS:
                raise PlanError(f"{where}points must name {', '.join(LISTS)}, got '{name}'")
        lists = {name: value if isinstance(value, list) else [value] for name, value in points.items()}
        found.append(lists_of({**config, **lists}, where))
    return str(group["name"]), found


def groups_of(config):
    """(name, lists of numbers) of each group, in the order in which they are run."""
    listed = config.get("groups") or []
    if not isinstance(listed, (list, tuple)):
        raise PlanError(f"groups must be a list of {{name: ..., points: [...]}}, got {listed!r}")
    if not listed:
        return [(ONLY_GROUP, [lists_of(config)])]
    found = [lists_of_group(config, number, group) for number, group in enumerate(listed, 1)]
    names = [name for name, _ in found]
    for name in names:
        if names.count(name) > 1:
            raise PlanError(f"groups must have different names, got '{name}' twice")
    return found


def plan(config):
    """The runs of a configuration by name: group after group, in each the cheapest first. A run of several groups
    belongs to the first of them."""
    unknown = sorted(set(config) - set(LISTS) - set(NUMBERS) - set(OTHERS))
    if unknown:
        raise PlanError(f"keywords must be among {', '.join([*LISTS, *NUMBERS, *OTHERS])}, got '{unknown[0]}'")
    groups = groups_of(config)
    numbers = {name: checked(name, config.get(name, default)) for name, default in NUMBERS.items()}
    measure = config.get("measure", OTHERS["measure"])
    if measure not in ("basic", "all"):
        raise PlanError(f"measure must be basic or all, got {measure!r}")
    for name in ("output", "earlier"):
        folder = config.get(name, OTHERS[name])
        if not isinstance(folder, str) or any(letter.isspace() for letter in folder) or (name in config and not folder):
            raise PlanError(f"{name} must be the name of a folder without spaces, got {folder!r}")
    listed = config.get("exceptions") or []
    if not isinstance(listed, (list, tuple)):
        raise PlanError(f"exceptions must be a list of {{where: {{...}}, use: {{...}}}}, got {listed!r}")
    exceptions = [checked_exception(number, exception) for number, exception in enumerate(listed, 1)]

    runs = {}
    for group, all_lists in groups:
        found = {}
        for combination in (combination for lists in all_lists for combination in product(*lists)):
            run = planned_run(values_of(combination, numbers, exceptions), measure, group)
            if run.name not in runs:
                found[run.name] = run
        runs.update(sorted(found.items(), key=lambda item: item[1].seconds))
    return runs


def values_of(combination, numbers, exceptions):
    """The numbers of one run."""
    values = {**numbers, **dict(zip(LISTS, combination))}
    axes = dict(values)
    for where, use in exceptions:
        if all(axes[name] == value for name, value in where.items()):
            values.update(use)
    return values


PLAN = ("group", *LISTS, "e", "strain", "steady")


def write_plan(runs, path):
    """plan.csv: a row for each planned run."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(("run", *PLAN))
        for run in runs:
            table.writerow((run.name, run.group, *(run.variables[name] for name in PLAN[1:])))
