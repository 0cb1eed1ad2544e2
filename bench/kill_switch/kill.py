"""The operator's kill on loopback: how long from a press to the robot's wheels commanded to zero, for many presses at random moments of its driving.

Three programs: `lapwing station` with the robot, which maps meanwhile; the robot's board in a simulated building, behind TCP; and this one, which presses. A press is
`POST /api/v1/emergency-stop` on a connection that is open, as a page's is; its moment is the one before the request is written. Zero is when the board has cut both wheels' voltages."""

import http.client
import json
import math
import os
import pathlib
import queue
import random
import re
import socket
import statistics
import subprocess
import tempfile
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
# The flat as it is: places that are not on the map are driven to by nobody.
EXPLORE = "robot = pick { id 'robot1'; timeout 60.seconds }\nexecute robot: drive { explore(); returnToStart() }\n"
PRESSES = int(os.environ.get("LAPWING_BENCH_PRESSES", "1000"))
BUDGET_S = 0.100


def free_tcp_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Board:
    """What the board says of its wheels, by `time.monotonic_ns`."""

    def __init__(self, program: pathlib.Path, port: int):
        self.process = subprocess.Popen([program, ROOT / "examples/buildings/flat.toml", str(port)], stdout=subprocess.PIPE, text=True)
        self.said = queue.Queue()
        threading.Thread(target=self.listen, daemon=True).start()

    def listen(self):
        for line in self.process.stdout:
            word, at = line.split()
            self.said.put((word, int(at)))

    def wait_for(self, word: str, timeout: float) -> int | None:
        end = time.monotonic() + timeout
        while (left := end - time.monotonic()) > 0:
            try:
                heard, at = self.said.get(timeout=left)
            except queue.Empty:
                return None
            if heard == word:
                return at
        return None

    def drain(self) -> str:
        """The last thing that it said and nobody has heard yet."""
        last = ""
        while not self.said.empty():
            last = self.said.get()[0]
        return last

    def wait_until_it_stays_at_zero(self, timeout: float) -> int | None:
        """Voltages pass through zero while the robot drives as well, for a moment: that is none."""
        while (at := self.wait_for("zero", timeout)) is not None and self.wait_for("driven", 0.1) is not None:
            pass
        return at

    def is_driven(self, timeout: float) -> bool:
        return self.wait_for("driven", timeout) is not None


class Station:
    def __init__(self, program: pathlib.Path, board_port: int, home: str):
        config = pathlib.Path(home, "station.toml")
        config.write_text('[map]\nhome = "41.178,-8.598,90"\n')
        words = ["station", "--config", config, "--link", "udpin://127.0.0.1:0", "--port", "0", "--robot", f"tcpout://127.0.0.1:{board_port}",
                 "--store", f"{home}/store"]
        environment = os.environ | {"LAPWING_HOME": str(ROOT), "XDG_DATA_HOME": home}
        self.process = subprocess.Popen([program, *words], stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True, env=environment)
        self.lines = []
        port = None
        for line in self.process.stderr:
            self.lines.append(line)
            if found := re.search(r"http://127\.0\.0\.1:(\d+)/", line):
                port = int(found.group(1))
                break
        if port is None:
            raise SystemExit("kill: the station does not start:\n" + "".join(self.lines))
        threading.Thread(target=lambda: self.lines.extend(self.process.stderr), daemon=True).start()
        self.connection = http.client.HTTPConnection("127.0.0.1", port, timeout=10)
        self.connection.connect()
        self.connection.sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    def ask(self, method: str, path: str, body=None):
        self.connection.request(method, f"/api/v1/{path}", None if body is None else json.dumps(body), {"Content-Type": "application/json"})
        answer = self.connection.getresponse()
        text = answer.read()
        if answer.status >= 300:
            raise SystemExit(f"kill: {method} {path}: {answer.status} {text.decode()}")
        return json.loads(text)

    def robot(self) -> dict:
        return next(vehicle for vehicle in self.ask("GET", "vehicles")["vehicles"] if vehicle["id"] == "robot1")

    def may_move(self) -> bool:
        return self.ask("GET", "health")["vehicles"][0]["may_move"]

    def wait_until(self, holds, what: str, timeout: float = 30.0):
        end = time.monotonic() + timeout
        while not holds():
            if time.monotonic() > end:
                raise SystemExit(f"kill: {what} did not come within {timeout:.0f} s\n" + "".join(self.lines[-10:]))
            time.sleep(0.01)


