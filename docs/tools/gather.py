#!/usr/bin/env python3
"""Lays out what mkdocs builds the site of: docs/tools/gather.py FOLDER.

Pages written for the site stand in docs/; keys, library and the folders' own pages are taken from where they stand, so that each text is
once in the repository; the command line's page and the validation tables are made here. Links between files of the repository
become links between pages; to a file that is no page they become its name.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = Path(os.environ.get("DIURNA_PROGRAM", ROOT / "build/release/diurna"))

# Pages of the repository -> of the site.
TAKEN = {
    "README.md": "house/README.md",
    "materials/README.md": "house/materials.md",
    "terrain/README.md": "house/terrain.md",
    "thermal/README.md": "house/thermal.md",
    "thermal/weather_file/README.md": "house/weather_file.md",
    "render/README.md": "house/render.md",
    "scenes/README.md": "house/scenes.md",
    "scenes/crossover/README.md": "house/crossover.md",
    "scenes/approach/README.md": "house/approach.md",
    "python/README.md": "house/python.md",
    "packaging/README.md": "house/packaging.md",
    "SECURITY.md": "house/SECURITY.md",
    "CONTRIBUTING.md": "house/CONTRIBUTING.md",
    "CHANGELOG.md": "house/CHANGELOG.md",
    "bench/courtyard/README.md": "house/courtyard.md",
    "tests/scenes/mistakes.md": "reference/mistakes.md",
    "scenes/KEYS.md": "reference/keys.md",
    "materials/LIBRARY.md": "reference/materials.md",
}
MADE = {"docs/reference/commands.md": "reference/commands.md"}  # as pages of docs/ call it


def pages():
    """Of the repository -> of the site, all of them."""
    own = {p.relative_to(ROOT).as_posix(): p.relative_to(ROOT / "docs").as_posix()
           for p in sorted((ROOT / "docs").glob("**/*.md")) if p != ROOT / "docs/README.md"}
    return {**TAKEN, **own}


def outside_fences(text, change):
    """A page's text with `change` made to all but its blocks of code."""
    parts = re.split(r"(^```.*?^```[^\n]*$)", text, flags=re.M | re.S)
    return "".join(part if part.startswith("```") else change(part) for part in parts)


def with_links(text, source, target, site, pictures):
    """The links of `source` as its copy `target` has to say them."""

    def link(match):
        picture, words, address = match[1], match[2], match[3]
        if re.match(r"[a-z]+:", address) or address.startswith("#"):
            return match[0]
        path, mark, anchor = address.partition("#")
        named = os.path.normpath(os.path.join(os.path.dirname(source), path))
        if named in site:
            there = os.path.relpath(site[named], os.path.dirname(target) or ".")
            return f"{picture}[{words}]({there}{mark}{anchor})"
        if not (ROOT / named).exists():
            raise SystemExit(f"{source}: no file {named}")
        if named.endswith((".png", ".svg")):
            pictures.add(named)
            there = os.path.relpath(f"pictures/{named}", os.path.dirname(target) or ".")
            return f"{picture}[{words}]({there})"
        return words if words.startswith("`") else f"{words} (`{named}`)"

    return outside_fences(text, lambda part: re.sub(r"(!?)\[([^\]]*)\]\(([^)\s]+)\)", link, part))


def marked(page, mark):
    """What stands in a page between <!-- mark --> and <!-- end -->."""
    return re.search(f"<!-- {mark} -->\n(.*?)<!-- end -->", (ROOT / page).read_text(), re.S)[1]


def with_tables(text):
    """"<!-- table NAME of PAGE -->" becomes that table."""
    return re.sub(r"<!-- table (\w+) of (\S+) -->", lambda m: marked(m[2], m[1]), text)


def equation_places():
    """A table of the equations of docs/theory.md and of the sources that name them."""
    named = {}
    for folder in ("materials", "terrain", "thermal", "render", "scenes"):
        for source in sorted((ROOT / folder).glob("**/*.?pp")):
            for number in re.findall(r"\(T(\d+)\) of docs/theory\.md", source.read_text()):
                named.setdefault(int(number), []).append(source.relative_to(ROOT).as_posix())
    rows = [f"| (T{n}) | {', '.join(f'`{place}`' for place in dict.fromkeys(places))} |" for n, places in sorted(named.items())]
    return "\n".join(["| equation | computed in |", "|---|---|", *rows])


def help_of(*verb):
    return subprocess.run([PROGRAM, *verb, "--help"], check=True, capture_output=True, text=True).stdout.rstrip()


def command_page():
    """What the program says of itself, verb by verb."""
    whole = help_of()
    verbs = re.findall(r"^  ([a-z]+)(?= {2,}|$)", whole.split("Subcommands:")[1], re.M)
    text = "# Command line\n\nWhat `diurna --help` and `diurna VERB --help` print. Exit codes: 0 done; 1 failed while running, or the\n"
    text += "solver has not converged (results are kept); 2 bad input or usage.\n\n"
    text += f"```text\n{whole}\n```\n"
    for verb in verbs:
        text += f"\n## diurna {verb}\n\n```text\n{help_of(verb)}\n```\n"
    return text


def main(folder):
    stage = Path(folder)
    site, pictures = {**pages(), **MADE}, set()
    for source, target in pages().items():
        text = with_tables((ROOT / source).read_text()).replace("<!-- places of equations -->", equation_places())
        place = stage / "pages" / target
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(with_links(text, source, target, site, pictures))
    (stage / "pages/reference/commands.md").write_text(command_page())
    for picture in sorted(pictures):
        place = stage / "pages/pictures" / picture
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / picture, place)
    shutil.copy(ROOT / "docs/pages.css", stage / "pages")
    shutil.copy(ROOT / "docs/mkdocs.yml", stage)
    shutil.copytree(ROOT / "docs/theme", stage / "theme", dirs_exist_ok=True)


if __name__ == "__main__":
    if not PROGRAM.exists():
        sys.exit("docs: build the program first: cmake --preset release && cmake --build --preset release --target diurna")
    main(sys.argv[1])
