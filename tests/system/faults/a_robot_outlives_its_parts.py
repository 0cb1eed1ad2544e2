"""A robot whose board is another program's, and a station that drives it: every part breaks in turn while it explores, and somebody stands in its way.
Each fault is named with its module and error code, the robot stands where it must and goes on when it is mended, and it touches
nothing. Killed with its map half made, the board stops by itself, and what was mapped is there when the station is started anew."""

import math
import pathlib
import signal
import tempfile

import harness
from served_building import ServedBuilding
from station import Station

FLAT = harness.ROOT / "examples/buildings/flat.toml"
SCRIPT = """
robot = pick { id 'robot1'; timeout 60.seconds }
execute robot: drive { explore(); returnToStart() }
"""
STANDS, DRIVES = True, False
# What breaks, the module that says so and with which code, and whether the robot stands then.
FAULTS = (
    (["unplugged"], "CAR", 201, STANDS),
    (["laser-silent"], "MMU", 301, STANDS),
    (["encoder-dead:right"], "CAR", 204, STANDS),
    (["imu-silent"], "SIM", 101, DRIVES),
    (["wheel-slips:left=0.5"], "SIM", 107, DRIVES),
    ([f"sonar-stuck:{number}" for number in range(5)], "SIM", 103, DRIVES),
)

web = harness.free_tcp_port()
station = Station(web)


def health() -> dict:
    return station.ask("health")[1]["vehicles"][0]


def module(name: str) -> dict:
    return next((m for m in health()["modules"] if m["module"] == name), {})


def says(name: str, code: int) -> bool:
    error = module(name).get("error") or {}
    return error.get("code") == code and bool(error.get("what_to_do"))


def may_move(yes: bool = True):
    harness.wait_until(lambda: health()["may_move"] == yes, 20, f"the robot may {'' if yes else 'not '}move; {health()}")


def stand_before(building: ServedBuilding):
    """The person, half a metre before the robot's rim."""
    pose = building.truth
    way_m, yaw = 0.18 + 0.5 + 0.22, math.radians(pose["yaw_deg"])
    building.does("person", 0, pose["x_m"] + way_m * math.cos(yaw), pose["y_m"] + way_m * math.sin(yaw))


with tempfile.TemporaryDirectory() as folder:
    plan, config = pathlib.Path(folder, "flat.toml"), pathlib.Path(folder, "station.toml")
    plan.write_text(FLAT.read_text() + "\n[[person]]\nat = [8.5, 6.4]\n")
    building = ServedBuilding(plan)
    config.write_text(f"""links = ["udpin://127.0.0.1:{harness.free_udp_port()}"]
robots = ["tcpout://127.0.0.1:{building.port}@10.9,-39,0"]
[web]
port = {web}
[store]
place = "store"
[map]
home = "41.1780,-8.5980,90"
""")
    with building, harness.lapwing("station", "--config", str(config)) as process:
        harness.wait_until(station.up, 30, "the station answers")
        harness.wait_until(lambda: station.vehicle("robot1").get("position"), 30, "the robot knows where it is")
        may_move()
        assert station.ask("script", {"name": "floor.dolphin", "source": SCRIPT})[0] == 202
        building.drives()

        for faults, name, code, stands in FAULTS:
            for fault in faults:
                building.does("fault", fault)
            harness.wait_until(lambda: says(name, code), 60, f"{name} says {code} of {faults}; {health()}")
            if stands:
                building.stands()
            for fault in faults:
                building.does("mend", fault.split(":")[0].split("=")[0])
            may_move()
            building.drives()

        stand_before(building)
        building.passes(5)
        building.does("person", 0, 8.5, 6.4)
        building.drives()

        # The board loses its power for a moment: its clock and its heading begin anew, the robot goes on.
        building.does("restart")
        building.drives()

        # The whole program that maps and plans hangs: the board stops by itself, and is driven on when it is back.
        process.send_signal(signal.SIGSTOP)
        building.stands()
        process.send_signal(signal.SIGCONT)
        building.drives()

        assert building.truth["collisions"] == 0, building.truth
        process.kill()
        building.stands()
        told = building.truth

    # Without a robot, and so all of it from the disk.
    config.write_text("\n".join(line for line in config.read_text().splitlines() if not line.startswith("robots")))
    with harness.lapwing("station", "--config", str(config)):
        harness.wait_until(station.up, 30, "the station answers again")
        grids = station.ask("grids")[1]["grids"]
        assert [grid["name"] for grid in grids] == ["robot 1"], grids
        walls = station.ask("layers/walls/features")[1]["features"]
        assert walls, "no wall is on the disk"
        print(f"driving whatever broke, {told['time_s']:.0f} s; on the disk {len(walls)} walls")
