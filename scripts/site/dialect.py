# SPDX-License-Identifier: GPL-2.0-or-later
"""The pages are CommonMark, as code hosts show them; MkDocs reads an older Markdown. What differs is put right here."""
import re

ITEM = re.compile(r"([-*] +|\d+\. +)")
NUMBER = re.compile(r"^(\d+)\.(?= )")  # within an item: a number that ends a sentence
FENCE = re.compile(r" *(```|~~~)")


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
            rest = line[width:]
            line = "    " + (rest if _is_code(rest) or fenced else NUMBER.sub(r"\1\\.", _text(rest)))
        elif line.strip() and not line.startswith(" "):
            width = 0
        several = width > 0 and (several or not line)  # blocks of an item: the next item begins after an empty line
        lines.append(line if fenced or _is_code(line) else _text(line))
    return "\n".join(lines)


def _is_code(line):
    return line.startswith("    ")


def _text(line):
    """A line in which `<x>` outside of code is text: pages have no tags but comments."""
    parts = re.split(r"(`+[^`]*`+)", line)
    for k in range(0, len(parts), 2):
        parts[k] = re.sub(r"<(?=[A-Za-z])", "&lt;", parts[k])
    return "".join(parts)
