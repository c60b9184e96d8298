"""Draws files of fix field/write (csv): profiles of a grid with one resolved axis, with errors as bands; maps of one
with two, a row for each file; slices of one with three. Draws tables of fix ave/time mode vector and of fix
ave/spatial as profiles, a line for each step. A panel is for a column, or for a vector by what its components have in
common."""
from pathlib import Path
import re

from grainscope.figures.style import RUN_COLOURS as COLOURS, save
from grainscope.tables import files_and_columns
import matplotlib.pyplot as plt
from matplotlib.animation import PillowWriter
from matplotlib.colors import Normalize
import numpy as np

from grainscope.errors import InputError
from grainscope.fields import panels, read_fields

STYLES = ["-", "--", ":", "-.", (0, (5, 1)), (0, (1, 1)), (0, (3, 1, 1, 1)), (0, (8, 3)), (0, (1, 4))]
MOST_ARROWS, MOST_MAPS = 24, 60


def label_of(field, several=False):
    """Step and time; of tables the step, and the file where there are `several`."""
    if not field.along:
        return f"step {field.step}, t = {field.time:g}"
    return f"{field.path}, step {field.step}" if several else f"step {field.step}"


def line_colours(number):
    """Of the files of a profile: named ones for a few, from dark to light over the steps for many."""
    return COLOURS[:number] if number <= len(COLOURS) else list(plt.get_cmap("viridis")(np.linspace(0, 0.92, number)))


def limits(fields, names, with_errors=False):
    """The least and the largest finite value of these columns in all files."""
    found = []
    for field in fields:
        for name in names:
            error = field.error(name) if with_errors else None
            found += [field.seen(name)] if error is None else [field.seen(name) - error, field.seen(name) + error]
    values = np.concatenate([np.ravel(values) for values in found])
    values = values[np.isfinite(values)]
    return (values.min(), values.max()) if values.size else (0.0, 1.0)


