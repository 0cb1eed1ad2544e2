"""A survey drone with its onboard programs, and its operator in plain Python. Not a test itself.

Its flight controller is simulated; with `LAPWING_FLIGHT_CONTROLLER=ardupilot` in the environment it is an ArduPilot in the loop (`LAPWING_SITL`).
"""

import contextlib
import json
import os
import pathlib
import signal
import socket
import subprocess
import tempfile
import threading
import time

import harness
from ardupilot import in_the_loop
from operator_link import COMMAND, Station

HOME = (43.2585, -79.9201)
IS_ARDUPILOT = os.environ.get("LAPWING_FLIGHT_CONTROLLER") == "ardupilot"
READY_S = 150 if IS_ARDUPILOT else 40  # from switching on until it may be armed


class Operator:
    """Speaks the operator link, or bare JSON, and keeps what it hears."""

    def __init__(self, port: int, plain: bool = False, name: str = "operator", token: str = ""):
        self.port, self.plain, self.name = port, plain, name
        self.heartbeats: list[dict] = []
        self.errors: list[str] = []
        self.slots: list[dict] = []  # GeoJSON features, as they were told last
        self.map: dict | None = None  # put together of the whole one and its changes, once `follow_map` has asked for them
        self.map_messages: list[dict] = []  # all that have come of it
        self.misses = 0  # changes that did not follow what was there
        self._changed = threading.Condition()
        self._station = Station(port, name=name, token=token)
        self._ends = False
        self.connect()

    def connect(self, seconds: float = 10) -> None:
        deadline = time.monotonic() + seconds
        while True:
            try:
                if self.plain:
                    self._socket = socket.create_connection(("127.0.0.1", self.port), timeout=5)
                else:
                    self._station.connect()
                    self._socket = self._station.socket
                break
            except OSError:
                assert time.monotonic() < deadline, f"nobody serves on port {self.port}"
                time.sleep(0.05)
        self._ends = False
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()

    def cut(self) -> None:
        """As a network does: without a word."""
        self._ends = True
        self._station.socket = self._socket
        self._station.cut()
        self._thread.join()

    def _read(self) -> None:
        with contextlib.suppress(OSError):
            self._read_plain() if self.plain else self._read_frames()

    def _read_plain(self) -> None:
        rest = b""
        while not self._ends:
            with contextlib.suppress(TimeoutError):
                piece = self._socket.recv(65536)
                if not piece:
                    return
                *lines, rest = (rest + piece).split(b"\n")
                for line in lines:
                    self._take(line.decode())

    def _read_frames(self) -> None:
        known = len(self._station.messages)
        while not self._ends:
            with contextlib.suppress(TimeoutError):
                self._station.hear()
            for _, _, text in self._station.messages[known:]:
                self._take(text)
            known = len(self._station.messages)

    def _take(self, text: str) -> None:
        message = json.loads(text)
        with self._changed:
            if message["Type"] == "Heartbeat":
                self.heartbeats.append(message)
            elif message["Type"] == "Slots":
                self.slots = message["Features"]["features"]
            elif message["Type"] in ("Map", "Map Changes"):
                self.map_messages.append(message)
                self._take_map(message)
            else:
                self.errors.append(message["Message"])
            self._changed.notify_all()

    def follow_map(self) -> None:
        """The whole map comes next, and then what changes."""
        self.command("Map", Send="Changes")

    def _take_map(self, message: dict) -> None:
        if message["Type"] == "Map":
            self.map = {**message, "Cells": list(message["Cells"])}
        elif self.map is not None and message["Since"] == self.map["Revision"]:
            for first, *cells in message["Changes"]:
                self.map["Cells"][first:first + len(cells)] = cells
            self.map["Revision"] = message["Revision"]
        elif self.map is not None:  # something is missing; nothing is known until the whole map is here again
            self.map = None
            self.misses += 1
            self.follow_map()

    def say(self, text: str) -> None:
        if self.plain:
            self._socket.sendall(text.encode())
        else:
            self._station.say(COMMAND, text)  # a frame is one sendall, so that those of the reader do not get in between

    def command(self, kind: str, **fields) -> None:
        self.say(json.dumps({"Type": kind, **fields}))

    @property
    def last(self) -> dict:
        return self.heartbeats[-1] if self.heartbeats else {}

    def wait(self, condition, what: str, seconds: float = 30):
        with self._changed:
            assert self._changed.wait_for(lambda: condition(self), seconds), \
                f"not within {seconds} s: {what}; last {({**self.last, 'Occupancy Map': '...'})}, errors {self.errors[-5:]}"

    def wait_for_state(self, state: str, seconds: float = 30) -> dict:
        """A heartbeat that comes from now on has it."""
        known = len(self.heartbeats)
        self.wait(lambda o: any(one["State"] == state for one in o.heartbeats[known:]), f"state {state}", seconds)
        return next(one for one in self.heartbeats[known:] if one["State"] == state)

    def wait_for_error(self, words: str, seconds: float = 10) -> str:
        self.wait(lambda o: any(words in one for one in o.errors), f"an ErrorLog with '{words}'", seconds)
        return next(one for one in self.errors if words in one)


