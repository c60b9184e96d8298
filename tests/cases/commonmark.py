# SPDX-License-Identifier: GPL-2.0-or-later
"""Lists, code, tables and headings of every page on the site are those of CommonMark, as another program reads it."""
from difflib import unified_diff
from html.parser import HTMLParser
import re
import sys

import markdown
from markdown_it import MarkdownIt

from case import main, require
from site_of_pages import SOURCE

sys.path.insert(0, str(SOURCE / "scripts/site"))
from dialect import for_mkdocs

BLOCKS = ("ul", "ol", "li", "pre", "table", "tr", "h1", "h2", "h3", "h4")
EXTENSIONS = ["tables", "fenced_code", "sane_lists", "pymdownx.betterem"]  # those of mkdocs.yml that make blocks


class Outline(HTMLParser):
    """(block, the beginning of its text) of a page, paragraphs as text of what they stand in."""

    def __init__(self, html):
        super().__init__()
        self.blocks = [["", ""]]
        self.feed(html)
        self.lines = [f"{tag}: {' '.join(text.split())[:60]}" for tag, text in self.blocks if tag]

    def handle_starttag(self, tag, attributes):
        if tag in BLOCKS:
            self.blocks.append([tag, ""])
        elif tag == "p" and (self.blocks[-1][0] != "li" or self.blocks[-1][1].strip()):
            self.blocks.append(["", ""])

    def handle_data(self, data):
        self.blocks[-1][1] += " " + data


def pages():
    yield from sorted(SOURCE.glob("*.md"))
    for folder in ("bench", "doc", "examples", "tests"):
        yield from sorted((SOURCE / folder).rglob("*.md"))


def differences(text, reference, made_ready=for_mkdocs):
    found = Outline(markdown.markdown(made_ready(text), extensions=EXTENSIONS)).lines
    text = re.sub(r"^<!--.*-->$", "", text, flags=re.M)
    return list(unified_diff(Outline(reference.render(text)).lines, found, "CommonMark", "site", "", "", 0, ""))


def blocks_of_pages(ranks):
    reference = MarkdownIt("commonmark", {"html": False}).enable("table")
    require(differences("- a\n\n      code\n", reference, str), "code that is read as a paragraph is not noticed")
    read = 0
    for page in pages():
        found = differences(page.read_text(), reference)
        require(not found, f"{page.relative_to(SOURCE)} is read otherwise:\n" + "\n".join(found[:30]))
        read += 1
    require(read > 80, f"only {read} pages")


main({"blocks-of-pages": blocks_of_pages})
