"""A service over TLS with certificates that the test makes: the command line and the Python package take the right one and
refuse every other, each with what to do; a renewed certificate counts without a restart; one that cannot be used keeps the
service from starting."""
import os
import pathlib
import socket
import ssl
import subprocess
import sys
import tempfile
import unittest

from service import Service, programs, refusal_to_start, root, until


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
        cls.certificate("renewed", "IP:127.0.0.1,DNS:localhost")

    @classmethod
    def tearDownClass(cls):
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

    def serve(self, name="good"):
        return Service(tempfile.mkdtemp(dir=self.here), "--tls-cert", self.here / f"{name}.pem", "--tls-key",
                       self.here / f"{name}.key")

    def breach(self, service, code, ca="ca.pem", host="127.0.0.1"):
        environment = {**os.environ, **({"BREACH_TLS_CA": str(self.here / ca)} if ca else {})}
        done = subprocess.run([programs / "breach", "--server", f"https://{host}:{service.port}", "list"], text=True,
                              capture_output=True, env=environment, timeout=60)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stderr

    def python(self, service, ca="ca.pem"):
        environment = {**os.environ, "PYTHONPATH": str(root / "services/python"),
                       **({"BREACH_TLS_CA": str(self.here / ca)} if ca else {})}
        code = ("import breachline\ntry:\n    print(breachline.runs())\nexcept breachline.BreachlineError as fault:\n"
                "    print('refused:', fault)\n")
        done = subprocess.run([sys.executable, "-c", code], text=True, capture_output=True, timeout=60,
                              env={**environment, "BREACH_SERVER": f"https://127.0.0.1:{service.port}"})
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_the_right_certificate_is_taken(self):
        with self.serve() as service:
            self.breach(service, 0)
            self.breach(service, 0, host="localhost")
            self.assertEqual(self.python(service).strip(), "[]")

    def test_an_unknown_authority_is_refused(self):
        with self.serve() as service:
            self.assertIn("--tls-ca", self.breach(service, 74, ca=None))
            self.assertIn("BREACH_TLS_CA", self.python(service, ca=None))
            self.assertIn("--tls-ca", self.breach(service, 74, ca="absent.pem"))
            self.assertIn("BREACH_TLS_CA", self.python(service, ca="absent.pem"))
            self.assertIn("--tls-ca", self.breach(service, 74, ca="good.key"))

    def test_a_wrong_name_and_an_expired_certificate_are_refused(self):
        with self.serve("other_name") as service:
            self.assertIn("another name", self.breach(service, 74))
            self.assertIn("refused", self.python(service))
        with self.serve("expired") as service:
            self.assertIn("expired", self.breach(service, 74))
            self.assertIn("expired", self.python(service))

    def served(self, port):
        context = ssl.create_default_context(cafile=self.here / "ca.pem")
        with socket.create_connection(("127.0.0.1", port), timeout=10) as plain:
            with context.wrap_socket(plain, server_hostname="127.0.0.1") as wire:
                return dict(each[0] for each in wire.getpeercert()["subject"])["commonName"]

    def test_a_renewed_certificate_counts_and_half_a_renewal_does_not(self):
        def put(name, ending):
            (self.here / "now.new").write_bytes((self.here / f"{name}.{ending}").read_bytes())
            os.replace(self.here / "now.new", self.here / f"now.{ending}")
        put("good", "pem"), put("good", "key")
        with self.serve("now") as service:
            self.assertEqual(self.served(service.port), "good")
            put("renewed", "pem")  # the key is still the old one's
            for _ in range(3):
                self.assertEqual(self.served(service.port), "good")
            put("renewed", "key")
            until(lambda: self.served(service.port) == "renewed")

    def test_what_cannot_be_used_keeps_the_service_from_starting(self):
        (self.here / "torn.pem").write_text("-----BEGIN CERTIFICATE-----\n")
        self.openssl("ec", "-in", "good.key", "-aes256", "-passout", "pass:secret", "-out", "locked.key")
        for certificate, key, said in (("absent.pem", "good.key", "absent.pem"), ("torn.pem", "good.key", "torn.pem"),
                                       ("good.pem", "renewed.key", "renewed.key is not the key"),
                                       ("good.pem", "absent.key", "absent.key"), ("good.pem", "good.pem", "holds no usable key"),
                                       ("good.pem", "locked.key", "password"), ("good.pem", None, "--tls-key")):
            arguments = ["--tls-cert", self.here / certificate] + (["--tls-key", self.here / key] if key else [])
            code, told = refusal_to_start(self.here, *arguments)
            self.assertEqual(code, 2, told)
            self.assertIn(said, told)

    def test_plain_http_and_old_protocols_get_nothing_and_hurt_nobody(self):
        with self.serve() as service:
            with service.connect(b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n") as plain:
                self.assertNotIn(b"200", plain.recv(4096))
            old = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
            old.check_hostname, old.verify_mode = False, ssl.CERT_NONE
            old.set_ciphers("ALL:@SECLEVEL=0")
            old.minimum_version = old.maximum_version = ssl.TLSVersion.TLSv1_1
            with service.connect() as plain, self.assertRaises(OSError):
                old.wrap_socket(plain)
            self.breach(service, 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
