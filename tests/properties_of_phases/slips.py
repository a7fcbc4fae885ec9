"""One slip in a valid scene: a document that must be refused, and the pointers of which one must be named.

Slips of single entries go by the schema: every entry has a type, a range or words, and every object its keys."""
import copy
import json

from answers import root

SCHEMA = json.loads((root / "workflows/schema/scene.schema.json").read_text())


def resolved(schema, value):
    """Without references; of several forms the one of the value's type."""
    while True:
        if "$ref" in schema:
            schema = SCHEMA["$defs"][schema["$ref"].rpartition("/")[2]]
        elif "oneOf" in schema:
            forms = [resolved(each, value) for each in schema["oneOf"]]
            schema = next((each for each in forms if fits(each, value)), forms[0])
        else:
            return schema


def fits(schema, value):
    if isinstance(value, dict):
        wanted = schema.get("properties", {}).get("type", {}).get("const")
        return schema.get("type") == "object" and wanted in (None, value.get("type"))
    kinds = {"number": (int, float), "integer": int, "string": str, "array": list, "boolean": bool}
    return isinstance(value, kinds.get(schema.get("type"), ()))


def entries(value, schema, pointer=""):
    """(pointer, value, schema) of all that the schema knows, from the outside in."""
    schema = resolved(schema, value)
    yield pointer, value, schema
    if isinstance(value, dict):
        for key, each in value.items():
            inner = schema.get("properties", {}).get(key, schema.get("additionalProperties"))
            if isinstance(inner, dict):
                yield from entries(each, inner, f"{pointer}/{key}")
    elif isinstance(value, list):
        for k, each in enumerate(value):
            yield from entries(each, schema.get("items", {}), f"{pointer}/{k}")


def parent_of(document, pointer):
    *path, last = pointer.split("/")[1:]
    for step in path:
        document = document[int(step)] if isinstance(document, list) else document[step]
    return document, int(last) if isinstance(document, list) else last


def put(document, pointer, value):
    parent, key = parent_of(document, pointer)
    parent[key] = value


def out_of_range(schema):
    """A number just outside what the schema allows; none: it allows all."""
    if "minimum" in schema:
        return schema["minimum"] - 1
    if "exclusiveMinimum" in schema:
        return schema["exclusiveMinimum"]
    return None


def slips_of_schema(document):
    for pointer, value, schema in entries(document, SCHEMA):
        if isinstance(value, dict):
            if schema.get("additionalProperties") is False:
                yield "unknown key", pointer + "/surplus", lambda made, p=pointer: put(made, p + "/surplus", 1), [pointer + "/surplus"]
            for key in schema.get("required", []):
                if key in value:
                    yield ("missing key", pointer, lambda made, p=f"{pointer}/{key}": drop(made, p), [pointer, f"{pointer}/{key}"])
        elif isinstance(value, list):
            if schema.get("minItems"):
                yield ("short list", pointer, lambda made, p=pointer, v=value, n=schema["minItems"]: put(made, p, v[:n - 1]), [pointer])
            yield "a word for a list", pointer, lambda made, p=pointer: put(made, p, "none"), [pointer]
        elif isinstance(value, bool):
            yield "a number for a switch", pointer, lambda made, p=pointer: put(made, p, 2), [pointer]
        elif isinstance(value, (int, float)):
            yield "a list for a number", pointer, lambda made, p=pointer: put(made, p, [1]), [pointer]
            yield "nothing for a number", pointer, lambda made, p=pointer: put(made, p, None), [pointer]
            yield "a word for a number", pointer, lambda made, p=pointer: put(made, p, "much"), [pointer]
            if out_of_range(schema) is not None:
                yield "below the range", pointer, lambda made, p=pointer, n=out_of_range(schema): put(made, p, n), [pointer]
            if "maximum" in schema:
                yield "above the range", pointer, lambda made, p=pointer, n=schema["maximum"] * 1.5 + 1: put(made, p, n), [pointer]
        elif "enum" in schema or "const" in schema:
            yield "misspelt word", pointer, lambda made, p=pointer, v=value: put(made, p, v + "x"), [pointer]


