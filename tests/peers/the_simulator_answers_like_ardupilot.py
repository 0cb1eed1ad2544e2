"""One table of what ArduPilot answers, asked of `lapwing sim` and, where one is named, of a real ArduPilot in the loop.

    the_simulator_answers_like_ardupilot.py                           the simulator
    the_simulator_answers_like_ardupilot.py --against copter=udpin:127.0.0.1:14550 --against rover=udpin:127.0.0.1:14560
    LAPWING_SITL="copter=udpin:127.0.0.1:14550" the_simulator_answers_like_ardupilot.py      the same

A real one is any that sends MAVLink there, freshly started; each case leaves it disarmed. Each row names the vehicle, what
is sent and what was answered, by ArduPilot 4.6.0-dev (fbb7858) in the loop unless the row says otherwise. `--only TEXT`
asks the rows whose name holds TEXT.
"""

import argparse
import dataclasses
import math
import os
import struct
import time
from typing import Callable

from pymavlink import mavutil

import harness

m = mavutil.mavlink
ACCEPTED, TEMPORARILY_REJECTED, DENIED, UNSUPPORTED, FAILED = range(5)
STABILIZE, COPTER_AUTO, COPTER_GUIDED, COPTER_LAND, BRAKE = 0, 3, 4, 9, 17
MANUAL, HOLD, ROVER_AUTO = 0, 4, 10
SEEN = "4.6.0-dev fbb7858"


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
        return harness.wait_until(lambda: (h := self.take()) and wanted(h) and h, seconds, f"{self.family}: {what}")

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

    def said(self, ask, seconds=1.5):
        """(answer, {text: severity}) of what is said in answer."""
        begin = len(self.heard)
        answer = ask()
        self.listen(seconds)
        return answer, {h.text: h.severity for h in self.heard[begin:] if h.get_type() == "STATUSTEXT"}

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
        self.mode(HOLD if self.family == "rover" else STABILIZE)
        for kind in (0, 1):
            self.link.mav.mission_clear_all_send(self.system, 1, kind)
            self.next("MISSION_ACK")
        self.heard.clear()


@dataclasses.dataclass
class Row:
    name: str
    vehicle: str
    ask: Callable[[Vehicle], object]
    answer: object
    seen: str = SEEN


ROWS = []


def row(vehicle, answer, seen=SEEN):
    """A case of the table: the function's name says what is asked, its value is compared with `answer`."""
    def add(ask):
        ROWS.append(Row(ask.__name__.replace("_", " "), vehicle, ask, answer, seen))
        return ask
    return add


def short(name, vehicle, answer, ask, seen=SEEN):
    ROWS.append(Row(name, vehicle, ask, answer, seen))


# ---- modes

short("AUTO without a mission, disarmed", "copter", (ACCEPTED, COPTER_AUTO),
      lambda v: (v.mode(COPTER_AUTO), v.shown()[0]))
short("MISSION_START without a mission, disarmed", "copter", (ACCEPTED, (COPTER_AUTO, False)),
      lambda v: (v.command(m.MAV_CMD_MISSION_START), v.shown()))
short("arming in AUTO without a mission", "copter", (FAILED, {"Arm: Mode requires mission": 2}),
      lambda v: (v.mode(COPTER_AUTO), v.said(v.arm))[1])
short("AUTO without a mission, armed", "copter", (FAILED, {"Mode change to AUTO failed: init failed": 4}),
      lambda v: (v.mode(COPTER_GUIDED), v.arm(), v.listen(1), v.said(lambda: v.mode(COPTER_AUTO), 0.5))[-1])
for name, number in (("FLIP", 14), ("AUTOTUNE", 15), ("FLOWHOLD", 22), ("TURTLE", 28)):
    short(f"{name}, disarmed", "copter", (FAILED, {f"Mode change to {name} failed: init failed": 4}),
          lambda v, number=number: v.said(lambda: v.mode(number)))
short("SYSTEMID, disarmed", "copter",
      (FAILED, {"No axis selected, SID_AXIS = 0": 4, "Mode change to SYSTEMID failed: init failed": 4}),
      lambda v: v.said(lambda: v.mode(25)))
short("FOLLOW without FOLL_ENABLE", "copter", (FAILED, {"Set FOLL_ENABLE = 1": 4, "Mode change to FOLLOW failed: init failed": 4}),
      lambda v: v.said(lambda: v.mode(23)))
short("a mode that is not built in", "copter", (FAILED, {"No such mode 13": 4}), lambda v: v.said(lambda: v.mode(13)))
short("THROW, disarmed", "copter", ACCEPTED, lambda v: v.mode(18))
short("AUTO without a mission", "rover", (FAILED, {"No Mission. Can't set AUTO.": 5, "Flight mode change failed": 4}),
      lambda v: v.said(lambda: v.mode(ROVER_AUTO)))
