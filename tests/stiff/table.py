#!/usr/bin/python3
"""The table of stiff and extreme cases: what is extreme, what is right, what came out.

    table.py                    runs the quick cases and prints their rows
    table.py --all              the slow ones and those of ctest's own label `stiff`, too
    table.py --markdown         --all, as the rows of docs/verification/stiff.md (workflows/verification/write)
    table.py --only TEXT        cases whose phase or name contains TEXT

Exit 1 when a row fails, or when docs/verification/stiff.md lacks a row."""
import argparse
import sys

import chain_cases  # noqa: F401  each module adds its cases
import fem_cases  # noqa: F401
import file_cases  # noqa: F401
import lem_cases  # noqa: F401
import mpm_cases  # noqa: F401
import transfer_cases  # noqa: F401
from ctest_cases import rows_of_ctest
from rows import Outcome, cases, judged, root


def shortened(text, most=90):
    return text if len(text) <= most else text[:most - 4].rstrip() + " ..."


def line(phase, name, extreme, right, outcome, seconds):
    verdict = outcome.margin if outcome.holds else "**fails**"
    cells = (name, phase, extreme, right, shortened(outcome.text.strip("; ")), verdict, f"{seconds:.1f}")
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--all", action="store_true")
    options.add_argument("--markdown", action="store_true")
    options.add_argument("--only", default="")
    asked = options.parse_args()
    every = asked.all or asked.markdown

    rows, wrong, total = [], [], 0.0
    page = None if asked.markdown else (root / "docs/verification/stiff.md").read_text()

    def keep(phase, name, extreme, right, outcome, seconds):
        nonlocal total
        total += seconds
        rows.append((phase, line(phase, name, extreme, right, outcome, seconds)))
        if not asked.markdown:
            print(rows[-1][1], flush=True)
        if not outcome.holds:
            wrong.append(name)
        if page is not None and f"| {name} | {phase} |" not in page:
            wrong.append(f"{name} (not in docs/verification/stiff.md)")

    for each in cases:
        if (each.slow and not every) or asked.only not in f"{each.phase} {each.name}":
            continue
        outcome, seconds = judged(each)
        keep(each.phase, each.name, each.extreme, each.right, outcome, seconds)
    for each in rows_of_ctest(asked.only) if every else ():
        keep(each.phase, each.name, each.extreme, each.right, Outcome(each.text, each.holds, each.margin), each.seconds)

    summary = f"{len(rows)} rows, {total:.1f} CPU seconds; not as expected: {', '.join(wrong) or 'none'}"
    if not asked.markdown:
        print(summary)
        return 1 if wrong else 0
    order = ["LEM", "FEM", "transfer", "MPM", "chain", "files"]
    print("\n".join(row for _, row in sorted(rows, key=lambda pair: order.index(pair[0]))))
    print(summary, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
