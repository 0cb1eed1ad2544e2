"""A robot of a station whose battery has little left while it is out exploring: that is said, the exploration ends by itself, the script drives it
home, and the log tells what was left unseen. Its board is another program's."""

import math
import pathlib
import tempfile

import harness
from served_building import ServedBuilding
from station import Station

SCRIPT = """
robot = pick { id 'robot1'; timeout 60.seconds }
execute robot: drive { explore(); returnToStart() }
"""

web = harness.free_tcp_port()
station = Station(web)


def carrier_code() -> int | None:
    modules = station.ask("health")[1]["vehicles"][0]["modules"]
    error = next((m for m in modules if m["module"] == "CAR"), {}).get("error") or {}
    return error.get("code")


def said() -> str:
    return next((line["text"] for line in station.ask("log")[1]["lines"] if " done: explore: " in line["text"]), "")


with tempfile.TemporaryDirectory() as folder, ServedBuilding(harness.ROOT / "examples/buildings/flat.toml") as building:
    config = pathlib.Path(folder, "station.toml")
    config.write_text(f"""links = ["udpin://127.0.0.1:{harness.free_udp_port()}"]
robots = ["tcpout://127.0.0.1:{building.port}@10.9,-39,0"]
[web]
port = {web}
[store]
place = "store"
[map]
home = "41.1780,-8.5980,90"
""")
    start = dict(building.truth)

    def away_m(truth: dict) -> float:
        return math.dist((truth["x_m"], truth["y_m"]), (start["x_m"], start["y_m"]))

    with harness.lapwing("station", "--config", str(config)):
        harness.wait_until(station.up, 30, "the station answers")
        harness.wait_until(lambda: station.vehicle("robot1").get("position"), 30, "the robot knows where it is")
        assert station.ask("script", {"name": "floor.dolphin", "source": SCRIPT})[0] == 202
        building.comes(lambda truth: away_m(truth) > 2.0, 120, "the robot is on its way")
        building.does("fault", "battery-low=0.1")
        harness.wait_until(lambda: carrier_code() == 208, 20, "CAR says that the battery is low")
        building.drives()
        harness.wait_until(said, 120, "the drive is over")
        assert " done: explore: its battery takes it home and little farther: " in said() and said().endswith(" left unseen"), said()
        building.stands()
        assert away_m(building.truth) < 0.6, (start, building.truth)
        assert building.truth["collisions"] == 0, building.truth
        print(f"home after {building.truth['time_s']:.0f} s; {said()}")
