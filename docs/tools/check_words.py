#!/usr/bin/env python3
"""Finds words that the pages avoid: docs/tools/check_words.py [PAGE.md...], all pages of the repository if none is given.

Checked is the text that people write: not blocks of code, not words in back quotes, not tables between generated marks, and not
the pages that the program prints. Exit code 1 and a line with a remedy for each finding.
"""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PRINTED = {"scenes/KEYS.md", "materials/LIBRARY.md", "tests/scenes/mistakes.md"}

# Words and phrases -> what to write instead.
AVOIDED = {
    r"told|tells?": "report, print, warn, give",
    r"(ask|asks|asked) for|wanted": "requested, needs",
    r"anew": "again, recomputed, regenerated",
    r"amiss": "wrong, missing, changed",
    r"hardly|doubts?": "implausible, not, warnings",
    r"goes": "moves, is, leads",
    r"on (its|their) way": "moving, on its trajectory",
    r"what (goes|stands|rides|moves)": "moving object, object at rest",
    r"stands? (for|in|written|there)|stood|as it stands": "represents, replaces, is",
    r"of (its|their) kind|(its|their|the) like": "representative, similar",
    r"likewise": "the same text again",
    r"felt|feels?": "thermally coupled",
    r"(left|leave|leaves|leaving) out|passed over": "skipped, omitted",
    r"(has been|have|is not) found": "converged, computed, from cache",
    r"worth": "changes the temperature by",
    r"light up|shines?|luminar(y|ies)": "illumination, light source",
    r"strays?|hops?": "outlier, secondary ray",
    r"at best": "lowest, highest",
    r"at the (least|most)": "at least, at most",
    r"nought": "zero",
    r"mends?": "repair, remedy",
    r"made up": "generated, invented",
    r"makes of": "computes from",
    r"there is none|to whom": "does not exist, the observer",
    r"will do": "is sufficient, limit",
    r"at hand": "available",
    r"but for (its|what|the)": "except",
    r"[\w.]+,? for one(?=[:;,.])": "for example",
    r"whatsoever|thereof|wherefore|heretofore|unto|betwixt|shall": "plain words",
}


def written(text):
    """The text with everything replaced by blanks that is not prose, line by line as before."""

    def blank(match):
        return re.sub(r"[^\n]", " ", match[0])

    text = re.sub(r"^```.*?^```[^\n]*$", blank, text, flags=re.M | re.S)
    text = re.sub(r"<!-- (\w+) -->\n.*?<!-- end -->", blank, text, flags=re.S)
    text = re.sub(r"^    [^\n]*$", blank, text, flags=re.M)
    text = re.sub(r"`[^`\n]*`", blank, text)
    return re.sub(r"\]\([^)\n]*\)", blank, text)


def findings(text):
    """Line, words and remedy of each."""
    prose = written(text)
    for words, remedy in AVOIDED.items():
        for match in re.finditer(rf"\b({words})\b", prose, re.I):
            yield prose.count("\n", 0, match.start()) + 1, match[0], remedy


def main(names):
    pages = [Path(name).resolve() for name in names]
    if not pages:
        listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "*.md"], cwd=ROOT, check=True, capture_output=True,
                                text=True).stdout.split()
        pages = [ROOT / name for name in listed if name not in PRINTED]
    wrong = 0
    for page in pages:
        for line, words, remedy in sorted(findings(page.read_text())):
            wrong += 1
            print(f"{page.relative_to(ROOT)}:{line}: \"{words}\" (write: {remedy})")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
