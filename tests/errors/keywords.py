# SPDX-License-Identifier: GPL-2.0-or-later
"""Every keyword of every style: missing, of another type, out of range on either side, nan, infinite, empty, twice,
unknown. What is refused is made from this table; so is what is taken, at the limits."""
from dataclasses import replace

from bad_input import Keyword, Kind, NOT_NUMBERS, Style, choice, even, number, require_all_refused, whole
from case import main
from deck import Deck
from packing import Grain, Packing
from plates import plated
from run import run

PLANE = Keyword("plane", choice("xy", "xz", "yz"))
COMPONENT = Keyword("component", choice("vx", "vy", "vz", "wx", "wy", "wz"))
WALLS = Keyword("walls", choice("no", "yes", "only"))
TYPE = Kind(
    "two atom types, each a number or *", ("1 1", "* *", "1 *"), ("0", "-1", "1.5", "1000001", "**"), NOT_NUMBERS
)
TYPES = [Keyword("types", TYPE), Keyword("types 1", replace(TYPE, good=("1", "*")), "types")]
REGION = Keyword(
    "region",
    Kind("a region that is defined", ("box",), ("q", "", "nan", "BOX")),
    ends="expected the ID of a region after 'region', got the end of the command",
)
ROWS = Keyword("rows", choice("types"))
VOLUME = Keyword(
    "volume", number("auto, a positive number or v_name", ("auto", "1e-300", "1e300"), ("0", "-1", "AUTO", "autos"))
)
PRESSURE = Keyword("pressure", choice("x", "y", "z", "mean"))
AXIS = Keyword("axis", choice("auto", "symmetry", "long", "short"))
FLOW = [
    Keyword(
        "flow",
        Kind(
            "box, none, rate, fit, gradient, layers or cells",
            ("box", "none", "fit", "gradient"),
            ("q", "", "nan", "1e999", "BOX", "5"),
        ),
    ),
    Keyword("flow rate", number("a shear rate", ("0", "-1e300", "1e300"), ())),
    Keyword("flow layers", whole(1, 10000)),
    Keyword("flow cells 1 1", whole(1, 1000), "flow cells"),
]
LENGTH = number("a positive length", ("1e-300", "1e300"), ("0", "-1", "-0.0", "1e-999"))
REFERENCE = Kind(
    "f_ID[n], v_name or time",
    ("v_strain", "f_press[1]", "time"),
    (
        "0.1",
        "strain",
        "c_x[1]",
        "f_",
        "f_press",
        "f_[1]",
        "f_press[]",
        "f_press[0]",
        "f_press[-1]",
        "f_press[1.5]",
        "f_press[nan]",
        "f_press[1e999]",
        "f_press[1",
        "f_press[1][2]",
        "f_press[x]",
    ),
    NOT_NUMBERS,
)
STRAIN = Keyword("strain", REFERENCE)
COLUMNS = (
    "id",
    "image",
    "point",
    "normal",
    "branch",
    "overlap",
    "force",
    "fn",
    "fn_damping",
    "ft",
    "un",
    "ut",
    "sliding",
    "slip",
    "mobilisation",
    "wall",
    "triangle",
    "strong",
    "cluster",
)


def compute(style, *keywords, **choices):
    if REGION in keywords:
        choices.setdefault("before", ("region box block 0 10 0 10 0 10 units box",))
    return Style(f"compute {style}", f"compute c all {style}", list(keywords), **choices)


def quantity(what, good, bad):
    return number(f"{what} or a variable v_name", (*good, "v_strain"), bad)


NEEDED = {"axis": "y", "target": "1e5", "every": "1e-3", "shear": "xy rate 0.05"}
BOX = ("boundary f f f", "region box block 0 10 0 10 0 10 units box", "create_box 1 box")


def press(**changes):
    words = {**NEEDED, **changes}
    return "fix press all press/strain " + " ".join(f"{k} {v}" for k, v in words.items() if v)


