"""Event streams: continued at the reader's position, at most 200, none delayed by a client that does not read, and all ended when
the service stops."""
import json
import signal
import sys
import tempfile
import threading
import time
import unittest

from service import Service, study, until

request = (b"GET /v1/events%s HTTP/1.1\r\nHost: localhost\r\nAccept: text/event-stream\r\n%s\r\n")


class Stream:
    def __init__(self, service, query=b"", headers=b""):
        self.connection = service.connect(request % (query, headers))
        self.buffer = b""
        self.status = int(self.read_until(b"\r\n\r\n")[9:12])
        self.head = self.last

    def read_until(self, mark):
        while mark not in self.buffer:
            part = self.connection.recv(65536)
            if not part:
                raise EOFError
            self.buffer += part
        self.last, self.buffer = self.buffer.split(mark, 1)
        return self.last

    def event(self):
        while True:
            lines = self.read_until(b"\n\n").split(b"\n")
            data = [line for line in lines if line.startswith(b"data: ")]
            if data:
                return json.loads(data[0][6:])

    def close(self):
        self.connection.close()


class Listeners(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.service = Service(self.folder.name, "--slots", "2")

    def tearDown(self):
        self.service.__exit__()
        self.folder.cleanup()

    def test_a_stream_goes_on_after_the_last_event_seen(self):
        run = self.service.submit(study())
        self.service.wait_for_end(run)
        events = self.service.ask("/v1/events?after=0")[2]["events"]
        stream = Stream(self.service, headers=b"Last-Event-ID: %d\r\n" % events[2]["seq"])
        for wanted in events[3:]:
            self.assertEqual(stream.event(), wanted)
        stream.close()

    def test_a_stream_of_one_run_has_no_other(self):
        first, second = self.service.submit(study()), self.service.submit(study())
        for run in (first, second):
            self.service.wait_for_end(run)
        everything = self.service.ask("/v1/events?after=0")[2]["events"]
        wanted = [each for each in everything if each["run"] == second]
        self.assertLess(len(wanted), len(everything))
        self.assertEqual(self.service.ask(f"/v1/events?after=0&run={second}")[2]["events"], wanted)
        stream = Stream(self.service, b"?after=0&run=" + second.encode())
        for each in wanted:
            self.assertEqual(stream.event(), each)
        stream.close()
        self.assertEqual(self.service.ask("/v1/events?run=nobody")[0], 404)

    def test_a_long_poll_waits_for_the_next_event(self):
        last = self.service.ask("/v1/events?after=0")[2]["next"]
        got = []
        waiting = threading.Thread(target=lambda: got.append(self.service.ask(f"/v1/events?after={last}&wait=30")))
        waiting.start()
        time.sleep(0.3)
        self.assertFalse(got)
        run = self.service.submit(study())
        waiting.join(20)
        self.assertEqual(got[0][2]["events"][0]["run"], run)

    def test_a_reader_beyond_the_newest_event_is_reset(self):
        """As after a restored backup: the numbers that it knows will not come for long."""
        newest = self.service.ask("/v1/events?after=0")[2]["next"]
        for query, headers in ((b"?after=1000000", b""), (b"", b"Last-Event-ID: 1000000\r\n")):
            stream = Stream(self.service, query, headers)
            stream.read_until(b"\n\n")
            self.assertEqual(stream.read_until(b"\n\n"), b"event: reset\nid: %d\ndata: {\"next\":%d}" % (newest, newest))
            run = self.service.submit(study())
            self.assertEqual(stream.event()["run"], run)
            stream.close()
            self.service.wait_for_end(run)
            newest = self.service.ask("/v1/events?after=1000000&wait=30")[2]["next"]
        self.assertEqual(self.service.ask("/v1/events?after=1000000&wait=30")[2],
                         {"events": [], "next": newest, "reset": True})

    def test_two_hundred_are_served_and_the_next_must_come_again(self):
        streams = [Stream(self.service) for _ in range(200)]
        self.assertEqual({each.status for each in streams}, {200})
        refused = Stream(self.service)
        self.assertEqual(refused.status, 503)
        self.assertIn(b"Retry-After:", refused.head)
        self.assertEqual(self.service.ask("/healthz")[0], 200)  # others are answered
        for each in streams:
            each.read_until(b"\n\n")  # the first message
        run = self.service.submit(study())
        self.assertEqual({each.event()["run"] for each in streams}, {run})
        for each in streams:
            each.close()
        refused.close()
        self.service.wait_for_end(run)

        def has_a_seat():
            stream = Stream(self.service)
            stream.close()
            return stream.status == 200

        until(has_a_seat)  # places are released

    def test_one_that_does_not_read_delays_no_other(self):
        stalled = [self.service.connect(request % (b"?after=0", b"")) for _ in range(20)]
        reader = Stream(self.service, b"?after=0")
        for _ in range(5):
            run = self.service.submit(study([0.25, 0.5, 0.75]))
            while (event := reader.event())["run"] != run:
                pass
            self.assertEqual(self.service.wait_for_end(run)["state"], "succeeded")
        for each in stalled:
            each.close()
        reader.close()

    def test_stopping_ends_all_streams(self):
        streams = [Stream(self.service) for _ in range(50)]
        self.service.end(signal.SIGTERM)  # within its 30 s, or the test fails
        self.assertEqual(self.service.process.returncode, 0)
        for each in streams:
            with self.assertRaises((EOFError, ConnectionResetError)):
                while True:
                    each.read_until(b"\n\n")
            each.close()

    def test_a_stop_right_after_the_start_is_heard(self):
        for _ in range(6):
            self.service.end(signal.SIGTERM)
            self.assertEqual(self.service.process.returncode, 0)
            self.service = Service(self.folder.name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