class Hall:
    """The robot goes to and fro between two places in the hall, 0.5 m and 3.5 m east of where it begins, so that it is always under way."""

    def __init__(self, robot: dict):
        self.start = robot["position"]
        self.metres_per_degree = 111_319.49 * math.cos(math.radians(self.start["lat_deg"]))
        self.goes_east = True

    def next_place(self, robot: dict) -> dict:
        east_m = (robot["position"]["lon_deg"] - self.start["lon_deg"]) * self.metres_per_degree
        if east_m > 2.5:
            self.goes_east = False
        elif east_m < 1.5:
            self.goes_east = True
        return {"lat_deg": self.start["lat_deg"], "lon_deg": self.start["lon_deg"] + (3.5 if self.goes_east else 0.5) / self.metres_per_degree}


def press(station: Station, board: Board, hall: Hall, pause_s: float) -> float | None:
    """Seconds to zero; infinity when it did not come; nothing when the wheels stood at the press."""
    station.wait_until(station.may_move, "a robot that may move")
    board.drain()
    station.ask("POST", "commands", {"action": "go_to", "vehicles": ["robot1"], "take_over": True, **hall.next_place(station.robot())})
    if not board.is_driven(10.0):
        raise SystemExit(f"kill: the robot does not drive: {station.ask('GET', 'commands')['commands'][-1]}\n" + "".join(station.lines[-10:]))
    time.sleep(pause_s)
    stands = board.drain() == "zero"
    pressed = time.monotonic_ns()
    station.ask("POST", "emergency-stop", {"action": "hold"})
    zero = None if stands else board.wait_until_it_stays_at_zero(5.0)
    station.ask("POST", "emergency-stop/release", {})
    if stands:
        return None
    return math.inf if zero is None else (zero - pressed) / 1e9


def measure(lapwing: pathlib.Path, board_program: pathlib.Path, say) -> dict:
    port = free_tcp_port()
    moments = random.Random(1)
    board = Board(board_program, port)
    took, missed = [], 0
    try:
        with tempfile.TemporaryDirectory() as home:
            station = Station(lapwing, port, home)
            try:
                station.wait_until(lambda: any(one["id"] == "robot1" and "position" in one for one in station.ask("GET", "vehicles")["vehicles"]), "the robot's place")
                hall = Hall(station.robot())
                station.ask("POST", "script", {"name": "explore.dolphin", "source": EXPLORE})
                station.wait_until(lambda: station.ask("GET", "script")["state"] not in ("running", "stopping"), "the end of the exploration", timeout=900.0)
                say(f"kill    explored: {station.ask('GET', 'script')['state']}")
                while len(took) + missed < PRESSES:
                    seconds = press(station, board, hall, moments.uniform(0.0, 0.4))
                    if seconds is None:
                        continue
                    if math.isinf(seconds):
                        missed += 1
                    else:
                        took.append(seconds)
                    if (len(took) + missed) % 200 == 0:
                        say(f"kill    {len(took) + missed} presses, p50 {statistics.median(took) * 1e3:.1f} ms, at most {max(took) * 1e3:.1f} ms")
            finally:
                station.process.kill()
                station.process.wait()
    finally:
        board.process.kill()
        board.process.wait()
    took.sort()
    at = lambda part: took[min(len(took) - 1, int(part * len(took)))]
    found = {"presses": PRESSES, "stopped": len(took), "missed": missed, "p50_s": at(0.5), "p99_s": at(0.99), "most_s": took[-1], "mean_s": statistics.mean(took),
             "over_budget": sum(one >= BUDGET_S for one in took), "load": os.getloadavg()[0]}
    say(f"kill    {found['stopped']} of {found['presses']} presses: press to wheels at zero p50 {found['p50_s'] * 1e3:.1f} ms, p99 {found['p99_s'] * 1e3:.1f} ms, "
        f"at most {found['most_s'] * 1e3:.1f} ms; {found['over_budget']} over the budget of {BUDGET_S * 1e3:.0f} ms")
    return found


if __name__ == "__main__":
    measure(ROOT / "build/release/bin/lapwing", ROOT / "build/bench/bin/bench_kill_board", lambda text: print(text, flush=True))
