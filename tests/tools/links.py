# SPDX-License-Identifier: GPL-2.0-or-later
"""The links of Markdown pages that lead within their own tree, and whether there is something at their ends."""
import re

FENCED = re.compile(r"^(```|~~~).*?^\1", re.M | re.S)
CODE = re.compile(r"(`+)(?!`).*?(?<!`)\1(?!`)", re.S)
LINKS = (
    re.compile(r"\]\(\s*<?([^)\s>]+)>?(?:\s+[\"'][^)]*)?\)"),  # [text](target), ![picture](target "title")
    re.compile(r"^ {0,3}\[[^\]]+\]:\s*<?([^\s>]+)", re.M),  # [name]: target
    re.compile(r"<(?:a|img)\b[^>]*?\b(?:href|src)=[\"']([^\"']+)", re.I),
)
HEADING = re.compile(r"^#{1,6}\s+(.*?)\s*#*\s*$", re.M)


def prose(text):
    """A page without its code, where brackets are no links."""
    return CODE.sub("", FENCED.sub("", text))


def anchors(text):
    """What `#...` may name on a page: its headings, as GitHub writes them, and a number where one comes again."""
    found = set()
    for heading in HEADING.findall(FENCED.sub("", text)):
        words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
        slug = name = re.sub(r"[^\w\- ]", "", words).strip().replace(" ", "-")
        again = 0
        while name in found:
            again += 1
            name = f"{slug}-{again}"
        found.add(name)
    return found


def links_of(page):
    """The targets of a page's links that do not lead to the web."""
    text = prose(page.read_text())
    return [
        target
        for pattern in LINKS
        for target in pattern.findall(text)
        if not re.match(r"[a-z][a-z0-9+.-]*:", target, re.I)
    ]


def broken_links(pages, top):
    """(number of links followed, the broken ones in words); a link that leads out of `top` is one."""
    followed, broken = 0, []
    top = top.resolve()
    for page in pages:
        for target in links_of(page):
            followed += 1
            name, _, anchor = target.partition("#")
            end = (page.parent / name).resolve() if name else page.resolve()
            if end != top and top not in end.parents:
                broken.append(f"{page}: {target} leads out of the tree")
            elif not end.exists():
                broken.append(f"{page}: {target} is not there")
            elif anchor and (end.suffix != ".md" or anchor not in anchors(end.read_text())):
                broken.append(f"{page}: {target}: no such heading")
    return followed, broken
