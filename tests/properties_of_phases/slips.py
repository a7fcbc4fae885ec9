"""One slip in a valid scene: a document that must be refused, and the pointers of which one must be named.

Slips of single entries go by the schema: every entry has a type, a range or words, and every object its keys."""
import copy
import json

from answers import root

SCHEMA = json.loads((root / "workflows/schema/scene.schema.json").read_text())


def resolved(schema, value):
    """The schema without references; of several forms the one of the value's type."""
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
    """(pointer, value, schema) of all entries in the schema, from the outside in."""
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


def overwritten(kind, pointer, value, *pointers):
    """Another value at one place; pointers: alternatives for the place in the fault."""
    return kind, lambda document: put(document, pointer, value), pointers or (pointer,)


def dropped(kind, pointer, key):
    def drop(document):
        parent, last = parent_of(document, f"{pointer}/{key}")
        del parent[last]
    return kind, drop, (pointer, f"{pointer}/{key}")


def slips_of_schema(document):
    """(kind, change of the document, pointers of which one must be named)"""
    for pointer, value, schema in entries(document, SCHEMA):
        if isinstance(value, dict):
            if schema.get("additionalProperties") is False:
                yield overwritten("unknown key", f"{pointer}/surplus", 1)
            for key in schema.get("required", []):
                yield dropped("missing key", pointer, key)
        elif isinstance(value, list):
            if schema.get("minItems"):
                yield overwritten("short list", pointer, value[:schema["minItems"] - 1])
            yield overwritten("a word for a list", pointer, "none")
        elif isinstance(value, bool):
            yield overwritten("a number for a switch", pointer, 2)
        elif isinstance(value, (int, float)):
            for kind, wrong in (("a list", [1]), ("nothing", None), ("a word", "much")):
                yield overwritten(f"{kind} for a number", pointer, wrong)
            if "minimum" in schema:
                yield overwritten("below the range", pointer, schema["minimum"] - 1)
            elif "exclusiveMinimum" in schema:
                yield overwritten("below the range", pointer, schema["exclusiveMinimum"])
            if "maximum" in schema:
                yield overwritten("above the range", pointer, schema["maximum"] * 1.5 + 1)
        elif "enum" in schema or "const" in schema:
            yield overwritten("misspelt word", pointer, value + "x")


def slips_of_regions(document):
    regions = document["section"]["regions"]
    for k, region in enumerate(regions):
        here, ring = f"/section/regions/{k}", region["polygon"]
        yield overwritten("unknown material", here + "/material", "clay")
        yield overwritten("open polygon", here + "/polygon", ring[:-1])
        yield overwritten("region without area", here + "/polygon", [ring[0], ring[1], ring[0], ring[0]])
        if len(ring) == 5:
            yield overwritten("crossed polygon", here + "/polygon", [ring[0], ring[2], ring[1], ring[3], ring[0]])
        if k > 0:
            yield overwritten("a name twice", here + "/name", regions[0]["name"])
            either = [f"/section/regions/{n}{end}" for n in range(len(regions)) for end in ("", "/polygon")]
            yield overwritten("overlap", here + "/polygon", [[x, y - 0.5] for x, y in ring], "/section/regions", *either)


def slips_of_meaning(document):
    yield from slips_of_regions(document)
    if "lem" in document:
        for name in ("entry", "exit"):
            yield overwritten("descending range", f"/lem/search/{name}", document["lem"]["search"][name][::-1])
        if "undrained" in document["lem"]:
            yield overwritten("unknown region", "/lem/undrained/0/region", "nowhere")
    if "mpm" in document:
        mpm = document["mpm"]
        x1 = mpm["domain_x"][1]
        yield overwritten("unknown region", "/mpm/runout/regions/0", "nowhere")
        for name in ("domain_x", "domain_y"):
            yield overwritten("descending range", f"/mpm/{name}", mpm[name][::-1])
        yield overwritten("floor below the grid", "/mpm/floor/level", -100)
        yield overwritten("gauge outside", "/mpm/gauges/0/x", x1 + 5)
    if "fem" in document:
        yield overwritten("nothing holds it", "/fem/supports", document["fem"]["supports"][:2])
        away = {"from": [9000, 0], "to": [9001, 0]}
        yield overwritten("support in the air", "/fem/supports/0", document["fem"]["supports"][0] | away,
                          "/fem/supports/0", "/fem/supports/0/from", "/fem/supports/0/to")
        yield overwritten("a corner that is no vertex", "/section/regions/0/mesh/corners/0", [0.37, 77])


def slipped(scene, random):
    """(kind, document with one slip, pointers of which one must be named)"""
    choice = list(slips_of_meaning(scene)) if random.random() < 0.5 else list(slips_of_schema(scene))
    kind = random.choice(sorted({each[0] for each in choice}))
    _, change, pointers = random.choice([each for each in choice if each[0] == kind])
    made = copy.deepcopy(scene)
    change(made)
    return kind, made, pointers
