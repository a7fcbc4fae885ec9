"""The published schemas are valid JSON Schema 2020-12, every number in them says its unit, and an independent
validator accepts the shipped scenes and studies and refuses what we refuse."""
import copy
import json
import os
import pathlib
import sys

import jsonschema

root = pathlib.Path(os.environ["BREACH_ROOT"])


def without_unit_of_numbers(schema, path=""):
    if isinstance(schema, dict):
        if schema.get("type") in ("number", "integer") and "unit" not in schema and "items" not in path.split("/")[-1:]:
            yield path
        for key, value in schema.items():
            yield from without_unit_of_numbers(value, f"{path}/{key}")


def main():
    for kind, folder in (("scene", "scenes"), ("study", "studies")):
        schema = json.loads((root / f"workflows/schema/{kind}.schema.json").read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        missing = list(without_unit_of_numbers(schema))
        assert not missing, f"numbers without a unit: {missing}"
        validator = jsonschema.Draft202012Validator(schema)
        files = sorted((root / "workflows" / folder).glob("*.json"))
        assert files, f"no {folder} shipped"
        for file in files:
            document = json.loads(file.read_text())
            faults = [f"{list(e.absolute_path)}: {e.message}" for e in validator.iter_errors(document)]
            assert not faults, f"{file}: {faults}"
            wrong = copy.deepcopy(document)
            wrong["no_such_key"] = 1
            assert list(validator.iter_errors(wrong)), f"{file}: an unknown key was accepted"
            print(f"{file.relative_to(root)}: valid")


if __name__ == "__main__":
    sys.exit(main())
