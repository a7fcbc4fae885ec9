"""Each flag of a program has a heading in docs/reference/flags.md, and each heading there is a flag."""
import os
import pathlib
import re
import sys

root = pathlib.Path(os.environ["BREACH_ROOT"])
rooms = ("core", "lem_tool", "fem_solver", "transfer_tool", "mpm_solver", "element_bench")
# Code that makes a flag: {"code", Severity::...}, flag("code", ...), warn(problems, "code", ...), each across lines.
raised = (
    re.compile(r'[{(]\s*"([a-z]+(?:_[a-z]+)*)",\s*(?:[\w.\s()>-]+\?\s*)?(?:fault::)?Severity::'),
    re.compile(r'\bflag\(\s*"([a-z]+(?:_[a-z]+)*)"'),
    re.compile(r'\bwarn\(\s*problems,\s*"([a-z]+(?:_[a-z]+)*)"'),
    re.compile(r'\bFlag\{\s*"([a-z]+(?:_[a-z]+)*)"'),
)


def main():
    texts = {file: file.read_text() for room in rooms for pattern in ("*.cpp", "*.hpp") for file in (root / room).rglob(pattern)}
    codes = {}
    for file, text in texts.items():
        for pattern in raised:
            for code in pattern.findall(text):
                codes.setdefault(code, file.relative_to(root))
    page = (root / "docs/reference/flags.md").read_text()
    rows = set(re.findall(r"^### ([a-z_]+)$", page, re.M))
    faults = [f"{file} raises {code}, which docs/reference/flags.md does not explain" for code, file in sorted(codes.items()) if code not in rows]
    sources = "".join(texts.values())
    faults += [f"docs/reference/flags.md explains {row}, which no program raises" for row in sorted(rows) if f'"{row}"' not in sources]
    print("\n".join(faults) or f"{len(codes)} flags found in the programs, {len(rows)} explained")
    return 1 if faults or len(codes) < 60 else 0


if __name__ == "__main__":
    sys.exit(main())
