"""The operator link in plain Python, written from docs/reference/operator-link.md alone, and a hand of Lapwing's to speak with."""

import contextlib
import pathlib
import secrets
import socket
import struct
import subprocess
import threading
import time
import zlib

import harness

PROGRAM = pathlib.Path(harness.LAPWING).parent / "operator_link_hand"
HELLO, WELCOME, REFUSED, DATA, ACK, RETURNED, PING, PONG, BYE = range(1, 10)
DURABLE, COMMAND, LATEST = range(3)


class Hand:
    """An end of Lapwing's that prints what it hears; its lines are kept."""

    def __init__(self, how: str, name: str, port: int, *options: str):
        self.lines: list[str] = []
        self._changed = threading.Condition()
        self.process = subprocess.Popen([PROGRAM, how, name, str(port), *options], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()
        self.port = int(self.wait_for("listening ").split()[1]) if how == "serve" else port

    def _read(self) -> None:
        for line in self.process.stdout:
            with self._changed:
                self.lines.append(line.rstrip("\n"))
                self._changed.notify_all()

    def count(self, beginning: str) -> int:
        return sum(line.startswith(beginning) for line in self.lines)

    def texts(self) -> list[str]:
        return [line.split(" ", 3)[3] for line in self.lines if line.startswith("got ")]

    def wait(self, condition, what: str, seconds: float = 30) -> None:
        with self._changed:
            assert self._changed.wait_for(condition, seconds), f"not within {seconds} s: {what}; {self.lines[-5:]}"

    def wait_for(self, beginning: str, seconds: float = 30) -> str:
        self.wait(lambda: self.count(beginning) > 0, f"a line '{beginning}...'", seconds)
        return next(line for line in reversed(self.lines) if line.startswith(beginning))

    def tell(self, line: str) -> None:
        with contextlib.suppress(BrokenPipeError):
            self.process.stdin.write(line + "\n")
            self.process.stdin.flush()

    def kill(self) -> None:
        """With SIGKILL."""
        self.process.kill()
        self.end()

    def end(self) -> None:
        with contextlib.suppress(BrokenPipeError):
            self.process.stdin.close()
        self.process.wait(timeout=20)
        self._reader.join()


class Refused(Exception):
    pass


class Station:
    """A client: keeps what must outlive a connection, and speaks on one at a time."""

    def __init__(self, port: int, name: str = "station", token: str = ""):
        self.port, self.name, self.token = port, name, token
        self.instance = secrets.randbits(63) | 1
        self.heard_streams, self.heard, self.taken = [0, 0, 0], [0, 0, 0], [0, 0, 0]
        self.sent: list[list[tuple[int, bytes, str]]] = [[], [], []]  # not acknowledged: number, key, text
        self.next = [1, 1, 1]
        self.messages: list[tuple[int, int, str]] = []
        self.acked = [0, 0, 0]
        self.returned: list[tuple[int, int, int]] = []
        self.socket: socket.socket | None = None

    def connect(self) -> None:
        self.socket = socket.create_connection(("127.0.0.1", self.port), timeout=5)
        self._buffer = b""
        body = struct.pack("<HQ", 1, self.instance)
        for lane in range(3):
            oldest = self.sent[lane][0][0] if self.sent[lane] else self.next[lane]
            body += struct.pack("<QQQQ", self.instance, oldest, self.heard_streams[lane], self.heard[lane])
        body += struct.pack("<III", 256, 2 * 1024 * 1024, 3000)
        body += struct.pack("<B", len(self.name)) + self.name.encode() + struct.pack("<H", len(self.token)) + self.token.encode()
        self.write(HELLO, body)
        kind, answer = self.frame()
        if kind == REFUSED:
            code, length = struct.unpack_from("<HH", answer)
            raise Refused(f"{code} {answer[4:4 + length].decode()}")
        assert kind == WELCOME, kind
        for lane in range(3):
            stream, oldest, heard_stream, heard = struct.unpack_from("<QQQQ", answer, 10 + 32 * lane)
            if stream != self.heard_streams[lane]:
                self.heard_streams[lane], self.heard[lane], self.taken[lane] = stream, 0, 0
            self.heard[lane] = max(self.heard[lane], oldest - 1)
            arrived = heard if heard_stream == self.instance else 0
            for number, key, text in self.sent[lane]:
                if number > arrived:
                    self._data(lane, number, key, text, 0)
        for lane in range(3):
            if self.taken[lane]:
                self.write(ACK, struct.pack("<BQ", lane, self.taken[lane]))

    def say(self, lane: int, text: str, key: str = "", lifetime_ms: int = 0) -> None:
        number = self.next[lane]
        self.next[lane] += 1
        self.sent[lane].append((number, key.encode(), text))
        self._data(lane, number, key.encode(), text, lifetime_ms)

    def _data(self, lane: int, number: int, key: bytes, text: str, lifetime_ms: int) -> None:
        now = time.monotonic_ns() // 1000
        self.write(DATA, struct.pack("<BQIQB", lane, number, lifetime_ms, now, len(key)) + key + text.encode())

    def write(self, kind: int, body: bytes, piece: int = 1 << 20) -> None:
        head = struct.pack("<BBI", 1, kind, len(body))
        frame = b"LW" + head + struct.pack("<I", zlib.crc32(head + body)) + body
        for at in range(0, len(frame), piece):
            self.socket.sendall(frame[at:at + piece])

    def frame(self) -> tuple[int, bytes]:
        """The next; raises an error of the socket when there is none in time or the connection ends."""
        while True:
            if len(self._buffer) >= 12:
                magic, version, kind, length, crc = struct.unpack_from("<2sBBII", self._buffer)
                assert (magic, version) == (b"LW", 1)
                if len(self._buffer) >= 12 + length:
                    body = self._buffer[12:12 + length]
                    assert zlib.crc32(self._buffer[2:8] + body) == crc
                    self._buffer = self._buffer[12 + length:]
                    return kind, body
            piece = self.socket.recv(65536)
            if not piece:
                raise ConnectionError("closed by the far end")
            self._buffer += piece

    def hear(self, acknowledge: bool = True) -> int:
        """One frame; its type."""
        kind, body = self.frame()
        if kind == DATA:
            lane, number, _, _, key_size = struct.unpack_from("<BQIQB", body)
            if number > self.heard[lane]:
                self.heard[lane] = self.taken[lane] = number
                self.messages.append((lane, number, body[22 + key_size:].decode()))
            if acknowledge:
                self.write(ACK, struct.pack("<BQ", lane, self.taken[lane]))
        elif kind == ACK:
            lane, number = struct.unpack("<BQ", body)
            self.acked[lane] = number
            self.sent[lane] = [one for one in self.sent[lane] if one[0] > number]
        elif kind == RETURNED:
            self.returned.append(struct.unpack("<BQB", body))
        elif kind == PING:
            self.write(PONG, body)
        return kind

    def hear_until(self, condition, what: str, seconds: float = 30) -> None:
        deadline = time.monotonic() + seconds
        while not condition():
            assert time.monotonic() < deadline, f"not within {seconds} s: {what}"
            self.hear()

    def cut(self) -> None:
        """As a network does: without a word."""
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        self.socket.close()
