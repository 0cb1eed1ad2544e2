"""A station with a robot in a simulated building: it is among the vehicles, drives by a script that is started over HTTP, its floor comes
onto the map, and the emergency stop holds it with a copter's. A robot whose place on the globe nobody knows is refused."""

import os
import pathlib
import subprocess
import tempfile

import harness
from station import Station

FLAT = pathlib.Path(__file__).resolve().parents[3] / "examples/buildings/flat.toml"
SCRIPT = """
robot = pick { id 'robot1'; timeout 60.seconds }
execute robot: drive { explore(); returnToStart() }
"""

link, web = harness.free_udp_port(), harness.free_tcp_port()
station = Station(web)
with harness.lapwing("station", "--robot", f"sim:{FLAT}", "--link", f"udpin://127.0.0.1:{link}", "--port", str(web)), \
        harness.lapwing("sim", "--vehicles", "copter:1", "--home", "41.1780,-8.5980,90", "--out", f"udpout://127.0.0.1:{link}"):
    harness.wait_until(station.up, 20, "the station answers")
    harness.wait_until(lambda: station.vehicle("robot1").get("position"), 20, "the robot says where it is")
    harness.wait_until(lambda: station.vehicle("1").get("position"), 30, "the copter beside it, too")
    assert station.vehicle("robot1")["family"] == "robot", station.vehicle("robot1")

    assert station.ask("script", {"name": "floor.dolphin", "source": SCRIPT})[0] == 202
    harness.wait_until(lambda: station.vehicle("robot1").get("track_m", 0) > 1, 60, "the robot drives")

    status, stop = station.ask("emergency-stop", {"operator": "tester"})
    assert status == 202 and stop["latched"], stop
    harness.wait_until(lambda: station.stopped("robot1")["confirmed"] and station.stopped("1")["confirmed"], 20, "both have confirmed their stop")
    harness.wait_until(lambda: station.ask("script")[1]["state"] == "stopped", 20, "the script is halted")
    assert station.command("go_to", "robot1", **{k: station.vehicle("robot1")["position"][k] for k in ("lat_deg", "lon_deg")})[0]["state"] == "refused"

for real in ("udpout://127.0.0.1:9", "ros2://0/robot1"):
    with tempfile.TemporaryDirectory() as new:  # the first station's store has a site
        refused = subprocess.run([os.environ["LAPWING"], "station", "--robot", real, "--port", "0", "--store", new], capture_output=True, text=True,
                                 timeout=30, check=False)
    assert refused.returncode == 2 and "where on the globe" in refused.stderr, (real, refused.returncode, refused.stderr)
print("the robot drove by a script of the station and stopped with the copter")
