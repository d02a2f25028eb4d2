#!/usr/bin/env python3
"""Lays out what mkdocs builds the site of: docs/tools/gather.py FOLDER.

Pages written for the site are in docs/. Keys, library and the folders' own pages are copied from their places. The help of every
command and the places of the equations are added here, at <!-- marks -->. Links between files of the repository become links between
pages; a link to a file that is no page becomes its name. A validation table that differs between README.md and docs/validation.md
is a mistake (bench/update_readme.sh fills both).
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
    "README.md": "code/README.md",
    "materials/README.md": "code/materials.md",
    "terrain/README.md": "code/terrain.md",
    "thermal/README.md": "code/thermal.md",
    "thermal/weather_file/README.md": "code/weather_file.md",
    "render/README.md": "code/render.md",
    "scenes/README.md": "code/scenes.md",
    "scenes/crossover/README.md": "code/crossover.md",
    "scenes/approach/README.md": "code/approach.md",
    "python/README.md": "code/python.md",
    "packaging/README.md": "code/packaging.md",
    "SECURITY.md": "code/SECURITY.md",
    "CONTRIBUTING.md": "code/CONTRIBUTING.md",
    "CHANGELOG.md": "code/CHANGELOG.md",
    "bench/courtyard/README.md": "code/courtyard.md",
    "tests/scenes/mistakes.md": "reference/mistakes.md",
    "scenes/KEYS.md": "reference/keys.md",
    "materials/LIBRARY.md": "reference/materials.md",
}


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
    """The text of a page between <!-- mark --> and <!-- end -->."""
    return re.search(f"<!-- {mark} -->\n(.*?)<!-- end -->", (ROOT / page).read_text(), re.S)[1]


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


def help_texts():
    """The help of the program and of each verb, as sections of docs/reference/commands.md."""
    whole = help_of()
    verbs = re.findall(r"^  ([a-z]+)(?= {2,}|$)", whole, re.M)
    page = (ROOT / "docs/reference/commands.md").read_text()
    unnamed = [verb for verb in verbs if not re.search(rf"`(diurna )?{verb}\b", page)]
    if not verbs or unnamed:
        raise SystemExit(f"docs/reference/commands.md: no row for {', '.join(unnamed) or 'any command'}")
    text = f"## diurna --help\n\n```text\n{whole}\n```\n"
    for verb in verbs:
        text += f"\n## diurna {verb}\n\n```text\n{help_of(verb)}\n```\n"
    return text


def main(folder):
    stage = Path(folder)
    site, pictures = pages(), set()
    if marked("README.md", "validation") != marked("docs/validation.md", "validation"):
        raise SystemExit("docs/validation.md: another table than README.md (bench/update_readme.sh fills both)")
    made = {"places of equations": equation_places, "help of every command": help_texts}
    for source, target in site.items():
        text = (ROOT / source).read_text()
        for mark, text_of in made.items():
            if f"<!-- {mark} -->" in text:
                text = text.replace(f"<!-- {mark} -->", text_of())
        place = stage / "pages" / target
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(with_links(text, source, target, site, pictures))
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
