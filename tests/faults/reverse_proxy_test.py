"""nginx with TLS in front of the service, configured as docs/how-to/reverse_proxy.md says: the page, submissions, large bodies and
events as they happen all pass through; slow clients, too many requests and too many connections do not. An nginx of its
own, in a folder of its own."""
import concurrent.futures
import contextlib
import http.client
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
import unittest
import urllib.error
import urllib.request

from service import Service, programs, root, study, until

nginx = shutil.which("nginx", path=os.environ["PATH"] + ":/usr/sbin")


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Proxy:
    """An nginx with the configuration of the page; `changes`: other values for entries that must exist in it."""

    def __init__(self, here, service, **changes):
        self.port = free_port()
        self.log = here / "error.log"
        server, below = re.findall(r"```nginx\n(.*?)```", (root / "docs/how-to/reverse_proxy.md").read_text(), re.S)
        server = server[:server.rindex("    }")] + below + "    }\n"
        for old, new in (("listen 443 ssl", f"listen 127.0.0.1:{self.port} ssl"), ("8470", str(service.port)),
                         ("/etc/ssl/dams.example.org.pem", str(here.parent / "cert.pem")),
                         ("/etc/ssl/dams.example.org.key", str(here.parent / "key.pem")), ("dams.example.org", "localhost"),
                         *changes.values()):
            assert old in server, old
            server = server.replace(old, new)
        here.mkdir()
        here.chmod(0o711)  # nginx's workers are another user where the test runs as root
        (here / "nginx.conf").write_text((root / "tests/faults/nginx.conf").read_text().replace("@server@", server))
        self.process = subprocess.Popen([nginx, "-p", str(here), "-e", "error.log", "-c", "nginx.conf"], stderr=subprocess.DEVNULL)
        self.url = f"https://localhost:{self.port}"
        self.trust = ssl.create_default_context(cafile=here.parent / "cert.pem")
        until(lambda: self.ask("/healthz")[0] == 200)

    def end(self):
        self.process.terminate()
        self.process.wait(30)

    def ask(self, path, body=None, token="", **headers):
        headers = {"Content-Type": "application/json", **({"Authorization": "Bearer " + token} if token else {}), **headers}
        data = None if body is None else body if isinstance(body, bytes) else json.dumps(body).encode()
        try:
            with urllib.request.urlopen(urllib.request.Request(self.url + path, data, headers), timeout=60,
                                        context=self.trust) as answer:
                return answer.status, answer.headers, answer.read()
        except urllib.error.HTTPError as error:
            return error.code, error.headers, error.read()
        except OSError:
            return 0, {}, b""

    def connect(self, text=b"", buffer=None):
        plain = socket.socket()
        if buffer:
            plain.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, buffer)
        plain.settimeout(30)
        plain.connect(("127.0.0.1", self.port))
        connection = self.trust.wrap_socket(plain, server_hostname="localhost")
        connection.sendall(text)
        return connection

    def status_from(self, address):
        connection = http.client.HTTPSConnection("localhost", self.port, timeout=30, context=self.trust,
                                                 source_address=(address, 0))
        with contextlib.closing(connection):
            connection.request("GET", "/healthz")
            return connection.getresponse().status


