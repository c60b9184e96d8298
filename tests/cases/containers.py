# SPDX-License-Identifier: GPL-2.0-or-later
"""containers/: both recipes are complete, say the same, and get all files that the build wants. Their commands are run
by cases/bare_debian.py, in bare systems."""
import fnmatch
import os
from pathlib import Path
import re
import shutil
import subprocess

from case import main, require

SOURCE = Path(os.environ["GRAINSCOPE_SOURCE"])
FOLDER = SOURCE / "containers"
HEADER = {"Bootstrap", "From", "Stage"}
SECTIONS = {"files", "post", "environment", "runscript", "test", "help"}


def stages_of_dockerfile():
    """(image, [(instruction, its words on one line)]) of each stage."""
    text = (FOLDER / "Dockerfile").read_text()
    lines = re.sub(r"\\\n", " ", re.sub(r"^#.*\n", "", text, flags=re.M)).splitlines()
    stages = []
    for line in filter(None, lines):
        instruction, _, words = line.partition(" ")
        if instruction == "FROM":
            stages.append((words.split()[0], []))
        else:
            stages[-1][1].append((instruction, " ".join(words.split())))
    return stages


def stages_of_definition():
    """(header, {section: its lines}) of each stage."""
    stages = []
    for part in re.split(r"^(?=Bootstrap:)", (FOLDER / "grainscope.def").read_text(), flags=re.M)[1:]:
        head, *sections = re.split(r"^%", part, flags=re.M)
        header = dict(re.findall(r"^(\w+): (\S+)$", head, flags=re.M))
        found = {}
        for section in sections:
            title, _, body = section.partition("\n")
            require(title.split()[0] not in found, f"%{title} is there twice")
            body = re.sub(r"\s*\\\n\s*", " ", body)
            found[title.split()[0]] = [line.strip() for line in body.splitlines() if line.strip()]
        stages.append((header, found))
    return stages


def commands(words):
    return [part.strip() for part in words.split("&&")]


def same_in_both(ranks):
    """One image, one way to build, one package to install."""
    docker, definition = stages_of_dockerfile(), stages_of_definition()
    require(len(docker) == len(definition) == 2, "not two stages")
    for (image, instructions), (header, sections) in zip(docker, definition):
        require(set(header) == HEADER and header["Bootstrap"] == "docker", f"header of a stage: {header}")
        require(set(sections) <= SECTIONS, f"sections: {set(sections)}")
        require(header["From"] == image, f"{header['From']} in one and {image} in the other")
        run = [part for instruction, words in instructions if instruction == "RUN" for part in commands(words)]
        # Docker removes, adds a user and changes folders by other means.
        own = [line for line in run if not line.startswith("useradd")]
        theirs = [line for line in sections["post"] if not line.startswith("cd ")]
        require(own == theirs, f"the commands differ:\n{own}\n{theirs}")
    require([header["Stage"] for header, _ in definition] == ["build", "final"], "names of the stages")
    for name in ("Dockerfile", "grainscope.def"):
        require("://" not in (FOLDER / name).read_text(), f"{name} names a host")


def tracked():
    """Files of the source tree, without what was built or run in it; also of one that is no git clone."""
    done = subprocess.run(["git", "-C", SOURCE, "ls-files"], capture_output=True, text=True)
    if done.returncode == 0:
        return [line for line in done.stdout.splitlines() if (SOURCE / line).is_file()]
    not_ours = {".git", "build", "out", "__pycache__"}
    files = [file.relative_to(SOURCE) for file in SOURCE.rglob("*") if file.is_file()]
    return [str(file) for file in files if not not_ours & set(file.parts)]


def admitted_by_docker():
    """By the file that Docker reads beside the Dockerfile: * takes all away, each !pattern gives back."""
    lines = [
        line for line in (FOLDER / "Dockerfile.dockerignore").read_text().splitlines() if line[:1] not in ("#", "")
    ]
    require(lines[0] == "*" and all(line[0] == "!" for line in lines[1:]), f"lines: {lines}")
    patterns = [line[1:] for line in lines[1:]]
    for pattern in patterns:
        require(list(SOURCE.glob(pattern)), f"Dockerfile.dockerignore: there is no {pattern}")

    def admits(pattern, file):
        return file.startswith(f"{pattern}/") or (
            fnmatch.fnmatch(file, pattern) and file.count("/") == pattern.count("/")
        )

    return [file for file in tracked() if any(admits(pattern, file) for pattern in patterns)]


def copied_by_definition():
    pairs = [line.split() for line in stages_of_definition()[0][1]["files"]]
    for source, target in pairs:
        require((SOURCE / source).exists() and target == f"/source/{source}", f"%files: {source} {target}")
    sources = [source for source, _ in pairs]
    return [file for file in tracked() if any(file == source or file.startswith(f"{source}/") for source in sources)]


def build_gets_its_files(ranks):
    """Configured from the files that come into each image alone; and all that is installed is among them."""
    scratch = Path(os.environ["GRAINSCOPE_SCRATCH"])
    require(sorted(admitted_by_docker()) == sorted(copied_by_definition()), "the images get different files")
    source = scratch / "source"
    for file in admitted_by_docker():
        (source / file).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(SOURCE / file, source / file)
    require(not (source / ".git").exists() and not (source / "tests/cases").exists(), "too much comes into the image")
    done = subprocess.run(
        [
            *(os.environ["GRAINSCOPE_CMAKE"], "--preset", "cluster", "-B", scratch / "build"),
            f"-DLIGGGHTS_SOURCE_DIR={os.environ['GRAINSCOPE_HOST_SOURCE']}",
        ],
        cwd=source,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    require(done.returncode == 0, done.stdout[-3000:])
    script = (scratch / "build" / "cmake_install.cmake").read_text()
    installed = re.findall(rf'"({re.escape(str(source))}/[^"]*)"', script)
    require(len(installed) > 8, f"only {installed} are installed")
    for file in installed:
        require(Path(file).exists(), f"{file} is installed and does not come into the image")
    (package,) = re.findall(r"COPY --from=build (\S+)", (FOLDER / "Dockerfile").read_text())
    require(Path(package).parent == Path("/package"), f"the package is copied from {package}")


main({"same-in-both": same_in_both, "build-gets-its-files": build_gets_its_files})
