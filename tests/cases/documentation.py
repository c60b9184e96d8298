# SPDX-License-Identifier: GPL-2.0-or-later
"""The pages before the reference: messages that they quote are those of the sources, all questions are in their list,
numbers are those that are tested, and all pages become a site without a fault."""
import json
import os
from pathlib import Path
import re
import shutil
import subprocess
import sys

from case import main, require
from links import anchors
import make_gallery
from site_of_pages import SOURCE, built, scratch

sys.path.insert(0, str(SOURCE / "scripts/site"))
from dialect import for_mkdocs
from site_links import faults

HOST = Path(os.environ["GRAINSCOPE_HOST_SOURCE"])
DOC = SOURCE / "doc"
LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
TOLD = 8  # letters of a message that a piece of it must have to be looked for


def literals(folder):
    """What the sources say: their string literals, those that follow one another as one."""
    texts = []
    for path in sorted([*folder.rglob("*.cpp"), *folder.rglob("*.h")]):
        text = re.sub(r"^#include.*$", "", path.read_text(errors="replace"), flags=re.M)
        texts += LITERAL.findall(re.sub(r'"\s*"', "", text))
    return "\n".join(texts)


def pieces(message):
    return [piece.strip(" '") for piece in message.split("...") if len(piece.strip(" '")) >= TOLD]


def quoted(page, chapter):
    text = re.split(r"^## ", page, flags=re.M)
    found = re.findall(r"^### `(.+)`$", next(part for part in text if part.startswith(chapter)), re.M)
    require(len(found) >= 10, f"only {len(found)} messages under '{chapter}'")
    return found


def messages_are_those_of_the_sources(ranks):
    page = (DOC / "faq.md").read_text()
    for chapter, folder in (("Messages of grainscope", SOURCE / "src"), ("Messages of LIGGGHTS", HOST)):
        said = literals(folder)
        require("this is said by nobody" not in said, "everything is found")
        for message in quoted(page, chapter):
            for piece in pieces(message):
                require(piece in said, f"no source in {folder} says '{piece}', which doc/faq.md quotes of '{message}'")


def questions_are_listed(ranks):
    """Each question of the pages that answer them, once; and at least 40."""
    listed = re.findall(r"\]\((measure_\w+\.md#[^)]+)\)", (DOC / "how_do_i.md").read_text())
    asked = []
    for page in sorted(DOC.glob("measure_*.md")):
        text = page.read_text()
        names = anchors("\n".join(re.findall(r"^## .*$", text, re.M)))
        asked += [f"{page.name}#{name}" for name in names]
    require(sorted(listed) == sorted(asked), f"in one of them alone: {sorted(set(listed) ^ set(asked))}")
    require(len(asked) >= 40, f"only {len(asked)} questions")


def rows_of(expected):
    """What expected.json asserts, as the rows of a table."""
    for value in expected["values"]:
        where = value["reduce"] + (f" from step {value['from']}" if "from" in value else "")
        yield f"| {value['file']} | {value['column']} | {where} | {value['expected']} +- {value['tolerance']} |"


def tutorials_have_the_tested_numbers(ranks):
    """The table of each tutorial is what the test of its example asserts, of the run that it names."""
    pages = sorted(DOC.glob("tutorial_*.md"))
    require(len(pages) >= 5, f"only {len(pages)} tutorials")
    for page in pages:
        text = page.read_text()
        example = re.search(r"\(\.\./examples/(\w+)/expected\.json\)", text)[1]
        expected = json.loads((SOURCE / "examples" / example / "expected.json").read_text())
        words = " ".join(f"-var {name} {value}" for name, value in expected["variables"].items())
        table = "\n".join(rows_of(expected))
        require(f"`{words}`" in text, f"{page.name} must name the tested run: {words}")
        require(table in text, f"{page.name} must have these rows:\n{table}")


def gallery(ranks):
    """The page is that of its list, whose pictures and examples are there."""
    require(
        (DOC / "gallery.md").read_text() == make_gallery.page(), "tests/tools/make_gallery.py --write makes it anew"
    )
    for picture in make_gallery.pictures():
        require((DOC / "images" / picture["picture"]).is_file(), f"doc/images/{picture['picture']} is missing")
        require((SOURCE / picture["example folder"]).is_dir(), f"{picture['example folder']} is missing")


