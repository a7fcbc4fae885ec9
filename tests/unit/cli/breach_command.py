"""The breach command with a simulated service: its requests, output and exit codes."""
import hashlib
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

import fake_service
from fake_service import Service, run_id

breach = os.path.join(os.environ["BREACH_BIN"], "breach")


def call(service, *arguments, **environment):
    address = service if isinstance(service, str) else service.url
    return subprocess.run([breach, *map(str, arguments)], text=True, capture_output=True, timeout=30,
                          env={"BREACH_SERVER": address, **environment})


class Breach(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.here = pathlib.Path(self.folder.name)

    def serve(self, **how):
        service = Service(**how)
        self.addCleanup(service.server_close)
        self.addCleanup(service.shutdown)
        return service

    def study(self, name="fake"):
        (self.here / "scene.json").write_text('{"name": "a scene"}')
        file = self.here / "study.json"
        file.write_text(json.dumps({"name": name, "scene": "scene.json"}))
        return file

    def test_submit_puts_the_scene_in_and_prints_the_id(self):
        service = self.serve()
        done = call(service, "submit", self.study(), "--set", "/mpm/cell_size=2", "--key", "k1")
        self.assertEqual((done.returncode, done.stdout), (0, run_id + "\n"), done.stderr)
        _, body, headers = service.posted[0]
        self.assertEqual(body, {"name": "fake", "scene": {"name": "a scene"}, "overrides": ["/mpm/cell_size=2"]})
        self.assertEqual(headers["Idempotency-Key"], "k1")

    def test_faults_found_by_the_server_are_listed(self):
        done = call(self.serve(), "submit", self.study("faulty"))
        self.assertEqual(done.returncode, 65)
        self.assertIn("/scene/mpm/cell_size: is negative", done.stderr)
        self.assertIn("remedy: give a positive size", done.stderr)

    def test_a_server_that_cannot_now_is_75(self):
        done = call(self.serve(), "submit", self.study("busy"))
        self.assertEqual(done.returncode, 75)
        self.assertIn("the disk is full", done.stderr)

    def test_no_server_is_75(self):
        service = Service()
        service.shutdown()
        service.server_close()
        for command in (["list"], ["submit", self.study()], ["watch", run_id], ["export", run_id, self.here / "out"]):
            done = call(service, *command)
            self.assertEqual(done.returncode, 75, command)
            self.assertIn("no answer from http://127.0.0.1:", done.stderr)

    def test_wrong_usage_is_2(self):
        for arguments in ([], ["submit"], ["list", "--nonsense"], ["nonsense"], ["watch"],
                          ["--server", "localhost:1", "list"]):
            self.assertEqual(call("http://127.0.0.1:1", *arguments).returncode, 2, arguments)

    def test_files_that_cannot_be_read_are_74_and_no_json_is_65(self):
        service = self.serve()
        self.assertEqual(call(service, "submit", self.here / "absent.json").returncode, 74)
        self.assertEqual(call(service, "list", BREACH_TOKEN_FILE=str(self.here / "absent")).returncode, 74)
        (self.here / "broken.json").write_text('{"a": 1, "a"')
        self.assertEqual(call(service, "submit", self.here / "broken.json").returncode, 65)
        self.assertEqual(service.posted, [])

    def test_the_token_is_sent(self):
        service = self.serve(token="secret")
        (self.here / "token").write_text("secret\n")
        refused = call(service, "list")
        self.assertEqual((refused.returncode, "a token is needed" in refused.stderr), (65, True))
        self.assertEqual(call(service, "--token-file", self.here / "token", "list").returncode, 0)

    def test_list_and_show(self):
        service = self.serve()
        self.assertIn(f"{run_id}  fake  running", call(service, "list").stdout)
        self.assertEqual(json.loads(call(service, "list", "--json").stdout)[0]["id"], run_id)
        page = call(service, "show", "latest").stdout
        self.assertIn("A run that is none", page)
        self.assertIn("mpm_solver      0.5  running", page)
        self.assertIn("fem_solver", call(service, "show", f"{run_id}-00000").stdout)
        self.assertEqual(call(service, "show", "nobody").returncode, 65)

    def test_watch_ends_with_the_run_and_says_how(self):
        for end, code in (("succeeded", 0), ("failed", 70), ("cancelled", 70)):
            done = call(self.serve(end=end), "watch", run_id)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertIn("mpm_solver  t_T 0.5 s  running\n", done.stdout)
            self.assertIn(f"mpm_solver  t_T 0.5 s  {end}", done.stdout)
            self.assertNotIn("\033", done.stdout)

    def test_interrupted_watch_says_that_the_run_goes_on(self):
        with subprocess.Popen([breach, "watch", run_id], text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              env={"BREACH_SERVER": self.serve(looks=10000).url}) as watching:
            watching.stdout.readline()
            watching.send_signal(signal.SIGINT)
            said = watching.communicate(timeout=30)[1]
        self.assertEqual(watching.returncode, 130)
        self.assertIn(f"The run goes on. To look on: breach watch {run_id}; to stop it: breach cancel {run_id}\n", said)

    def test_a_report_is_a_pdf_or_a_page(self):
        service, page, sheet = self.serve(), self.here / "a.html", self.here / "a.pdf"
        self.assertEqual(call(service, "report", "latest", "--output", page).stdout, f"{page}\n")
        self.assertEqual(page.read_text(), "<html>the report</html>")
        missing = call(service, "report", "latest", "--output", sheet, PATH=str(self.here))
        self.assertEqual(missing.returncode, 74)
        self.assertIn("install weasyprint", missing.stderr)
        (self.here / "weasyprint").write_text('#!/bin/sh\n{ echo %PDF; /bin/cat "$2"; } > "$3"\n')
        (self.here / "weasyprint").chmod(0o755)
        self.assertEqual(call(service, "report", "latest", "--output", sheet, PATH=str(self.here)).returncode, 0)
        self.assertEqual(sheet.read_text(), "%PDF\n<html>the report</html>")
        self.assertEqual(call(service, "report", "latest", "--output", self.here / "a.doc").returncode, 2)

    def test_watch_as_json_gives_this_runs_events_and_the_run(self):
        lines = [json.loads(each) for each in call(self.serve(), "watch", run_id, "--json").stdout.splitlines()]
        self.assertEqual([each["run"] for each in lines[:-1]], [run_id])
        self.assertEqual(lines[-1]["run"]["state"], "succeeded")

    def test_watch_follows_a_service_that_was_restored_from_a_backup(self):
        lines = [json.loads(each) for each in call(self.serve(looks=6, restored=True), "watch", run_id, "--json").stdout.splitlines()]
        self.assertEqual([each.get("seq") for each in lines[:-1]], [2, 2])

    def test_a_questionable_end_is_said_and_counts_when_asked_to(self):
        for words in (["watch", run_id], ["submit", self.study(), "--watch"], ["results", run_id]):
            for strict, code in (([], 0), (["--strict"], 70)):
                done = call(self.serve(end="questionable", looks=0), *words, *strict)
                self.assertEqual(done.returncode, code, done.stderr)
                self.assertIn("questionable: 1 of 1 runouts still moving: lower bounds", done.stderr)

    def test_rows_are_filtered_by_state_and_flag(self):
        service = self.serve(looks=0)
        call(service, "results", run_id, "--state", "questionable", "--flag", "still_moving", "--csv")
        self.assertIn(f"/v1/runs/{run_id}/results?format=csv&state=questionable&flag=still_moving", service.asked)

    def test_orders_to_a_run(self):
        service = self.serve()
        for words in (["pause"], ["resume"], ["retry"], ["priority", "10"]):
            done = call(service, words[0], "latest", *words[1:])
            self.assertEqual((done.returncode, "running" in done.stdout), (0, True), done.stderr)
            self.assertEqual(service.posted[-1][0], f"/v1/runs/{run_id}/{words[0]}")
        self.assertEqual(service.posted[-1][1], {"priority": 10})
        self.assertEqual(call(service, "rename", "latest", "Weak beach").returncode, 0)
        self.assertEqual(service.posted[-1][:2], (f"/v1/runs/{run_id}/title", {"title": "Weak beach"}))

    def test_a_scene_is_made_a_study(self):
        service = self.serve()
        self.study()
        done = call(service, "submit", "--scene", self.here / "scene.json", "--times", "0.5,1", "--set", "/a=1")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(service.posted[0][1], {"format": "breachline-study/1", "name": "a scene", "overrides": ["/a=1"],
                                                "scene": {"name": "a scene"}, "transfer_times": [0.5, 1.0]})
        both = call(service, "submit", self.study(), "--scene", self.here / "scene.json")
        self.assertEqual((both.returncode, len(service.posted)), (2, 1))

    def test_a_new_scene_comes_from_a_template_and_is_never_written_over(self):
        nobody = "http://127.0.0.1:1"
        new = lambda *words: call(nobody, "new", *words)
        for name in ("upstream_dam", "downstream_dam", "slope", "heap"):
            self.assertIn(name, new("--list").stdout)
        self.assertRegex(new("upstream_dam", "--help").stdout, r"--starter-height m +of the starter dam \(1 to 200 m; default height / 3 = 10 m\)")
        folder = self.here / "My Dam"
        made = new("slope", "--height", 12, "--output", folder)
        self.assertEqual((made.returncode, made.stdout.split("\n")[:2]), (0, [str(folder / "scene.json"), str(folder / "study.json")]), made.stderr)
        self.assertIn(f"breach submit {folder}/study.json", made.stderr)
        self.assertEqual(json.loads((folder / "scene.json").read_text())["name"], "slope", "the folder's name names no run")
        before = (folder / "scene.json").read_bytes()
        again = new("slope", "--height", 15, "--output", folder)
        self.assertEqual(again.returncode, 65)
        self.assertIn("--force", again.stderr)
        self.assertEqual((folder / "scene.json").read_bytes(), before)
        shaken = new("upstream_dam", "--height", 15, "--with-fem", "--output", folder, "--force", "--name", "shaken", "--json")
        self.assertEqual(json.loads(shaken.stdout)["options"]["with_fem"], True, shaken.stderr)
        self.assertTrue((folder / "motion.csv").read_text().startswith("# Synthetic"))
        self.assertEqual(json.loads((folder / "study.json").read_text())["name"], "shaken")

    def test_a_new_scene_is_refused_by_its_options(self):
        for words, told in ((["--height", "high"], '--height: is "high"'), (["--height", "-5"], "from 3 to 200 m"),
                            (["--raises", "2.5"], "--raises: is 2.5"), (["--starter-height", "40"], "at most 0.95 height")):
            refused = call("http://127.0.0.1:1", "new", "upstream_dam", "--output", self.here / "none", *words)
            self.assertEqual(refused.returncode, 65, refused.stderr)
            self.assertIn(told, refused.stderr)
            self.assertFalse((self.here / "none").exists())
        unknown = call("http://127.0.0.1:1", "new", "upstream_dam", "--hight", "20")
        self.assertEqual(unknown.returncode, 2)

    def test_every_word_has_an_example_and_a_wrong_one_is_named(self):
        words = ("submit", "sweep", "extend", "list", "show", "watch", "cancel", "pause", "resume", "retry", "rename", "priority",
                 "results", "logs", "telemetry", "report", "export", "plan", "rm", "du", "files", "open", "new", "draw", "completion")
        for word in words:
            self.assertIn(f"breach {word} ", call("http://127.0.0.1:1", word, "--help").stdout)
        wrong = call("http://127.0.0.1:1", "restart", run_id)
        self.assertEqual(wrong.returncode, 2)
        self.assertIn('unknown command "restart"', wrong.stderr)
        for word in words:
            self.assertIn(word, wrong.stderr)
        self.assertIn("For example: breach submit", call("http://127.0.0.1:1").stderr)

    def test_a_misspelt_word_or_option_is_answered_with_the_one_that_was_meant(self):
        for words, said in ((["submitt"], 'breach: unknown command "submitt"; did you mean submit?'),
                            (["list", "--jsn"], "breach list: unknown option --jsn; did you mean --json?"),
                            (["results", "latest", "--flga=still_moving"], "breach results: unknown option --flga=still_moving; did you mean --flag?"),
                            (["accuracy", "s.json", "--within2"], "did you mean --within?"),
                            (["new", "upsteam_dam"], "did you mean upstream_dam?"),
                            (["new", "upstream_dam", "--hight", "20"], "breach new upstream_dam: unknown option --hight; did you mean --height?")):
            done = call("http://127.0.0.1:1", *words)
            self.assertEqual((done.returncode, said in done.stderr), (2, True), done.stderr)

    def test_options_stand_before_the_command_or_behind_it(self):
        service = self.serve(looks=0)
        for words in (["--csv", "results", run_id], ["results", "--csv", run_id], ["results", run_id, "--csv"],
                      ["--flag", "list", "--csv", "results", run_id], ["--server", service.url, "--csv", "results", run_id]):
            self.assertEqual(call(service, *words).stdout, "transfer_time,runout\n0.5,12.5\n", words)

    def test_a_run_is_named_by_its_id_its_beginning_or_its_name(self):
        service = self.serve(looks=0)
        for name in (run_id, run_id[:6], "fake", "latest"):
            self.assertEqual(call(service, "results", name, "--csv").stdout, "transfer_time,runout\n0.5,12.5\n", name)
        none = call(service, "results", "fak")
        self.assertEqual((none.returncode, 'no run has the name or id "fak"' in none.stderr), (65, True), none.stderr)

    def test_rm_asks_and_says_how_much_it_frees(self):
        service = self.serve(looks=0)
        refused = call(service, "rm", "fake")
        self.assertEqual((refused.returncode, "give --yes" in refused.stderr, service.removed), (65, True, []), refused.stderr)
        self.assertIn("12.3 MB freed", call(service, "rm", "fake", "--yes").stdout)
        self.assertEqual(service.removed, [f"/v1/runs/{run_id}"])
        for answer, removed in (("n\n", 1), ("y\n", 2)):
            leader, follower = os.openpty()
            os.write(leader, answer.encode())
            done = subprocess.run([breach, "rm", "fake"], stdin=follower, text=True, capture_output=True, timeout=30, env={"BREACH_SERVER": service.url})
            os.close(leader), os.close(follower)
            self.assertIn(f"{run_id}  fake  12.3 MB\nRemove it (12.3 MB)? [y/N]", done.stderr)
            self.assertEqual(len(service.removed), removed)

    def test_completion_knows_every_command_in_each_shell(self):
        for shell, form in (("bash", "        results) options="), ("zsh", "#compdef breach\n"),
                            ("fish", "complete -c breach -n '__fish_seen_subcommand_from results' -l csv -d")):
            script = call("http://127.0.0.1:1", "completion", shell).stdout
            self.assertIn(form, script)
            for word in ("submit", "transfers", "hydrograph"):
                self.assertIn(word, script)

    def test_a_file_that_the_server_does_not_find_is_sent_once_and_named_by_its_content(self):
        service = self.serve()
        (self.here / "m.csv").write_text("a motion")
        (self.here / "scene.json").write_text('{"name": "shaken", "fem": {"motion": {"file": "m.csv"}}}')
        (self.here / "study.json").write_text(json.dumps({"name": "shaken", "scene": "scene.json", "variants": [
            {"name": "a", "overrides": ["/fem/motion/file=m.csv", "/fem/msh_file=/only/there.msh"]}]}))
        reference = f"file:sha256/{hashlib.sha256(b'a motion').hexdigest()}.csv"
        for uploads in (1, 1):
            done = call(service, "submit", self.here / "study.json")
            self.assertEqual((done.returncode, done.stdout), (0, run_id + "\n"), done.stderr)
            study = service.posted[-1][1]
            self.assertEqual(study["scene"]["fem"]["motion"]["file"], reference)
            self.assertEqual(study["variants"][0]["overrides"], [f"/fem/motion/file={reference}", "/fem/msh_file=/only/there.msh"])
            self.assertEqual(len(service.files), uploads)
        self.assertEqual(service.uploads, 2, "one broke off, one came through; the second study needed none")

    def test_quiet_says_nothing_beside_what_was_asked_for(self):
        done = call(self.serve(end="questionable"), "submit", self.study(), "--watch", "--quiet")
        self.assertEqual((done.returncode, len(done.stdout.splitlines()), done.stderr), (0, 2, ""))

    def test_submit_can_watch(self):
        done = call(self.serve(end="failed"), "submit", self.study(), "--watch")
        self.assertEqual(done.returncode, 70)
        self.assertTrue(done.stdout.startswith(run_id + "\n"))

    def test_results(self):
        service = self.serve(looks=0)
        self.assertIn("0.5  succeeded        12.5\n", call(service, "results", run_id).stdout)
        self.assertEqual(call(service, "results", run_id, "--csv").stdout, "transfer_time,runout\n0.5,12.5\n")
        self.assertEqual(json.loads(call(service, "results", run_id, "--json").stdout)["rows"][0]["runout"], 12.5)
        self.assertEqual(call(self.serve(end="failed", looks=0), "results", run_id).returncode, 70)

    def test_telemetry_comes_whole_though_the_server_gives_parts(self):
        service = self.serve()
        done = call(service, "telemetry", run_id, "mpm_solver", "--transfer-time", "0.5", "--json")
        self.assertEqual([json.loads(each)["kinetic_energy"] for each in done.stdout.splitlines()], [0, 2, 4, 6, 8])
        self.assertIn("transfer_time=0.5", service.asked[-1])
        call(service, "telemetry", run_id, "mpm_solver", "--variant", "soft", "--json")
        self.assertIn("variant=soft", service.asked[-1])
        csv = call(service, "telemetry", run_id, "mpm_solver", "--csv").stdout.splitlines()
        self.assertEqual((csv[0], csv[2]), ("kinetic_energy,time", "2.0,0.1"))

    def test_logs(self):
        service = self.serve()
        whole = fake_service.log.decode()
        self.assertEqual(call(service, "logs", f"{run_id}-00001").stdout, whole)
        self.assertEqual(call(service, "logs", "-n", "2", f"{run_id}-00001").stdout, "line 4\nline 5\n")
        self.assertEqual(call(service, "logs", f"{run_id}-00002").returncode, 65)
        service.looks_left = 0
        self.assertEqual(call(service, "logs", "-f", f"{run_id}-00001").stdout, whole)

    def test_cancel(self):
        done = call(self.serve(), "cancel", run_id)
        self.assertEqual((done.returncode, "cancelled" in done.stdout), (0, True))

    def test_plan_takes_scenes_and_studies(self):
        service = self.serve()
        self.study()
        self.assertIn("the scene is dry", call(service, "plan", self.here / "scene.json").stdout)
        study = pathlib.Path(os.environ["BREACH_ROOT"]) / "workflows/studies/slope_sweep.json"
        self.assertIn("the scene is dry", call(service, "plan", study).stdout)
        self.assertEqual(service.posted[-1][1]["format"], "breachline-scene/1")

    def test_draw_needs_no_server(self):
        scenes = pathlib.Path(os.environ["BREACH_ROOT"]) / "workflows/scenes"
        picture = self.here / "section.svg"
        nowhere = "http://127.0.0.1:9"
        done = call(nowhere, "draw", scenes / "mochikoshi.json", "--output", picture)
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stderr, r"^warning: /mpm/cell_size: only 4\.42 cells [^\n]*\nwarning: [^\n]*: bands of shear [^\n]*\n$")
        root = xml.etree.ElementTree.parse(picture).getroot()
        regions = [each.get("data-region") for each in root.iter() if each.get("class") == "region"]
        self.assertEqual(regions, ["foundation", "tailings", "lower_dam", "upper_dam"])
        for phase in ("lem_tool: ", "fem_solver: ", "transfer_tool: ", "mpm_solver: ", "All: "):
            self.assertIn(f"\n{phase}", "\n" + done.stdout)
            self.assertIn(phase, "".join(root.itertext()))
        alone = call(nowhere, "draw", scenes / "slope.json", "--set", "/mpm/cell_size=0.5", "--json")
        self.assertEqual([each["phase"] for each in json.loads(alone.stdout)["phases"]],
                         ["lem_tool", "fem_solver", "transfer_tool", "mpm_solver"])

    def test_draw_takes_a_study_and_marks_what_is_wrong(self):
        scenes = pathlib.Path(os.environ["BREACH_ROOT"]) / "workflows/scenes"
        picture, study = self.here / "section.svg", self.here / "study.json"
        (self.here / "dam.json").write_text((scenes / "slope.json").read_text())
        study.write_text(json.dumps({"name": "s", "scene": "dam.json", "transfer_times": [0.5, 1, 1.5, 2]}))
        done = call("http://127.0.0.1:9", "draw", study, "--output", picture)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("All, 1 fem_solver, 1 lem_tool, 4 mpm_solver, 4 transfer_tool: ", done.stdout)
        done = call("http://127.0.0.1:9", "draw", study, "--output", picture, "--set", "/fem/crest=[70,12]")
        self.assertEqual((done.returncode, done.stdout), (65, ""))
        self.assertIn("/scene/fem/crest: ", done.stderr)
        marked = [each.get("data-pointer") for each in xml.etree.ElementTree.parse(picture).getroot().iter()
                  if each.get("class") == "fault"]
        self.assertEqual(set(marked), {"/scene/fem/crest"})

    def test_draw_meshes_once(self):
        scene = pathlib.Path(os.environ["BREACH_ROOT"]) / "workflows/scenes/slope.json"
        picture, caches = self.here / "section.svg", self.here / "caches"
        made = []
        for _ in range(2):
            done = call("http://127.0.0.1:9", "draw", scene, "--mesh", "--output", picture, XDG_CACHE_HOME=str(caches))
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("mesh of 1215 elements, 1327 nodes", picture.read_text())
            self.assertIn("1,215 elements", done.stdout)
            made.append([(file.name, file.stat().st_mtime_ns) for file in (caches / "breachline/meshes").iterdir()])
        self.assertEqual(len(made[0]), 1)
        self.assertEqual(made[0], made[1])
        other = call("http://127.0.0.1:9", "draw", scene, "--mesh", "--set", "/section/regions/1/mesh/divisions=[45,16]",
                     XDG_CACHE_HOME=str(caches))
        self.assertEqual(other.returncode, 0, other.stderr)
        self.assertEqual(len(list((caches / "breachline/meshes").iterdir())), 2)

    def test_import_makes_a_scene_that_draw_takes(self):
        (self.here / "m.json").write_text(json.dumps({"materials": {"clay": {"density": 2000, "law": {
            "type": "mohr_coulomb", "E_MPa": 40, "nu": 0.3, "c_kPa": 5, "phi_deg": 30}}}}))
        drawing, scene, picture = self.here / "dam.csv", self.here / "new/folder/dam.json", self.here / "drawn/dam.svg"
        drawing.write_text("region,x,y\nclay,0,0\nclay,40,0\nclay,20,8\nclay,0,8\n\nbase,0,-3\nbase,40,-3\n"
                           "base,40,0.02\nbase,0,0\n")
        wishes = ["import", drawing, "--materials", self.here / "m.json", "--output", scene, "--draw", picture]
        nowhere = "http://127.0.0.1:9"
        refused = call(nowhere, *wishes)
        self.assertEqual(refused.returncode, 65)
        self.assertIn("line 7: layer base has no material", refused.stderr)
        self.assertFalse(scene.exists())
        self.assertIn('class="fault"', picture.read_text())
        done = call(nowhere, *wishes, "--map", "base=clay")
        self.assertEqual((done.returncode, done.stdout), (0, f"{scene}\n"), done.stderr)
        self.assertIn("at (40, 0), 0.02 m: base, clay", done.stderr)
        self.assertIn("guessed: /lem/search/entry", done.stderr)
        self.assertIn("read in m (metres, as nothing says otherwise): the section is 40 m long and 11 m high", done.stderr)
        self.assertNotIn('class="fault"', picture.read_text())
        self.assertEqual(call(nowhere, "draw", scene).returncode, 0)
        report = json.loads(call(nowhere, *wishes, "--map", "base=clay", "--json").stdout)
        self.assertEqual(report["healed"][0]["size"], 0.02)
        self.assertEqual((report["unit"], report["unit_from"], report["size"]), ("m", "default", [40, 11]))
        self.assertEqual(call(nowhere, *wishes[:-2], "--phreatic", self.here / "none.csv").returncode, 74)
        low = [*wishes, "--map", "base=clay", "--unit", "in"]
        refused = call(nowhere, *low)
        self.assertEqual(refused.returncode, 65)
        self.assertIn("the slope is 0.203 m high only, read in in; the section would be 40 m by 11 m in m", refused.stderr)
        self.assertIn("confirm it with --yes", refused.stderr)
        self.assertEqual(call(nowhere, *low, "--yes").returncode, 0)

    def test_draw_of_nothing_is_65_and_leaves_no_picture(self):
        for text in ("{", "[]", '{"name": "a scene"}'):
            (self.here / "scene.json").write_text(text)
            done = call("http://127.0.0.1:9", "draw", self.here / "scene.json", "--output", self.here / "none.svg")
            self.assertEqual((done.returncode, done.stdout), (65, ""), text)
            self.assertFalse((self.here / "none.svg").exists())
        self.assertEqual(call("http://127.0.0.1:9", "draw", self.here / "nobody.json").returncode, 74)

    def test_export_holds_everything_verified(self):
        service, out = self.serve(looks=0), self.here / "out"
        done = call(service, "export", run_id, out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((out / "tasks/fem_solver/snapshots/snapshot_0.500000.vtkhdf").read_bytes(), fake_service.artifact)
        self.assertEqual((out / "tasks/mpm_0.500000/log.1.txt").read_bytes(), fake_service.log)
        # Again: complete files are not fetched again.
        service.asked.clear()
        (out / "tasks/mpm_0.500000/result.json").write_text("damaged")
        self.assertEqual(call(service, "export", run_id, out).returncode, 0)
        self.assertEqual(sum("artifacts" in each for each in service.asked), 1)
        self.assertEqual((out / "tasks/mpm_0.500000/result.json").read_bytes(), fake_service.result)

    def test_export_keeps_no_file_that_is_not_what_was_promised(self):
        out = self.here / "out"
        done = call(self.serve(looks=0, lies=True), "export", run_id, out)
        self.assertEqual(done.returncode, 74)
        self.assertIn("its SHA-256 is", done.stderr)
        self.assertFalse(list(out.rglob("*.vtkhdf*")))

    def test_export_does_not_mix_with_other_files(self):
        (self.here / "mine").write_text("x")
        done = call(self.serve(), "export", run_id, self.here)
        self.assertEqual((done.returncode, "holds something else" in done.stderr), (74, True))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