short("MISSION_START without a mission", "rover", FAILED, lambda v: v.command(m.MAV_CMD_MISSION_START))


# ---- missions

@row("rover", ("Mission Complete", 5, (ROVER_AUTO, True), 5))
def stays_in_AUTO_and_armed_after_its_mission(v):
    assert v.upload([(16, (), 0, 0, 0), (16, (), 12, 0, 0)]) == 0
    assert v.mode(ROVER_AUTO) == ACCEPTED and v.arm() == ACCEPTED
    text = v.wait(lambda h: h.get_type() == "STATUSTEXT" and "omplete" in h.text, 60, "the end of its mission")
    v.listen(3)
    return text.text, text.severity, v.shown(), v.next("MISSION_CURRENT").mission_state


@row("copter", ((COPTER_AUTO, True), True))
def goes_on_when_it_meets_the_ground_in_AUTO(v):
    assert v.upload([(16, (), 0, 0, 0), (22, (), 0, 0, 8), (16, (), 200, 0, -30), (16, (), 400, 0, -30)]) == 0
    assert v.mode(COPTER_GUIDED) == ACCEPTED and v.arm() == ACCEPTED
    assert v.command(m.MAV_CMD_MISSION_START) == ACCEPTED
    v.wait(lambda h: h.get_type() == "STATUSTEXT" and h.text.startswith("SIM Hit ground"), 90, "the ground")
    first = v.next("GLOBAL_POSITION_INT")
    v.listen(6)
    later = v.next("GLOBAL_POSITION_INT")
    return v.shown(), (later.lat - first.lat) * 1e-7 * 111_320 > 2


@row("copter", (COPTER_GUIDED, True))
def goes_on_when_it_is_sent_into_the_ground_in_GUIDED(v):
    v.climb(8)
    lat, lon = v.place(60, 0)
    v.link.mav.set_position_target_global_int_send(0, v.system, 1, 6, 0b110111111000, lat, lon, -20, 0, 0, 0, 0, 0, 0, 0, 0)
    v.wait(lambda h: h.get_type() == "STATUSTEXT" and h.text.startswith("SIM Hit ground"), 90, "the ground")
    v.listen(3)
    return v.shown()


@row("copter", (0, 1))
def tells_mission_mode_1_in_AUTO_and_0_elsewhere(v):
    outside = v.next("MISSION_CURRENT").mission_mode
    v.mode(COPTER_AUTO)
    v.listen(0.5)
    return outside, v.next("MISSION_CURRENT").mission_mode


@row("copter", m.MAV_MISSION_DENIED)
def lets_nobody_read_a_mission_that_is_being_written(v):
    v.link.mav.mission_count_send(v.system, 1, 3, 0)
    v.next("MISSION_REQUEST")
    v.link.mav.mission_request_int_send(v.system, 1, 0, 0)
    answer = v.next("MISSION_ACK").type
    v.wait(lambda h: h.get_type() == "MISSION_ACK" and h.type == m.MAV_MISSION_OPERATION_CANCELLED, 30, "the end of the upload")
    return answer


def square(v, corners):
    points = [(40, 40), (40, -40), (-40, -40), (-40, 40)][:corners]
    return v.upload([(m.MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION, (corners,), n, e, 0) for n, e in points], 1)


short("a fence of four corners", "copter", (0, {"Fence Indexed OK": 7}), lambda v: v.said(lambda: square(v, 4)))
short("a fence of two corners", "copter", (1, {"Invalid vertex count (2)": 4, "Fence validation failed": 4}),
      lambda v: v.said(lambda: square(v, 2)))


# ---- commands

short("DO_SET_SERVO of a free channel", "copter", ACCEPTED, lambda v: v.command(m.MAV_CMD_DO_SET_SERVO, 9, 1500))
short("DO_SET_SERVO of a motor", "copter", (FAILED, {"ServoRelayEvent: Channel 1 is already in use": 6}),
      lambda v: v.said(lambda: v.command(m.MAV_CMD_DO_SET_SERVO, 1, 1500)))
short("DO_SET_SERVO of a channel that there is not", "copter", FAILED, lambda v: v.command(m.MAV_CMD_DO_SET_SERVO, 40, 1500))
short("DO_SET_RELAY of the first relay", "copter", ACCEPTED, lambda v: v.command(m.MAV_CMD_DO_SET_RELAY, 0, 1))
short("DO_SET_RELAY of one that is not set up", "copter", FAILED, lambda v: v.command(m.MAV_CMD_DO_SET_RELAY, 5, 1))
short("an interval of a message that it lacks", "copter", (DENIED, {"No ap_message for mavlink id (11050)": 6}),
      lambda v: v.said(lambda: v.command(m.MAV_CMD_SET_MESSAGE_INTERVAL, 11050, 100_000)))
