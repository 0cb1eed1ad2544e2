"""What every ArduPilot answers. Not a test itself."""

import math
import struct

from ardupilot.files import Files
from ardupilot.table import Rows
from ardupilot.vehicle import ACCEPTED, DENIED, FAILED, m

ROWS = Rows()

# ---- plans

@ROWS.row(m.MAV_MISSION_DENIED)
def lets_nobody_read_a_mission_that_is_being_written(v):
    v.link.mav.mission_count_send(v.system, 1, 3, 0)
    v.next("MISSION_REQUEST")
    v.link.mav.mission_request_int_send(v.system, 1, 0, 0)
    answer = v.next("MISSION_ACK").type
    v.wait(lambda h: h.get_type() == "MISSION_ACK" and h.type == m.MAV_MISSION_OPERATION_CANCELLED, 30, "the end of the upload")
    return answer


@ROWS.row((0, 0, (0, 1)))
def begins_anew_with_a_second_count_in_mid_upload(v):
    """The next request, that after an item, and what came of it: (answer, items)."""
    v.link.mav.mission_count_send(v.system, 1, 4, 0)
    first = v.next("MISSION_REQUEST").seq
    v.link.mav.mission_item_int_send(v.system, 1, 0, 3, 16, 0, 1, 0, 0, 0, 0, *v.place(0, 0), 0, 0)
    v.wait(lambda h: h.get_type() == "MISSION_REQUEST" and h.seq == 1, 10, "the request for item 1")
    v.link.mav.mission_count_send(v.system, 1, 2, 0)
    again = v.next("MISSION_REQUEST").seq
    answer = v.upload([(16, (), 0, 0, 0), (16, (), 10, 0, 10)])
    v.link.mav.mission_request_list_send(v.system, 1, 0)
    return first, again, (answer, v.next("MISSION_COUNT").count - 1)


@ROWS.row((m.MAV_MISSION_DENIED, 1, 0))
def denies_a_second_count_of_another_station_in_mid_upload(v):
    """The answer to the other, the next request of the first, what came of the first."""
    v.link.mav.mission_count_send(v.system, 1, 2, 0)
    v.next("MISSION_REQUEST")
    mav = v.link.mav
    mav.srcSystem = 254
    mav.mission_count_send(v.system, 1, 3, 0)
    mav.srcSystem = 255
    denied = v.next("MISSION_ACK").type
    v.link.mav.mission_item_int_send(v.system, 1, 0, 3, 16, 0, 1, 0, 0, 0, 0, *v.place(0, 0), 0, 0)
    asked = v.wait(lambda h: h.get_type() == "MISSION_REQUEST" and h.seq == 1, 10, "the request for item 1").seq
    v.link.mav.mission_item_int_send(v.system, 1, 1, 3, 16, 0, 1, 0, 0, 0, 0, *v.place(10, 0), 10, 0)
    return denied, asked, v.next("MISSION_ACK").type


def square(v, corners):
    points = [(40, 40), (40, -40), (-40, -40), (-40, 40)][:corners]
    return v.upload([(m.MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION, (corners,), n, e, 0) for n, e in points], 1)


ROWS.ask("no fence any more", (0, {"Fence Indexed OK": 7}), lambda v: v.said(lambda: v.clear(m.MAV_MISSION_TYPE_FENCE)))
ROWS.ask("a mission of no items", (0, {"Flight plan received": 6}), lambda v: v.said(lambda: v.upload([])))
ROWS.ask("a fence of no items", (0, {"Fence Indexed OK": 7}), lambda v: v.said(lambda: v.upload([], m.MAV_MISSION_TYPE_FENCE)))
ROWS.ask("a fence of four corners", (0, {"Fence Indexed OK": 7}), lambda v: v.said(lambda: square(v, 4)))
ROWS.ask("a fence of two corners", (1, {"Invalid vertex count (2)": 4, "Fence validation failed": 4}),
         lambda v: v.said(lambda: square(v, 2)))


# ---- commands

ROWS.ask("DO_SET_SERVO of a free channel", ACCEPTED, lambda v: v.command(m.MAV_CMD_DO_SET_SERVO, 9, 1500))
ROWS.ask("DO_SET_SERVO of a channel in use", (FAILED, {"ServoRelayEvent: Channel 1 is already in use": 6}),
         lambda v: v.said(lambda: v.command(m.MAV_CMD_DO_SET_SERVO, 1, 1500)))
ROWS.ask("DO_SET_SERVO of a channel that there is not", FAILED, lambda v: v.command(m.MAV_CMD_DO_SET_SERVO, 40, 1500))
ROWS.ask("DO_SET_RELAY of the first relay", ACCEPTED, lambda v: v.command(m.MAV_CMD_DO_SET_RELAY, 0, 1))
ROWS.ask("DO_SET_RELAY of one that is not set up", FAILED, lambda v: v.command(m.MAV_CMD_DO_SET_RELAY, 5, 1))
ROWS.ask("an interval of a message that it lacks", (DENIED, {"No ap_message for mavlink id (11050)": 6}),
         lambda v: v.said(lambda: v.command(m.MAV_CMD_SET_MESSAGE_INTERVAL, 11050, 100_000)))