BARE = "fix press all press/strain"
PLANE_MOVES = "'rate' and a shear rate, 'target' and a shear stress, or 'fixed'"
PRESS = Style(
    "fix press/strain",
    "fix press all press/strain",
    [
        Keyword("axis", choice("x", "y", "z")),
        Keyword("target", quantity("a pressure >= 0", ("0", "1e300"), ("-1e-9", "-3"))),
        Keyword(
            "x", Kind("target, rate or fixed", ("target 5", "rate -0.1", "rate v_strain", "fixed"), ("5", "mean", ""))
        ),
        Keyword("z", Kind("target, rate or fixed", ("target v_strain", "rate 0", "fixed"), ("Target", "nan"))),
        Keyword("x target", quantity("a pressure >= 0", ("0", "1e300"), ("-1e-9", "-3"))),
        Keyword("x rate", number("a rate or a variable v_name", ("0", "-5", "v_strain"), ())),
        Keyword(
            "shear",
            Kind("xy, xz or yz", ("xy rate 1", "xz rate 1", "xy rate 2"), ("yx", "XY", "", "nan", "x")),
        ),
        Keyword("shear xy rate", quantity("a shear rate other than 0", ("1e-300", "-5"), ("0", "-0.0")), "rate"),
        Keyword("every", number("a strain > 0", ("1e-9", "1e9"), ("0", "-1"))),
        Keyword("every/time", number("a time > 0", ("1e-9", "1e9"), ("0", "-1"))),
        Keyword("every/step", number("a whole number of steps >= 1", ("1", "1e9"), ("0", "0.5", "2.5", "-1"))),
        Keyword("gain", number("auto or a velocity per pressure >= 0", ("auto", "0"), ("-1e-9", "AUTO"))),
        Keyword("limit", number("between 0 and 1, both excluded", ("1e-9", "0.999"), ("0", "1", "-0.1", "2"))),
        Keyword("maxrate", number("a rate > 0", ("1e-9", "1e9"), ("0", "-1"))),
        Keyword("momentum", choice("yes", "no")),
        Keyword("kinetic", choice("yes", "no")),
    ],
    needed=NEEDED,
    before=BOX,
    order=(
        "axis",
        "target",
        "x",
        "y",
        "z",
        "mean",
        "ratio",
        "shear",
        "every",
        "every/time",
        "every/step",
        "gain",
        "limit",
        "maxrate",
        "momentum",
        "kinetic",
    ),
    more=[
        (press(shear="xy"), f"expected {PLANE_MOVES} after 'xy', got the end of the command"),
        (press(shear="xy speed 1"), f"'shear xy' must be followed by {PLANE_MOVES}, got 'speed'"),
        (press(shear="xy target x"), "'shear xy target' must be a shear stress or a variable v_name, got 'x'"),
        (
            press(shear="xy target 1", every=None) + " every/step 5",
            "'shear' with 'target' needs 'maxrate': grains that yield would be sheared ever faster",
        ),
        (
            press(shear="xy target 1", every=None) + " every/step 5 maxrate 1 gain 1e-6",
            "'gain' must be auto with 'target' of a shear, got 1e-06",
        ),
        (press() + " y fixed", "'axis y' and 'y' exclude each other"),
        (
            BARE + " every/step 5",
            "no motion of the box is given: use 'axis' and 'target', 'x', 'y', 'z', 'mean' or 'shear'",
        ),
        (BARE + " ratio 1 1 1 x fixed every/step 5", "'ratio' needs 'mean target' and a pressure"),
        (BARE + " mean pressure 5", "'mean' must be target, got 'pressure'"),
        (BARE + " mean target -5", "'mean target' must be a pressure >= 0 or a variable v_name, got '-5'"),
        (
            BARE + " mean target 5 ratio 1 1",
            "expected three numbers >= 0, of x, y and z after '1', got the end of the command",
        ),
        (BARE + " mean target 5 ratio 1 -1 1", "'ratio' must be three numbers >= 0, of x, y and z, got '-1'"),
        (
            BARE + " mean target 5 ratio 1 1 1 z rate 1 every/step 5",
            "'ratio' of z must be 0 beside 'z', got 1",
        ),
        (
            BARE + " mean target 5 ratio 0 0 0 every/step 5",
            "'mean' moves no edge: all are fixed, driven or have a ratio of 0",
        ),
        (
            BARE + " mean target 5 x target 3 every/step 5",
            "'mean' and 'x target' exclude each other: hold each edge by a target of its own",
        ),
        (BARE + " mean target 5 gain 1 every/step 5", "'gain' must be auto with 'mean', got 1"),
        (
            BARE + " x fixed y target 4 every 1e-3",
            "'every' counts strain, and without a 'rate' the box has none: use 'every/time' or 'every/step'",
        ),
        (press(axis=None), "'axis x', 'axis y' or 'axis z' is required"),
        (press(target=None), "'target' and a pressure are required"),
        (press(every=None), "'every', 'every/time' or 'every/step' is required"),
        (
            press(every=None, shear=None),
            "without a 'rate', 'every/time' or 'every/step' is required",
        ),
        (
            press(shear=None),
            "'every' counts strain, and without a 'rate' the box has none: use 'every/time' or 'every/step'",
        ),
        (
            press() + " every/step 3",
            "'every', 'every/time' and 'every/step' exclude each other, got a second one: 'every/step'",
        ),
    ],
)
NO_WALLS = "there are none yet, define it after fix wall/gran"
NEEDED_BY_A_PLATE = {"mesh": "plate", "axis": "z", "target": "1e5", "area": "4", "every/step": "5"}


