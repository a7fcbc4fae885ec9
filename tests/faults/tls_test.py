"""The command line and the Python package use https with a proxy in front of the service: they accept the right certificate and
refuse every other, with a remedy."""
import contextlib
import http.server
import json
import os
import pathlib
import ssl
import subprocess
import sys
import tempfile
import threading
import unittest

from service import Service, programs, root


class PassesOn(http.server.BaseHTTPRequestHandler):
    def do_GET(self):
        status, _, answer = self.server.service.ask(self.path)
        text = json.dumps(answer).encode()
        self.send_response(status)
        self.send_header("Content-Type", "application/json")
        self.send_header("Content-Length", str(len(text)))
        self.end_headers()
        self.wfile.write(text)

    def log_message(self, *_):
        pass


class Tls(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.here = pathlib.Path(cls.folder.name)
        cls.openssl("req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-keyout", "ca.key",
                    "-out", "ca.pem", "-days", "30", "-subj", "/CN=test authority")
        cls.certificate("good", "IP:127.0.0.1,DNS:localhost")
        cls.certificate("other_name", "DNS:elsewhere.example")
        cls.certificate("expired", "IP:127.0.0.1,DNS:localhost", "-days", "-1")
        cls.service = Service(cls.here)

    @classmethod
    def tearDownClass(cls):
        cls.service.__exit__()
        cls.folder.cleanup()

    @classmethod
    def openssl(cls, *arguments):
        subprocess.run(["openssl", *arguments], cwd=cls.here, check=True, capture_output=True)

    @classmethod
    def certificate(cls, name, names, *days):
        cls.openssl("req", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-keyout", f"{name}.key", "-out",
                    f"{name}.csr", "-subj", "/CN=" + name)
        (cls.here / "names").write_text("subjectAltName=" + names)
        cls.openssl("x509", "-req", "-in", f"{name}.csr", "-CA", "ca.pem", "-CAkey", "ca.key", "-CAcreateserial", "-extfile",
                    "names", "-out", f"{name}.pem", *(days or ("-days", "30")))

    @contextlib.contextmanager
    def serve(self, name="good"):
        """Starts an https server with this certificate in front of the service, like nginx; returns its port."""
        front = http.server.ThreadingHTTPServer(("127.0.0.1", 0), PassesOn)
        front.service = self.service
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        context.load_cert_chain(self.here / f"{name}.pem", self.here / f"{name}.key")
        front.socket = context.wrap_socket(front.socket, server_side=True)
        serving = threading.Thread(target=front.serve_forever)
        serving.start()
        try:
            yield front.server_port
        finally:
            front.shutdown()
            serving.join()
            front.server_close()

    def breach(self, port, code, ca="ca.pem", host="127.0.0.1"):
        environment = {**os.environ, **({"BREACH_TLS_CA": str(self.here / ca)} if ca else {})}
        done = subprocess.run([programs / "breach", "--server", f"https://{host}:{port}", "list"], text=True,
                              capture_output=True, env=environment, timeout=60)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stderr

    def python(self, port, ca="ca.pem"):
        environment = {**os.environ, "PYTHONPATH": str(root / "services/python"),
                       **({"BREACH_TLS_CA": str(self.here / ca)} if ca else {})}
        code = ("import breachline\ntry:\n    print(len(breachline.runs()))\nexcept breachline.BreachlineError as fault:\n"
                "    print('refused:', fault)\n")
        done = subprocess.run([sys.executable, "-c", code], text=True, capture_output=True, timeout=60,
                              env={**environment, "BREACH_SERVER": f"https://127.0.0.1:{port}"})
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_the_right_certificate_is_taken(self):
        with self.serve() as port:
            self.breach(port, 0)
            self.breach(port, 0, host="localhost")
            self.assertEqual(self.python(port).strip(), "0")

    def test_an_unknown_authority_is_refused(self):
        with self.serve() as port:
            self.assertIn("--tls-ca", self.breach(port, 74, ca=None))
            self.assertIn("BREACH_TLS_CA", self.python(port, ca=None))
            self.assertIn("--tls-ca", self.breach(port, 74, ca="absent.pem"))
            self.assertIn("BREACH_TLS_CA", self.python(port, ca="absent.pem"))
            self.assertIn("--tls-ca", self.breach(port, 74, ca="good.key"))

    def test_a_wrong_name_and_an_expired_certificate_are_refused(self):
        with self.serve("other_name") as port:
            self.assertIn("another name", self.breach(port, 74))
            self.assertIn("refused", self.python(port))
        with self.serve("expired") as port:
            self.assertIn("expired", self.breach(port, 74))
            self.assertIn("expired", self.python(port))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