def drop(document, pointer):
    parent, key = parent_of(document, pointer)
    del parent[key]


def slips_of_meaning(document):
    for k, region in enumerate(document["section"]["regions"]):
        here = f"/section/regions/{k}"
        polygon = region["polygon"]
        yield "unknown material", here, lambda made, p=here: put(made, p + "/material", "clay"), [here + "/material"]
        yield "open polygon", here, lambda made, p=here, v=polygon: put(made, p + "/polygon", v[:-1]), [here + "/polygon"]
        if len(polygon) == 5:
            yield ("crossed polygon", here, lambda made, p=here, v=polygon: put(made, p + "/polygon", [v[0], v[2], v[1], v[3], v[0]]),
                   [here + "/polygon"])
        yield "region without area", here, lambda made, p=here, v=polygon: put(made, p + "/polygon", [v[0], v[1], v[0], v[0]]), [here + "/polygon"]
        if k > 0:
            yield ("a name twice", here, lambda made, p=here, v=document["section"]["regions"][0]["name"]: put(made, p + "/name", v),
                   [here + "/name"])
            moved = [[x, y - 0.5] for x, y in polygon]
            others = [f"/section/regions/{n}{end}" for n in range(len(document["section"]["regions"])) for end in ("", "/polygon")]
            yield "overlap", here, lambda made, p=here, v=moved: put(made, p + "/polygon", v), [*others, "/section/regions"]
    lists = [("/mpm/runout/regions/0", "mpm"), ("/lem/undrained/0/region", "lem")]
    for pointer, part in lists:
        if part in document and (part != "lem" or "undrained" in document["lem"]):
            yield "unknown region", pointer, lambda made, p=pointer: put(made, p, "nowhere"), [pointer]
    ranges = {"lem": ["/lem/search/entry", "/lem/search/exit"], "mpm": ["/mpm/domain_x", "/mpm/domain_y"]}
    for part, pointers in ranges.items():
        for pointer in pointers if part in document else []:
            parent, key = parent_of(document, pointer)
            yield "descending range", pointer, lambda made, p=pointer, v=parent[key][::-1]: put(made, p, v), [pointer]
    if "mpm" in document:
        x0, x1 = document["mpm"]["domain_x"]
        yield "part of a cell", "/mpm/domain_x", lambda made: put(made, "/mpm/domain_x", [x0, x1 + 0.3]), ["/mpm/domain_x"]
        yield "floor off the grid", "/mpm/floor/level", lambda made: made["mpm"]["floor"].update(level=-100), ["/mpm/floor/level"]
        yield "gauge outside", "/mpm/gauges/0", lambda made: put(made, "/mpm/gauges/0/x", x1 + 5), ["/mpm/gauges/0/x"]
    if "fem" in document:
        yield "nothing holds it", "/fem/supports", lambda made: put(made, "/fem/supports", made["fem"]["supports"][:2]), ["/fem/supports"]
        far = [[9000, 0], [9001, 0]]
        yield ("support in the air", "/fem/supports/0", lambda made: made["fem"]["supports"][0].update({"from": far[0], "to": far[1]}),
               ["/fem/supports/0", "/fem/supports/0/from", "/fem/supports/0/to"])
        yield ("a corner that is no vertex", "/section/regions/0/mesh", lambda made: put(made, "/section/regions/0/mesh/corners/0", [0.37, 77]),
               ["/section/regions/0/mesh/corners/0"])
        yield ("step longer than its stage", "/fem/stages/1", lambda made: put(made, "/fem/stages/1/time_step", 100),
               ["/fem/stages/1/time_step", "/fem/stages/1"])


def slipped(scene, random):
    """(kind, document, pointers of which one must be named)"""
    choice = list(slips_of_meaning(scene)) if random.random() < 0.5 else list(slips_of_schema(scene))
    kind = random.choice(sorted({each[0] for each in choice}))
    _, _, change, pointers = random.choice([each for each in choice if each[0] == kind])
    made = copy.deepcopy(scene)
    change(made)
    return kind, made, pointers
