"""A ground station's end of one ArduPilot: it asks, and keeps what it hears. Not a test itself."""

import math
import time

from pymavlink import mavutil

import harness

m = mavutil.mavlink
ACCEPTED, TEMPORARILY_REJECTED, DENIED, UNSUPPORTED, FAILED = range(5)
STABILIZE, COPTER_AUTO, COPTER_GUIDED, COPTER_LAND, BRAKE = 0, 3, 4, 9, 17
MANUAL, HOLD, ROVER_AUTO = 0, 4, 10
AT_REST = {"copter": STABILIZE, "rover": HOLD, "plane": MANUAL}


class Vehicle:
    """A ground station's end of one vehicle: asks, and keeps what it hears."""

    def __init__(self, link: str, family: str):
        self.family = family
        self.link = mavutil.mavlink_connection(link, source_system=255, source_component=190)
        self.heard = []
        self.beaten = 0.0
        heartbeat = self.wait(lambda h: h.get_type() == "HEARTBEAT" and h.autopilot == m.MAV_AUTOPILOT_ARDUPILOTMEGA, 120,
                              "a heartbeat")
        self.system = heartbeat.get_srcSystem()
        for name in ("EKF_STATUS_REPORT", "GLOBAL_POSITION_INT", "MISSION_CURRENT", "SYS_STATUS"):
            self.command(m.MAV_CMD_SET_MESSAGE_INTERVAL, getattr(m, f"MAVLINK_MSG_ID_{name}"), 200_000)
        self.wait(lambda r: r.get_type() == "EKF_STATUS_REPORT" and r.flags & 0x10 and not r.flags & 0x80, 180, "a position")
        # Where it prearms: the checks run once in a while.
        self.wait(lambda s: s.get_type() == "SYS_STATUS" and s.onboard_control_sensors_health & (1 << 28), 180, "readiness to arm")
        self.home = self.next("GLOBAL_POSITION_INT")

    def take(self, seconds=0.05):
        if time.monotonic() - self.beaten > 0.5:
            self.beaten = time.monotonic()
            self.link.mav.heartbeat_send(m.MAV_TYPE_GCS, m.MAV_AUTOPILOT_INVALID, 0, 0, 4)
        message = self.link.recv_match(blocking=True, timeout=seconds)
        if message is not None and message.get_type() != "BAD_DATA" and message.get_srcSystem() not in (252, 255):
            self.heard.append(message)
            return message
        return None

    def wait(self, wanted, seconds=20, what="a message"):
        return harness.wait_until(lambda: (h := self.take()) and wanted(h) and h, seconds, f"{self.family}: {what}", pause=0)

    def next(self, kind, seconds=20):
        return self.wait(lambda h: h.get_type() == kind, seconds, kind)

    def listen(self, seconds):
        """What comes in so long."""
        before, end = len(self.heard), time.monotonic() + seconds
        while time.monotonic() < end:
            self.take()
        return self.heard[before:]

    def hears(self, kind, seconds, wanted=lambda h: True):
        return next((h for h in self.listen(seconds) if h.get_type() == kind and wanted(h)), None)

    def command(self, number, *params):
        self.link.mav.command_long_send(getattr(self, "system", 0), 1, number, 0, *params, *[0] * (7 - len(params)))
        return self.wait(lambda a: a.get_type() == "COMMAND_ACK" and a.command == number, 20, f"the answer to {number}").result

    def mode(self, number):
        return self.command(m.MAV_CMD_DO_SET_MODE, 1, number)

    def arm(self):
        return self.command(m.MAV_CMD_COMPONENT_ARM_DISARM, 1)

    def shown(self):
        """(mode, armed) of the next two heartbeats: arming shows late."""
        self.next("HEARTBEAT")
        heartbeat = self.next("HEARTBEAT")
        return heartbeat.custom_mode, bool(heartbeat.base_mode & m.MAV_MODE_FLAG_SAFETY_ARMED)

    def said(self, ask, seconds=1.5, until=None):
        """(answer, {text: severity}) of what is said in answer, so long or until that text has come."""
        begin = len(self.heard)

        def texts():
            return {h.text: h.severity for h in self.heard[begin:] if h.get_type() == "STATUSTEXT"}

        answer = ask()
        if until:
            harness.wait_until(lambda: until in texts() or self.take() and False, 10, f"{self.family}: {until!r}", pause=0)
        else:
            self.listen(seconds)
        return answer, texts()

    def clear(self, kind):
        self.link.mav.mission_clear_all_send(self.system, 1, kind)
        return self.wait(lambda h: h.get_type() == "MISSION_ACK" and h.mission_type == kind, 10, "MISSION_ACK").type

    def upload(self, items, kind=m.MAV_MISSION_TYPE_MISSION):
        """`items`: (command, (params), north, east, up) about home."""
        self.link.mav.mission_count_send(self.system, 1, len(items), kind)
        while True:
            asked = self.wait(lambda h: h.get_type() in ("MISSION_REQUEST", "MISSION_REQUEST_INT", "MISSION_ACK"))
            if asked.get_type() == "MISSION_ACK":
                return asked.type
            command, params, north, east, up = items[asked.seq]
            lat, lon = self.place(north, east)
            self.link.mav.mission_item_int_send(self.system, 1, asked.seq, m.MAV_FRAME_GLOBAL_RELATIVE_ALT_INT, command, 0, 1,
                                                *(list(params) + [0] * (4 - len(params))), lat, lon, up, kind)

    def place(self, north, east):
        lat = self.home.lat + north / 111_320 * 1e7
        return round(lat), round(self.home.lon + east / 111_320 / math.cos(math.radians(self.home.lat / 1e7)) * 1e7)

    def parameter(self, name):
        self.link.mav.param_request_read_send(self.system, 1, name.encode(), -1)
        return self.wait(lambda h: h.get_type() == "PARAM_VALUE" and h.param_id == name, 10, name)

    def set_parameter(self, name, value, kind):
        self.link.mav.param_set_send(self.system, 1, name.encode(), value, kind)
        return self.wait(lambda h: h.get_type() == "PARAM_VALUE" and h.param_id == name, 10, name)

    def request(self, name):
        begin = len(self.heard)
        answer = self.command(m.MAV_CMD_REQUEST_MESSAGE, getattr(m, f"MAVLINK_MSG_ID_{name}"))
        self.listen(0.5)
        return answer, next((h for h in self.heard[begin:] if h.get_type() == name), None)

    def climb(self, height):
        assert self.mode(COPTER_GUIDED) == ACCEPTED and self.arm() == ACCEPTED
        assert self.command(m.MAV_CMD_NAV_TAKEOFF, 0, 0, 0, 0, 0, 0, height) == ACCEPTED
        self.wait(lambda h: h.get_type() == "GLOBAL_POSITION_INT" and h.relative_alt > (height - 1) * 1000, 60, "its height")

    def rest(self):
        """Back to the ground, disarmed, in the first mode, without plans."""
        mode, armed = self.shown()
        if armed and self.family == "copter":
            self.mode(COPTER_LAND)
            quiet = time.monotonic() + 20
            while self.shown()[1] and time.monotonic() < quiet:
                pass
        self.command(m.MAV_CMD_COMPONENT_ARM_DISARM, 0, 21196)
        if armed and self.family == "plane":
            self.wait(lambda h: h.get_type() == "GLOBAL_POSITION_INT" and math.hypot(h.vx, h.vy, h.vz) < 30, 60, "it has come down")
        self.mode(AT_REST[self.family])
        self.clear(m.MAV_MISSION_TYPE_MISSION)
        # The last that is heard of it is the text: what comes after that answers the next question.
        self.said(lambda: self.clear(m.MAV_MISSION_TYPE_FENCE), until="Fence Indexed OK")
        self.heard.clear()
