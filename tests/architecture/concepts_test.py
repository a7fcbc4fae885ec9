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
# Keys that still lack a user: the list may only shrink.
without_user = set((root / "tests/architecture/without_user.txt").read_text().split())


class Schema:
    """Keys of a schema by their place, and who uses each."""

    def __init__(self, name: str) -> None:
        self.root = json.loads((root / f"workflows/schema/{name}.schema.json").read_text())
        self.places: dict[int, str] = {}
        self.nodes: dict[int, Any] = {}
        self.users: dict[int, str] = {}
        self.list_keys(self.root, f"{name}:")

    def follow(self, node: Any) -> Any:
        while "$ref" in node and "properties" not in node:
            node = self.root["$defs"][node["$ref"].split("/")[-1]]
        return node

    def inner(self, node: Any) -> Iterator[tuple[str, Any]]:
        """Schemas that a value of the schema `node` or its elements may have."""
        yield from (("", part) for part in node.get("oneOf", []))
        yield from (("/*", node[key]) for key in ("items", "additionalProperties") if isinstance(node.get(key), dict))

    def list_keys(self, node: Any, place: str) -> None:
        node = self.follow(node)
        for key, part in node.get("properties", {}).items():
            if id(part) not in self.places:
                kind = node["properties"].get("type", {}).get("const")
                self.places[id(part)] = f"{place}{f'({kind})' if kind else ''}/{key}"
                self.nodes[id(part)] = part
                self.list_keys(part, self.places[id(part)])
        for step, part in self.inner(node):
            self.list_keys(part, place + step)

    def fits(self, value: Any, node: Any) -> bool:
        if not isinstance(value, dict):
            return node.get("type") != "object" and "const" not in node
        keys = node.get("properties", {})
        return node.get("type") == "object" and all(keys.get(k, {}).get("const", v) == v for k, v in value.items())

    def use(self, value: Any, node: Any, user: str) -> None:
        """Marks the keys of a value."""
        node = self.follow(node)
        for part in map(self.follow, node.get("oneOf", [])):
            if self.fits(value, part):
                self.use(value, part, user)
        if isinstance(value, list) and isinstance(node.get("items"), dict):
            for element in value:
                self.use(element, node["items"], user)
        for key, part in value.items() if isinstance(value, dict) else ():
            if key in node.get("properties", {}):
                self.users.setdefault(id(node["properties"][key]), user)
                self.use(part, node["properties"][key], user)
            elif isinstance(node.get("additionalProperties"), dict):
                self.use(part, node["additionalProperties"], user)

    def use_pointer(self, pointer: str, value: Any, user: str) -> None:
        """Marks the keys on the way of a JSON pointer. Of several schemas that an entry may have, all that know the next key count."""
        nodes = [self.root]
        for name in pointer.split("/")[1:]:
            nodes = [self.follow(node) for node in nodes]
            nodes += [self.follow(part) for node in nodes for part in node.get("oneOf", [])]
            known = [node["properties"][name] for node in nodes if name in node.get("properties", {})]
            for part in known:
                self.users.setdefault(id(part), user)
            nodes = known or [part for node in nodes for step, part in self.inner(node) if step]
        for node in nodes:
            self.use(value, node, user)


def users(scene: Schema, study: Schema) -> None:
    """Finds the users in the files of people, then in the programs that write scenes (by a key's name, below a used key)."""
    law = scene.root["$defs"]["material"]["properties"]["law"]
    for folder in ("workflows", "docs/tutorials", "docs/how-to", "tests/verification"):
        for path in sorted((root / folder).rglob("*.*")):
            user, text = str(path.relative_to(root)), path.read_text() if path.suffix in (".json", ".md") else ""
            if "schema" in path.parts or "results" in path.parts:
                continue
            for pointer, value in re.findall(r"[\"`'](/(?:[a-z]\w*/)+\w+)(?:=([^\"`']*))?", text):
                scene.use_pointer(pointer, readable(value), user)
            for block in [text] if path.suffix == ".json" else re.findall(r"^ *(?:```json|cat .*<<.*)\n(.*?)^ *(?:```|END|EOF)", text, re.M | re.S):
                document = readable(block)
                kind = document.get("format", "") if isinstance(document, dict) else ""
                schema = scene if "scene" in kind else study if "study" in kind else None
                if schema:
                    schema.use(document, schema.root, user)
                elif "element-test" in kind:
                    scene.use(document.get("law"), law, user)
    pages = [path for folder in ("docs/tutorials", "docs/how-to") for path in sorted((root / folder).glob("*.md"))]
    for path in pages + [file for folder in writers for file in sorted((root / folder).glob("*.cpp"))]:
        names = set(re.findall(r'["`](\w+)["`]', path.read_text()))
        for schema in (scene, study):
            used = {plain(schema.places[key]) for key in schema.users} | {"scene:", "study:"}
            for key, place in schema.places.items():
                above, name = plain(place).rsplit("/", 1)
                if name in names and above in used:
                    schema.users.setdefault(key, str(path.relative_to(root)))


def plain(place: str) -> str:
    return re.sub(r"/\*|\(\w+\)", "", place)


def readable(text: str) -> Any:
    try:
        return json.loads(text)
    except json.JSONDecodeError:
        return None  # a part of a document


def main() -> int:
    scene, study = Schema("scene"), Schema("study")
    users(scene, study)
    faults, kept, lacking = [], 0, set()
    for schema in (scene, study):
        for key, place in schema.places.items():
            user, reason = schema.users.get(key), schema.nodes[key].get("kept_for")
            if "--table" in sys.argv:
                print(f"{place:72} {user or reason or '-'}")
            kept += reason is not None
            if user and reason:
                faults.append(f"{place}: remove \"kept_for\" from the schema: {user} uses it")
            elif not user and not reason:
                lacking.add(place)
    faults += [f"{place}: no workflow, tutorial, how-to or verification case uses it: remove it" for place in sorted(lacking - without_user)]
    faults += [f"{place}: has a user now, or is gone: remove it from without_user" for place in sorted(without_user - lacking)]
    if kept > largest_kept:
        faults.append(f"{kept} keys have \"kept_for\" in the schemas: at most {largest_kept} may")
    count = len(scene.places) + len(study.places)
    print("\n".join(faults) or f"{count} keys and entries: {kept} kept for a reason, {len(without_user)} still without a user")
    return 1 if faults or count < 200 else 0


if __name__ == "__main__":
    sys.exit(main())
