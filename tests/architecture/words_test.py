"""What a person reads is in plain English (CONTRIBUTING.md, Style): few words, short sentences, the field's terms. Pages, messages,
descriptions, comments and names of tests.

    words_test.py              every rule; exit 1 where one is broken
    words_test.py --count      words per page"""
import ast
import fnmatch
import io
import json
import re
import statistics
import sys
import tokenize

import documents
from documents import root

MOST_WORDS = 45000  # of all pages together
MOST_WORDS_OF = {"README.md": 900, "CONTRIBUTING.md": 900, "CHANGELOG.md": 600}
MOST_WORDS_OF_A_ROOM = 150
MOST_TERMS = 60
LONGEST_LINE = 160
LONGEST_SENTENCE = 40
MEDIAN_SENTENCE = 18

TEMPLATES = "workflows/verification/pages/"
NOT_FOR_READERS = ("tests/fuzz/corpus/", TEMPLATES)

# A word of ours and the field's term that replaces it. Code (`draws`) and quoted names are exempt.
BANNED = {
    r"doors?": "interface, entry point, input",
    r"wish(es|ed)?": "request, option",
    r"bells?": "notification",
    r"errands?": "task, call",
    r"doubt(s|ed)?": "flag, warning, uncertainty",
    r"(is|are|was|were|be) told": "the report states, the command prints",
    r"(is|are) asked of": "requester",
    r"(comes?|came) to nothing": "did not fire, had no effect",
    r"(is|was|were) let go|lets? go(?! of)": "since the transfer, released",
    r"holds? up(?! to)": "delays, supports",
    r"as it (lies|stands)": "unchanged, in place",
    r"hangs? on": "depends on",
    r"takes? for|taken for": "reads as, is mistaken for",
    r"tell(s|ing)? apart|told apart": "distinguishes, exceeds the noise",
    r"for ever": "permanently",
    r"whatever": "independent of, any",
    r"mend(s|ed|ing)?": "correct, repair",
    r"bears": "supports, withstands",
    r"what (became|becomes) of": "state of, result of",
    r"nobody|somebody": "no one, another client",
    r"believe(s|d)?": "rely on, use",
    r"so many(?! (as|that))": "this many",
}
# One word per idea: the twin and the word.
TWINS = {
    r"draws|(an?|each|one|per|every|last|previous|new) draw(?! (the|it|them|a)\b)": "repeat",
    r"redrawn": "repeated",
}
# Names of functions and types that a reader could not guess, and what the project calls such things now.
BANNED_NAMES = {
    "check_company": "what it refuses", "check_companions": "what it refuses", "hangs_on": "depends_on", "press": "send_signals, look_soon",
    "fate_of": "end_of", "worth_of": "usable_with", r"told_by\w*": "by", r"what_tells\w*": "how_to_measure", "take_apart": "split",
    "leave_to_the_cache": "answer_from_cache", "still": "unless_removed", "why_lively": "reason_to_go_on", "Heap": "Cluster",
    "Findings": "Problems (of a scene; findings are of results)", "findings_of": "problems_of",
}
MESSAGES = ["core", "element_bench", "fem_solver", "lem_tool", "mpm_solver", "services", "transfer_tool"]
DESCRIPTIONS = ["workflows/schema/scene.schema.json", "workflows/schema/study.schema.json", "workflows/schema/element_test.schema.json",
                "services/orchestrator/http/openapi.json"]
# Code that stays as it is: keys of measured results, and this list of words.
FROZEN = ("tests/benchmark/features/", "tests/verification/mpm/stiffness_test.py", "tests/architecture/words_test.py")
SAID_BY = ("services/web/static/", "services/python/")  # literals of JavaScript and Python that a person reads
TOKEN = re.compile(r'(?P<comment>//[^\n]*(?:\n[ \t]*//[^\n]*)*|/\*.*?\*/)|(?P<raw>R"(\w*)\(.*?\)\3")'
                   r"|(?P<literal>\"(?:[^\"\\\n]|\\.)*\"|'(?:[^'\\\n]|\\.)*'|`(?:[^`\\]|\\.)*`)", re.S)
# Where a banned word is the right one: (file, text around it).
EXCEPTIONS = [
    ("services/orchestrator/study/conflicts.cpp", "give /accuracy/draws and /accuracy/draws_of"),
    ("services/orchestrator/study/conflicts.cpp", "an uncertainty study draws lattices itself"),
]