def plate(**changes):
    words = {**NEEDED_BY_A_PLATE, **{k.replace("_", "/"): v for k, v in changes.items()}}
    return "fix press all press/wall " + " ".join(f"{k} {v}" for k, v in words.items() if v)


PLATE = Style(
    "fix press/wall",
    "fix press all press/wall",
    [
        Keyword("axis", choice("x", "y", "z")),
        Keyword("target", number("a pressure > 0 or a variable v_name", ("1e-300", "1e300", "v_strain"), ("0", "-3"))),
        Keyword("area", number("box or an area > 0", ("box", "1e-9", "1e9"), ("0", "-1", "BOX"))),
        Keyword("every/time", number("a time > 0", ("1e-9", "1e9"), ("0", "-1"))),
        Keyword("every/step", number("a whole number of steps >= 1", ("1", "1e9"), ("0", "0.5", "2.5", "-1"))),
        Keyword("toward", Kind("+ or -", ("+", "-"), ("q", "", "nan", "1", "++"))),
        Keyword("gain", number("auto or a velocity per pressure >= 0", ("auto", "0"), ("-1e-9", "AUTO"))),
        Keyword("base", choice("yes", "no")),
        Keyword("limit", number("a distance > 0", ("1e-9", "1e9"), ("0", "-0.1"))),
        Keyword("maxrate", number("a velocity > 0", ("1e-9", "1e9"), ("0", "-1"))),
    ],
    needed=NEEDED_BY_A_PLATE,
    before=BOX,
    order=("mesh", "axis", "target", "area", "every/time", "every/step", "toward", "gain", "base", "limit", "maxrate"),
    more=[
        (plate(mesh=None), "'mesh' and the ID of a fix mesh/surface are required"),
        (plate(axis=None), "'axis x', 'axis y' or 'axis z' is required"),
        (plate(target=None), "'target' and a pressure are required"),
        (plate(area=None), "'area' and an area, or 'area box', is required"),
        (plate(every_step=None), "'every/time' or 'every/step' is required"),
        (
            plate() + " every/time 3",
            "'every/time' and 'every/step' exclude each other, got a second one: 'every/time'",
        ),
        (
            plate(),
            f"'mesh' must name a mesh of a fix wall/gran, got 'plate': {NO_WALLS}",
        ),
        (
            "fix press all press/wall mesh",
            "expected the ID of a fix mesh/surface after 'mesh', got the end of the command",
        ),
        (plate() + " mesh lid", "'mesh' is given twice"),
    ],
)
NAMES_OF_WALLS = [
    ("compute c all wall/contact walls", "expected names of walls after 'walls', got the end of the command"),
    ("compute c all wall/contact walls about 0 0 0", "expected names of walls after 'walls', got 'about'"),
    ("compute c all wall/contact walls floor walls lid", "'walls' is given twice"),
    (
        "compute c all wall/contact walls floor",
        f"'walls' must name walls (a fix wall/gran primitive, or a mesh of one), got 'floor': {NO_WALLS}",
    ),
]
STYLES = [
    compute("stress/contact", REGION, *TYPES, ROWS, WALLS, VOLUME, PLANE, PRESSURE),
    compute("nematic", REGION, PLANE, AXIS),
    compute("contact/grain", REGION, *TYPES, WALLS, PLANE),
    compute("contact/solver"),
    compute("energy/ledger"),
    compute(
        "wall/contact",
        Keyword("about 0 0", number("three coordinates", ("0", "-1e300"), ()), "about"),
        Keyword("losses", choice("yes", "no")),
        Keyword("impacts", choice("yes", "no")),
        order=("walls", "about", "area", "losses", "impacts"),
        more=NAMES_OF_WALLS
        + [
            (
                "compute c all wall/contact about",
                "expected three coordinates after 'about', got the end of the command",
            ),
            ("compute c all wall/contact about 0 nan 0", "'about' must be three coordinates, got 'nan'"),
            (
                "compute c all wall/contact area",
                "expected the name of a wall and its area after 'area', got the end of the command",
            ),
            (
                "compute c all wall/contact area about 0 0 0",
                "expected the name of a wall and its area after 'area', got 'about'",
            ),
            (
                "compute c all wall/contact area lid 2",
                f"'area' must name walls (a fix wall/gran primitive, or a mesh of one), got 'lid': {NO_WALLS}",
            ),
            ("compute c all wall/contact area lid 2 area lid 2", "'area' is given twice"),
        ],
    ),
    compute(
        "wall/triangle",
        Keyword("wear", choice("yes", "no")),
        order=("walls", "wear"),
        more=[
            ("compute c all wall/triangle walls", "expected names of meshes after 'walls', got the end of the command"),
            ("compute c all wall/triangle walls wear yes", "expected names of meshes after 'walls', got 'wear'"),
            (
                "compute c all wall/triangle walls floor",
                f"'walls' must name meshes of a fix wall/gran, got 'floor': {NO_WALLS}",
            ),
        ],
    ),
    compute("dissipation", Keyword("mode", choice("instantaneous", "step", "ledger")), REGION, *TYPES, ROWS, WALLS),
    compute(
        "fabric",
        REGION,
        *TYPES,
        ROWS,
        WALLS,
        PLANE,
        flags=("branch", "force/normal", "force/tangential"),
        order=("branch", "force/normal", "force/tangential", "region", "types", "rows", "walls", "plane"),
    ),
    compute(
        "contact/surface",
        Keyword("bins", whole(1, 1000)),
        Keyword("angle", choice("polar", "parametric")),
        Keyword("axis", choice("auto", "x", "y", "z")),
        REGION,
        *TYPES,
        WALLS,
        VOLUME,
        PRESSURE,
    ),
    compute("contact/direction", Keyword("bins", even(2, 10000)), REGION, *TYPES, WALLS, PLANE),
    compute(
        "contact/force",
        Keyword("bins", whole(1, 10000)),
        Keyword("max", number("a positive number", ("1e-300", "1e300"), ("0", "-1"))),
        Keyword("tail", number("a number, not negative", ("0", "1e300"), ("-1", "-1e-300"))),
        REGION,
        *TYPES,
        WALLS,
    ),
    compute(
        "packing",
        Keyword("rate", number("auto, a positive number or v_name", ("auto", "1e-300", "1e300"), ("0", "-1", "AUTO"))),
        Keyword("rattlers", whole(1, 100)),
        REGION,
        WALLS,
        VOLUME,
        PLANE,
        PRESSURE,
    ),
    compute(
        "contact/local",
        REGION,
        *TYPES,
        WALLS,
        flags=COLUMNS,
        sort="column",
        order=(*COLUMNS, "region", "types", "walls"),
    ),
    compute("fluctuation", PLANE, Keyword("layers", whole(1, 10000)), Keyword("diameter", LENGTH), *FLOW, REGION),
    compute("layering", Keyword("axis", choice("x", "y", "z")), Keyword("layers", even(2, 1000))),
    compute(
        "velocity/correlation",
        COMPONENT,
        Keyword("bins", whole(1, 10000)),
        Keyword("range", LENGTH),
        Keyword("method", choice("direct", "mesh")),
        Keyword("method mesh mesh", whole(1, 100), "mesh"),
        *FLOW,
        PLANE,
        Keyword("average", choice("one", "running")),
        REGION,
        order=("component", "bins", "range", "method", "mesh", "flow", "plane", "average", "region"),
        more=[
            ("compute c all velocity/correlation mesh 4", "'mesh' needs 'method mesh'"),
            ("compute c all velocity/correlation mesh 4 method mesh mesh 4", "'mesh' is given twice"),
        ],
    ),
    compute(
        "velocity/memory",
        COMPONENT,
        Keyword("every", number("a positive strain", ("1e-300", "1e300"), ("0", "-0.1"))),
        Keyword("lags", whole(1, 400)),
        STRAIN,
        *FLOW,
        PLANE,
        REGION,
        order=("component", "every", "lags", "strain", "flow", "plane", "region"),
    ),
    compute(
        "displacement/shear",
        Keyword("start", number("a strain", ("0", "-5", "1e300"), ())),
        STRAIN,
        *FLOW,
        PLANE,
        REGION,
        order=("start", "strain", "flow", "plane", "region"),
    ),
    PRESS,
    PLATE,
    Style("fix nve/spheroid", "fix spheroid all nve/spheroid", before=BOX),
    Style(
        "pair_style gran/insitu",
        "pair_style gran/insitu model hertz tangential history",
        [
            Keyword("ledger", choice("on", "off"), ends="'ledger' must be on or off, got the end of the command"),
            Keyword(
                "setup", choice("neutral", "host"), ends="'setup' must be neutral or host, got the end of the command"
            ),
            Keyword(
                "time_level",
                choice("synchronized", "host"),
                ends="'time_level' must be synchronized or host, got the end of the command",
            ),
        ],
        others=True,
    ),
]