ROWS.ask("a message that it lacks", FAILED, lambda v: v.command(m.MAV_CMD_REQUEST_MESSAGE, 11050))


@ROWS.row((ACCEPTED, True, ACCEPTED, True))
def tells_its_version_and_its_home(v):
    answer, version = v.request("AUTOPILOT_VERSION")
    told, home = v.request("HOME_POSITION")
    return answer, any(version.flight_custom_version), told, all(math.isnan(q) for q in home.q)


# ---- parameters

@ROWS.row((True, True, []))
def tells_that_its_sensors_are_calibrated(v):
    """By bits (gyroscope, accelerometer, compass, barometer), as newer MAVSDK asks, and by parameters that are not zero."""
    state = v.next("SYS_STATUS")
    return (state.onboard_control_sensors_present & 15 == 15, state.onboard_control_sensors_health & 15 == 15,
            [name for name in ("INS_ACCOFFS", "COMPASS_OFS") for axis in "XYZ"
             if v.parameter(f"{name}_{axis}").param_value == 0])


for name, kind in (("FENCE_TYPE", m.MAV_PARAM_TYPE_INT8), ("FENCE_ACTION", m.MAV_PARAM_TYPE_INT8),
                   ("FENCE_ENABLE", m.MAV_PARAM_TYPE_INT8), ("FENCE_RADIUS", m.MAV_PARAM_TYPE_REAL32),
                   ("SYSID_THISMAV", m.MAV_PARAM_TYPE_INT16), ("ARMING_CHECK", m.MAV_PARAM_TYPE_INT32),
                   ("BATT_CAPACITY", m.MAV_PARAM_TYPE_INT32), ("SR0_POSITION", m.MAV_PARAM_TYPE_INT16)):
    ROWS.ask(f"the type of {name}", kind, lambda v, name=name: v.parameter(name).param_type)


@ROWS.row((m.MAV_PARAM_TYPE_INT8, 3.0, m.MAV_PARAM_TYPE_REAL32, 650.0))
def sets_a_parameter_whatever_type_is_said(v):
    fence, radius = v.parameter("FENCE_TYPE").param_value, v.parameter("FENCE_RADIUS").param_value
    whole = v.set_parameter("FENCE_TYPE", 3, m.MAV_PARAM_TYPE_REAL32)
    real = v.set_parameter("FENCE_RADIUS", 650, m.MAV_PARAM_TYPE_INT32)
    v.set_parameter("FENCE_TYPE", fence, m.MAV_PARAM_TYPE_INT8)
    v.set_parameter("FENCE_RADIUS", radius, m.MAV_PARAM_TYPE_REAL32)
    return whole.param_type, whole.param_value, real.param_type, real.param_value


@ROWS.row((0x671B, True, True, 6))
def serves_its_parameters_as_a_file(v):
    content, end = Files(v).read("@PARAM/param.pck")
    magic, count, total = struct.unpack("<HHH", content[:6])
    return magic, count == total == v.parameter("FENCE_TYPE").param_count, b"FENCE_" in content, end[0]


ROWS.ask("a file that there is not", (129, bytes([10])), lambda v: Files(v).ask(4, b"@PARAM/nothing.pck"))


# ---- telemetry

STREAMED = {"RAW_IMU", "SCALED_IMU2", "SCALED_PRESSURE", "SYS_STATUS", "POWER_STATUS", "MEMINFO", "MISSION_CURRENT",
            "GPS_RAW_INT", "SERVO_OUTPUT_RAW", "RC_CHANNELS", "GLOBAL_POSITION_INT",
            "LOCAL_POSITION_NED", "ATTITUDE", "AHRS2", "VFR_HUD", "AHRS", "SYSTEM_TIME", "BATTERY_STATUS",
            "EKF_STATUS_REPORT", "VIBRATION"}


@ROWS.row(set())
def streams_what_it_is_asked_for(v):
    """What is missing of it."""
    v.link.mav.request_data_stream_send(v.system, 1, 0, 4, 1)
    came = {h.get_type() for h in v.listen(3)}
    v.link.mav.request_data_stream_send(v.system, 1, 0, 4, 0)
    for name in ("EKF_STATUS_REPORT", "GLOBAL_POSITION_INT", "MISSION_CURRENT", "SYS_STATUS"):
        v.command(m.MAV_CMD_SET_MESSAGE_INTERVAL, getattr(m, f"MAVLINK_MSG_ID_{name}"), 200_000)
    return STREAMED - came
