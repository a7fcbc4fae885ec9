"""Every page that a comment, a page or a message names exists, and every link between pages leads somewhere."""
import os
import pathlib
import re
import subprocess
import sys

root = pathlib.Path(os.environ["BREACH_ROOT"])
# A path of letters that ends in .md, as prose and code write it. What programs write at run time is no page of ours.
named = re.compile(r"(?<![\w./-])((?:[\w.-]+/)*[\w-]+\.md)\b")
link = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")
templates = root / "workflows/verification/pages"  # their links are those of the pages in docs/verification that they become
written_at_run_time = {"index.md"}
code = {".hpp", ".cpp", ".in", ".py", ".mjs", ".js", ".txt", ".json", ".sh"}


def tracked():
    listed = subprocess.run(["git", "-C", str(root), "ls-files", "-z"], capture_output=True, text=True)
    if listed.returncode == 0:
        return [root / name for name in listed.stdout.split("\0") if name]
    return [f for f in root.rglob("*") if f.is_file() and "build" not in f.relative_to(root).parts]


def main():
    faults, names = [], 0
    for file in tracked():
        if not file.is_file() or file.suffix not in code | {".md"}:
            continue
        text = file.read_text(errors="replace")
        here = file.relative_to(root)
        if file.suffix == ".md":
            folder = root / "docs/verification" if file.parent == templates else file.parent
            for target in link.findall(text):
                names += 1
                if "://" not in target and not (folder / target).exists():
                    faults.append(f"{here}: the link {target} leads nowhere")
            continue
        for page in set(named.findall(text)) - written_at_run_time:
            names += 1
            if not (root / page).exists() and not (file.parent / page).exists():
                faults.append(f"{here}: names {page}, which does not exist (give its path from the project's root)")
    print("\n".join(faults) or f"{names} names of pages, all there")
    return 1 if faults or names < 20 else 0


if __name__ == "__main__":
    sys.exit(main())
