#!/usr/bin/env python3
"""Checks a built site: docs/tools/check_site.py FOLDER.

Every link and anchor within it leads somewhere; nothing that a browser loads by itself (scripts, styles, fonts, pictures, frames)
comes from elsewhere. Links that a reader may click lead anywhere.
"""

import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

LOADED = {"script": "src", "img": "src", "iframe": "src", "source": "src", "embed": "src", "object": "data", "input": "src"}


class Page(HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.links, self.loads, self.anchors, self.styles = [], [], set(), []
        self._in_style = False
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self._in_style = tag == "style"
        for name in ("id", "name"):
            if values.get(name):
                self.anchors.add(values[name])
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
        if tag == "link" and values.get("href") and values.get("rel") != "canonical":
            self.loads.append(values["href"])
        if tag in LOADED and values.get(LOADED[tag]):
            self.loads.append(values[LOADED[tag]])
        if values.get("style"):
            self.styles.append(values["style"])

    def handle_data(self, data):
        if self._in_style:
            self.styles.append(data)


def loads_of_style(text):
    return re.findall(r"url\(\s*['\"]?([^'\")]+)", text) + re.findall(r"@import\s+['\"]([^'\"]+)", text)


def is_elsewhere(address):
    return bool(urlsplit(address).netloc)


def main(folder):
    root = Path(folder).resolve()
    pages = {path: Page(path.read_text()) for path in sorted(root.rglob("*.html"))}
    mistakes, links, loads = [], 0, 0

    def lead(path, address, is_load):
        where = path.relative_to(root)
        if address.startswith("data:"):
            return
        if is_elsewhere(address):
            if is_load:
                mistakes.append(f"{where}: loads {address} from elsewhere")
            return
        parts = urlsplit(address)
        if parts.scheme:
            return
        named = (path.parent / unquote(parts.path)).resolve() if parts.path else path
        if path.name == "404.html" and parts.path.startswith("/"):
            named = (root / parts.path.lstrip("/")).resolve()
        if named.is_dir():
            named = named / "index.html"
        if not named.exists():
            mistakes.append(f"{where}: {address} leads nowhere")
        elif parts.fragment and named in pages and unquote(parts.fragment) not in pages[named].anchors:
            mistakes.append(f"{where}: {address}: no such place on that page")

    for path, page in pages.items():
        for address in page.links:
            links += 1
            lead(path, address, False)
        for address in page.loads + [a for style in page.styles for a in loads_of_style(style)]:
            loads += 1
            lead(path, address, True)
    for path in sorted(root.rglob("*.css")):
        for address in loads_of_style(path.read_text()):
            loads += 1
            if is_elsewhere(address):
                mistakes.append(f"{path.relative_to(root)}: loads {address} from elsewhere")
    for line in mistakes:
        print(line, file=sys.stderr)
    print(f"{len(pages)} pages, {links} links, {loads} things loaded, {len(mistakes)} mistakes")
    return 1 if mistakes or not pages else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