def tracked(*patterns):
    return [str(file.relative_to(root)) for file in documents.tracked()
            if file.is_file() and any(fnmatch.fnmatch(file.name, pattern) for pattern in patterns)]


def is_generated(text):
    return re.search(r"^(Generated|Written) by `", text, re.M) is not None


def number_of_words(text):
    return sum(any(each.isalnum() for each in word) for word in text.split())


def prose(text):
    """Paragraphs and items of lists: without code, tables, headings and the targets of links."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    paragraphs, now = [], []
    for line in [*text.splitlines(), ""]:
        starts = re.match(r"\s*(?:[-*]|\d+\.) ", line)
        ends = not line.strip() or line.startswith(("#", "|", "    ", "![", "<"))
        if (starts or ends) and now:
            paragraphs.append(" ".join(now))
            now = []
        if not ends or (starts and line.strip()):
            now.append(re.sub(r"^\s*(?:[-*]|\d+\.) ", "", line).strip())
    plain = [re.sub(r"`[^`]*`", "CODE", re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", each)).replace("*", "") for each in paragraphs]
    return [each for each in plain if each]


def sentences(text):
    for paragraph in prose(text):
        for each in re.split(r"(?<=[.!?:])\s+(?=[A-Z\"(0-9])", paragraph):
            if number_of_words(each) > 2:
                yield each


def without_code(text):
    blocks = re.sub(r"^    .*$", "", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S), flags=re.M)
    return re.sub(r"`[^`\n]*`|\"[^\"\n]*\"|\]\([^)]*\)", "", blocks)


def faults_of_words(place, text, rules):
    for pattern, better in rules.items():
        for found in re.finditer(rf"\b(?:{pattern})\b", text, re.I):
            around = re.sub(r"\s+", " ", text[max(0, found.start() - 30):found.end() + 30]).strip()
            yield f"{place}: \"{found[0]}\" ({better}): ... {around} ..."


def faults_of_pages():
    total = 0
    for name in tracked("*.md"):
        if name.startswith(NOT_FOR_READERS):
            continue
        text = (root / name).read_text()
        if is_generated(text):
            continue
        words = number_of_words(text)
        total += words
        if words > MOST_WORDS_OF.get(name, words):
            yield f"{name}: {words} words, at most {MOST_WORDS_OF[name]}"
        if name.endswith("/README.md") and name != "docs/README.md" and words > MOST_WORDS_OF_A_ROOM:
            yield f"{name}: {words} words, at most {MOST_WORDS_OF_A_ROOM}: users' pages are in docs"
        for number, line in enumerate(text.splitlines(), 1):
            if len(line) > LONGEST_LINE and not line.startswith("|"):
                yield f"{name}:{number}: a line of {len(line)} characters, at most {LONGEST_LINE}"
        lengths = [(number_of_words(each), each) for each in sentences(text)]
        for length, each in lengths:
            if length > LONGEST_SENTENCE:
                yield f"{name}: a sentence of {length} words, at most {LONGEST_SENTENCE}: {each[:80]} ..."
        if lengths and statistics.median(length for length, _ in lengths) > MEDIAN_SENTENCE:
            yield f"{name}: sentences of {statistics.median(length for length, _ in lengths)} words (median), at most {MEDIAN_SENTENCE}"
        yield from faults_of_words(name, without_code(text), BANNED | TWINS)
    if total > MOST_WORDS:
        yield f"{total} words in all pages, at most {MOST_WORDS}: shorten a page, or generate it"
    glossary = (root / "docs/reference/glossary").with_suffix(".md")
    if glossary.exists():
        text = glossary.read_text()
        terms = max(len(re.findall(r"^\| (?!---)", text, re.M)) - len(re.findall(r"^\| ?---", text, re.M)), len(re.findall(r"^(?:- )?\*\*", text, re.M)))
        if terms > MOST_TERMS:
            yield f"{glossary.relative_to(root)}: {terms} terms, at most {MOST_TERMS}"


def descriptions(document, path=""):
    if isinstance(document, dict):
        for name, each in document.items():
            if name in ("description", "summary", "title") and isinstance(each, str):
                yield path, each
            else:
                yield from descriptions(each, f"{path}/{name}")
    elif isinstance(document, list):
        for number, each in enumerate(document):
            yield from descriptions(each, f"{path}/{number}")


def faults_of_descriptions():
    for name in DESCRIPTIONS:
        for path, text in descriptions(json.loads((root / name).read_text())):
            yield from faults_of_words(f"{name}: {path}", without_code(text), BANNED | TWINS)


def literals(text):
    """(line, literal) of what a program says: adjacent ones joined, one word alone is a name."""
    code = re.sub(r"(?m)^\s*(//.*|#include.*)$|(?<=[;{},)])\s*//.*$", "", text)
    for found in re.finditer(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*', code):
        literal = "".join(re.findall(r'"((?:[^"\\\n]|\\.)*)"', found[0]))
        if " " in literal.strip():
            yield re.sub(r'\\"[^"]*?\\"', "", literal.replace("\\n", " "))


def faults_of_messages():
    for name in tracked("*.cpp", "*.hpp"):
        if name.split("/", 1)[0] not in MESSAGES:
            continue
        for literal in literals((root / name).read_text()):
            if not literal.startswith((".", "<")) and ".verdict{" not in literal and not any(name == file and part in literal for file, part in EXCEPTIONS):
                yield from faults_of_words(name, literal, BANNED | TWINS)


def texts_of_python(text):
    """(comment?, text) of each comment and literal; a docstring is a comment."""
    tree = ast.parse(text)
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef)
    for node in ast.walk(tree):
        if isinstance(node, documented):
            yield True, ast.get_docstring(node) or ""
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield False, node.value
    lines = {token.start[0]: token.string for token in tokenize.generate_tokens(io.StringIO(text).readline) if token.type == tokenize.COMMENT}
    yield True, "\n".join(part for line, part in lines.items() for part in ([] if line - 1 in lines else [""]) + [part])


def texts_of_code(text):
    """The same of C++ and JavaScript. In C++ a ' between digits is no quote."""
    for found in TOKEN.finditer(re.sub(r"(?<=\d)'(?=\d)", "", text)):
        if not found["raw"]:
            yield found["comment"] is not None, found["comment"] or re.sub(r"\$\{[^{}]*\}", "VALUE", found["literal"][1:-1])