def draw_profiles(figure, shown, fields, groups):
    """Profiles of the files `shown`; with the limits of all `fields` where these are not all shown."""
    columns = min(3, len(groups))
    axes = figure.subplots(-(-len(groups) // columns), columns, squeeze=False, sharex=True)
    (along,) = shown[0].resolved
    for axis, (title, names) in zip(axes.flat, groups):
        for field, colour in zip(shown, line_colours(len(shown))):
            for number, name in enumerate(names):
                single = len(shown) == 1  # components by colours then, else by dashes
                style = {"color": COLOURS[number % len(COLOURS)] if single else colour}
                style["linestyle"] = STYLES[(number // len(COLOURS) if single else number) % len(STYLES)]
                axis.plot(field[along], field.seen(name), label=name if field is shown[0] else None, **style)
                error = field.error(name)
                if error is not None:
                    low, high = field.seen(name) - error, field.seen(name) + error
                    axis.fill_between(field[along], low, high, color=style["color"], alpha=0.2, linewidth=0)
        axis.set_title(title)
        if len(names) > 1:
            axis.legend(fontsize=7)
        if len(shown) < len(fields):
            low, high = limits(fields, names, with_errors=True)
            margin = 0.05 * (high - low) or 0.05 * abs(high) or 1.0
            axis.set_ylim(low - margin, high + margin)
    for axis in axes.flat[len(groups) :]:
        axis.set_axis_off()
    for axis in axes.flat[max(0, len(groups) - columns) : len(groups)]:  # the lowest of each column
        axis.set_xlabel(along)
        axis.tick_params(labelbottom=True)
    if len(shown) == 1:
        figure.suptitle(label_of(shown[0]))
    else:
        lines = [plt.Line2D([], [], color=colour) for colour in line_colours(len(shown))]
        kept = range(len(shown)) if len(shown) <= 10 else [0, len(shown) - 1]
        several = len({field.path for field in shown}) > 1
        labels = [label_of(shown[k], several) for k in kept]
        figure.legend([lines[k] for k in kept], labels, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncol=3)


def corners(middles):
    """Corners of the cells, of their middles: a lattice goes on by half a step at both ends of both axes."""
    for axis in (0, 1):
        middles = np.moveaxis(middles, axis, 0)
        first, last = 1.5 * middles[0] - 0.5 * middles[1], 1.5 * middles[-1] - 0.5 * middles[-2]
        middles = np.moveaxis(np.concatenate([[first], 0.5 * (middles[1:] + middles[:-1]), [last]]), 0, axis)
    return middles


def is_tilted(across, up):
    """Whether the columns of cells do not stand at right angles, by more than rounding."""
    reach = max(np.ptp(across), np.ptp(up))
    return max(np.ptp(across, axis=0).max(), np.ptp(up, axis=1).max()) > 1e-9 * reach


def colour_scale(fields, name):
    """Colours for a column in all files: around 0 where it has both signs."""
    low, high = limits(fields, [name])
    if low < 0 < high:
        return {"cmap": "RdBu_r", "norm": Normalize(-max(-low, high), max(-low, high))}
    return {"cmap": "viridis", "norm": Normalize(low, high)}


def in_plane(field, prefix):
    """The two components of a vector in the plane of a map, across and up."""
    names = [f"{prefix}_{axis}" for axis in field.resolved]
    missing = [name for name in names if name not in field.columns]
    if missing:
        raise InputError(f"--vectors {prefix} needs columns {' and '.join(names)} of {field.path}; {field.has}")
    return [field.seen(name) for name in names]


def draw_arrows(axis, field, fields, prefix):
    """Arrows from some of the middles; the longest of all files reaches to the next one."""
    across, up = (field[name] for name in field.resolved)
    every = max(1, -(-max(across.shape) // MOST_ARROWS))
    kept = (slice(every // 2, None, every),) * 2
    step = every * min(np.ptp(across) / (across.shape[1] - 1), np.ptp(up) / (up.shape[0] - 1))
    lengths = np.array([np.hypot(*in_plane(one, prefix)) for one in fields])
    longest = np.max(lengths, initial=0.0, where=np.isfinite(lengths))
    u, v = in_plane(field, prefix)
    scale = longest / step if longest > 0 else 1.0
    axis.quiver(across[kept], up[kept], u[kept], v[kept], angles="xy", scale_units="xy", scale=scale, pivot="mid")


def draw_map(figure, axis, field, fields, name, vectors):
    across, up = (field[coordinate] for coordinate in field.resolved)
    colours = colour_scale(fields, name)
    x, y = corners(across), corners(up)
    if is_tilted(across, up):
        image = axis.pcolormesh(x, y, field.seen(name), **colours)
    else:
        extent = (x[0, 0], x[0, -1], y[0, 0], y[-1, 0])
        image = axis.imshow(field.seen(name), origin="lower", extent=extent, interpolation="nearest", **colours)
    axis.set_aspect("equal")
    figure.colorbar(image, ax=axis, shrink=0.8)
    if vectors:
        draw_arrows(axis, field, fields, vectors)


def draw_maps(figure, shown, fields, groups, vectors):
    """A row for each file `shown`, a column for each column of the files; colours are those of all `fields`."""
    names = [name for _, group in groups for name in group]
    if len(names) * len(shown) > MOST_MAPS:
        raise InputError(
            f"{len(shown)} files of {len(names)} columns are more than {MOST_MAPS} maps: name some columns"
        )
    axes = figure.subplots(len(shown), len(names), squeeze=False)
    for row, field in zip(axes, shown):
        for axis, name in zip(row, names):
            draw_map(figure, axis, field, fields, name, vectors)
            axis.set(title=name, xlabel=field.resolved[0], ylabel=field.resolved[1])
        if len(shown) > 1:
            row[0].set_ylabel(f"{label_of(field)}\n{field.resolved[1]}")
    if len(shown) == 1:
        figure.suptitle(label_of(shown[0]))


def figure_size(field, groups, rows):
    if len(field.resolved) == 1:
        return 3.4 * min(3, len(groups)), 2.6 * -(-len(groups) // 3) + 0.6
    return 3.8 * sum(len(names) for _, names in groups), 3.2 * rows + 0.4


def draw_into(figure, shown, fields, groups, vectors=None):
    if len(fields[0].resolved) == 1:
        draw_profiles(figure, shown, fields, groups)
    else:
        draw_maps(figure, shown, fields, groups, vectors)


def draw(fields, words=None, vectors=None):
    """The figure of all files together."""
    groups = panels(fields[0], words)
    figure = plt.figure(figsize=figure_size(fields[0], groups, len(fields)), layout="constrained")
    draw_into(figure, fields, fields, groups, vectors)
    return figure


def frames(fields, words=None, vectors=None):
    """One figure, drawn anew for each file, with the limits and colours of all."""
    groups = panels(fields[0], words)
    figure = plt.figure(figsize=figure_size(fields[0], groups, 1), layout="constrained")
    for field in fields:
        figure.clear()
        draw_into(figure, [field], fields, groups, vectors)
        yield figure


def animate(fields, path, words=None, vectors=None, rate=8):
    writer, drawn = PillowWriter(fps=rate), frames(fields, words, vectors)
    with plt.rc_context({"savefig.bbox": None}):  # all frames of one size
        figure = next(drawn)
        with writer.saving(figure, str(path), dpi=100):
            writer.grab_frame()
            for _ in drawn:
                writer.grab_frame()
    plt.close(figure)


def cut(fields, word, vectors=None):
    """The fields that are drawn: those of a slice, `z=k`, where one is asked for; with one or two resolved axes."""
    first = fields[0]
    several = {axis: n for axis, n in zip(first.coordinates, first.cells) if n > 1}
    there_are = "there are " + (", ".join(f"{axis}=0 to {axis}={n - 1}" for axis, n in several.items()) or "none")
    if word:
        axis, _, layer = word.partition("=")
        if not re.fullmatch("[0-9]+", layer) or int(layer) >= several.get(axis, 0):
            raise InputError(f"--slice must be one of the layers of {first.path}, got '{word}'; {there_are}")
        fields = [field.sliced(axis, int(layer)) for field in fields]
    left = len(fields[0].resolved)
    if left == 3:
        raise InputError(f"--slice must name a layer of {first.path}, of {first.size} cells; {there_are}")
    if left == 0:
        leaves = f"--slice {word} leaves" if word else f"{first.path} has"
        raise InputError(f"{leaves} one cell; a profile has several (the grid: {first.size})")
    if vectors and left == 1:
        raise InputError(f"--vectors is for maps, got '{vectors}' for a profile along {fields[0].resolved[0]}")
    return fields


def add_arguments(parser):
    parser.add_argument("file", help="file of fix field/write, fix ave/time mode vector or fix ave/spatial")
    parser.add_argument(
        "more",
        nargs="*",
        default=[],
        metavar="file or column",
        help="more files, of the same grid at other steps, and names of columns: v_x, or v for all its components "
        "(default: all)",
    )
    parser.add_argument(
        "--against", metavar="COLUMN", help="of tables, what profiles are drawn over (default: the first column)"
    )
    parser.add_argument("--slice", metavar="AXIS=K", help="the layer K (from 0) of cells along an axis, as z=3")
    parser.add_argument("--vectors", metavar="NAME", help="arrows of this vector on maps, as v")
    parser.add_argument("--output", metavar="FILE", help="the picture of all files, .png or .pdf")
    parser.add_argument("--animate", metavar="FILE", help="a .gif of the files in the order of their steps")
    parser.add_argument("--rate", type=float, default=8.0, help="files in a second of --animate (default: 8)")


def check(arguments):
    if not arguments.output and not arguments.animate:
        raise InputError("--output or --animate must name a file to write")
    for name, endings in (("output", (".png", ".pdf")), ("animate", (".gif",))):
        path = getattr(arguments, name)
        if path and Path(path).suffix not in endings:
            raise InputError(f"--{name} must end in {' or '.join(endings)}, got '{path}'")
    if not 0 < arguments.rate <= 50:
        raise InputError(f"--rate must be above 0 and at most 50, got {arguments.rate:g}")


def run(arguments):
    check(arguments)
    files, columns = files_and_columns(arguments.file, arguments.more)
    fields = cut(read_fields(files, arguments.against), arguments.slice, arguments.vectors)
    if arguments.output:
        save(draw(fields, columns, arguments.vectors), arguments.output)
    if arguments.animate:
        animate(fields, arguments.animate, columns, arguments.vectors, arguments.rate)
    print(*filter(None, (arguments.output, arguments.animate)), sep="\n")
