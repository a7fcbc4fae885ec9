"""Clients that send or read too slowly are cut off, over plain connections; a body that is announced as too large is
refused and not kept; where all places are taken the next one hears so. Each by real sockets."""
import json
import pathlib
import socket
import sys
import tempfile
import threading
import time
import unittest

from service import Service, study, until

head = b"POST /v1/runs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"


def trickle(connection, text, pause):
    """Sends it byte by byte until the other side ends the connection; how many went."""
    connection.settimeout(pause)
    for sent in range(len(text)):
        try:
            connection.sendall(text[sent:sent + 1])
            if connection.recv(65536) == b"":
                return sent
        except TimeoutError:
            pass
        except OSError:
            return sent
    return len(text)


class SlowClients(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()

    def tearDown(self):
        self.folder.cleanup()

    def serve(self, *arguments):
        return Service(self.folder.name, "--patience", "0.5", *arguments)

    def resident_mb(self, service):
        status = pathlib.Path(f"/proc/{service.process.pid}/status").read_text()
        return int(status.split("VmRSS:")[1].split()[0]) / 1024

    def test_heads_and_bodies_that_trickle_are_cut_off(self):
        with self.serve() as service:
            cases = {"head": head * 20, "body": b"{" * 1000}
            begun = {"head": b"", "body": head + b"Content-Length: 100000\r\n\r\n"}
            sent = {}

            def run(what):
                with service.connect(begun[what]) as connection:
                    sent[what] = trickle(connection, cases[what], 0.1)
            clients = [threading.Thread(target=run, args=(what,)) for what in cases]
            for each in clients:
                each.start()
            for each in clients:
                each.join()
            for what, text in cases.items():
                self.assertLess(sent[what], len(text) / 2, what)
            self.assertEqual(service.ask("/v1/runs")[2]["runs"], [])

    def test_a_body_at_a_fair_pace_may_take_longer(self):
        with self.serve() as service:
            body = json.dumps(study()).encode()
            with service.connect(head + b"Content-Length: %d\r\nConnection: close\r\n\r\n" % (len(body) + 60000)) as connection:
                for part in (body, *[b" " * 10000] * 6):
                    connection.sendall(part)
                    time.sleep(0.2)
                self.assertIn(b" 202 ", connection.recv(4096))

    def test_a_new_client_may_wait_as_long_as_for_a_head(self):
        with Service(self.folder.name, "--patience", "9") as service, service.connect() as connection:
            time.sleep(6)  # a connection may rest for 5 s between two requests, and this is before the first
            connection.sendall(b"GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")
            self.assertIn(b" 200 ", connection.recv(4096))

    def test_readers_that_do_not_read_are_cut_off(self):
        with self.serve() as service:
            threads = lambda: len(open_sockets(service))
            before = threads()
            silent = socket.socket()
            silent.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            silent.connect(("127.0.0.1", service.port))
            silent.sendall(b"GET /openapi.json HTTP/1.1\r\nHost: localhost\r\n\r\n" * 200)  # far more than buffers hold
            stream = socket.socket()
            stream.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            stream.connect(("127.0.0.1", service.port))
            stream.sendall(b"GET /v1/events?after=0 HTTP/1.1\r\nHost: localhost\r\nAccept: text/event-stream\r\n\r\n")
            until(lambda: threads() >= before + 2)
            until(lambda: threads() <= before + 1)  # the silent one; the stream has nothing to be blocked by yet
            variants = [{"name": f"v{i}", "overrides": [f"/mpm/duration={1 + 0.1 * i}"]} for i in range(20)]
            run = service.submit(study(times=[0.01 * (i + 1) for i in range(200)], variants=variants))
            # Some MB of events, more than buffers hold; four thousand tasks at once take a loaded machine its time.
            for order in ("cancel", *["retry", "cancel"] * 3):
                service.ask(f"/v1/runs/{run}/{order}", b"", timeout=100)
            until(lambda: threads() <= before)
            silent.close(), stream.close()

    def test_a_body_too_large_is_refused_before_it_is_there(self):
        with self.serve() as service:
            before = self.resident_mb(service)
            for length in (17 << 20, 1 << 40):
                clients = [service.connect(head + b"Content-Length: %d\r\n\r\n" % length) for _ in range(8)]
                for each in clients:
                    try:
                        for _ in range(15):
                            each.sendall(b" " * (1 << 20))
                    except OSError:
                        pass
                self.assertLess(self.resident_mb(service) - before, 40, "8 bodies of 15 MB are not kept")
                for each in clients:
                    each.close()
            with service.connect(head + b"Content-Length: %d\r\n\r\n" % (17 << 20)) as connection:
                connection.sendall(b" " * (17 << 20))
                self.assertIn(b" 413 ", connection.recv(4096))

    def test_where_all_places_are_taken_the_next_one_hears_so(self):
        with Service(self.folder.name) as service:
            before = len(open_sockets(service))  # what it listens on
            clients = [service.connect(b"GET ") for _ in range(512)]
            until(lambda: len(open_sockets(service)) >= before + 512)
            answers = []
            for _ in range(4):
                with service.connect(b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n") as late:
                    answers.append(late.recv(4096))
            self.assertTrue(all(b" 503 " in each and b"/problems/busy" in each and b"Retry-After: " in each for each in answers),
                            answers[:1])
            for each in clients:
                each.close()
            until(lambda: service.raw(b"GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n") == 200)


def open_sockets(service):
    """Connections that the service holds."""
    found = []
    for each in pathlib.Path(f"/proc/{service.process.pid}/fd").iterdir():
        try:
            if str(each.readlink()).startswith("socket:"):
                found.append(each.name)
        except OSError:
            pass  # closed meanwhile
    return found


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
