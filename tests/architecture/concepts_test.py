"""Every key of a scene and entry of a study has a user (a shipped workflow, a tutorial, a how-to, a verification case, or a scene that
templates and imports write), or the schema says under "kept_for" why it is there without one. Prints all of them with --table."""
import json
import os
import pathlib
import re
import sys
from typing import Any, Iterator

root = pathlib.Path(os.environ.get("BREACH_ROOT", pathlib.Path(__file__).parents[2]))
largest_kept = 15
writers = ("services/templates", "services/earthquake", "services/import")


class Schema:
    """A schema's keys by place, as scene:/mpm/gauges/x, and who uses each. Alternatives of an entry share its place."""

    def __init__(self, name: str) -> None:
        self.root = json.loads((root / f"workflows/schema/{name}.schema.json").read_text())
        self.start = f"{name}:"
        self.keys: dict[str, Any] = {}
        self.users: dict[str, str] = {}
        self.list_keys(self.root, self.start)

    def follow(self, node: Any) -> Any:
        while "$ref" in node:
            node = self.root["$defs"][node["$ref"].split("/")[-1]]
        return node

    def inner(self, node: Any) -> Iterator[Any]:  # schemas of a list's elements, or of values under names of the user's own
        yield from (self.follow(node[key]) for key in ("items", "additionalProperties") if isinstance(node.get(key), dict))

    def list_keys(self, node: Any, place: str) -> None:
        node = self.follow(node)
        for key, part in node.get("properties", {}).items():
            self.keys.setdefault(f"{place}/{key}", part)
            self.list_keys(part, f"{place}/{key}")
        for part in [*node.get("oneOf", []), *self.inner(node)]:
            self.list_keys(part, place)

    def use(self, value: Any, node: Any, place: str, user: str) -> None:
        node = self.follow(node)
        known = node.get("properties", {})
        if isinstance(value, dict) and any(value.get(key, each.get("const")) != each.get("const", value.get(key)) for key, each in known.items()):
            return  # of another type
        for key, part in value.items() if isinstance(value, dict) else ():
            if key in known:
                self.users.setdefault(f"{place}/{key}", user)
                self.use(part, known[key], f"{place}/{key}", user)
        elements = value if isinstance(value, list) else [part for key, part in value.items() if key not in known] if isinstance(value, dict) else []
        for element in elements:
            for part in self.inner(node):
                self.use(element, part, place, user)
        for part in node.get("oneOf", []):
            self.use(value, part, place, user)

    def use_pointer(self, pointer: str, value: Any, user: str) -> None:
        """Marks the keys on the way of a JSON pointer and those of its value."""
        node, place = self.root, self.start
        for name in pointer.split("/")[1:]:
            alternatives = [node, *map(self.follow, node.get("oneOf", []))]
            known = [each["properties"][name] for each in alternatives if name in each.get("properties", {})]
            if known:
                place += f"/{name}"
                self.users.setdefault(place, user)
            node = next((self.follow(each) for each in known + [part for each in alternatives for part in self.inner(each)]), {})
        self.use(value, node, place, user)


def readable(text: str) -> Any:
    try:
        return json.loads(text)
    except json.JSONDecodeError:
        return None  # a part of a document


def find_users(scene: Schema, study: Schema) -> None:
    """In files of people, then in pages and programs that write scenes (there by a key's name, below a used key)."""
    for folder in ("workflows", "docs/tutorials", "docs/how-to", "tests/verification"):
        for path in sorted((root / folder).rglob("*.*")):
            ours = path.suffix in (".json", ".md") and not {"schema", "results"} & {*path.parts}
            user, text = str(path.relative_to(root)), path.read_text() if ours else ""
            for pointer, value in re.findall(r"[\"`'](/[a-z]\w*(?:/\w+)+)(?:=([^\"`']*))?", text):
                scene.use_pointer(pointer, readable(value), user)
            document = readable(text)
            kind = document.get("format", "") if isinstance(document, dict) else ""
            if "element-test" in kind:
                scene.use({"soil": {"law": document.get("law")}}, scene.root["properties"]["materials"], "scene:/materials", user)
            for schema in (scene, study):
                if schema.start[:-1] in kind:
                    schema.use(document, schema.root, schema.start, user)
    pages = [path for folder in ("docs/tutorials", "docs/how-to") for path in sorted((root / folder).glob("*.md"))]
    for path in pages + [file for folder in writers for file in sorted((root / folder).glob("*.cpp"))]:
        names = set(re.findall(r'["`](\w+)["`]', path.read_text()))
        for schema in (scene, study):
            for place in schema.keys:
                above, name = place.rsplit("/", 1)
                if name in names and (above in schema.users or above == schema.start):
                    schema.users.setdefault(place, str(path.relative_to(root)))


def main() -> int:
    scene, study = Schema("scene"), Schema("study")
    find_users(scene, study)
    users, keys = scene.users | study.users, scene.keys | study.keys
    reasons = {place: part["kept_for"] for place, part in keys.items() if "kept_for" in part}
    lacking = {place for place in keys if place not in users and not any((place + "/").startswith(kept + "/") for kept in reasons)}
    if "--table" in sys.argv:
        print("\n".join(f"{place:60} {users.get(place) or reasons.get(place, '-')}" for place in keys))
    faults = [f"{place}: no workflow, tutorial, how-to or verification case uses it: remove it" for place in sorted(lacking)]
    faults += [f"{place}: remove \"kept_for\" from the schema: {users[place]} uses it" for place in reasons if place in users]
    if len(reasons) > largest_kept:
        faults.append(f"{len(reasons)} keys have \"kept_for\" in the schemas: at most {largest_kept} may")
    print("\n".join(faults) or f"{len(keys)} keys and entries: {len(reasons)} kept for a reason")
    return 1 if faults or len(keys) < 200 else 0


if __name__ == "__main__":
    sys.exit(main())
