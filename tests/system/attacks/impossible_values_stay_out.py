"""A vehicle tells what cannot be in every field of every message, beside an honest one: no viewer is told any of it, by WebSocket
or HTTP, the station says and counts what it left out, and the map still shows the honest vehicle at its place.

With SHOT=FILE.png the page is photographed. The page is left out where the browser app, its packages or Chromium are missing."""

import json
import os
import pathlib
import shutil
import subprocess
import time
import urllib.request

import ground
import harness
import liar
from mavlink_peer import Peer, mavlink

PLACE = (41.178, -8.598)
# Of every number that is told about a vehicle, by its key.
BOUNDS = {
    "lat_deg": (-90, 90), "lon_deg": (-180, 180), "alt_m": (-12000, 60000), "relative_alt_m": (-12000, 60000),
    "north": (-300, 300), "east": (-300, 300), "down": (-300, 300), "heading_rad": (0, 6.2832), "from_rad": (0, 6.2832),
    "remaining": (0, 1), "throttle": (0, 1), "buffer_free": (0, 1), "loss": (0, 1), "voltage_v": (0, 1000), "current_a": (-100, 1000),
    "consumed_ah": (0, 2000), "time_left_s": (0, 604800), "airspeed_m_s": (0, 300), "climb_m_s": (-300, 300), "speed_m_s": (0, 215),
    "hdop": (0, 100), "satellites": (0, 254), **{angle: (-12.6, 12.6) for angle in ("roll", "pitch", "yaw", "roll_rad", "pitch_rad", "yaw_rad")},
}


def check(value, key=""):
    """Every number in there is one, and can be."""
    if isinstance(value, dict):
        for name, inner in value.items():
            if name != "age_s":
                check(inner, name)
    elif isinstance(value, list):
        for inner in value:
            check(inner, key)
    elif value is None:
        assert key in ("pulses_us",), f"{key} is null: a number that JSON cannot hold"
    elif isinstance(value, (int, float)) and not isinstance(value, bool):
        lowest, highest = BOUNDS.get(key, (-2.1e7, 1e9))
        assert lowest <= value <= highest, f"{key} is {value}"


class Crew:
    """The honest vehicle and the liar, on one link."""

    def __init__(self, port: int):
        self.honest, self.liar = Peer(port, 1), Peer(port, 66)
        self.started = time.monotonic()

    def tell_the_truth(self, peer, place=PLACE):
        since_ms = int(1000 * (time.monotonic() - self.started))
        lat, lon = (round(angle * 1e7) for angle in place)
        mav = peer.mav
        peer.heartbeat()
        peer.say(mav.gps_raw_int_encode(0, 3, lat, lon, 90000, 121, 200, 0, 0, 12))
        peer.say(mav.ekf_status_report_encode(0x33F, 0.1, 0.1, 0.1, 0.1, 0))
        peer.say(mav.global_position_int_encode(since_ms, lat, lon, 90000, 0, 0, 0, 0, 9000))
        peer.say(mav.sys_status_encode(0, 0, 0, 100, 12000, 100, 80, 0, 0, 0, 0, 0, 0))
        while peer.listen():
            pass


def read_all(viewer, seconds: float):
    """Everything that it is told in that time, checked."""
    told, deadline = 0, time.monotonic() + seconds
    while time.monotonic() < deadline:
        try:
            message = viewer.message(max(0.05, deadline - time.monotonic()))
        except TimeoutError:
            break
        for key in ("vehicles", "pictures", "path"):
            check(message.get(key), key) if key in message else None
        told += message["type"] == "vehicles"
    return told


def page_of(station, name: str):
    """What the page shows, or nothing where it cannot be opened."""
    web = harness.ROOT / "web"
    missing = [what for what, there in (("chromium", shutil.which("chromium")), ("node", shutil.which("node")),
                                        ("web/node_modules", (web / "node_modules").exists()),
                                        ("web/dist", (web / "dist/index.html").exists())) if not there]
    if missing:
        print("the page is not looked at:", ", ".join(missing), "missing")
        return None
    arguments = ["node", str(web / "e2e/look.mjs"), f"http://127.0.0.1:{station.port}/", name, os.environ.get("SHOT", "")]
    done = subprocess.run(arguments, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stdout + done.stderr
    return json.loads(done.stdout.splitlines()[-1])


with ground.station() as station:
    crew = Crew(station.link_ports[0])
    viewer = station.viewer()
    for _ in range(3):
        crew.tell_the_truth(crew.honest)
        crew.tell_the_truth(crew.liar, (41.179, -8.597))  # first it is believed
        time.sleep(0.1)
    harness.wait_until(lambda: "position" in station.vehicles().get(66, {}), 10, "the liar is known at a place")
    told = 0
    for number, lie in enumerate(liar.lies()):
        crew.liar.say(lie)
        if number % 50 == 0:
            crew.tell_the_truth(crew.honest)
            crew.liar.heartbeat()
            told += read_all(viewer, 0.05)
    told += read_all(viewer, 1.0)
    assert told > 10, f"{told} messages about vehicles"

    # The two of which the map once broke for everybody, the last that is heard.
    unknown = 2**31 - 1
    crew.liar.say(crew.liar.mav.global_position_int_encode(1, unknown, unknown, -2**31, -2**31, 32767, 32767, 32767, 65535))
    crew.liar.say(crew.liar.mav.global_position_int_encode(1, unknown - 1, unknown - 1, 0, 0, 0, 0, 0, 65535))
    crew.liar.say(crew.liar.mav.sys_status_encode(0, 0, 0, 0, 12000, 100, -128, 0, 0, 0, 0, 0, 0))
    crew.tell_the_truth(crew.honest)
    read_all(viewer, 0.5)
    newcomer = station.viewer()
    read_all(newcomer, 0.5)
    for vehicle in station.vehicles().values():
        check(vehicle)
    honest = station.vehicles()[1]["position"]
    assert abs(honest["lat_deg"] - PLACE[0]) < 1e-6 and abs(honest["lon_deg"] - PLACE[1]) < 1e-6, honest

    metrics = urllib.request.urlopen(f"http://127.0.0.1:{station.port}/metrics", timeout=10).read().decode()
    counted = [line for line in metrics.splitlines() if line.startswith("lapwing_link_impossible_values_total")]
    assert any('message="GLOBAL_POSITION_INT",field="lat"' in line for line in counted), metrics
    assert len(counted) > 40, counted
    harness.wait_until(lambda: any("vehicle 66 tells what cannot be: GLOBAL_POSITION_INT.lat" in line for line in station.said), 10, "it is said")
    lines = [line for line in station.said if "tells what cannot be" in line]
    assert len(lines) < 300, f"{len(lines)} lines"

    shown = page_of(station, "copter 1")
    if shown:
        assert not shown["complaints"], shown
        assert shown["isInView"] and shown["rows"] == 2, shown
print(f"{len(counted)} fields were counted, {told} messages held nothing impossible")
