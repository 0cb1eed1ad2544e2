"""Vehicles made by pymavlink, one for each mode of pymavlink's own tables, are shown by the station with the same mode names."""

import socket

from pymavlink import mavutil
from pymavlink.dialects.v20 import ardupilotmega as mavlink

import harness
import map_client

ARDUPILOT = {
    mavlink.MAV_TYPE_QUADROTOR: mavutil.mode_mapping_acm,
    mavlink.MAV_TYPE_FIXED_WING: mavutil.mode_mapping_apm,
    mavlink.MAV_TYPE_GROUND_ROVER: mavutil.mode_mapping_rover,
    mavlink.MAV_TYPE_SUBMARINE: mavutil.mode_mapping_sub,
    mavlink.MAV_TYPE_AIRSHIP: mavutil.mode_mapping_blimp,
}
# The station says PX4's modes as MAVROS does, so that AUTO.LAND is told from a LAND of ArduPilot.
PX4 = {
    "LOITER": "AUTO.LOITER", "MISSION": "AUTO.MISSION", "RTL": "AUTO.RTL", "LAND": "AUTO.LAND", "RTGS": "AUTO.RTGS",
    "FOLLOWME": "AUTO.FOLLOW_TARGET", "TAKEOFF": "AUTO.TAKEOFF",
}


def heartbeats():
    """(type, autopilot, custom mode, name)"""
    for kind, table in ARDUPILOT.items():
        for number, name in table.items():
            yield kind, mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA, number, name
    for name, (_, main, sub) in mavutil.px4_map.items():
        yield mavlink.MAV_TYPE_QUADROTOR, mavlink.MAV_AUTOPILOT_PX4, main << 16 | sub << 24, PX4.get(name, name)


expected = dict(enumerate(heartbeats(), start=1))
assert 80 < len(expected) <= 250, len(expected)
with map_client.station() as station, socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as vehicles:
    vehicles.connect(("127.0.0.1", station.link_port))

    def all_shown():
        for system, (kind, autopilot, mode, _) in expected.items():
            sender = mavlink.MAVLink(None, srcSystem=system, srcComponent=1)
            beat = sender.heartbeat_encode(kind, autopilot, mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED, mode, mavlink.MAV_STATE_STANDBY)
            vehicles.send(beat.pack(sender))
        shown = station.vehicles()
        return shown if len(shown) == len(expected) else None

    shown = harness.wait_until(all_shown, 20, "every vehicle is on the map")
wrong = {system: (shown[system]["mode"], row) for system, row in expected.items() if shown[system]["mode"] != row[3]}
assert not wrong, wrong
print(f"{len(expected)} modes have the names that pymavlink gives them")
