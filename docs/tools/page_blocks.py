"""Fenced blocks of a Markdown page, and what the ones for readers' terminals ask for.

A block that begins with "# file: NAME" is that file, one that begins with "# add to NAME" goes to its end. A ```console block
has commands behind "$ " and, below each, what it prints. A line "..." stands for any number of lines, "…" within a line for any
words; empty lines do not count, and spaces in a row are one. A command fails unless "$ echo $?" follows, which tells its exit
code. A block that begins with "# not run: REASON" is shown alone.
"""

import re
from dataclasses import dataclass, field


@dataclass
class Block:
    line: int  # of the page, from 1, where the text begins
    language: str
    text: str


@dataclass
class Command:
    line: int
    text: str
    quoted: list = field(default_factory=list)  # lines that it prints


def blocks_of(page):
    """Of a page's text, from top to bottom."""
    found, opened, fence = [], None, ""
    for number, line in enumerate(page.split("\n"), 1):
        mark = re.match(r"(```+)\s*([\w-]*)\s*$", line)
        if opened is None and mark:
            opened, fence = Block(number + 1, mark[2], ""), mark[1]
        elif opened is not None and line.rstrip() == fence:
            found.append(opened)
            opened = None
        elif opened is not None:
            opened.text += line + "\n"
    if opened is not None:
        raise ValueError(f"line {opened.line}: a block that does not end")
    return found


def commands_of(block):
    """Of a console block. A command goes on in the next line after a backslash, and to the end word of a "here" text."""
    found, ends_with = [], None
    for number, line in enumerate(block.text.rstrip("\n").split("\n"), block.line):
        if ends_with is not None:
            found[-1].text += "\n" + line
            if line == ends_with:
                ends_with = None
        elif found and found[-1].text.endswith("\\"):
            found[-1].text += "\n" + line
        elif line.startswith("$ "):
            found.append(Command(number, line[2:]))
            here = re.search(r"<<'?(\w+)'?", line)
            ends_with = here[1] if here else None
        elif found:
            found[-1].quoted += [line.rstrip()] if line.strip() else []
        else:
            raise ValueError(f"line {number}: output before any command")
    return found


def line_fits(quoted, line):
    one_space = [re.sub(r"\s+", " ", text) for text in (quoted, line)]
    pattern = ".*".join(re.escape(part) for part in one_space[0].split("…"))
    return re.fullmatch(pattern, one_space[1]) is not None


def first_misfit(quoted, lines):
    """The first quoted line that the lines do not have where it should stand; None if they have all of them."""
    at, anywhere, blocks = 0, False, []  # runs of lines that follow one another, and whether they may begin anywhere
    run = []
    for line in quoted + ["..."]:
        if line.strip() == "...":
            if run:
                blocks.append((anywhere, run))
            anywhere, run = True, []
        else:
            run.append(line)
    whole = bool(quoted) and quoted[-1].strip() != "..."
    for anywhere, run in blocks:
        best = -1
        for start in range(at, len(lines) + 1) if anywhere else [at]:
            fit = 0
            while fit < len(run) and start + fit < len(lines) and line_fits(run[fit], lines[start + fit]):
                fit += 1
            if fit == len(run):
                at = start + fit
                break
            best = max(best, fit)
        else:
            return run[best]
    if whole and at != len(lines):
        return f"(nothing after it, but there is {lines[at]!r})"
    return None
