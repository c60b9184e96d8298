# SPDX-License-Identifier: GPL-2.0-or-later
"""Format and faults of the source files, by the tools and options that CONTRIBUTING.md names: what they would change is
printed, with the command that mends it."""
import ast
from concurrent.futures import ThreadPoolExecutor
import difflib
import json
import os
from pathlib import Path
import re
import shutil
import subprocess
import sys
import tempfile

from case import main, require

SOURCE, BUILD = Path(os.environ["GRAINSCOPE_SOURCE"]), Path(os.environ["GRAINSCOPE_BUILD"])
FOLDERS = ("src", "tests", "bench", "cmake", "examples", "scripts", "tools")
# Versions that agree on this tree: those of Debian 12 and 13, and between.
CLANG_FORMAT, BLACK = range(14, 20), range(23, 26)
SHOWN = 40  # lines


def files(is_one):
    """Paths from the top of the tree, of the files of the project that `is_one`."""
    found = [path for folder in FOLDERS for path in (SOURCE / folder).rglob("*") if path.is_file() and is_one(path)]
    return sorted(str(path.relative_to(SOURCE)) for path in found if "__pycache__" not in path.parts)


def cpp_files():
    return files(lambda path: path.suffix in (".cpp", ".h"))


def python_files():
    def is_python(path):
        if path.suffix or path.parent.name != "scripts":
            return path.suffix == ".py"
        return "python" in path.read_text().partition("\n")[0]

    return files(is_python)


def called(tool, *words, text=None):
    """Exit code, standard output and error of a tool, begun at the top of the tree."""
    require(shutil.which(tool), f"{tool} is missing: scripts/install-packages {tool}")
    environment = dict(os.environ, BLACK_CACHE_DIR=str(BUILD / "black-cache"))
    done = subprocess.run([tool, *words], cwd=SOURCE, env=environment, input=text, capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def agrees(tool, versions):
    """Whether the tool that is installed is one of those that agree with each other."""
    words = called(tool, "--version")[1]
    version = int(re.search(r"(?:version|black,) (\d+)", words)[1])
    if version not in versions:
        print(f"not checked: {tool} {version} may write another format than {versions[0]} to {versions[-1]} do")
    return version in versions


def first_lines(text):
    lines = text.splitlines()
    return "\n".join(lines[:SHOWN] + ["..."] * (len(lines) > SHOWN))


def clang_format(ranks):
    if not agrees("clang-format", CLANG_FORMAT):
        return
    style = "#if C\nComputeStyle(a/b,C)\n#endif\n"
    _, words, _ = called("clang-format", "--assume-filename=src/x.cpp", text="int  *x ;\n" + style)
    require(words == "int *x;\n" + style, f"does not follow .clang-format: {words}")
    complaints = called("clang-format", "--dry-run", "--Werror", *cpp_files())[2]
    bad, shown = sorted(set(re.findall(r"^(\S+?):\d+:\d+: error", complaints, re.M))), []
    for name in bad:
        before, after = (SOURCE / name).read_text(), called("clang-format", name)[1]
        shown += difflib.unified_diff(before.splitlines(), after.splitlines(), name, name, n=1, lineterm="")
    require(not bad, f"to be mended by: clang-format -i {' '.join(bad)}\n" + first_lines("\n".join(shown)))
    require(not complaints, complaints)


def black(ranks):
    if not agrees("black", BLACK):
        return
    code, words, complaint = called("black", "--quiet", "--diff", "-", text="x = [1,\n  2]\n")
    require("+x = [1, 2]" in words, f"black does not work: {words}{complaint}")
    code, shown, complaint = called("black", "--fast", "--check", "--diff", "--quiet", *python_files())
    bad = re.findall(r"^--- (\S+)\t", shown, re.M)
    require(code == 0, f"to be mended by: black {' '.join(bad)}\n{first_lines(shown + complaint)}")


def flake8(ranks):
    code, shown, complaint = called("flake8", "-", text="import os\n")
    require("F401" in shown, f"flake8 does not work: {shown}{complaint}")
    code, shown, complaint = called("flake8", *python_files())
    require(code == 0, f"to be mended by hand:\n{first_lines(shown + complaint)}")


# Packages of others, which a script may lack until it is installed; all else that is imported must be in the tree.
OTHERS = set(
    "numpy scipy matplotlib pandas yaml PIL snakemake mkdocs markdown markdown_it selenium paraview vtkmodules".split()
)


def imports(ranks):
    """Modules of the project are where they are imported from, also those of scripts that no test runs."""
    shared = [SOURCE / folder for folder in ("tools", "tests", "tests/tools", "tests/cases", "scripts/site")]
    missing, seen = [], 0
    for file in python_files():
        path = SOURCE / file
        for node in ast.walk(ast.parse(path.read_text())):
            names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            if isinstance(node, ast.ImportFrom) and node.level == 0:
                names = [node.module]
            for name in names:
                if name.split(".")[0] in sys.stdlib_module_names | OTHERS:
                    continue
                seen += 1
                part = Path(*name.split("."))
                places = [folder / part for folder in (path.parent, *shared)]
                if not any(place.with_suffix(".py").exists() or place.is_dir() for place in places):
                    missing.append(f"{file}: {name}")
    require(seen > 100, f"only {seen} imports were looked at")
    require(not missing, "no such module: " + "; ".join(missing))


def clang_tidy(ranks):
    """Kernels and styles, as they are compiled; headers through the files that include them."""
    commands = (BUILD / "compile_commands.json").read_text().replace(" -fno-canonical-system-headers", "")  # gcc's
    mine = sorted({c["file"] for c in json.loads(commands) if Path(c["file"]).is_relative_to(SOURCE / "src")})
    require(len(mine) > 70, f"only {len(mine)} files are compiled")
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        (Path(folder) / "compile_commands.json").write_text(commands)
        found = list(pool.map(lambda name: called("clang-tidy", "-p", folder, "--quiet", name), mine))
    bad = [words + complaint * bool(code) for code, words, complaint in found if code or "warning:" in words]
    require(not bad, f"{len(bad)} files to be mended by hand:\n{first_lines(chr(10).join(bad))}")


def citation(ranks):
    """CITATION.cff has what its format, 1.2.0, requires, and the version of the program."""
    import yaml

    found = yaml.safe_load((SOURCE / "CITATION.cff").read_text())
    missing = {"cff-version", "message", "title", "authors"} - found.keys()
    require(not missing, f"without {missing}")
    require(found["cff-version"] == "1.2.0" and found["type"] == "software", f"is of {found['cff-version']}")
    require(found["title"] == "grainscope" and found["license"] == "GPL-2.0-or-later", f"{found}")
    version = re.search(r"project\(grainscope VERSION (\S+)", (SOURCE / "CMakeLists.txt").read_text())[1]
    require(found["version"] == version, f"version {found['version']}, CMakeLists.txt has {version}")
    paper = found["references"][0]
    readme = (SOURCE / "README.md").read_text()
    require(paper["doi"] in readme and paper["title"].partition(":")[0] in readme, f"README.md cites another: {paper}")
    for entry in (found, paper):
        people = [a.get("name") or (a.get("family-names") and a.get("given-names")) for a in entry["authors"]]
        require(people and all(people), f"authors without name: {entry['authors']}")


main(
    {
        "clang-format": clang_format,
        "black": black,
        "flake8": flake8,
        "imports": imports,
        "clang-tidy": clang_tidy,
        "citation": citation,
    }
)
