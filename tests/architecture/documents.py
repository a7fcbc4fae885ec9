"""Every page named in a comment, page or message exists; every link between pages and its anchor exist; every tutorial is run; no
conflict marker of a merge is left."""
import os
import pathlib
import re
import subprocess
import sys

root = pathlib.Path(os.environ["BREACH_ROOT"])
# A path of letters that ends in .md. Files written at run time are no pages.
named = re.compile(r"(?<![\w./-])((?:[\w.-]+/)*[\w-]+\.md)\b")
link = re.compile(r"\]\(([^)#\s]*)(?:#([^)\s]*))?\)")
templates = root / "workflows/verification/pages"  # their links are those of the pages in docs/verification that they become
written_at_run_time = {"index.md"}
code = {".hpp", ".cpp", ".in", ".py", ".mjs", ".js", ".txt", ".json", ".sh"}


def tracked():
    listed = subprocess.run(["git", "-C", str(root), "ls-files", "-z"], capture_output=True, text=True)
    if listed.returncode == 0:
        return [root / name for name in listed.stdout.split("\0") if name]
    return [f for f in root.rglob("*") if f.is_file() and "build" not in f.relative_to(root).parts]


def anchors(page):
    """Anchors of a page's headings, by GitHub's rule: lower case, no punctuation, - for a space; repeated ones get -1, -2."""
    found = set(re.findall(r'<a (?:id|name)="([^"]+)"', text := re.sub(r"^```.*?^```", "", page.read_text(), flags=re.M | re.S)))
    for heading in re.findall(r"^#{1,6} +(.*?)(?: +#+)? *$", text, re.M):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
        slug = re.sub(r"[^\w\- ]", "", plain.lower()).replace(" ", "-")
        found.add(slug if slug not in found else next(f"{slug}-{k}" for k in range(1, 99) if f"{slug}-{k}" not in found))
    return found


def main():
    faults, names = [], 0
    for file in tracked():
        if not file.is_file() or file.suffix not in code | {".md"}:
            continue
        text = file.read_text(errors="replace")
        here = file.relative_to(root)
        faults += [f"{here}: has the mark of an unsolved merge, {mark}" for mark in re.findall(r"^(?:<{7}|>{7}) .*", text, re.M)]
        if file.suffix == ".md":
            folder = root / "docs/verification" if file.parent == templates else file.parent
            for target, anchor in link.findall(text):
                names += 1
                page = folder / target if target else file
                if "://" not in target and not page.exists():
                    faults.append(f"{here}: the link {target} leads nowhere")
                elif anchor and page.suffix == ".md" and "://" not in target and anchor not in anchors(page):
                    faults.append(f"{here}: {target}#{anchor}: the page has no such heading")
            continue
        for page in set(named.findall(text)) - written_at_run_time:
            names += 1
            if not (root / page).exists() and not (file.parent / page).exists():
                faults.append(f"{here}: names {page}, which does not exist (give its path from the project's root)")
    registered = (root / "tests/workflow/CMakeLists.txt").read_text()
    for page in (root / "docs/tutorials").glob("*.md"):
        if not re.search(rf"tutorial [^)]*\b{page.stem}\b", registered):
            faults.append(f"docs/tutorials/{page.name}: tests/workflow/CMakeLists.txt does not run its commands")
    print("\n".join(faults) or f"{names} names of pages, all there")
    return 1 if faults or names < 20 else 0


if __name__ == "__main__":
    sys.exit(main())
