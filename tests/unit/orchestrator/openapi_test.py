"""/openapi.json against the server that serves it: every route of the source is in it and no other, every operation
answers with a documented status and media type, and every JSON answer fits its schema. Every operation has an example: a real
call of services/orchestrator/http/examples.json, which is made again with the real phases.

    openapi_test.py --write    makes these calls and writes their answers, shortened, to examples.json

Each call follows those before it. A new one needs method, path, call (the path as it is sent) and status, and its body. An id or
SHA-256 in it is that of an answer before it."""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.error
import urllib.request

import jsonschema

root = pathlib.Path(os.environ["BREACH_ROOT"])
programs = pathlib.Path(os.environ["BREACH_BIN"])
examples = root / "services/orchestrator/http/examples.json"
identifier = re.compile(r"[0-9a-z]{26}(-\d+)?|[0-9a-f]{64}")


def study(times):
    scene = json.loads((root / "workflows/scenes/slope.json").read_text())
    return {"format": "breachline-study/1", "name": "described", "scene": scene, "transfer_times": times}


def shortened(value, schema, document):
    """Lists keep their first entries, objects whose entries the schema does not name three, texts their beginning."""
    kind = "array" if isinstance(value, list) else "object"
    schema = next((each for each in schema.get("oneOf", ()) if "$ref" in each or each["type"] == kind), schema)
    while "$ref" in schema:
        schema = document["components"]["schemas"][schema["$ref"].split("/")[-1]]
    if isinstance(value, dict):
        known, others = schema.get("properties", {}), schema.get("additionalProperties") or {}
        kept = [name for place, name in enumerate(value) if known or place < 3 or name in schema.get("required", ())]
        return {name: shortened(value[name], known.get(name, others), document) for name in kept}
    if isinstance(value, list):
        return [shortened(each, schema.get("items", {}), document) for each in value[:1 if isinstance(value[0], dict) else 3]] if value else []
    return value if not isinstance(value, str) or len(value) <= 160 else value[:160] + "..."


def learn(old, new, known):
    """Maps identifiers of an old answer to those of the new one."""
    if isinstance(old, dict) and isinstance(new, dict):
        for name in old.keys() & new.keys():
            learn(old[name], new[name], known)
    elif isinstance(old, list) and isinstance(new, list):
        for pair in zip(old, new):
            learn(*pair, known)
    elif isinstance(old, str) and isinstance(new, str) and identifier.fullmatch(new):
        known.setdefault(old, new)