def site(ranks):
    code, words = built(scratch() / "site")
    require(code == 0, f"mkdocs ended with {code}:\n{words[-4000:]}")
    for name in ("index.html", "doc/how_do_i.html", "examples/silo/index.html", "search/search_index.json"):
        require((scratch() / "site" / name).is_file(), f"the site has no {name}")
    page = (scratch() / "site/examples/silo/index.html").read_text()
    require("zcylinder ${R} 0 0" in page, "the silo's page does not show its input script")


def faults_are_found(ranks):
    """Each way in which a link of a site can be wrong, and what comes from elsewhere, among right ones."""
    folder = scratch() / "pages"
    (folder / "sub").mkdir(parents=True)
    (folder / "sub/right.html").write_text('<h1 id="one">One</h1><a href="../index.html#top">up</a>')
    (folder / "picture.png").touch()
    (folder / "style.css").write_text("a { background: url(https://example.org/a.png) } b { src: url(data:x) }")
    right = (
        '<h1 id="top"><a href="sub/right.html#one"><a href="#top"><a href="https://example.org"><img src="picture.png">'
    )
    wrong = ["gone.html", "sub/right.html#two", "#bottom", "../beyond.html", "sub"]
    links = "".join(f'<a href="{target}">' for target in wrong)
    loaded = '<script src="https://example.org/x.js"></script><link rel="stylesheet" href="//example.org/y.css">'
    (folder / "index.html").write_text(right + links + loaded + '<img src="z">')
    found = faults(folder)
    for target in (*wrong, "https://example.org/x.js", "//example.org/y.css", "z", "https://example.org/a.png"):
        require(
            sum(re.search(rf": {re.escape(target)}:? ", fault) is not None for fault in found) == 1,
            f"'{target}' is not among {found}",
        )
    require(len(found) == len(wrong) + 4, f"found: {found}")


def page_without_a_place_refused(ranks):
    """A page that no line of the navigation names, in a copy of what the site is made of."""
    copy = scratch() / "copy"
    for name in ("doc", "examples", "tools", "scripts/site", "bench/README.md", "tests/README.md", "mkdocs.yml"):
        (copy / name).parent.mkdir(parents=True, exist_ok=True)
        kind = shutil.copytree if (SOURCE / name).is_dir() else shutil.copy
        kind(SOURCE / name, copy / name)
    for page in SOURCE.glob("*.md"):
        shutil.copy(page, copy)
    (copy / "doc/forgotten.md").write_text("# Forgotten\n")
    code, words = built(scratch() / "site", copy)
    wanted = "pages without a line under 'nav' of mkdocs.yml: doc/forgotten.md"
    require(code != 0 and wanted in words, f"mkdocs ended with {code}:\n{words[-2000:]}")


def lists_of_commonmark(ranks):
    """What the pages' Markdown and MkDocs's read differently, by hand."""
    for text, expected in (
        ("- a\n  b\n\n      code", "- a\n    b\n\n        code"),
        ("1. a\n\n   b\n2. c", "1. a\n\n    b\n\n2. c"),
        ("1. a\n2. b", "1. a\n2. b"),
        ("- above\n  4. The limit", "- above\n    4\\. The limit"),
        ("- a\n  <x>\n\n      <y>", "- a\n    &lt;x>\n\n        <y>"),
        ("- a\n\nb\n  c", "- a\n\nb\n  c"),
        ("mean <F_n> of `<F_n>`", "mean &lt;F_n> of `<F_n>`"),
        ("```\n- a\n  <b>\n```", "```\n- a\n  <b>\n```"),
        ("    <F_n> stays", "    <F_n> stays"),
    ):
        found = for_mkdocs(text)
        require(found == expected, f"{text!r} became {found!r}, not {expected!r}")


def script_refuses(ranks):
    done = subprocess.run(
        [SOURCE / "scripts/docs", "--serv"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    require(done.returncode == 1 and "got '--serv'" in done.stderr, f"exit code {done.returncode}: {done.stderr}")


main(
    {
        "messages-are-those-of-the-sources": messages_are_those_of_the_sources,
        "questions-are-listed": questions_are_listed,
        "tutorials-have-the-tested-numbers": tutorials_have_the_tested_numbers,
        "gallery": gallery,
        "site": site,
        "faults-are-found": faults_are_found,
        "page-without-a-place-refused": page_without_a_place_refused,
        "lists-of-commonmark": lists_of_commonmark,
        "script-refuses": script_refuses,
    }
)