@contextlib.contextmanager
def flight_controller(port: int, vehicle: str = "copter:1", options: tuple[str, ...] = ()):
    """The process of a copter that sends to that UDP port; vehicle and options are those of `lapwing sim`."""
    if IS_ARDUPILOT:
        with in_the_loop.started("copter", port, speedup=1, home=(*HOME, 100)) as process:
            yield process
        return
    words = ["sim", "--vehicles", vehicle, *options, "--home", f"{HOME[0]},{HOME[1]},100", "--out", f"udpout://127.0.0.1:{port}"]
    process = subprocess.Popen([harness.LAPWING, *words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        yield process
    finally:
        process.send_signal(signal.SIGINT)
        process.wait(timeout=10)


class Drone:
    """A flight controller and `lapwing onboard`, ended with the block."""

    def __init__(self, mode: str = "framed", decide: str = "", desk: str = "", processes: str = "", vehicle: str = "copter:1",
                 simulator: tuple[str, ...] = ()):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="lapwing-drone-"))
        self.port, self.link, self.domain = harness.free_tcp_port(), harness.free_udp_port(), harness.own_domain()
        self.config = self.folder / "onboard.toml"
        self.config.write_text(f"""
health_file = "health.json"
[bus]
domain = {self.domain}
[bridge]
link = "udpin://127.0.0.1:{self.link}"
[decide]
state_folder = "state"
{decide}
[operator]
port = {self.port}
mode = "{mode}"
{desk}
{processes}
""")
        self.log: list[str] = []
        self._vehicle, self._simulator = vehicle, simulator

    def __enter__(self):
        self._flight_controller = flight_controller(self.link, self._vehicle, self._simulator)
        self.simulator = self._flight_controller.__enter__()
        self.start()
        return self

    def start(self) -> None:
        self.onboard = subprocess.Popen([harness.LAPWING, "onboard", "--config", self.config], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                        text=True)
        self._reader = threading.Thread(target=self._read, args=(self.onboard.stderr,), daemon=True)
        self._reader.start()

    def _read(self, stream) -> None:
        for line in stream:
            self.log.append(line.rstrip("\n"))

    def __exit__(self, kind, *_):
        if kind is not None:
            print("\n".join(self.log[-80:]))
        try:
            if self.onboard.poll() is None:
                self.onboard.send_signal(signal.SIGTERM)
                try:
                    self.onboard.wait(timeout=30)
                except subprocess.TimeoutExpired:
                    self.onboard.kill()
                    self.onboard.wait()
                    if kind is None:
                        raise
        finally:
            self._flight_controller.__exit__(None, None, None)

    def health(self) -> dict[str, dict]:
        with contextlib.suppress(OSError, ValueError):
            return {one["name"]: one for one in json.loads((self.folder / "health.json").read_text())["processes"]}
        return {}

    def pid(self, name: str) -> int | None:
        return self.health().get(name, {}).get("pid")

    def wait_for_log(self, words: str, seconds: float = 20) -> str:
        harness.wait_until(lambda: any(words in line for line in self.log) or time.sleep(0.05), seconds, f"a line with '{words}' in {self.log[-12:]}")
        return next(line for line in self.log if words in line)


def arm(operator: Operator, ready_s: float = READY_S) -> None:
    """To Arm, with its motors running. A drone that has just been switched on needs a while until it may be."""
    deadline = time.monotonic() + ready_s
    operator.wait(lambda o: o.last, "the first heartbeat", READY_S)
    while True:
        operator.command("Arm")
        with contextlib.suppress(AssertionError):
            operator.wait(lambda o: o.last["State"] == "Arm" and o.last["Armed"], "armed", 5)
            break
        assert time.monotonic() < deadline, f"it is not armed: {operator.errors[-5:]}"


def take_off(operator: Operator, ready_s: float = READY_S) -> None:
    """From the ground to Hover."""
    arm(operator, ready_s)
    operator.command("Takeoff")
    operator.wait(lambda o: o.last["State"] == "Hover", "Hover", 40)
