"""Hostile requests: unlimited JSON, paths outside, slow clients. Each is refused with a problem, and the service answers the
next one normally."""
import json
import pathlib
import sys
import tempfile
import time
import unittest

from service import Service, study


class Extremes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        here = pathlib.Path(cls.folder.name)
        (here / "secret").write_text("secret")
        (here / "web").mkdir()
        (here / "web/index.html").write_text("<p>page</p>")
        (here / "web/out.txt").symlink_to(here / "secret")
        (here / "web/up").symlink_to(here)
        cls.service = Service(here, "--web", here / "web")
        cls.run_id = cls.service.submit(study())
        cls.service.wait_for_end(cls.run_id)

    @classmethod
    def tearDownClass(cls):
        cls.service.__exit__()
        cls.folder.cleanup()

    def tearDown(self):
        self.assertEqual(self.service.ask("/readyz")[0], 200)

    def test_json_without_measure_is_refused_with_its_faults(self):
        whole = json.dumps(study())
        cases = {
            "deep array": "[" * 200000,
            "deep object": '{"a":' * 100000,
            "duplicate key": whole[:-1] + ', "name": "again"}',
            "duplicate key inside": whole.replace('"title": ""', '"title": "", "title": "x"', 1),
            "too large a number": whole.replace("[0.5]", "[1e400]"),
            "not a number": whole.replace("[0.5]", "[NaN]"),
            "infinite": whole.replace("[0.5]", "[Infinity]"),
            "half a surrogate": whole.replace('"title": ""', '"title": "\\ud800"', 1),
            "huge array": whole.replace("[0.5]", json.dumps([i * 1e-6 for i in range(300000)])),
            "long text for a number": whole.replace("[0.5]", '["' + "9" * 100000 + '"]'),
            "torn": whole[: len(whole) // 2],
            "empty": "",
        }
        for what, text in cases.items():
            with self.subTest(what):
                status, _, body = self.service.ask("/v1/runs", text.encode())
                self.assertEqual(status, 422, body)
                self.assertTrue(body["faults"], what)
        for text in (b'{"name": "\xff\xfe"}', b"\xef\xbb\xbf\x00\x01", bytes(range(256))):
            self.assertEqual(self.service.ask("/v1/runs", text)[0], 422)
        self.assertEqual(self.service.ask("/v1/runs", b" " * (17 << 20))[0], 413)
        self.assertEqual(len(self.service.ask("/v1/runs")[2]["runs"]), 1, "none of them made a run")

    def test_paths_that_lead_elsewhere_are_not_followed(self):
        task = f"{self.run_id}-00000"
        ups = ("..", "%2e%2e", "%2E%2e", "..%2f..", "..%5c..", ".%2e", "....//", "%252e%252e", "..;", "%c0%ae%c0%ae")
        for up in ups:
            for path in (f"/static/{up}/secret", f"/static/{up}/{up}/secret", f"/v1/tasks/{task}/frames/{up}%2fsecret/points",
                         f"/v1/artifacts/{up}%2fsecret", f"/v1/runs/{up}", f"/v1/examples/{up}%2fsecret"):
                self.assertIn(self.raw_get(path), (400, 404), path)
        for path in ("/static/out.txt", "/static/up/secret", "/static//etc/passwd", "/static/%2fetc%2fpasswd",
                     "/static/index.html%00.js", "/static/%00", "/static/" + "a" * 4000, "/static/.hidden",
                     f"/v1/tasks/{task}%00/frames", "/v1/runs/" + "x" * 6000):
            self.assertIn(self.raw_get(path), (400, 404, 414), path[:60])

    def raw_get(self, path):
        return self.service.raw(f"GET {path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n".encode())

    def test_slow_requests_delay_no_other(self):
        head = b"POST /v1/runs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
        slow = [self.service.connect(head[: 5 + i]) for i in range(40)]  # headers without end
        slow += [self.service.connect(head + b"Content-Length: 1000\r\n\r\n{") for _ in range(40)]  # body without end
        slow += [self.service.connect() for _ in range(40)]  # connected, silent
        for _ in range(10):
            for each in slow:
                try:
                    each.sendall(b"x")
                except OSError:
                    pass  # the connection was refused
            self.assertEqual(self.service.ask("/healthz", timeout=10)[0], 200)
            time.sleep(0.05)
        for each in slow:
            each.close()

    def test_doubtful_requests_end_their_connection(self):
        cases = {
            "two lengths": b"POST /v1/runs HTTP/1.1\r\nHost: localhost\r\nContent-Length: 2\r\nContent-Length: 3\r\n\r\n{}",
            "length and chunks": b"POST /v1/runs HTTP/1.1\r\nHost: localhost\r\nContent-Length: 2\r\n"
                                 b"Transfer-Encoding: chunked\r\n\r\n0\r\n\r\n",
            "no request": b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03\r\n\r\n",
            "no version": b"GET /\r\n\r\n",
        }
        for what, text in cases.items():
            with self.subTest(what):
                self.assertIn(self.service.raw(text), (0, 400))
        many = b"".join(b"X-%d: 1\r\n" % i for i in range(100))
        self.assertEqual(self.service.raw(b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n" + many + b"\r\n"), 431)


    def test_a_body_too_large_is_refused_before_it_is_there(self):
        head = b"POST /v1/runs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: %d\r\n\r\n"
        before = self.resident_mb()
        for length in (17 << 20, 1 << 40):
            clients = [self.service.connect(head % length) for _ in range(8)]
            for each in clients:
                try:
                    for _ in range(15):
                        each.sendall(b" " * (1 << 20))
                except OSError:
                    pass
            self.assertLess(self.resident_mb() - before, 40, "8 bodies of 15 MB are not kept")
            for each in clients:
                each.close()
        with self.service.connect(head % (17 << 20)) as connection:
            connection.sendall(b" " * (17 << 20))
            self.assertIn(b" 413 ", connection.recv(4096))

    def resident_mb(self):
        status = pathlib.Path(f"/proc/{self.service.process.pid}/status").read_text()
        return int(status.split("VmRSS:")[1].split()[0]) / 1024


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
