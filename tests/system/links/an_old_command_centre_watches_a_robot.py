"""A command centre that speaks nothing but the seed's lines, over a plain socket, at a station with a robot: it hears how each module is, sends
the robot off, stops, kills and releases it, and is told the doors that were found, also after it was away. Damaged lines change nothing."""

import pathlib
import re
import socket
import subprocess
import sys
import tempfile

import harness
from station import Station

WING = harness.ROOT / "examples/buildings/wing.toml"
LINE = re.compile(r"(SIM|CAR|MMU|PLN|POI|CM)_(CC|VSL)_(\d+)_(.*)")


class Centre:
    """What it has heard of each module: (to whom, milliseconds, message), the newest last."""

    def __init__(self, port: int):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=10)
        self.rest = b""
        self.heard: dict[str, list[tuple[str, int, str]]] = {}

    def say(self, text: str):
        self.socket.sendall(text.encode() + b"\n")

    def listen(self):
        """Takes what comes next, waiting for it."""
        data = self.socket.recv(65536)
        assert data, "the robot hung up"
        *lines, self.rest = (self.rest + data).split(b"\n")
        for line in lines:
            match = LINE.fullmatch(line.decode())
            assert match, line
            sender, to, stamp, message = match.groups()
            self.heard.setdefault(sender, []).append((to, int(stamp), message))

    def comes(self, true, seconds: float, what: str):
        def listened():
            self.listen()
            return true()
        return harness.wait_until(listened, seconds, f"{what}; heard {({k: v[-1] for k, v in self.heard.items()})}", pause=0)

    def last(self, sender: str, to: str = "CC") -> str:
        return next((message for receiver, _, message in reversed(self.heard.get(sender, [])) if receiver == to), "")

    def pose(self) -> tuple[int, int, int]:
        x, y, yaw = map(int, self.last("MMU", "VSL").split(":"))
        return x, y, yaw

    def points(self) -> list[str]:
        return [message for to, _, message in self.heard.get("POI", []) if to == "VSL"]

    def is_told_a_room(self) -> bool:
        """By what was read on its name tag. A sign that was come to and could not be read is a door, without a text."""
        points = [re.fullmatch(r'"(Door|Name Tag)", "(.*)", -?\d+, -?\d+', point) for point in self.points()]
        assert all(points), self.points()
        return any(kind == "Name Tag" and text for kind, text in (point.groups() for point in points))

    def moved(self, begin, least_cm: int) -> bool:
        return abs(self.pose()[0] - begin[0]) + abs(self.pose()[1] - begin[1]) > least_cm


link, web, port = harness.free_udp_port(), harness.free_tcp_port(), harness.free_tcp_port()
has_eyes = (pathlib.Path(harness.LAPWING).parent / "lapwing-vision").exists()
station = Station(web)
with harness.lapwing("station", "--robot", f"sim:{WING}", "--old-parts", f"tcpin://127.0.0.1:{port}", "--link", f"udpin://127.0.0.1:{link}", "--port",
                     str(web)):
    harness.wait_until(station.up, 30, "the station answers")
    centre = Centre(port)
    centre.comes(lambda: all(centre.last(module).startswith("ready:") for module in ("SIM", "CAR", "MMU", "PLN", "CM")) and centre.last("MMU", "VSL"),
                 30, "every module says that it is ready, and mapping where it is")

    # Ten times a second, by the robot's own clock.
    before = len(centre.heard["CAR"])
    centre.comes(lambda: len(centre.heard["CAR"]) >= before + 20, 30, "twenty more lines of the carrier")
    stamps = [stamp for _, stamp, _ in centre.heard["CAR"][before:before + 20]]
    assert stamps == sorted(stamps) and stamps[-1] - stamps[0] >= 1500, stamps

    begin = centre.pose()
    centre.say("CC_PLN_1000_CONTINUE")
    centre.comes(lambda: centre.moved(begin, 60), 60, "it explores")
    assert station.vehicle("robot1")["control"]["commander"] == "the old command centre", station.vehicle("robot1")

    # Nonsense, cut lines and lines without end are no orders.
    for nonsense in ("CC_PLN_x_STOP", "CAR_CC_1_ready:0:0", "PLN_CAR_1_High", "%%%", "x" * 5000):
        centre.say(nonsense)
    begin = centre.pose()
    centre.comes(lambda: centre.moved(begin, 60), 60, "it explores all the same")

    centre.say("CC_CAR_2000_Kill")
    centre.comes(lambda: centre.last("CAR").startswith("ready:205:"), 10, "the carrier says that it was killed")
    centre.say("CC_PLN_3000_CONTINUE")
    centre.comes(lambda: centre.last("CAR").startswith("ready:0:"), 10, "the carrier is let go")
    before = len(centre.heard["CAR"])
    begin = centre.pose()
    centre.comes(lambda: len(centre.heard["CAR"]) >= before + 20, 30, "two seconds have gone")
    assert not centre.moved(begin, 10), "it was let go, and not sent off"

    centre.say("CC_PLN_4000_CONTINUE")
    centre.comes(lambda: centre.moved(begin, 60), 60, "it explores again")
    if has_eyes:
        centre.comes(centre.is_told_a_room, 240, "it has read a name tag")
    known = centre.points()
    # The link is cut, and a line with it; meanwhile the robot goes on, and all of what was found is told to who comes back.
    centre.socket.sendall(b"CC_PLN_4500_ST")
    centre.socket.close()
    centre = Centre(port)
    # A door whose sign was read better since has one line now.
    centre.comes(lambda: (centre.points() or not known) and centre.last("MMU", "VSL"), 30, "who comes back is told")
    begin = centre.pose()
    centre.comes(lambda: centre.moved(begin, 30), 90, "it went on without its command centre")
    centre.say("CC_PLN_5000_STOP")
    harness.wait_until(lambda: station.vehicle("robot1").get("mode") == "HOLD", 20, "it stands")
    if has_eyes:
        assert centre.is_told_a_room(), centre.points()

with tempfile.TemporaryDirectory() as new:
    for wrong, why in (("tcpin://0.0.0.0:5771", "no password"), ("udpin://127.0.0.1:5771", "a stream"), ("robot7=tcpin://127.0.0.1:0", "no robot 'robot7'")):
        refused = subprocess.run([harness.LAPWING, "station", "--robot", f"sim:{WING}", "--old-parts", wrong, "--port", "0", "--store", new],
                                 capture_output=True, text=True, timeout=60, check=False)
        assert refused.returncode == 2 and why in refused.stderr, (wrong, refused.returncode, refused.stderr)
print(f"{len(known)} points of interest, {'with' if has_eyes else 'without'} eyes", file=sys.stdout)
