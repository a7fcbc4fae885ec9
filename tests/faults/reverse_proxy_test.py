"""nginx with TLS in front of the service, configured as docs/reverse_proxy.md says: the page, submissions, large bodies,
events as they happen, and who asks, all pass through. An nginx of its own, in a folder of its own."""
import json
import os
import pathlib
import re
import shutil
import socket
import ssl
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.error
import urllib.request

from service import Service, programs, root, study, until

nginx = shutil.which("nginx", path=os.environ["PATH"] + ":/usr/sbin")


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class ReverseProxy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        here = cls.here = pathlib.Path(cls.folder.name)
        subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-keyout",
                        "key.pem", "-out", "cert.pem", "-days", "2", "-subj", "/CN=localhost", "-addext",
                        "subjectAltName=DNS:localhost"], cwd=here, check=True, capture_output=True)
        made = subprocess.run([programs / "breachline", "token", "new", "anna", "--rights", "submit", "--file", here / "tokens"],
                              capture_output=True, text=True, check=True)
        cls.secret = made.stdout.strip()
        (here / "token").write_text(cls.secret)
        cls.service = Service(here, "--tokens", here / "tokens", "--behind-proxy", "--address-limit", "5")
        cls.port = free_port()
        page = (root / "docs/reverse_proxy.md").read_text()
        server = re.search(r"```nginx\n(.*?)```", page, re.S)[1]
        below = server[server.index("        location / {"):server.rindex("    }")]
        below = below.replace("location / {", "location /breachline/ {").replace(":8470;", ":8470/;")
        server = server[:server.rindex("    }")] + below + "    }\n"
        for old, new in (("listen 443 ssl", f"listen 127.0.0.1:{cls.port} ssl"), ("8470", str(cls.service.port)),
                         ("/etc/ssl/dams.example.org.pem", str(here / "cert.pem")),
                         ("/etc/ssl/dams.example.org.key", str(here / "key.pem")), ("dams.example.org", "localhost")):
            assert old in server, old
            server = server.replace(old, new)
        frame = (root / "tests/faults/nginx.conf").read_text()
        (here / "nginx.conf").write_text(frame.replace("@server@", server))
        cls.proxy = subprocess.Popen([nginx, "-p", str(here), "-e", "error.log", "-c", "nginx.conf"], stderr=subprocess.DEVNULL)
        cls.url = f"https://localhost:{cls.port}"
        cls.trust = ssl.create_default_context(cafile=here / "cert.pem")
        until(lambda: cls.ask("/healthz")[0] == 200)

    @classmethod
    def tearDownClass(cls):
        cls.proxy.terminate()
        cls.proxy.wait(30)
        cls.service.__exit__()
        cls.folder.cleanup()

    @classmethod
    def ask(cls, path, body=None, token=True, **headers):
        headers = {"Content-Type": "application/json", **({"Authorization": "Bearer " + cls.secret} if token else {}), **headers}
        data = None if body is None else body if isinstance(body, bytes) else json.dumps(body).encode()
        try:
            with urllib.request.urlopen(urllib.request.Request(cls.url + path, data, headers), timeout=60,
                                        context=cls.trust) as answer:
                return answer.status, answer.headers, answer.read()
        except urllib.error.HTTPError as error:
            return error.code, error.headers, error.read()
        except OSError:
            return 0, {}, b""

    def test_1_page_and_submission_pass(self):
        self.assertIn(b"<!doctype html>", self.ask("/")[2].lower())
        status, _, body = self.ask("/v1/runs", study(), Origin=self.url)
        self.assertEqual((status, json.loads(body)["submitted_by"]), (202, "anna"))
        self.assertEqual(self.ask("/v1/runs", study(), Origin="https://evil.example")[0], 403)
        for prefix in ("", "/breachline"):
            done = subprocess.run([programs / "breach", "--server", self.url + prefix, "--tls-ca", self.here / "cert.pem",
                                   "--token-file", self.here / "token", "list"], capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("fault", done.stdout)

    def test_2_a_large_file_passes_and_one_too_large_is_a_problem(self):
        record = b"".join(b"%.3f 0.1\n" % (0.001 * i) for i in range(400000))
        self.assertGreater(len(record), 4 << 20)
        status, _, body = self.ask("/v1/files?name=record.txt", record, **{"Content-Type": "application/octet-stream"})
        self.assertEqual(status, 201, body)
        status, headers, _ = self.ask("/v1/runs", b" " * (17 << 20))
        self.assertEqual((status, headers["Content-Type"]), (413, "application/problem+json"))

    def test_3_events_pass_as_they_happen(self):
        with socket.create_connection(("localhost", self.port), timeout=30) as plain:
            with self.trust.wrap_socket(plain, server_hostname="localhost") as wire:
                wire.sendall(b"GET /v1/events HTTP/1.1\r\nHost: localhost:%d\r\nAccept: text/event-stream\r\n"
                             b"Authorization: Bearer %s\r\n\r\n" % (self.port, self.secret.encode()))
                seen = b""
                while b"retry: 2000" not in seen:
                    seen += wire.recv(65536)
                run = json.loads(self.ask("/v1/runs", study())[2])["id"]
                while run.encode() not in seen:  # or it times out: nginx would hold 4 kB back and more
                    part = wire.recv(65536)
                    self.assertTrue(part)
                    seen += part

    def test_4_the_limit_counts_who_asks_not_the_proxy(self):
        # The proxy says who asks: what a client claims of itself does not get it another count.
        statuses = [self.ask("/v1/runs", token=False, **{"X-Forwarded-For": f"10.0.0.{i}"})[0] for i in range(40)]
        self.assertIn(429, statuses)
        self.assertEqual(self.ask("/v1/runs")[0], 200, "a token has a count of its own")
        # Others behind the same proxy, as its header tells them, are not put off by that.
        elsewhere = self.service.ask("/v1/runs", **{"X-Forwarded-For": "192.0.2.7"})[0]
        self.assertEqual(elsewhere, 401)


if __name__ == "__main__":
    if not nginx:
        print("skipped: nginx is not installed (nginx-light)")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
