"""Idle connections, connections that come and go, silent viewers, floods of requests and of WebSocket messages, with an operator beside them: each of his
emergency stops, over HTTP on a new connection and over his WebSocket, is answered all along. Prints how long it took."""

import base64
import json
import os
import pathlib
import socket
import statistics
import subprocess
import sys
import tempfile
import threading
import time

import ground
import harness

TOKEN = "a-token-of-sixteen-letters-or-more"
STOPS = 100
LONGEST_S = 2.0  # of any one; what is usual is printed

# The attackers: a process of their own, so that they take no time from the operator's.
ATTACK = r"""
import base64, os, socket, sys, threading, time
kind, port, QUERY = sys.argv[1], int(sys.argv[2]), sys.argv[3].encode()
head = f"Host: 127.0.0.1:{port}\r\n".encode()

def connect():
    try:
        return socket.create_connection(("127.0.0.1", port), timeout=5)
    except OSError:
        return None

def idle():
    held = []
    while True:
        for _ in range(300):
            one = connect()
            if one:
                try:
                    one.sendall(b"GET / HTTP/1.1\r\nHost: 127")
                except OSError:
                    pass
                held.append(one)
        held = held[-600:]
        time.sleep(0.3)

def churn():
    while True:
        one = connect()
        if one:
            one.close()
        time.sleep(0.001)

def silent_viewers():
    held = []
    while True:
        one = connect()
        if one:
            key = base64.b64encode(os.urandom(16))
            try:
                one.sendall(b"GET /api/v1/ws HTTP/1.1\r\n" + head + b"Upgrade: websocket\r\nConnection: Upgrade\r\n"
                            b"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: " + key + b"\r\n\r\n")
            except OSError:
                pass
            held.append(one)
        held = held[-200:]
        time.sleep(0.02)

def requests():
    ask = b"GET /api/v1/status HTTP/1.1\r\n" + head + b"\r\n"
    while True:
        one = connect()
        try:
            for _ in range(50):
                one.sendall(ask * 10)
                for _ in range(10):
                    one.recv(65536)
                time.sleep(0.005)
        except (OSError, AttributeError):
            pass

def words():
    # Asks as fast as it is taken, and reads nothing of the answers.
    ping = b'{"type":"ping","id":"x"}'
    stop = b'{"type":"stop_script"}'
    frames = b"".join(bytes([0x81, 0x80 | len(text)]) + bytes(4) + text for text in (ping, stop)) * 200
    talkers = []
    for _ in range(3):
        one = connect()
        key = base64.b64encode(os.urandom(16))
        one.sendall(b"GET /api/v1/ws" + QUERY + b" HTTP/1.1\r\n" + head + b"Upgrade: websocket\r\nConnection: Upgrade\r\n"
                    b"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: " + key + b"\r\n\r\n")
        talkers.append(one)
    def talk(one):
        try:
            while True:
                one.sendall(frames)
        except OSError:
            pass
    for one in talkers:
        threading.Thread(target=talk, args=(one,), daemon=True).start()

work = {"words": words, "idle": idle, "churn": churn, "viewers": silent_viewers, "requests": requests}[kind]
threading.Thread(target=work, daemon=True).start()
print("on", flush=True)
sys.stdin.read()
"""


