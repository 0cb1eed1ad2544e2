"""A station with its map, and what it knows of vehicles. Not a test itself."""

import base64
import contextlib
import json
import os
import re
import signal
import socket
import struct
import subprocess
import time
import urllib.parse
import urllib.request

import harness


class Station:
    def __init__(self, process, address, link_port):
        self.process = process
        self.address = address
        self.link_port = link_port

    def vehicles(self) -> dict[int, dict]:
        """By system id."""
        with urllib.request.urlopen(f"{self.address}/api/v1/vehicles", timeout=10) as answer:
            return {vehicle["system_id"]: vehicle for vehicle in json.load(answer)["vehicles"]}

    def interrupt(self):
        self.process.send_signal(signal.SIGINT)


class Viewer:
    """What a browser hears: the station's messages over its WebSocket, as they come."""

    def __init__(self, address):
        url = urllib.parse.urlsplit(address)
        self.socket = socket.create_connection((url.hostname, url.port), timeout=10)
        self.buffer = b""
        key = base64.b64encode(os.urandom(16)).decode()
        lines = ["GET /api/v1/ws HTTP/1.1", f"Host: {url.netloc}", "Upgrade: websocket", "Connection: Upgrade",
                 "Sec-WebSocket-Version: 13", f"Sec-WebSocket-Key: {key}", "", ""]
        self.socket.sendall("\r\n".join(lines).encode())
        while b"\r\n\r\n" not in self.buffer:
            self.buffer += self.socket.recv(4096)
        head, self.buffer = self.buffer.split(b"\r\n\r\n", 1)
        assert b" 101 " in head.splitlines()[0], head

    def take(self, count):
        while len(self.buffer) < count:
            more = self.socket.recv(65536)
            assert more, "the station has closed the connection"
            self.buffer += more
        taken, self.buffer = self.buffer[:count], self.buffer[count:]
        return taken

    def receive(self) -> dict:
        """The next message, put together from its frames."""
        text = b""
        while True:
            first, length = self.take(2)
            if length == 126:
                length = struct.unpack(">H", self.take(2))[0]
            elif length == 127:
                length = struct.unpack(">Q", self.take(8))[0]
            body = self.take(length)
            if first & 0x0F > 1:  # neither a text nor more of one
                continue
            text += body
            if first & 0x80:
                return json.loads(text)

    def wait_for(self, kind, condition, seconds) -> dict:
        """The first message of that type for which the condition holds."""
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            message = self.receive()
            if message["type"] == kind and condition(message):
                return message
        raise AssertionError(f"no such {kind} within {seconds} s")

    def send(self, message: dict):
        body, mask = json.dumps(message).encode(), os.urandom(4)
        assert len(body) < 126
        masked = bytes(byte ^ mask[i % 4] for i, byte in enumerate(body))
        self.socket.sendall(bytes([0x81, 0x80 | len(body)]) + mask + masked)


def said_before_listening(process) -> str:
    """What a station prints until its map can be reached, or until it ends."""
    said = []
    for line in process.stderr:
        said.append(line)
        if "Ctrl-C ends" in line:
            break
    return "".join(said)


def address_in(said: str) -> str:
    """Of the map, in what the station has printed."""
    address = re.search(r"http://127\.0\.0\.1:\d+", said)
    assert address, said
    return address[0]


@contextlib.contextmanager
def station(*arguments):
    """A station on free ports of loopback, until the block ends."""
    port = harness.free_udp_port()
    command = [harness.LAPWING, "station", "--link", f"udpin://127.0.0.1:{port}", "--port", "0", *arguments]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    try:
        said = said_before_listening(process)
        yield Station(process, address_in(said), port)
    finally:
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=20)


@contextlib.contextmanager
def replaying(*arguments):
    """The address of a map that shows what is kept, until the block ends."""
    process = subprocess.Popen([harness.LAPWING, "replay", *arguments, "--port", "0"], stderr=subprocess.PIPE, text=True)
    try:
        yield address_in(said_before_listening(process))
    finally:
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=20)
