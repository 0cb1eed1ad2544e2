"""Idle connections, connections that come and go, silent viewers, floods of requests and of WebSocket messages, with an operator beside them: each of his
emergency stops, over HTTP on a new connection and over his WebSocket, is answered and reaches every vehicle all along: ten copters in the air, a hundred
on the ground. Prints how long it took to the answer, and to the last of the vehicles."""

import base64
import contextlib
import json
import math
import multiprocessing
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
import wire
from pymavlink.dialects.v20 import ardupilotmega as mavlink

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
        self.asked = 0
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
                now, whole, text = time.time(), text, b""
                if b'"reply"' not in whole and b'"pong"' not in whole:
                    continue  # news of vehicles: to read it would take the time that is measured
                message = json.loads(whole)
                if message.get("type") in ("reply", "pong"):
                    self.answers[message["id"]] = now
        except (ConnectionError, OSError):
            self.answers["over"] = time.time()

    def frame(self, kind, payload):
        size = bytes([0x80 | len(payload)]) if len(payload) < 126 else bytes([0x80 | 126]) + len(payload).to_bytes(2, "big")
        self.socket.sendall(bytes([0x80 | kind]) + size + bytes(4) + payload)

    def say(self, message):
        self.frame(1, json.dumps(message).encode())

    def is_answered(self, name):
        assert "over" not in self.answers, "the operator's WebSocket was closed"
        return name in self.answers

    def ask(self, what: str) -> float:
        self.asked += 1
        name, began = f"{what} {self.asked}", time.time()
        self.say({"type": what, "id": name})
        while not self.is_answered(name):
            assert time.time() - began < 10, f"{what} over WebSocket had no answer"
            time.sleep(0.0005)
        return self.answers[name] - began

    def stop_over_websocket(self) -> float:
        return self.ask("emergency_stop")

    def release(self):
        self.ask("release_emergency_stop")

    def stop_over_http(self) -> float:
        began = time.time()
        body = b"{}"
        with socket.create_connection(("127.0.0.1", self.port), timeout=10) as one:
            one.sendall((f"POST /api/v1/emergency-stop HTTP/1.1\r\nHost: 127.0.0.1:{self.port}\r\n{self.authorization}"
                         f"Content-Type: application/json\r\nContent-Length: {len(body)}\r\n\r\n").encode() + body)
            answer = one.recv(4096)
        assert answer.startswith(b"HTTP/1.1 2"), answer[:200]
        return time.time() - began


STOPPING = (mavlink.MAV_CMD_DO_SET_MODE, mavlink.MAV_CMD_COMPONENT_ARM_DISARM)


class StopsOnTheWire(wire.Wire):
    """Tells what stops vehicles, and when it came to them."""

    def __init__(self, station_port: int, told):
        super().__init__(station_port)
        self.told = told

    def keep(self, seen: wire.Seen):
        if seen.to_vehicle and getattr(seen.message, "command", 0) in STOPPING:
            self.told.send((seen.at, seen.vehicle))


def relay(station_port: int, told):
    with StopsOnTheWire(station_port, told) as link:
        told.send(link.vehicle_port)
        threading.Event().wait()


class Vehicles:
    """Copters of `lapwing sim` behind a relay: a process of its own, so that it takes no time from the operator's."""

    def __init__(self, count: int, pipe):
        self.count, self.pipe = count, pipe

    def reached_after(self, began: float) -> float:
        """How long it took until the last of them had a stop that was sent after that."""
        came: dict[int, float] = {}
        while len(came) < self.count:
            assert self.pipe.poll(5), f"the stop reached {len(came)} of {self.count} vehicles"
            at, vehicle = self.pipe.recv()
            if at >= began:
                came.setdefault(vehicle, at)
        return max(came.values()) - began


@contextlib.contextmanager
def vehicles(station_port: int, count: int):
    ours, theirs = multiprocessing.Pipe()
    process = multiprocessing.get_context("fork").Process(target=relay, args=(station_port, theirs), daemon=True)
    process.start()
    try:
        out = f"udpout://127.0.0.1:{ours.recv()}"
        with harness.lapwing("sim", "--vehicles", f"copter:{count}", "--home", "47.3977,8.5456,488", "--out", out):
            yield Vehicles(count, ours)
    finally:
        process.kill()
        process.join()


def percentile(values, share):
    return sorted(values)[math.ceil(share * len(values)) - 1]


def operate(operator, fleet, what: str):
    for name, stop in (("HTTP", operator.stop_over_http), ("WebSocket", operator.stop_over_websocket)):
        answered, reached = [], []
        for _ in range(STOPS):
            began = time.time()
            answered.append(stop())
            reached.append(fleet.reached_after(began))
            operator.release()
            time.sleep(0.003)
        for until, times in (("the answer", answered), (f"the last of {fleet.count} vehicles", reached)):
            assert max(times) < LONGEST_S, f"{what}: an emergency stop over {name} took {max(times):.2f} s to {until}"
            print(f"{what}: {len(times)} emergency stops over {name}, to {until}: median {1000 * statistics.median(times):.1f} ms, "
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


def is_ready(vehicle: dict) -> bool:
    return vehicle.get("health", {}).get("prearm_ok", False)


def is_up(vehicle: dict) -> bool:
    return vehicle.get("relative_alt_m", 0) > 1


with tempfile.TemporaryDirectory() as folder:
    file = pathlib.Path(folder, "station.token")
    file.touch(0o600)
    file.write_text(TOKEN + "\n")
    for token, arguments, count in (("", (), 10), (TOKEN, ("--token-file", str(file)), 100)):
        with ground.station(*arguments, token=token) as station, vehicles(station.link_ports[0], count) as fleet:
            def all_are(wanted):
                time.sleep(0.1)
                known = station.vehicles().values()
                return len(known) == fleet.count and all(map(wanted, known))

            harness.wait_until(lambda: all_are(is_ready), 60, "the vehicles are ready")
            operator = Operator(station.port, token)
            if count == 10:
                operator.say({"type": "command", "action": "take_off", "vehicles": list(map(str, station.vehicles())), "height_m": 5})
                harness.wait_until(lambda: all_are(is_up), 60, "the vehicles are in the air")
            guarded = f"{count} copters, {'with a token' if token else 'without a token'}"
            operate(operator, fleet, f"{guarded}, alone")
            for kinds in (("idle",), ("churn",), ("viewers",), ("requests",), ("words",), ("idle", "churn", "viewers", "requests", "words")):
                attackers = attacked(station.port, token, *kinds)
                try:
                    operate(operator, fleet, f"{guarded}, {' and '.join(kinds)}")
                finally:
                    end(attackers)
                operator.is_answered("hello")  # its WebSocket is still the first one