def names_of_tests(name, text):
    if name.endswith(".cpp"):
        for found in re.finditer(r"^TEST(?:_F|_P)?\((\w+),\s*(\w+)\)", text, re.M):
            yield " ".join(re.findall(r"[A-Z]?[a-z0-9]+|[A-Z]+(?![a-z])", f"{found[1]} {found[2]}"))
    elif name.endswith(".py"):
        yield from (found[1].replace("_", " ") for found in re.finditer(r"def (test_\w+)", text))
    elif name.endswith(".mjs"):
        yield from (found[1] for found in re.finditer(r'^test\("([^"]*)"', text, re.M))


def faults_of_code():
    for name in tracked("*.cpp", "*.hpp", "*.py", "*.js", "*.mjs"):
        if name.startswith(FROZEN):
            continue
        text = (root / name).read_text()
        said = name.startswith(SAID_BY)
        for is_comment, each in (texts_of_python if name.endswith(".py") else texts_of_code)(text):
            if is_comment or (said and " " in each.strip()):
                plain = re.sub(r"\s*\n\s*(?://+<?|#)?\s*", " ", re.sub(r"`[^`\n]*`|\"[^\"\n]*\"", "", each))
                yield from faults_of_words(name, plain, BANNED)
        for each in names_of_tests(name, text):
            yield from faults_of_words(f"{name}: name of a test", each, BANNED)


def faults_of_names():
    banned = re.compile(r"\b(?:struct |class )?(" + "|".join(BANNED_NAMES) + r")(?=\(| \{)")
    for name in tracked("*.cpp", "*.hpp", "*.py"):
        if name.startswith(FROZEN):
            continue
        for found in banned.finditer(TOKEN.sub("", (root / name).read_text())):
            instead = next(each for word, each in BANNED_NAMES.items() if re.fullmatch(word, found[1]))
            yield f"{name}: the name {found[1]}: use {instead}"


def main():
    if "--count" in sys.argv:
        for name in tracked("*.md"):
            if not name.startswith(NOT_FOR_READERS):
                text = (root / name).read_text()
                print(f"{number_of_words(text):6} {'generated ' if is_generated(text) else ''}{name}")
        return 0
    faults = [*faults_of_pages(), *faults_of_descriptions(), *faults_of_messages(), *faults_of_code(), *faults_of_names()]
    print("\n".join(faults) or "plain")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
