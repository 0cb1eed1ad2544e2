"""A running `lapwing station` and those who look at it. Not a test itself."""

import base64
import contextlib
import http.client
import json
import os
import re
import signal
import socket
import struct
import subprocess
import threading

import harness


class Viewer:
    """A WebSocket to the station: what a browser has open. Messages are read when asked for."""

    def __init__(self, port: int):
        self._socket = socket.create_connection(("127.0.0.1", port), timeout=10)
        key = base64.b64encode(os.urandom(16)).decode()
        self._socket.sendall((f"GET /api/v1/ws HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                              f"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\n\r\n").encode())
        self._data = b""
        while b"\r\n\r\n" not in self._data:
            self._data += self._socket.recv(4096)
        head, self._data = self._data.split(b"\r\n\r\n", 1)
        assert b" 101 " in head.splitlines()[0], head

    def close(self):
        self._socket.close()

    def _take(self, count: int) -> bytes:
        while len(self._data) < count:
            got = self._socket.recv(65536)
            if not got:
                raise ConnectionError("the station closed the connection")
            self._data += got
        taken, self._data = self._data[:count], self._data[count:]
        return taken

    def _frame(self) -> tuple[int, bool, bytes]:
        """Kind, whether the message ends with it, and what is in it. Servers do not mask."""
        first, length = self._take(2)
        if length == 126:
            length = struct.unpack(">H", self._take(2))[0]
        elif length == 127:
            length = struct.unpack(">Q", self._take(8))[0]
        return first & 0x0F, bool(first & 0x80), self._take(length)

    def message(self, seconds: float = 10.0) -> dict:
        """The next message; TimeoutError when none comes."""
        ping, pong = 9, 10
        self._socket.settimeout(seconds)
        text = b""
        while True:
            kind, is_last, part = self._frame()
            if kind == ping:  # a mask of zeros leaves the echo as it is
                self._socket.sendall(bytes([0x80 | pong, 0x80 | len(part)]) + bytes(4) + part)
            elif kind < 8:
                text += part
                if is_last:
                    return json.loads(text)


class Station:
    """HTTP at `port`, vehicles at `link_ports`."""

    def __init__(self, process, port: int, link_ports: list[int], token: str = ""):
        self.process, self.port, self.link_ports = process, port, link_ports
        self._headers = {"Authorization": f"Bearer {token}"} if token else {}
        self.said: list[str] = []

    def get(self, path: str) -> dict:
        return self._ask("GET", path)[1]

    def post(self, path: str, body: dict | None = None) -> tuple[int, dict]:
        return self._ask("POST", path, json.dumps(body or {}))

    def _ask(self, method: str, path: str, body: str | None = None) -> tuple[int, dict]:
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=20)
        with contextlib.closing(connection):
            connection.request(method, path, body, self._headers | ({"Content-Type": "application/json"} if body else {}))
            answer = connection.getresponse()
            return answer.status, json.loads(answer.read())

    def vehicles(self) -> dict[int, dict]:
        """What is known of each, by its number."""
        return {int(vehicle["id"]): vehicle for vehicle in self.get("/api/v1/vehicles")["vehicles"]}

    def viewer(self) -> Viewer:
        return Viewer(self.port)


@contextlib.contextmanager
def station(*arguments: str, links: int = 1, stdout=subprocess.DEVNULL, token: str = ""):
    """Runs until the block ends; listens for vehicles on free ports. What scripts print goes to `stdout`; `token` is the one that it asks for."""
    ports = [harness.free_udp_port() for _ in range(links)]
    wanted = [word for port in ports for word in ("--link", f"udpin://127.0.0.1:{port}")]
    process = subprocess.Popen([harness.LAPWING, "station", *wanted, "--port", "0", *arguments], stderr=subprocess.PIPE,
                               stdout=stdout, text=True)
    ground = None
    try:
        address = None
        for line in process.stderr:
            address = address or re.search(r"http://127\.0\.0\.1:(\d+)/", line)
            if "listening for vehicles" in line:
                break
        assert address, "the station did not start"
        ground = Station(process, int(address[1]), ports, token)
        # Somebody has to read what it says, or it would wait for that.
        threading.Thread(target=lambda: ground.said.extend(process.stderr), daemon=True).start()
        yield ground
    finally:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(timeout=30)
        except subprocess.TimeoutExpired:
            process.kill()
            raise AssertionError("the station did not end within 30 s of an interrupt") from None


def resident_mb(pid: int) -> float:
    with open(f"/proc/{pid}/status") as status:
        return next(int(line.split()[1]) / 1024 for line in status if line.startswith("VmRSS:"))


def open_files(pid: int) -> int:
    return len(os.listdir(f"/proc/{pid}/fd"))


def cpu_seconds(pid: int) -> float:
    with open(f"/proc/{pid}/stat") as stat:
        fields = stat.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
