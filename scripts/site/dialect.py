# SPDX-License-Identifier: GPL-2.0-or-later
"""The pages are CommonMark, as code hosts show them; MkDocs reads an older Markdown. What differs is put right here."""
import re

ITEM = re.compile(r"([-*] +|\d+\. +)")
NUMBER = re.compile(r"^(\d+)\.(?= )")  # within an item: a number that ends a sentence
FENCE = re.compile(r" *(```|~~~)")
HTML = r"/?(?:a|img|br|sub|sup|p|div|details|summary|!--)\b|!--"


def for_mkdocs(text):
    """A page whose blocks are those of CommonMark: items are indented by four, `<x>` is no tag."""
    lines, width, fenced, several = [], 0, False, False
    for line in text.split("\n"):
        if FENCE.match(line):
            fenced = not fenced
        item = ITEM.match(line)
        if item and not fenced:
            lines += [""] if several and lines[-1] else []
            width, several = len(item[0]), False
        elif width and line.startswith(" " * width):
            line = "    " + NUMBER.sub(r"\1\\.", line[width:])
        elif line.strip() and not line.startswith(" "):
            width = 0
        several = (
            several or not line
        ) and width > 0  # an item of several blocks: the next one begins after an empty line
        lines.append(line if fenced or line.startswith("    ") else _plain(line))
    return "\n".join(lines)


def _plain(line):
    """A line's text with what is no tag, outside of code."""
    parts = re.split(r"(`+[^`]*`+)", line)
    for k in range(0, len(parts), 2):
        parts[k] = re.sub(rf"<(?!{HTML})(?=[A-Za-z])", "&lt;", parts[k])
    return "".join(parts)
