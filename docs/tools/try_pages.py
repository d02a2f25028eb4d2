#!/usr/bin/env python3
"""Runs the commands of the documentation's pages, each page in a folder of its own, and compares what they quote.

    docs/test.sh [PAGE.md...]

Exit code 1 and a line for each command that failed where it should not, or printed something else. $DIURNA is the folder of the
sources, as on the pages; DIURNA_PROGRAM names another program than that of build/release.
"""

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from page_blocks import blocks_of, commands_of, first_misfit

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = Path(os.environ.get("DIURNA_PROGRAM", ROOT / "build/release/diurna"))
LONGEST = 600  # [s] that a command may take


def run(command, folder, environment):
    """Exit code and the lines printed; no code of what takes too long."""
    try:
        done = subprocess.run(["bash", "-o", "pipefail", "-c", command], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=LONGEST)
    except subprocess.TimeoutExpired:
        return None, [f"not done after {LONGEST} s"]
    return done.returncode, done.stdout.decode("utf-8", "replace").rstrip("\n").split("\n")


def try_block(block, folder, environment):
    """Mistakes of one block, and the folder that it leaves its reader in."""
    mistakes = []
    commands = commands_of(block)
    for at, command in enumerate(commands):
        if command.text == "echo $?":
            continue
        if command.text.startswith("cd "):
            folder = folder / command.text[3:]
        code, lines = run("true" if command.text.startswith("cd ") else command.text, folder, environment)
        follows = commands[at + 1] if at + 1 < len(commands) else None
        expected = int(follows.quoted[0]) if follows and follows.text == "echo $?" else 0
        if code != expected:
            mistakes.append((command, f"exit code {code}, the page says {expected}", lines))
            continue
        misfit = first_misfit(command.quoted, [line.rstrip() for line in lines if line.strip()])
        if misfit is not None:
            mistakes.append((command, f"it does not print: {misfit}", lines))
    return mistakes, folder


def try_page(page, scratch):
    """Number of commands, of mistakes."""
    folder = scratch / page.relative_to(ROOT).with_suffix("")
    folder.mkdir(parents=True)
    environment = dict(os.environ, DIURNA=str(ROOT), XDG_CACHE_HOME=str(scratch / "cache"),
                       PATH=f"{PROGRAM.parent}:{os.environ['PATH']}")
    commands = mistakes = 0
    for block in blocks_of(page.read_text()):
        first, _, rest = block.text.partition("\n")
        if first.startswith("# not run: "):
            continue
        if first.startswith("# file: "):
            (folder / first[8:]).parent.mkdir(parents=True, exist_ok=True)
            (folder / first[8:]).write_text(rest if first.endswith(".csv") else block.text)
        elif first.startswith("# add to "):
            with open(folder / first[9:], "a") as file:
                file.write("\n" + rest)
        elif block.language == "console":
            commands += sum(c.text != "echo $?" for c in commands_of(block))
            found, folder = try_block(block, folder, environment)
            for command, what, lines in found:
                mistakes += 1
                print(f"{page.relative_to(ROOT)}:{command.line}: {command.text}\n    {what}")
                print("".join(f"    | {line}\n" for line in lines[-40:]), end="")
        elif block.language in ("toml", "csv"):
            mistakes += 1
            print(f"{page.relative_to(ROOT)}:{block.line}: say which file it is (# file: NAME, # add to NAME)")
    return commands, mistakes


def main(names):
    pages = [Path(name).resolve() for name in names]
    pages = pages or sorted((ROOT / "docs").glob("*.md")) + sorted((ROOT / "docs").glob("*/**/*.md"))
    begin, wrong = time.monotonic(), 0
    with tempfile.TemporaryDirectory() as scratch:
        for page in pages:
            start = time.monotonic()
            commands, mistakes = try_page(page, Path(scratch))
            wrong += mistakes
            if commands:
                print(f"{page.relative_to(ROOT)}: {commands} commands, {mistakes} wrong, {time.monotonic() - start:.1f} s",
                      flush=True)
    print(f"all: {wrong} wrong, {time.monotonic() - begin:.0f} s")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