short("a message that it lacks", "copter", FAILED, lambda v: v.command(m.MAV_CMD_REQUEST_MESSAGE, 11050))


@row("copter", (ACCEPTED, True, ACCEPTED, True))
def tells_its_version_and_its_home(v):
    answer, version = v.request("AUTOPILOT_VERSION")
    told, home = v.request("HOME_POSITION")
    return answer, any(version.flight_custom_version), told, all(math.isnan(q) for q in home.q)


# ---- parameters

@row("copter", (True, True, []))
def tells_that_its_sensors_are_calibrated(v):
    """By bits (gyroscope, accelerometer, compass, barometer), as newer MAVSDK asks, and by parameters that are not zero."""
    state = v.next("SYS_STATUS")
    return (state.onboard_control_sensors_present & 15 == 15, state.onboard_control_sensors_health & 15 == 15,
            [name for name in ("INS_ACCOFFS", "INS_GYROFFS", "COMPASS_OFS") for axis in "XYZ"
             if v.parameter(f"{name}_{axis}").param_value == 0])


for name, kind in (("FENCE_TYPE", m.MAV_PARAM_TYPE_INT8), ("FENCE_ACTION", m.MAV_PARAM_TYPE_INT8),
                   ("FENCE_ENABLE", m.MAV_PARAM_TYPE_INT8), ("RTL_ALT", m.MAV_PARAM_TYPE_INT32),
                   ("WPNAV_SPEED", m.MAV_PARAM_TYPE_REAL32), ("FENCE_RADIUS", m.MAV_PARAM_TYPE_REAL32),
                   ("SYSID_THISMAV", m.MAV_PARAM_TYPE_INT16), ("ARMING_CHECK", m.MAV_PARAM_TYPE_INT32),
                   ("BATT_CAPACITY", m.MAV_PARAM_TYPE_INT32), ("SR0_POSITION", m.MAV_PARAM_TYPE_INT16)):
    short(f"the type of {name}", "copter", kind, lambda v, name=name: v.parameter(name).param_type)


@row("copter", (m.MAV_PARAM_TYPE_INT8, 3.0, m.MAV_PARAM_TYPE_REAL32, 650.0))
def sets_a_parameter_whatever_type_is_said(v):
    fence, speed = v.parameter("FENCE_TYPE").param_value, v.parameter("WPNAV_SPEED").param_value
    whole = v.set_parameter("FENCE_TYPE", 3, m.MAV_PARAM_TYPE_REAL32)
    real = v.set_parameter("WPNAV_SPEED", 650, m.MAV_PARAM_TYPE_INT32)
    v.set_parameter("FENCE_TYPE", fence, m.MAV_PARAM_TYPE_INT8)
    v.set_parameter("WPNAV_SPEED", speed, m.MAV_PARAM_TYPE_REAL32)
    return whole.param_type, whole.param_value, real.param_type, real.param_value


class Files:
    """The protocol by hand: https://mavlink.io/en/services/ftp.html"""

    def __init__(self, vehicle):
        self.vehicle, self.seq = vehicle, 0

    def ask(self, opcode, data=b"", offset=0, size=None):
        self.seq = (self.seq + 1) % 65536
        packet = struct.pack("<HBBBBBBI", self.seq, 0, opcode, len(data) if size is None else size, 0, 0, 0, offset) + data
        self.vehicle.link.mav.file_transfer_protocol_send(0, self.vehicle.system, 1, list(packet.ljust(251, b"\0")))
        answer = self.vehicle.wait(lambda h: h.get_type() == "FILE_TRANSFER_PROTOCOL", 10, f"file operation {opcode}")
        payload = bytes(answer.payload)
        return payload[3], payload[12:12 + payload[4]]

    def read(self, path):
        self.ask(2)
        opened, _ = self.ask(4, path.encode())
        assert opened == 128, f"{path} is not there"
        content = b""
        while True:
            result, data = self.ask(5, offset=len(content), size=239)
            if result != 128:
                self.ask(1)
                return content, data
            content += data


@row("copter", (0x671B, True, True, 6))
def serves_its_parameters_as_a_file(v):
    content, end = Files(v).read("@PARAM/param.pck")
    magic, count, total = struct.unpack("<HHH", content[:6])
    return magic, count == total == v.parameter("RTL_ALT").param_count, b"WPNAV_" in content, end[0]


short("a file that there is not", "copter", (129, bytes([10])), lambda v: Files(v).ask(4, b"@PARAM/nothing.pck"))


# ---- telemetry

