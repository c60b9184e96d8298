# SPDX-License-Identifier: GPL-2.0-or-later
"""What MkDocs does beside its own: the site mirrors the repository's tree, so that links lead where they lead there. A
page without a place in the navigation, a dead link or an asset from another host ends the build."""
from fnmatch import fnmatch
import os
from pathlib import Path
import re
import sys

from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File, Files

sys.path.insert(0, str(Path(__file__).parent))
from dialect import for_mkdocs
from site_links import faults

TOP = Path(__file__).resolve().parent.parent.parent
PAGES = ("README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md", "bench/README.md", "tests/README.md")
FOLDERS = ("doc", "examples", "tools")  # with all that their pages may lead to: decks, pictures, programs
OF_RUNS = ("*/__pycache__/*", "*/out/*", "*/.snakemake/*", "*.dump", "*.restart", "*/log.*")  # not for the site


def names():
    """The files of the site, from the top of the repository."""
    yield from PAGES
    yield "scripts/site/site.css"
    for folder in FOLDERS:
        for path in sorted((TOP / folder).rglob("*")):
            name = path.relative_to(TOP).as_posix()
            if path.is_file() and not any(fnmatch(name, pattern) for pattern in OF_RUNS):
                yield name


def on_files(files, config):
    """The repository's files in place of those of doc/ alone; the theme's stay."""
    of_theme = [file for file in files if TOP not in Path(file.abs_src_path).parents]
    mine = [File(name, str(TOP), config["site_dir"], config["use_directory_urls"]) for name in names()]
    return Files(of_theme + mine)


def on_nav(nav, config, files):
    placed = {page.file.src_uri for page in nav.pages}
    lost = [file.src_uri for file in files.documentation_pages() if file.src_uri not in placed]
    if lost:
        raise PluginError(f"pages without a line under 'nav' of mkdocs.yml: {', '.join(lost)}")


def input_scripts(page):
    """Of an example's page: its decks, to be read below it."""
    folder = (TOP / page.file.src_uri).parent
    if folder.parent != TOP / "examples":
        return
    for deck in sorted(folder.glob("in.*")):
        yield f"\n## {deck.name}\n\n```\n{deck.read_text().rstrip()}\n```\n"


def page_of(folder):
    """The page of a folder, or that of the nearest above."""
    return folder / "README.md" if (folder / "README.md").is_file() else page_of(folder.parent)


def on_page_markdown(markdown, page, config, files):
    here = (TOP / page.file.src_uri).parent

    def to_page(found):
        """A link to a folder leads to its page."""
        end = (here / found[1]).resolve()
        return f"]({os.path.relpath(page_of(end), here)})" if end.is_dir() else found[0]

    return re.sub(r"\]\(([^)#:\s]+)\)", to_page, for_mkdocs(markdown)) + "".join(input_scripts(page))


def on_post_build(config):
    found = faults(Path(config["site_dir"]))
    if found:
        raise PluginError("the site has faults:\n" + "\n".join(found))
