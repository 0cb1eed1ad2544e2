"""Plans in files, and on vehicles before anybody else is there. Not a test itself."""

import json

from pymavlink import mavutil

WAYPOINT, LAND, TAKE_OFF = 16, 21, 22
ABOVE_HOME, ABOVE_SEA = 3, 0


def text(items, fence: dict | None = None) -> str:
    """A .plan file; an item is (command, latitude, longitude, height above home)."""
    plan = {"fileType": "Plan", "version": 1, "groundStation": "QGroundControl",
            "mission": {"version": 2, "firmwareType": 3, "plannedHomePosition": [41.178, -8.598, 90],
                        "items": [{"type": "SimpleItem", "autoContinue": True, "command": command, "doJumpId": number, "frame": ABOVE_HOME,
                                   "params": [0, 0, 0, None if command == WAYPOINT else 0, lat, lon, height]}
                                  for number, (command, lat, lon, height) in enumerate(items, 1)]}}
    if fence:
        plan["geoFence"] = {"version": 2, "circles": [], "polygons": [], **fence}
    return json.dumps(plan)


class Uploader:
    """A ground station at the port where vehicles send; it must be gone before another one comes there."""

    def __init__(self, port: int):
        self.link = mavutil.mavlink_connection(f"udpin:127.0.0.1:{port}", source_system=250, source_component=190)
        self.heard = set()

    def close(self):
        self.link.close()

    def find(self, *systems: int):
        while not set(systems) <= self.heard:
            message = self.link.recv_match(type="HEARTBEAT", blocking=True, timeout=20)
            assert message is not None, f"nothing of {set(systems) - self.heard}"
            self.heard.add(message.get_srcSystem())

    def give(self, system: int, items, px4: bool = False):
        """A mission as `text` has them; ArduPilot has its home before it."""
        mav = self.link.mav
        if not px4:
            items = [(WAYPOINT, 0, 0, 0), *items]
        mav.mission_count_send(system, 1, len(items), 0)
        while True:
            message = self.link.recv_match(type=["MISSION_REQUEST", "MISSION_REQUEST_INT", "MISSION_ACK"], blocking=True, timeout=10)
            assert message is not None, f"vehicle {system} does not take a mission"
            if message.get_srcSystem() != system:
                continue
            if message.get_type() == "MISSION_ACK":
                assert message.type == 0, message
                return
            command, lat, lon, height = items[message.seq]
            mav.mission_item_int_send(system, 1, message.seq, 6 if px4 else ABOVE_HOME, command, 0, 1, 0, 0, 0, 0, round(lat * 1e7), round(lon * 1e7),
                                      height, 0)
