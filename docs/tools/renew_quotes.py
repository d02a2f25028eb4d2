#!/usr/bin/env python3
"""Writes what the program prints now into the pages' quotes: docs/tools/renew_quotes.py PAGE.md...

For a change of messages. Each quoted line that the command no longer prints is replaced by the most similar line of its output, with
"…" again where the quote had it, or where a number differs from the quote's. Look at the difference before you commit it.
"""

import difflib
import os
import re
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from page_blocks import blocks_of, commands_of, first_misfit, line_fits
from try_pages import PROGRAM, ROOT, run

NUMBER = re.compile(r"[-+]?\d(?:[\d.:eTZ+-]*\d)?Z?")


def renewed(old, line):
    """The printed line as the quote has to say it."""
    if "…" not in old:
        return line
    known = [word for word in re.split(r"[\s,;()]+", old) if word]

    def number(match):
        if match[0] in known:
            return match[0]
        for word in known:
            head = word.split("…")[0]
            if "…" in word and head and match[0].startswith(head):
                return word.strip(":")
        return "…"

    return NUMBER.sub(number, line)


def closest(old, lines):
    return max(lines, key=lambda line: difflib.SequenceMatcher(None, old, line).ratio(), default=None)


def renew(page):
    """Runs a page's blocks and replaces quotes; number of lines replaced."""
    text = page.read_text()
    lines, changes = text.split("\n"), 0
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch) / "page"
        folder.mkdir()
        environment = dict(os.environ, DIURNA=str(ROOT), XDG_CACHE_HOME=f"{scratch}/cache",
                           PATH=f"{PROGRAM.parent}:{os.environ['PATH']}")
        for block in blocks_of(text):
            first, _, rest = block.text.partition("\n")
            if first.startswith("# file: "):
                (folder / first[8:]).write_text(rest if first.endswith(".csv") else block.text)
            elif first.startswith("# add to "):
                with open(folder / first[9:], "a") as file:
                    file.write("\n" + rest)
            if block.language != "console" or first.startswith("# "):
                continue
            for command in commands_of(block):
                if command.text == "echo $?":
                    continue
                if command.text.startswith("cd "):
                    folder = folder / command.text[3:]
                    continue
                printed = [line.rstrip() for line in run(command.text, folder, environment)[1] if line.strip()]
                if first_misfit(command.quoted, printed) is None:
                    continue
                at = command.line - 1 + command.text.count("\n") + 1
                for old in command.quoted:
                    while lines[at].rstrip() != old:
                        at += 1
                    if old.strip() != "..." and not any(line_fits(old, line) for line in printed):
                        new = closest(old, printed)
                        if new is not None:
                            lines[at] = renewed(old, new.replace(str(folder), "…"))
                            changes += 1
                    at += 1
    page.write_text("\n".join(lines))
    return changes


if __name__ == "__main__":
    for name in sys.argv[1:]:
        print(f"{name}: {renew(Path(name).resolve())} lines renewed", flush=True)
