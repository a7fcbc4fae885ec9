"""A closed loop of HTTP clients: each sends its next request after the last answer."""
import asyncio
import multiprocessing
import time


def request_bytes(port, method, path, body=b"", accept="*/*"):
    head = (f"{method} {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nAccept: {accept}\r\n"
            f"Content-Type: application/json\r\nContent-Length: {len(body)}\r\n\r\n")
    return head.encode() + body


async def read_chunks(reader):
    body = b""
    while size := int(await reader.readuntil(b"\r\n"), 16):
        body += (await reader.readexactly(size + 2))[:-2]
    await reader.readexactly(2)
    return body


async def read_answer(reader):
    """(status, body, whether the connection stays open)"""
    head = (await reader.readuntil(b"\r\n\r\n")).decode("latin-1").lower()
    length, chunked = 0, False
    for line in head.split("\r\n"):
        if line.startswith("content-length:"):
            length = int(line.split(":")[1])
        if line.startswith("transfer-encoding:"):
            chunked = True
    body = await read_chunks(reader) if chunked else await reader.readexactly(length)
    return int(head[9:12]), body, "connection: close" not in head


async def one_client(port, request, until, seconds, answers, faults):
    connection = None
    while time.monotonic() < until:
        try:
            if connection is None:
                connection = await asyncio.open_connection("127.0.0.1", port, limit=1 << 24)
            began = time.perf_counter()
            connection[1].write(request)
            status, body, stays_open = await read_answer(connection[0])
            seconds.append(time.perf_counter() - began)
            if not 200 <= status < 300:
                faults.append(f"{status} {body[:200]!r}")
            elif answers is not None:
                answers.append(body)
            if not stays_open:
                connection[1].close()
                connection = None
        except (OSError, asyncio.IncompleteReadError) as error:
            faults.append(repr(error))
            connection = None
    if connection:
        connection[1].close()


def one_process(port, request, clients, duration, keep, pipe):
    seconds, faults = [], []
    answers = [] if keep else None

    async def all_clients():
        until = time.monotonic() + duration
        await asyncio.gather(*(one_client(port, request, until, seconds, answers, faults) for _ in range(clients)))

    asyncio.run(all_clients())
    pipe.send((seconds, answers or [], faults))


class Loop:
    """Starts at once; `result` waits for the end: (seconds of each request, bodies if kept, faults)."""

    def __init__(self, port, request, clients, duration, keep=False, processes=2):
        processes = min(processes, clients)
        self.duration = duration
        self.workers = []
        for i in range(processes):
            share = clients // processes + (i < clients % processes)
            here, there = multiprocessing.Pipe(duplex=False)
            worker = multiprocessing.Process(target=one_process, args=(port, request, share, duration, keep, there))
            worker.start()
            self.workers.append((worker, here))

    def result(self):
        seconds, answers, faults = [], [], []
        for worker, pipe in self.workers:
            for whole, part in zip((seconds, answers, faults), pipe.recv()):
                whole += part
            worker.join()
        return seconds, answers, faults