class Api(unittest.TestCase):
    stand_in = None

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        here = pathlib.Path(cls.folder.name)
        (here / "bin").mkdir()
        for name in ("lem_tool", "fem_solver", "transfer_tool", "mpm_solver"):
            (here / "bin" / name).symlink_to(programs / (cls.stand_in or name))
        cls.service = subprocess.Popen([programs / "breachline", "serve", "--data", here / "data", "--port", "0", "--bin",
                                        here / "bin"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        cls.url = json.loads(cls.service.stdout.readline())["url"]
        cls.document = json.loads(cls.ask("GET", "/openapi.json")[2])
        cls.seen = set()

    @classmethod
    def tearDownClass(cls):
        cls.service.terminate()
        cls.service.wait(30)
        cls.service.stdout.close()
        cls.folder.cleanup()

    @classmethod
    def ask(cls, method, path, body=None, **headers):
        data = None if body is None else body if isinstance(body, bytes) else json.dumps(body).encode()
        headers = {"Content-Type": "application/json", **headers}
        request = urllib.request.Request(cls.url + path, data, headers, method=method)
        try:
            with urllib.request.urlopen(request, timeout=60) as answer:
                return answer.status, answer.headers, answer.read()
        except urllib.error.HTTPError as error:
            return error.code, error.headers, error.read()

    @classmethod
    def wait(cls):
        """Waits for the end of all runs."""
        for _ in range(6000):
            if all(run["finished"] for run in json.loads(cls.ask("GET", "/v1/runs?limit=500")[2])["runs"]):
                return
            time.sleep(0.05)
        raise AssertionError("a run does not end")

    def check(self, method, template, path, status, body=None, **headers):
        """The answer has this status and matches its operation."""
        operation = self.document["paths"][template][method.lower()]
        self.seen.add((template, method.lower()))
        got, answer_headers, text = self.ask(method, path, body, **headers)
        self.assertEqual(got, status, f"{method} {path}: {text[:300]}")
        response = operation["responses"].get(str(got), operation["responses"]["default"])
        if "$ref" in response:
            response = self.document["components"]["responses"][response["$ref"].split("/")[-1]]
        media = answer_headers.get("Content-Type", "").split(";")[0]
        described = response.get("content", {})
        self.assertTrue(media in described or "*/*" in described, f"{method} {path}: {media} is not described")
        self.media = media if media in described else "*/*"
        if media.endswith("json"):
            self.fits(json.loads(text), described[media]["schema"], f"{method} {path}")
        return text

    def fits(self, value, schema, where):
        resolver = jsonschema.RefResolver.from_schema(self.document)
        faults = list(jsonschema.Draft202012Validator(schema, resolver=resolver).iter_errors(value))
        self.assertFalse(faults, f"{where}: {[f'{list(each.absolute_path)}: {each.message[:200]}' for each in faults[:3]]}")


class Examples(Api):
    def test_1_each_call_is_answered_as_described(self):
        calls, known = json.loads(examples.read_text()), {}
        for call in calls:
            if call["path"] != "/v1/workers":
                self.wait()
            text = json.dumps([call["call"], call.get("body")])
            for old in sorted(known, key=len, reverse=True):
                text = text.replace(old, known[old])
            path, body = json.loads(text)
            raw = isinstance(body, str)
            answer = self.check(call["method"].upper(), call["path"], path, int(call["status"]), body.encode() if raw else body,
                                **({"Content-Type": "application/octet-stream"} if raw else {}))
            if self.media.endswith("json"):
                answer = json.loads(answer)
            else:  # arrays follow the first line of frames
                answer = (answer if self.media.startswith("text") else answer.split(b"\n")[0]).decode()
            learn(call.get("answer"), answer, known)
            schema = self.document["paths"][call["path"]][call["method"]]["responses"][call["status"]]["content"][self.media].get("schema", {})
            call.update(call=path, media=self.media, body=body, answer=shortened(answer, schema, self.document))
        if "--write" in sys.argv:
            order = ("method", "path", "call", "status", "name", "media", "body", "answer")
            lines = [json.dumps({each: call[each] for each in order if call.get(each) is not None}) for call in calls]
            examples.write_text("[\n " + ",\n ".join(lines).replace(', "body": ', ',\n  "body": ').replace(', "answer": ', ',\n  "answer": ') + "\n]\n")

    def test_2_each_operation_has_an_example_as_it_describes(self):
        for path, methods in self.document["paths"].items():
            for method, operation in methods.items():
                answers = [media for each in operation["responses"].values() for media in each.get("content", {}).values()]
                for bodies in (answers, list(operation.get("requestBody", {}).get("content", {}).values())):
                    shown = [(media, each["value"]) for media in bodies for each in media.get("examples", {}).values()]
                    self.assertTrue(shown or not bodies, f"{method} {path}: http/examples.json has no example of it")
                    for media, value in shown:
                        self.fits(value, media.get("schema", {}), f"the example of {method} {path}")


class Described(Api):
    stand_in = "fake_phase"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.run_id = json.loads(cls.ask("POST", "/v1/runs", study([0.25, 0.5]))[2])["id"]
        cls.wait()

    def test_1_it_is_openapi_3_1_and_its_schemas_are_sound(self):
        self.assertTrue(self.document["openapi"].startswith("3.1"))
        for schema in self.document["components"]["schemas"].values():
            jsonschema.Draft202012Validator.check_schema(schema)
        named = set(re.findall(r'"#/components/schemas/(\w+)"', json.dumps(self.document)))
        self.assertEqual(named, set(self.document["components"]["schemas"]))

    def test_2_it_has_every_route_of_the_source_and_no_other(self):
        source = "".join(each.read_text() for each in (root / "services/orchestrator/http").glob("*.cpp"))
        routes = {(path, method) for method, path in re.findall(r'router\.(get|post|remove)\(\s*"([^"]+)"', source)}
        routes = {(path, "delete" if method == "remove" else method) for path, method in routes}
        described = {(path, method) for path, methods in self.document["paths"].items() for method in methods}
        self.assertEqual(routes, described)
        for path, methods in self.document["paths"].items():
            for operation in methods.values():
                parts = set(re.findall(r"\{([^}]+)\}", path))
                given = {each["name"] for each in operation.get("parameters", []) if each["in"] == "path"}
                self.assertEqual(parts, given, path)

    def test_3_every_operation_answers_as_described(self):
        run, task = self.run_id, f"{self.run_id}-00000"
        page = json.loads(self.ask("GET", f"/v1/runs/{run}")[2])
        transfer = next(each for each in page["tasks"] if each["phase"] == "transfer_tool")
        artifact = page["tasks"][0]["artifacts"][0]["sha256"]
        get = lambda template, path, status=200, **headers: self.check("GET", template, path, status, **headers)
        post = lambda template, path, status, body=None: self.check("POST", template, path, status, body)
        for path in ("/", "/healthz", "/readyz", "/metrics", "/openapi.json", "/v1/schema/scene", "/v1/schema/study",
                     "/v1/examples", "/v1/runs", "/v1/sweeps", "/v1/telemetry/fields"):
            get(path, path)
        get("/static/{file...}", "/static/none.js", 404)
        example = json.loads(get("/v1/examples", "/v1/examples"))["examples"][0]["name"]
        get("/v1/examples/{name}", f"/v1/examples/{example}")
        of_template = "/v1/templates/{name}"
        named = [each["name"] for each in json.loads(get("/v1/templates", "/v1/templates"))["templates"]]
        made = json.loads(post(of_template, f"/v1/templates/{named[0]}", 200, {"height": 20, "with_fem": True}))
        self.assertIn("file:sha256/", made["study"]["scene"]["fem"]["motion"]["file"])
        post("/v1/cost", "/v1/cost", 200, made["study"])
        refused = json.loads(post(of_template, f"/v1/templates/{named[0]}", 422, {"height": 20, "raises": 99}))
        self.assertEqual(refused["faults"][0]["pointer"], "/raises")
        post(of_template, "/v1/templates/none", 404, {})
        post("/v1/scenes/plan", "/v1/scenes/plan", 200, study([0.5])["scene"])
        for body in (study([0.5]), study([0.5])["scene"]):
            self.assertTrue(post("/v1/draw", "/v1/draw", 200, body).startswith(b"<svg "))
            post("/v1/cost", "/v1/cost", 200, body)
        section = {"drawing": "region,x,y\nclay,0,0\nclay,40,0\nclay,20,8\nclay,0,8\n", "file": "dam.csv",
                   "materials": {"clay": {"density": 2000, "law": {"type": "mohr_coulomb", "E_MPa": 40, "nu": 0.3, "c_kPa": 5, "phi_deg": 30}}}}
        made = json.loads(post("/v1/import", "/v1/import", 200, section))
        self.assertEqual(made["scene"]["section"]["regions"][0]["name"], "clay")
        post("/v1/draw", "/v1/draw", 200, made["scene"])
        shaken = {**section, "phreatic": "x,y\n0,6\n40,0\n", "layers": ["clay=3"], "with_fem": True, "pga": 0.2}
        made = json.loads(post("/v1/import", "/v1/import", 200, shaken))
        self.assertIn("file:sha256/", made["scene"]["fem"]["motion"]["file"])
        post("/v1/cost", "/v1/cost", 200, {**made["study"], "scene": made["scene"]})
        self.assertIn("REGION=5,10", post("/v1/import", "/v1/import", 422, {**shaken, "layers": []}).decode())
        at_rest = {**section, "phreatic": "x,y\n0,6\n40,0\n", "liquefied": ["clay=0.08,CPTu 2024"]}
        made = json.loads(post("/v1/import", "/v1/import", 200, at_rest))
        post("/v1/cost", "/v1/cost", 200, {**made["study"], "scene": made["scene"]})
        self.assertIn("names no source", post("/v1/import", "/v1/import", 422, {**at_rest, "liquefied": ["clay=0.08"]}).decode())
        wrong = {**section, "drawing": section["drawing"] + "\nsand,0,8\nsand,9,8\nsand,9,9\n"}
        self.assertIn("(0, 8)", post("/v1/import", "/v1/import", 422, wrong).decode())
        self.assertIn(b'class="fault"', post("/v1/import", "/v1/import?picture=1", 200, wrong))
        post("/v1/import", "/v1/import", 422, {**wrong, "drawing": 5, "more": 1})
        post("/v1/draw", "/v1/draw?mesh=2", 400, study([0.5]))
        post("/v1/draw", "/v1/draw", 422, {"scene": 1})
        post("/v1/cost", "/v1/cost", 422, {"scene": {}})
        post("/v1/runs", "/v1/runs", 202, study([0.25]))
        post("/v1/sweeps", "/v1/sweeps", 202, study([0.25, 0.75]))
        get("/v1/runs/{id}", f"/v1/runs/{run}")
        self.assertNotIn("tasks", json.loads(get("/v1/runs/{id}", f"/v1/runs/{run}?tasks=0")))
        get("/v1/runs/{id}", f"/v1/runs/{run}?tasks=2", 400)
        get("/v1/runs/{id}/report", "/v1/runs/none/report", 404)
        get("/v1/runs/{id}/tasks", f"/v1/runs/{run}/tasks?limit=2")
        for kind, name in (("runs", "/v1/runs"), ("sweeps", "/v1/sweeps")):
            for form in ("", "?format=csv", "?format=hdf5", "?format=csv&table=means", "?format=hdf5&table=means",
                         "?from=1&limit=1"):
                get(f"/v1/{kind}/{{id}}/results", f"{name}/{run}/results{form}")
        get("/v1/runs/{id}/telemetry", f"/v1/runs/{run}/telemetry")
        get("/v1/runs/{id}/envelopes", f"/v1/runs/{run}/envelopes")
        get("/v1/runs/{id}/hydrograph", f"/v1/runs/{run}/hydrograph?for=paper", 400)
        get("/v1/runs/{id}/hydrograph", f"/v1/runs/{run}/hydrograph?for=csv&interval=60", 400)
        get("/v1/runs/{id}/triggers", f"/v1/runs/{run}/triggers")
        get("/v1/sweeps/{id}", f"/v1/sweeps/{run}")
        get("/v1/tasks/{id}", f"/v1/tasks/{task}")
        get("/v1/tasks/{id}/attempts/{n}/log", f"/v1/tasks/{task}/attempts/1/log")
        get("/v1/tasks/{id}/frames", f"/v1/tasks/{task}/frames")
        get("/v1/tasks/{id}/frames/{name}/points", f"/v1/tasks/{transfer['id']}/frames/none.vtkhdf/points", 404)
        get("/v1/artifacts/{sha256}", f"/v1/artifacts/{artifact}")
        get("/v1/workers", "/v1/workers")
        get("/v1/transfers", "/v1/transfers?limit=1")
        get("/v1/transfers", "/v1/transfers?why=chance", 400)
        get("/v1/runs/{id}/transfers", f"/v1/runs/{run}/transfers?why=at_time")
        get("/v1/sweeps", "/v1/sweeps?state=refining")
        get("/v1/events", f"/v1/events?after=0&run={run}")
        judged = {**study([0.5]), "accuracy": {"quantity": "runout", "ladders": [
            {"name": "cells", "steps": [["/mpm/cell_size=1"], ["=0.5"]]}]}}
        accurate = json.loads(post("/v1/runs", "/v1/runs", 202, judged))["id"]
        get("/v1/runs/{id}/accuracy", f"/v1/runs/{accurate}/accuracy")
        get("/v1/runs/{id}/accuracy", f"/v1/runs/{accurate}/accuracy?asked_error=0.1")
        get("/v1/runs/{id}/accuracy", f"/v1/runs/{accurate}/accuracy?asked_error=0", 400)
        get("/v1/runs/{id}/accuracy", f"/v1/runs/{run}/accuracy", 404)
        self.wait()
        drawn = {**study([0.5]), "uncertainty": {"samples": 6, "parameters": [
            {"name": "strength", "sets": ["/mpm/cfl"], "distribution": {"type": "uniform", "from": 0.3, "to": 0.5}}]}}
        uncertain = json.loads(post("/v1/runs", "/v1/runs", 202, drawn))["id"]
        self.wait()
        route = "/v1/runs/{id}/uncertainty"
        get(route, f"/v1/runs/{uncertain}/uncertainty")
        get(route, f"/v1/runs/{uncertain}/uncertainty?quantity=runout")
        get(route, f"/v1/runs/{uncertain}/uncertainty?format=csv")
        get(route, f"/v1/runs/{uncertain}/uncertainty?format=hdf5")
        get(route, f"/v1/runs/{uncertain}/uncertainty?quantity=nonsense", 400)
        get(route, f"/v1/runs/{run}/uncertainty", 404)
        get("/v1/runs/{id}/motions", f"/v1/runs/{run}/motions", 404)

        post("/v1/sweeps/{id}/extend", f"/v1/sweeps/{run}/extend", 202, {"transfer_times": [0.25, 0.75]})
        self.wait()
        criterion = {"kind": "criterion", "when": "time > 0.1"}
        post("/v1/runs/{id}/triggers", f"/v1/runs/{run}/triggers", 202, criterion)
        for order in ("pause", "resume", "retry"):
            post(f"/v1/runs/{{id}}/{order}", f"/v1/runs/{run}/{order}", 202)
        post("/v1/runs/{id}/priority", f"/v1/runs/{run}/priority", 202, {"priority": 3})
        renamed = json.loads(post("/v1/runs/{id}/title", f"/v1/runs/{run}/title", 202, {"title": "Weak beach, zweiter Versuch"}))
        self.assertEqual(renamed["title"], "Weak beach, zweiter Versuch")
        self.assertEqual([each["id"] for each in json.loads(get("/v1/runs", "/v1/runs?search=weak%20BEACH"))["runs"]], [run])
        self.assertEqual(json.loads(get("/v1/runs", "/v1/runs?search=nothing%25"))["runs"], [])
        for wrong in ("", "  ", "a\nb", 3, "x" * 201):
            post("/v1/runs/{id}/title", f"/v1/runs/{run}/title", 400, {"title": wrong})
        post("/v1/sweeps/{id}/cancel", f"/v1/sweeps/{run}/cancel", 202)
        post("/v1/runs/{id}/cancel", f"/v1/runs/{run}/cancel", 202)
        delete = lambda template, path, status: self.check("DELETE", template, path, status)
        get("/v1/storage", "/v1/storage")
        self.wait()
        delete("/v1/runs/{id}", f"/v1/runs/{run}", 202)
        motion = (root / "workflows/motions/synthetic_short.csv").read_bytes()
        raw = {"Content-Type": "application/octet-stream"}
        sent = [json.loads(self.check("POST", "/v1/files", "/v1/files?name=a.csv", status, motion, **raw)) for status in (201, 200)]
        self.assertEqual(sent[0]["reference"], f"file:sha256/{sent[0]['sha256']}.csv")
        self.check("POST", "/v1/files", "/v1/files?name=a.csv", 415, motion)
        self.check("POST", "/v1/files", "/v1/files?name=a.csv", 422, b"no motion", **raw)
        get("/v1/files", "/v1/files")
        self.assertEqual(get("/v1/files/{sha256}", f"/v1/files/{sent[0]['sha256']}"), motion)
        delete("/v1/files/{sha256}", f"/v1/files/{sent[0]['sha256']}", 202)
        delete("/v1/files/{sha256}", f"/v1/files/{sent[0]['sha256']}", 404)

    def test_4_what_is_wrong_is_a_described_problem(self):
        for template, methods in self.document["paths"].items():
            if "{id}" not in template:
                continue
            path = template.replace("{id}", "nobody").replace("{n}", "1").replace("{name}", "x")
            bodies = {"priority": {"priority": 1}, "title": {"title": "new"}, "triggers": {"kind": "manual"}, "extend": {"transfer_times": [1]}}
            for method in methods:
                body = bodies.get(path.split("/")[-1]) if method == "post" else None
                self.check(method.upper(), template, path, 404, body)
        self.check("POST", "/v1/runs", "/v1/runs", 422, {"name": 1})
        self.check("GET", "/v1/runs", "/v1/runs?limit=0", 400)
        self.check("GET", "/v1/runs", "/v1/runs?limits=1", 400)
        self.check("POST", "/v1/runs", "/v1/runs", 415, b"{}", **{"Content-Type": "text/plain"})

    def test_5_no_operation_was_left_out(self):
        described = {(path, method) for path, methods in self.document["paths"].items() for method in methods}
        self.assertEqual(described - self.seen, set())


if __name__ == "__main__":
    unittest.main(argv=[*sys.argv[:1], *(["Examples.test_1_each_call_is_answered_as_described"] if "--write" in sys.argv else [])], failfast=True)