STREAMED = {"RAW_IMU", "SCALED_IMU2", "SCALED_PRESSURE", "SYS_STATUS", "POWER_STATUS", "MEMINFO", "MISSION_CURRENT",
            "GPS_RAW_INT", "NAV_CONTROLLER_OUTPUT", "SERVO_OUTPUT_RAW", "RC_CHANNELS", "GLOBAL_POSITION_INT",
            "LOCAL_POSITION_NED", "ATTITUDE", "AHRS2", "VFR_HUD", "AHRS", "SYSTEM_TIME", "BATTERY_STATUS",
            "EKF_STATUS_REPORT", "VIBRATION"}


@row("copter", set())
def streams_what_it_is_asked_for(v):
    """What is missing of it."""
    v.link.mav.request_data_stream_send(v.system, 1, 0, 4, 1)
    came = {h.get_type() for h in v.listen(3)}
    v.link.mav.request_data_stream_send(v.system, 1, 0, 4, 0)
    for name in ("EKF_STATUS_REPORT", "GLOBAL_POSITION_INT", "MISSION_CURRENT", "SYS_STATUS"):
        v.command(m.MAV_CMD_SET_MESSAGE_INTERVAL, getattr(m, f"MAVLINK_MSG_ID_{name}"), 200_000)
    return STREAMED - came


@row("copter", (True, True, True, True, True))
def feels_its_weight_at_rest(v):
    """Gravity, the earth's field, motors off, no vibration, the pressure of the place's height."""
    _, imu = v.request("RAW_IMU")
    _, servos = v.request("SERVO_OUTPUT_RAW")
    _, vibration = v.request("VIBRATION")
    _, pressure = v.request("SCALED_PRESSURE")
    field = math.hypot(imu.xmag, imu.ymag, imu.zmag)
    height = 44330 * (1 - (pressure.press_abs / 1013.25) ** 0.190295)
    return (abs(imu.zacc + 1000) < 60 and math.hypot(imu.xacc, imu.yacc) < 60, 250 < field < 650, servos.servo1_raw == 1000,
            vibration.vibration_x < 5 and vibration.clipping_0 == 0, abs(height - v.home.alt * 1e-3) < 60)


@row("copter", (True, True, True))
def feels_that_it_flies(v):
    """Its motors turn about alike, its second estimate is where the first is."""
    v.climb(8)
    v.listen(2)
    _, servos = v.request("SERVO_OUTPUT_RAW")
    _, ahrs = v.request("AHRS2")
    here = v.next("GLOBAL_POSITION_INT")
    motors = [servos.servo1_raw, servos.servo2_raw, servos.servo3_raw, servos.servo4_raw]
    return (all(1200 < motor < 1900 for motor in motors), max(motors) - min(motors) < 200,
            abs(ahrs.lat - here.lat) < 100 and abs(ahrs.altitude - here.alt * 1e-3) < 3)


def plain(value):
    """What is compared: a set stays one, a tuple of numbers and texts too; texts that any row may hear are left out."""
    if isinstance(value, dict):
        return {text: severity for text, severity in value.items() if not text.startswith(("PreArm", "EKF", "GPS", "AHRS"))}
    return tuple(plain(part) for part in value) if isinstance(value, tuple) else value


def ask_all(family: str, link: str, only: str):
    vehicle = Vehicle(link, family)
    wrong = []
    rows = [one for one in ROWS if one.vehicle == family and only in one.name]
    for one in rows:
        vehicle.rest()
        try:
            answer = plain(one.ask(vehicle))
            differs = answer != one.answer
        except AssertionError as error:
            answer, differs = error, True
        print(f"{'WRONG' if differs else 'like ' + one.seen}: {family}: {one.name}"
              + (f"\n    answered {answer}\n    expected {one.answer}" if differs else ""), flush=True)
        if differs:
            wrong.append(one.name)
    vehicle.rest()
    vehicle.link.close()
    return len(rows), wrong


def against_the_simulator(only):
    results = []
    for family in ("copter", "rover"):
        port = harness.free_udp_port()
        with harness.lapwing("sim", "--vehicles", family, "--out", f"udpout://127.0.0.1:{port}", "--speedup", "5"):
            results.append(ask_all(family, f"udpin:127.0.0.1:{port}", only))
    return results


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--against", action="append", default=os.environ.get("LAPWING_SITL", "").split(),
                        metavar="FAMILY=LINK", help="an ArduPilot: copter=udpin:127.0.0.1:14550")
    parser.add_argument("--only", default="", metavar="TEXT")
    options = parser.parse_args()
    if options.against:
        results = [ask_all(*named.split("=", 1), options.only) for named in options.against]
    else:
        print("no ArduPilot named (--against, LAPWING_SITL): the simulator alone")
        results = against_the_simulator(options.only)
    wrong = [name for _, names in results for name in names]
    assert not wrong, f"{len(wrong)} answers differ: {wrong}"
    print(f"{sum(count for count, _ in results)} answers as ArduPilot's")


main()