def slug(style):
    return style.name.split()[-1].replace("/", "-")


def refused(style, every=False):
    """All of them on one rank; on more, one: every rank reads the same words. `every`: also each word that no keyword
    of its kind takes, at each keyword."""

    def case(ranks):
        inputs = list(style.refused(every))
        require_all_refused(style, inputs if ranks == 1 else inputs[len(inputs) // 2 :][:1], ranks)

    return case


def undone(command):
    kind, name = command.split()[:2]
    return (
        [f"{ {'compute': 'uncompute', 'fix': 'unfix'}[kind]} {name}"]
        if kind in ("compute", "fix")
        else ["pair_coeff * *"]
    )


def taken(style):
    """The other side of the limits, in surroundings that are right."""

    def case(ranks):
        grain = Grain((5.0, 5.0, 5.0), (1.0, 1.0, 1.5))
        commands = [line for command in style.taken() for line in (command, *undone(command))]
        deck = Deck(Packing((20.0, 20.0, 20.0), [grain]))
        if style is PLATE:
            deck = plated(replace(deck.packing, triclinic=False), boundary="f f f")
        deck.body += ["variable strain equal step", *commands]
        run(deck, ranks)
        print(f"{len(commands) // 2} commands taken")

    return case


CASES = (
    {f"{slug(style)}-refused": refused(style) for style in STYLES}
    | {f"{slug(style)}-refused-every-word": refused(style, True) for style in STYLES}
    | {f"{slug(style)}-taken": taken(style) for style in STYLES}
)

if __name__ == "__main__":
    main(CASES)
