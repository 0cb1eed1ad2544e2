"""MAVProxy as a foreign ground station on `lapwing sim`: parameters, mission, fence and rally points, a flight to its end."""

import os
import pathlib
import queue
import subprocess
import sys
import tempfile
import threading
import time

import harness

SPEEDUP = 5
HOME_LAT, HOME_LON = 41.1780, -8.5980
TAKE_OFF, WAYPOINT, RETURN, FENCE_CORNER, RALLY_POINT = 22, 16, 20, 5001, 5100
MISSION = [(0, WAYPOINT, 0, HOME_LAT, HOME_LON, 90), (3, TAKE_OFF, 0, 0, 0, 20),
           (3, WAYPOINT, 0, 41.1784, HOME_LON, 20), (3, WAYPOINT, 0, 41.1784, -8.5975, 25), (3, RETURN, 0, 0, 0, 0)]
FENCE = [(3, FENCE_CORNER, 4, lat, lon, 0)
         for lat, lon in ((41.17, -8.61), (41.19, -8.61), (41.19, -8.59), (41.17, -8.59))]
RALLY = [(3, RALLY_POINT, 0, 41.1785, -8.5985, 30)]


class MavProxy:
    """The program at its prompt: what it says is read line by line, what it is told goes to its standard input."""

    def __init__(self, port: int, folder: str):
        arguments = [sys.executable, "-m", "MAVProxy.mavproxy", f"--master=udpin:127.0.0.1:{port}", "--show-errors"]
        self.process = subprocess.Popen(arguments, cwd=folder, env=os.environ | {"HOME": folder}, text=True, bufsize=1,
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.said, self.lines = queue.Queue(), []
        threading.Thread(target=self._listen, daemon=True).start()

    def _listen(self):
        for line in self.process.stdout:
            self.said.put(line.rstrip())

    def tell(self, command: str):
        self.process.stdin.write(command + "\n")

    def hear(self, words: str, seconds: float = 30):
        """Until a line with these words; what was said before it is read and gone."""
        deadline = time.monotonic() + seconds
        while True:
            try:
                line = self.said.get(timeout=max(0.0, deadline - time.monotonic()))
            except queue.Empty:
                shown = "\n".join(self.lines[-40:])
                raise AssertionError(f"MAVProxy did not say {words!r} within {seconds} s:\n{shown}") from None
            self.lines.append(line)
            if words in line:
                return line

    def end(self):
        self.process.kill()
        self.process.wait()


def write_waypoints(folder: str, name: str, items) -> None:
    lines = ["QGC WPL 110"]
    for seq, (frame, command, first, lat, lon, alt) in enumerate(items):
        lines.append("\t".join(str(x) for x in (seq, 0, frame, command, first, 0, 0, 0, lat, lon, alt, 1)))
    (pathlib.Path(folder) / name).write_text("\n".join(lines) + "\n")


def read_waypoints(path: pathlib.Path):
    rows = [line.split() for line in path.read_text().splitlines()[1:]]
    return [(int(row[3]), float(row[8]), float(row[9]), float(row[10])) for row in rows]


def agree(sent, got) -> bool:
    """Item 0 is home, whatever was sent; a command without a place comes back without one."""
    same = [command == back[0] and abs(lat - back[1]) < 1e-6 and abs(lon - back[2]) < 1e-6 and abs(alt - back[3]) < 0.02
            for (_, command, _, lat, lon, alt), back in zip(sent, got)]
    return len(sent) == len(got) and all(same)


def ask_for_parameter(proxy: MavProxy, name: str) -> str:
    """It sets parameters in the background, so what is asked for next may overtake that."""
    proxy.tell(f"param fetch {name}")
    return proxy.hear(f"{name} = ")


def fly(proxy: MavProxy, folder: str):
    proxy.hear("Detected vehicle 1:1")
    proxy.hear("EKF3 IMU0 is using GPS", seconds=60)
    proxy.hear("parameters", seconds=60)  # it fetches them all before anything else
    proxy.tell("param set RTL_ALT 1200")
    harness.wait_until(lambda: "1200" in ask_for_parameter(proxy, "RTL_ALT"), 20, "RTL_ALT is stored")

    proxy.tell("wp load mission.waypoints")
    proxy.hear("TYPE_MISSION: ACCEPTED")
    proxy.tell("wp save back.waypoints")
    proxy.hear("Saved 5 waypoints")
    back = read_waypoints(pathlib.Path(folder) / "back.waypoints")
    assert agree(MISSION[1:], back[1:]), f"the mission came back as {back}"

    proxy.tell("fence load fence.waypoints")
    proxy.hear("TYPE_FENCE: ACCEPTED")
    proxy.tell("rally load rally.waypoints")
    proxy.hear("TYPE_RALLY: ACCEPTED")
    proxy.tell("rally list")
    assert "41.1785" in proxy.hear("5100 3 "), "the rally point did not come back"

    proxy.tell("mode guided")
    proxy.hear("Mode GUIDED")
    proxy.tell("arm throttle")
    proxy.hear("ARMED")
    proxy.tell("takeoff 15")
    proxy.hear("NAV_TAKEOFF: ACCEPTED")
    proxy.tell("long MISSION_START")
    proxy.hear("MISSION_START: ACCEPTED")
    proxy.hear("waypoint 3", seconds=60)
    proxy.hear("DISARMED", seconds=90)


def main():
    try:
        import MAVProxy  # noqa: F401
    except ImportError:
        print("skipped: MAVProxy is not installed; ./lapwing test installs it")
        sys.exit(harness.SKIPPED)
    port = harness.free_udp_port()
    with tempfile.TemporaryDirectory() as folder:
        write_waypoints(folder, "mission.waypoints", MISSION)
        write_waypoints(folder, "fence.waypoints", FENCE)
        write_waypoints(folder, "rally.waypoints", RALLY)
        proxy = MavProxy(port, folder)
        try:
            proxy.hear("Waiting for heartbeat", seconds=60)  # the vehicle's first texts are not repeated
            with harness.lapwing("sim", "--vehicles", "copter:1", "--home", f"{HOME_LAT},{HOME_LON},90", "--out",
                                 f"udpout://127.0.0.1:{port}", "--speedup", str(SPEEDUP)):
                fly(proxy, folder)
        finally:
            proxy.end()


if __name__ == "__main__":
    main()
