"""The product's size in tokens by room stays within tests/architecture/sizes.json. A token is a word, a literal or a sign outside
comments and includes: a long name counts once, a dense line as what it holds.

    size_test.py                       fails where a room has grown
    size_test.py --because "REASON"    takes today's sizes; a room that grew needs the reason, which the file keeps"""
import collections
import json
import os
import pathlib
import re
import subprocess
import sys

root = pathlib.Path(os.environ.get("BREACH_ROOT", pathlib.Path(__file__).parents[2]))
table = root / "tests/architecture/sizes.json"
kinds = {".cpp": "C++", ".hpp": "C++", ".py": "Python", ".js": "JavaScript"}
token = re.compile(r'"(?:[^"\\\n]|\\.)*"|\w+|[^\w\s]')
comments = {"Python": re.compile(r'"""(?s:.*?)"""|#[^\n]*'), "other": re.compile(r"//[^\n]*|/\*(?s:.*?)\*/|^#include[^\n]*", re.M)}
most_reasons = 12  # older ones are in the history


def kind_of(path):
    if not path.suffix and path.read_bytes()[:40].startswith(b"#!/usr/bin/env python"):
        return "Python"
    return kinds.get(path.suffix)


def sizes():
    rooms = collections.Counter()
    for name in subprocess.run(["git", "ls-files"], capture_output=True, text=True, cwd=root, check=True).stdout.split("\n"):
        path = root / name
        first, *others = pathlib.Path(name).parts or ("",)
        if first in ("", "tests", "docs", "workflows", "deploy", ".ci") or not path.is_file() or not kind_of(path):
            continue
        kind = kind_of(path)
        room = f"{first}/{others[0]}" if first in ("core", "services") else first
        rooms[f"{room}, {kind}"] += len(token.findall(comments.get(kind, comments["other"]).sub("", path.read_text())))
    return dict(sorted(rooms.items()))


def main():
    now, known = sizes(), json.loads(table.read_text()) if table.is_file() else {"rooms": {}, "reasons": []}
    grown = [f"{room}: {size} tokens, {known['rooms'].get(room, 0)} in {table.relative_to(root)}"
             for room, size in now.items() if size > known["rooms"].get(room, 0)]
    if "--because" in sys.argv:
        reason = sys.argv[sys.argv.index("--because") + 1]
        reasons = [*known["reasons"], *([reason] if grown else [])][-most_reasons:]
        table.write_text(json.dumps({"rooms": now, "reasons": reasons}, indent=1, ensure_ascii=False) + "\n")
    elif grown:
        sys.exit("\n".join(grown) + "\nMake it shorter, or say why it grew: tests/architecture/size_test.py --because \"...\"")
    print(f"C++ {sum(size for room, size in now.items() if room.endswith('C++'))} tokens, "
          f"Python {sum(size for room, size in now.items() if room.endswith('Python'))}")


if __name__ == "__main__":
    main()