class Operator:
    def __init__(self, port: int, token: str = ""):
        self.port = port
        self.authorization = f"Authorization: Bearer {token}\r\n" if token else ""
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=10)
        key = base64.b64encode(os.urandom(16)).decode()
        query = f"?token={token}" if token else ""
        self.socket.sendall((f"GET /api/v1/ws{query} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\n"
                             f"Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\n\r\n").encode())
        self.data = b""
        while b"\r\n\r\n" not in self.data:
            self.data += self.socket.recv(4096)
        head, self.data = self.data.split(b"\r\n\r\n", 1)
        assert b" 101 " in head.splitlines()[0], head
        self.answers: dict[str, float] = {}
        self.stops = 0
        self.reader = threading.Thread(target=self.read, daemon=True)
        self.reader.start()
        self.say({"type": "ping", "id": "hello"})
        harness.wait_until(lambda: self.is_answered("hello"), 10, "the WebSocket answers")

    def read(self):
        """Notes when each request was answered."""
        def take(count):
            while len(self.data) < count:
                got = self.socket.recv(65536)
                if not got:
                    raise ConnectionError
                self.data += got
            taken, self.data = self.data[:count], self.data[count:]
            return taken

        self.socket.settimeout(None)
        text = b""
        try:
            while True:
                first, length = take(2)
                if length == 126:
                    length = int.from_bytes(take(2), "big")
                elif length == 127:
                    length = int.from_bytes(take(8), "big")
                payload = take(length)
                if first & 0x0F == 9:
                    self.frame(10, payload)
                    continue
                text += payload
                if not first & 0x80:
                    continue
                message, text = json.loads(text), b""
                if message.get("type") in ("reply", "pong"):
                    self.answers[message["id"]] = time.monotonic()
        except (ConnectionError, OSError):
            self.answers["over"] = time.monotonic()

    def frame(self, kind, payload):
        size = bytes([0x80 | len(payload)]) if len(payload) < 126 else bytes([0x80 | 126]) + len(payload).to_bytes(2, "big")
        self.socket.sendall(bytes([0x80 | kind]) + size + bytes(4) + payload)

    def say(self, message):
        self.frame(1, json.dumps(message).encode())

    def is_answered(self, name):
        assert "over" not in self.answers, "the operator's WebSocket was closed"
        return name in self.answers

    def stop_over_websocket(self) -> float:
        self.stops += 1
        name, began = f"stop {self.stops}", time.monotonic()
        self.say({"type": "emergency_stop", "id": name})
        while not self.is_answered(name):
            assert time.monotonic() - began < 10, "an emergency stop over WebSocket had no answer"
            time.sleep(0.0005)
        return self.answers[name] - began

    def stop_over_http(self) -> float:
        began = time.monotonic()
        body = b"{}"
        with socket.create_connection(("127.0.0.1", self.port), timeout=10) as one:
            one.sendall((f"POST /api/v1/emergency-stop HTTP/1.1\r\nHost: 127.0.0.1:{self.port}\r\n{self.authorization}"
                         f"Content-Type: application/json\r\nContent-Length: {len(body)}\r\n\r\n").encode() + body)
            answer = one.recv(4096)
        assert answer.startswith(b"HTTP/1.1 2"), answer[:200]
        return time.monotonic() - began


def percentile(values, share):
    return sorted(values)[min(len(values) - 1, int(share * len(values)))]


def operate(operator, what: str):
    http, ws = [], []
    for _ in range(STOPS):
        http.append(operator.stop_over_http())
        ws.append(operator.stop_over_websocket())
        time.sleep(0.01)
    for name, times in (("HTTP", http), ("WebSocket", ws)):
        assert max(times) < LONGEST_S, f"{what}: an emergency stop over {name} took {max(times):.2f} s"
        print(f"{what}: {len(times)} emergency stops over {name}: median {1000 * statistics.median(times):.1f} ms, "
              f"p99 {1000 * percentile(times, 0.99):.1f} ms, longest {1000 * max(times):.1f} ms")


def attacked(port: int, token: str, *kinds: str):
    query = f"?token={token}" if token else ""
    attackers = [subprocess.Popen([sys.executable, "-c", ATTACK, kind, str(port), query], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
                 for kind in kinds]
    for attacker in attackers:
        assert attacker.stdout.readline() == b"on\n"
    time.sleep(1.0)
    return attackers


def end(attackers):
    for attacker in attackers:
        attacker.kill()
        attacker.wait()


with tempfile.TemporaryDirectory() as folder:
    file = pathlib.Path(folder, "station.token")
    file.touch(0o600)
    file.write_text(TOKEN + "\n")
    for token, arguments in (("", ()), (TOKEN, ("--token-file", str(file)))):
        with ground.station(*arguments) as station:
            operator = Operator(station.port, token)
            guarded = "with a token" if token else "without a token"
            operate(operator, f"{guarded}, alone")
            for kinds in (("idle",), ("churn",), ("viewers",), ("requests",), ("words",), ("idle", "churn", "viewers", "requests", "words")):
                attackers = attacked(station.port, token, *kinds)
                try:
                    operate(operator, f"{guarded}, {' and '.join(kinds)}")
                finally:
                    end(attackers)
                operator.is_answered("hello")  # its WebSocket is still the first one
