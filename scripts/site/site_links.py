# SPDX-License-Identifier: GPL-2.0-or-later
"""The links of a site that is built: whether pages, files, pictures and headings are there, and nothing is loaded from
another host."""
from html.parser import HTMLParser
import re
from urllib.parse import unquote, urlsplit


class Reader(HTMLParser):
    """Of a page: the names that `#...` may lead to, where links lead, and what is loaded to show it."""

    def __init__(self):
        super().__init__()
        self.names, self.links, self.loaded = set(), [], []

    def handle_starttag(self, tag, attributes):
        words = dict(attributes)
        self.names.update(words[key] for key in ("id", "name") if words.get(key))
        if tag == "a" and words.get("href"):
            self.links.append(words["href"])
        elif words.get("src"):
            self.loaded.append(words["src"])
        elif tag == "link" and {"stylesheet", "icon", "preload"}.intersection(words.get("rel", "").split()):
            self.loaded.append(words["href"])


def read(page):
    reader = Reader()
    reader.feed(page.read_text())
    return reader


def faults(site):
    """In words, what is wrong with the links of all pages below the folder `site`."""
    site = site.resolve()
    pages = {page: read(page) for page in sorted(site.rglob("*.html")) if page.name != "404.html"}
    found = []
    for page, reader in pages.items():
        for target in reader.links + reader.loaded:
            where = f"{page.relative_to(site)}: {target}"
            parts = urlsplit(target)
            if parts.scheme or parts.netloc:
                if target in reader.loaded and parts.scheme != "data":
                    found.append(f"{where} is loaded from another host")
                continue
            end = (page.parent / unquote(parts.path)).resolve() if parts.path else page
            end = end / "index.html" if end.is_dir() else end
            if site not in end.parents or not end.is_file():
                found.append(f"{where} leads nowhere")
            elif parts.fragment and end in pages and unquote(parts.fragment) not in pages[end].names:
                found.append(f"{where}: no such heading")
    for sheet in sorted(site.rglob("*.css")):
        found += [f"{sheet.relative_to(site)}: {url} is loaded from another host" for url in outside(sheet.read_text())]
    return found


def outside(sheet):
    return re.findall(r"url\(\s*[\"']?((?:https?:)?//[^)\"']+)", sheet)
