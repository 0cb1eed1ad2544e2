"""Foreign ground stations and Lapwing hand plans to each other: by files, and through a simulated vehicle."""

import asyncio
import json
import pathlib
import tempfile

import harness
from pymavlink import mavutil, mavwp

try:
    from mavsdk import System
    from mavsdk.geofence import Circle, FenceType, GeofenceData, Point, Polygon
    from mavsdk.mission_raw import MissionItem
except ImportError:
    print("mavsdk is not installed: ./lapwing test installs it")
    raise SystemExit(harness.SKIPPED)

HOME = (41.178, -8.598)
ITEMS = [(22, HOME[0], HOME[1], 20.0), (16, 41.1785, -8.598, 25.0), (16, 41.1785, -8.597, 30.5)]
FENCE = [(41.17, -8.61), (41.17, -8.58), (41.19, -8.58)]


def write_way_points(path: pathlib.Path):
    """As MAVProxy and pymavlink save them."""
    loader = mavwp.MAVWPLoader()
    for seq, (command, lat, lon, alt) in enumerate([(16, *HOME, 90.0), *ITEMS]):
        loader.add(mavutil.mavlink.MAVLink_mission_item_message(1, 1, seq, 3 if seq else 0, command, 0, 1, 0, 0, 0, 0, lat, lon, alt))
    loader.save(str(path))


def read_way_points(path: pathlib.Path) -> list:
    loader = mavwp.MAVWPLoader()
    count = loader.load(str(path))
    return [(loader.wp(i).command, round(loader.wp(i).x, 6), round(loader.wp(i).y, 6), loader.wp(i).z) for i in range(1, count)]


async def share(port: int, folder: pathlib.Path):
    """MAVSDK uploads, Lapwing reads; Lapwing uploads, MAVSDK reads; MAVSDK reads Lapwing's file."""
    link = f"udpin://127.0.0.1:{port}"
    plan = folder / "ours.plan"
    harness.expect_exit(0, "mission", "convert", str(folder / "theirs.waypoints"), str(plan))
    drone = System(port=harness.free_tcp_port())
    await drone.connect(system_address=link)
    async for state in drone.core.connection_state():
        if state.is_connected:
            break
    imported = await drone.mission_raw.import_qgroundcontrol_mission(str(plan))
    assert [(i.command, i.x, i.y, i.z) for i in imported.mission_items][-len(ITEMS):] == [
        (command, round(lat * 1e7), round(lon * 1e7), alt) for command, lat, lon, alt in ITEMS], imported.mission_items
    await drone.mission_raw.upload_mission(
        [MissionItem(i, 3 if i else 0, command, int(i == 0), 1, 0.0, 0.0, 0.0, 0.0, round(lat * 1e7), round(lon * 1e7), alt, 0)
         for i, (command, lat, lon, alt) in enumerate([(16, *HOME, 90.0), *ITEMS])])
    await drone.geofence.upload_geofence(GeofenceData(
        [Polygon([Point(*corner) for corner in FENCE], FenceType.INCLUSION)], [Circle(Point(*HOME), 25.0, FenceType.EXCLUSION)]))


def main(folder: pathlib.Path):
    write_way_points(folder / "theirs.waypoints")
    port = harness.free_udp_port()
    with harness.lapwing("sim", "--vehicles", "copter:1", "--home", f"{HOME[0]},{HOME[1]},90", "--out", f"udpout://127.0.0.1:{port}",
                         "--speedup", "5"):
        asyncio.run(asyncio.wait_for(share(port, folder), 120))
        back = folder / "back.plan"
        harness.expect_exit(0, "mission", "download", "--link", f"udpin://127.0.0.1:{port}", "--out", str(back))
    held = json.loads(back.read_text())
    assert [i["command"] for i in held["mission"]["items"]] == [i[0] for i in ITEMS], held
    assert len(held["geoFence"]["polygons"][0]["polygon"]) == len(FENCE) and held["geoFence"]["circles"][0]["inclusion"] is False, held
    assert held["geoFence"]["circles"][0]["circle"]["radius"] == 25, held

    ours = folder / "ours.waypoints"
    harness.expect_exit(0, "mission", "convert", str(back), str(ours))
    assert read_way_points(ours) == [(c, round(lat, 6), round(lon, 6), alt) for c, lat, lon, alt in ITEMS], read_way_points(ours)


with tempfile.TemporaryDirectory() as name:
    main(pathlib.Path(name))
