"""The table of stiff and extreme cases: what is extreme, what is right, what came out.

    table.py                    runs the quick cases and prints their rows
    table.py --all              the slow ones and those of ctest's own label `stiff`, too
    table.py --write FILE       --all, written as Markdown: docs/stiff.md
    table.py --only TEXT        cases whose phase or name contains TEXT

Exit 1 when a row fails that is not a known failure (KNOWN below), when a known one holds, or when docs/stiff.md lacks a row."""
import argparse
import datetime
import sys

import chain_cases  # noqa: F401  each module adds its cases
import fem_cases  # noqa: F401
import file_cases  # noqa: F401
import lem_cases  # noqa: F401
import mpm_cases  # noqa: F401
import transfer_cases  # noqa: F401
from ctest_cases import rows_of_ctest
from rows import Outcome, cases, judged, root

# Rows that show a defect nobody has mended yet, with the page that explains it.
KNOWN = {}

HEAD = """# Stiff and extreme cases

What is extreme, what is right by a closed form, a bound or a refusal, and what came out. Margin: what is allowed over what was
reached; *refusal* where the right answer is a clear no. A row that does not hold says **fails**. Written by

    tests/stiff/table.py --write docs/stiff.md

(`ctest -L stiff` runs the quick ones, `ctest -L long` checks every row; Froude's proportion of a scaled dam: lengths L, times
sqrt(L / g), stiffness and cohesion rho g L.)

"""


def line(phase, name, extreme, right, outcome, seconds):
    verdict = outcome.margin if outcome.holds else "**fails**"
    cells = (name, phase, extreme, right, outcome.text.strip("; "), verdict, f"{seconds:.1f}")
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--all", action="store_true")
    options.add_argument("--write")
    options.add_argument("--only", default="")
    asked = options.parse_args()
    every = asked.all or asked.write is not None

    rows, wrong, total = [], [], 0.0
    page = (root / "docs/stiff.md").read_text() if not asked.write else None

    def keep(phase, name, extreme, right, outcome, seconds):
        nonlocal total
        total += seconds
        rows.append((phase, line(phase, name, extreme, right, outcome, seconds)))
        print(rows[-1][1], flush=True)
        if outcome.holds == (name in KNOWN):
            wrong.append(name)
        if page is not None and f"| {name} | {phase} |" not in page:
            wrong.append(f"{name} (not in docs/stiff.md)")

    for each in cases:
        if (each.slow and not every) or asked.only not in f"{each.phase} {each.name}":
            continue
        outcome, seconds = judged(each)
        keep(each.phase, each.name, each.extreme, each.right, outcome, seconds)
    for each in rows_of_ctest(asked.only) if every else ():
        keep(each.phase, each.name, each.extreme, each.right, Outcome(each.text, each.holds, each.margin), each.seconds)

    print(f"{len(rows)} rows, {total:.1f} CPU seconds; not as expected: {', '.join(wrong) or 'none'}")
    if asked.write:
        order = ["LEM", "FEM", "transfer", "MPM", "chain", "files"]
        text = HEAD + "| case | phase | extreme | right | came out | margin | CPU s |\n|---|---|---|---|---|---|---|\n"
        text += "".join(row + "\n" for phase, row in sorted(rows, key=lambda pair: order.index(pair[0])))
        text += f"\n{len(rows)} rows, {total:.0f} CPU seconds in all, {datetime.date.today()}.\n"
        if KNOWN:
            text += "\nKnown failures:\n\n" + "".join(f"- *{name}*: {where}\n" for name, where in KNOWN.items())
        with open(asked.write, "w") as out:
            out.write(text)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