class ReverseProxy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        here = cls.here = pathlib.Path(cls.folder.name)
        here.chmod(0o711)
        subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-keyout",
                        "key.pem", "-out", "cert.pem", "-days", "2", "-subj", "/CN=localhost", "-addext",
                        "subjectAltName=DNS:localhost"], cwd=here, check=True, capture_output=True)
        made = subprocess.run([programs / "breachline", "token", "new", "anna", "--rights", "submit", "--file", here / "tokens"],
                              capture_output=True, text=True, check=True)
        cls.secret = made.stdout.strip()
        (here / "token").write_text(cls.secret)
        cls.service = Service(here, "--tokens", here / "tokens")
        cls.proxy = Proxy(here / "as_documented", cls.service)

    @classmethod
    def tearDownClass(cls):
        cls.proxy.end()
        cls.service.__exit__()
        cls.folder.cleanup()

    def ask(self, path, body=None, **headers):
        return self.proxy.ask(path, body, self.secret, **headers)

    def other_proxy(self, name, **changes):
        proxy = Proxy(self.here / name, self.service, **changes)
        self.addCleanup(proxy.end)
        return proxy

    def stream_request(self, port):
        return (b"GET /v1/events HTTP/1.1\r\nHost: localhost:%d\r\nAccept: text/event-stream\r\nAuthorization: Bearer %s\r\n\r\n"
                % (port, self.secret.encode()))

    def test_page_and_submission_pass(self):
        self.assertIn(b"<!doctype html>", self.ask("/")[2].lower())
        status, _, body = self.ask("/v1/runs", study(), Origin=self.proxy.url)
        self.assertEqual((status, json.loads(body)["submitted_by"]), (202, "anna"))
        self.assertEqual(self.ask("/v1/runs", study(), Origin="https://evil.example")[0], 403)
        self.assertEqual(self.proxy.ask("/v1/runs")[0], 401)
        for prefix in ("", "/breachline"):
            done = subprocess.run([programs / "breach", "--server", self.proxy.url + prefix, "--tls-ca", self.here / "cert.pem",
                                   "--token-file", self.here / "token", "list"], capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("fault", done.stdout)

    def test_a_large_file_passes_and_one_too_large_is_a_problem(self):
        record = b"".join(b"%.3f 0.1\n" % (0.001 * i) for i in range(400000))
        self.assertGreater(len(record), 4 << 20)
        for prefix in ("", "/breachline"):
            status, _, body = self.ask(prefix + "/v1/files?name=record.txt", record, **{"Content-Type": "application/octet-stream"})
            self.assertIn(status, (200, 201), body)
            status, headers, _ = self.ask(prefix + "/v1/runs", b" " * (17 << 20))
            self.assertEqual((status, headers["Content-Type"]), (413, "application/problem+json"))

    def test_events_pass_as_they_happen(self):
        with self.proxy.connect(self.stream_request(self.proxy.port)) as wire:
            seen = b""
            while b"retry: 2000" not in seen:
                seen += wire.recv(65536)
            run = json.loads(self.ask("/v1/runs", study())[2])["id"]
            while run.encode() not in seen:  # otherwise times out: nginx would hold back 4 kB and more
                part = wire.recv(65536)
                self.assertTrue(part)
                seen += part

    def test_slow_clients_are_cut_off(self):
        proxy = self.other_proxy("impatient", head=("client_header_timeout 10s", "client_header_timeout 1s"),
                                 body=("client_body_timeout 10s", "client_body_timeout 1s"),
                                 answer=("send_timeout 10s", "send_timeout 1s"))
        with proxy.connect() as connection:
            self.assertLess(sent_before_the_end(connection, b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n" * 20), 400)
        for path in (b"/v1/runs", b"/v1/files?name=record.txt"):
            head = b"POST %s HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer %s\r\nContent-Length: 100000\r\n\r\n{"
            with proxy.connect(head % (path, self.secret.encode())) as connection:
                self.assertIn(connection.recv(4096)[9:12], (b"408", b""), path)
        with proxy.connect(b"GET /openapi.json HTTP/1.1\r\nHost: localhost\r\n\r\n" * 200, buffer=4096):  # more than buffers hold
            until(lambda: re.search("client timed out.*while sending", proxy.log.read_text()))

    def test_too_many_requests_of_one_address_get_429(self):
        proxy = self.other_proxy("few_requests", rate=("rate=200r/s", "rate=1r/s"), burst=("burst=1000 delay=400", "burst=5 delay=2"))
        with concurrent.futures.ThreadPoolExecutor(30) as clients:
            statuses = list(clients.map(lambda _: proxy.ask("/healthz")[0], range(30)))
        self.assertEqual(set(statuses), {200, 429})
        self.assertEqual(proxy.status_from("127.0.0.2"), 200, "another address has a count of its own")

    def test_too_many_connections_of_one_address_get_429(self):
        proxy = self.other_proxy("few_connections", most=("limit_conn breachline_connections 64", "limit_conn breachline_connections 3"))
        streams = [proxy.connect(self.stream_request(proxy.port)) for _ in range(3)]
        self.assertEqual({each.recv(4096)[9:12] for each in streams}, {b"200"})
        self.assertEqual(proxy.ask("/healthz")[0], 429)
        self.assertEqual(proxy.status_from("127.0.0.2"), 200, "another address has a count of its own")
        for each in streams:
            each.close()
        until(lambda: proxy.ask("/healthz")[0] == 200)


def sent_before_the_end(connection, text):
    """Number of its bytes sent, one by one, until the other side closes the connection."""
    connection.settimeout(0.1)
    for sent in range(len(text)):
        try:
            connection.sendall(text[sent:sent + 1])
            if connection.recv(4096) == b"":
                return sent
        except TimeoutError:
            pass
        except OSError:
            return sent
    return len(text)


if __name__ == "__main__":
    if not nginx:
        print("skipped: nginx is not installed (nginx-light)")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
