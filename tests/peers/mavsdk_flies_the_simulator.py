"""MAVSDK (its Python package with the bundled server) as a foreign ground station on `lapwing sim`."""

import asyncio

import harness

try:
    from mavsdk import System
    from mavsdk.mission_raw import MissionItem
except ImportError:
    print("mavsdk is not installed: ./lapwing test installs it")
    raise SystemExit(harness.SKIPPED)

SPEEDUP = 10
HOME_LAT, HOME_LON = 41.1780, -8.5980
GLOBAL_RELATIVE_ALT = 3
WAYPOINT, TAKEOFF, RTL = 16, 22, 20


async def first(stream, condition, seconds, what):
    async def look():
        async for value in stream:
            if condition(value):
                return value

    try:
        return await asyncio.wait_for(look(), seconds)
    except asyncio.TimeoutError:
        raise AssertionError(f"not within {seconds} s: {what}") from None


def item(seq, command, north_deg, east_deg, altitude):
    return MissionItem(seq, GLOBAL_RELATIVE_ALT, command, int(seq == 0), 1, 0.0, 0.0, 0.0, 0.0,
                       int(round((HOME_LAT + north_deg) * 1e7)), int(round((HOME_LON + east_deg) * 1e7)), altitude, 0)


async def fly(port: int):
    drone = System(port=harness.free_tcp_port())
    await drone.connect(system_address=f"udpin://127.0.0.1:{port}")
    await first(drone.core.connection_state(), lambda state: state.is_connected, 30, "a connection")
    # An ArduPilot sends nothing but heartbeats until it is asked.
    for set_rate in (drone.telemetry.set_rate_health, drone.telemetry.set_rate_position, drone.telemetry.set_rate_gps_info,
                     drone.telemetry.set_rate_home):
        await set_rate(4.0)
    await first(drone.telemetry.health(), lambda health: health.is_global_position_ok and health.is_home_position_ok, 60,
                "a global position and a home")
    # Calibrated sensors among others: programs wait for it before they arm.
    await first(drone.telemetry.health_all_ok(), lambda ok: ok, 60, "health in every respect")

    mission = [
        item(0, WAYPOINT, 0, 0, 0.0),
        item(1, TAKEOFF, 0, 0, 20.0),
        item(2, WAYPOINT, 0.0005, 0, 25.0),
        item(3, WAYPOINT, 0.0005, 0.0005, 25.0),
        item(4, RTL, 0, 0, 0.0),
    ]
    await drone.mission_raw.upload_mission(mission)
    back = await drone.mission_raw.download_mission()
    assert [i.command for i in back] == [i.command for i in mission], f"downloaded {back}"

    await drone.action.set_takeoff_altitude(15.0)
    await drone.action.arm()
    await drone.action.takeoff()
    await first(drone.telemetry.position(), lambda position: position.relative_altitude_m > 13, 40, "the copter at 15 m")
    await drone.mission_raw.start_mission()
    await first(drone.telemetry.position(), lambda position: position.latitude_deg > HOME_LAT + 0.00045, 60,
                "the copter at the northern waypoint")
    await first(drone.telemetry.armed(), lambda armed: not armed, 90, "the copter back on the ground, disarmed")


def main():
    port = harness.free_udp_port()
    with harness.lapwing("sim", "--vehicles", "copter:1", "--home", f"{HOME_LAT},{HOME_LON},90", "--out",
                      f"udpout://127.0.0.1:{port}", "--speedup", str(SPEEDUP)):
        asyncio.run(asyncio.wait_for(fly(port), 240))
    print("MAVSDK connected, armed, took off, uploaded, downloaded and flew a mission on the simulator")


main()
