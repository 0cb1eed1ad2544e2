"""A station forwards: another ground station sees its vehicles and commands them, unless it may only watch; and /metrics shows
vehicles, links and forwarding."""

import pathlib
import re
import subprocess
import tempfile
import urllib.request

import harness
import map_client
from mavlink_peer import Peer, mavlink

CONFIG = """
links = ["udpin://127.0.0.1:{vehicles}", "north=udpin://127.0.0.1:{north}"]
[web]
port = 0
[[forward]]
name = "other"
url = "udpout://127.0.0.1:{other}"
[[forward]]
name = "viewer"
url = "udpout://127.0.0.1:{viewer}"
read_only = true
[[forward]]
name = "northern"
network = "north"
url = "udpout://127.0.0.1:{northern}"
"""

with tempfile.TemporaryDirectory() as folder:
    ports = {name: harness.free_udp_port() for name in ("vehicles", "north", "other", "viewer", "northern")}
    file = pathlib.Path(folder, "station.toml")
    file.write_text(CONFIG.format(**ports))
    other = Peer(ports["other"], 254, 190, listens=True)
    viewer = Peer(ports["viewer"], 253, 190, listens=True)
    northern = Peer(ports["northern"], 252, 190, listens=True)
    station = subprocess.Popen([harness.LAPWING, "station", "--config", str(file)], stderr=subprocess.PIPE, text=True)
    try:
        said = map_client.said_before_listening(station)
        address = re.search(r"http://127\.0\.0\.1:\d+/", said)
        assert address, said
        vehicle = Peer(ports["vehicles"], 7)
        vehicle.heartbeat()
        vehicle.hears_type("HEARTBEAT", 255)
        for ride_along in (other, viewer):
            ride_along.hears_type("HEARTBEAT", 7)
        for ride_along in (viewer, other):
            ride_along.heartbeat(mavlink.MAV_TYPE_GCS)
            ride_along.say(ride_along.mav.command_long_encode(7, 1, 400, 0, 1, 0, 0, 0, 0, 0, 0))
        assert vehicle.hears_type("COMMAND_LONG", 254).command == 400
        vehicle.say(vehicle.mav.command_ack_encode(400, 0, 0, 0, 254, 190))
        other.hears_type("COMMAND_ACK", 7)
        vehicle.heartbeat()
        viewer.hears(lambda m: m.get_srcSystem() == 7 and viewer.heard.count(m) == 1 and m.get_seq() == 2, what="the second heartbeat")
        assert not any(m.get_srcSystem() == 253 for m in vehicle.heard), "the viewer was obeyed"
        # Another network is another world: its vehicle 7 is seen where that network is forwarded.
        rover = Peer(ports["north"], 7)
        rover.heartbeat(mavlink.MAV_TYPE_GROUND_ROVER)
        assert northern.hears_type("HEARTBEAT", 7).type == mavlink.MAV_TYPE_GROUND_ROVER
        northern.say(northern.mav.command_long_encode(7, 1, 401, 0, 1, 0, 0, 0, 0, 0, 0))
        assert rover.hears_type("COMMAND_LONG", 252).command == 401
        other.forget()
        assert not any(m.get_type() == "HEARTBEAT" and m.type == mavlink.MAV_TYPE_GROUND_ROVER for m in other.heard)
        assert not any(m.get_srcSystem() == 252 for m in vehicle.heard)
        with urllib.request.urlopen(f"{address[0]}metrics", timeout=10) as answer:
            text = answer.read().decode()
        for wanted in (r'lapwing_vehicle_connected\{vehicle="7",name="[^"]*"\} 1\n',
                       rf'lapwing_link_received_frames_total\{{link="udpin://127.0.0.1:{ports["vehicles"]}"\}} 3\n',
                       r'lapwing_router_dropped_frames_total\{endpoint="viewer",direction="in",reason="read_only"\} 2\n',
                       r'lapwing_router_frames_total\{endpoint="other",direction="in"\} 2\n',
                       r'lapwing_router_frames_total\{endpoint="northern",direction="in"\} 1\n',
                       r'lapwing_router_frames_total\{endpoint="vehicles of north",direction="in"\} \d+\n', r"# EOF\n$"):
            assert re.search(wanted, text), (wanted, text)
    finally:
        station.terminate()
        station.communicate(timeout=20)
    assert station.returncode == 0, station.returncode
print("other programs ride along")
