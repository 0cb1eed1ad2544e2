"""What an ArduCopter answers. Not a test itself."""

import math

from ardupilot.table import Rows
from ardupilot.vehicle import ACCEPTED, COPTER_AUTO, COPTER_GUIDED, FAILED, m

ROWS = Rows()

# ---- modes

ROWS.ask("AUTO without a mission, disarmed", (ACCEPTED, COPTER_AUTO),
         lambda v: (v.mode(COPTER_AUTO), v.shown()[0]))
ROWS.ask("MISSION_START without a mission, disarmed", (ACCEPTED, (COPTER_AUTO, False)),
         lambda v: (v.command(m.MAV_CMD_MISSION_START), v.shown()))
ROWS.ask("arming in AUTO without a mission", (FAILED, {"Arm: Mode requires mission": 2}),
         lambda v: (v.mode(COPTER_AUTO), v.said(v.arm))[1])
ROWS.ask("AUTO without a mission, armed", (FAILED, {"Mode change to AUTO failed: init failed": 4}),
         lambda v: (v.mode(COPTER_GUIDED), v.arm(), v.listen(1), v.said(lambda: v.mode(COPTER_AUTO), 0.5))[-1])
for name, number in (("FLIP", 14), ("AUTOTUNE", 15), ("FLOWHOLD", 22), ("TURTLE", 28)):
    ROWS.ask(f"{name}, disarmed", (FAILED, {f"Mode change to {name} failed: init failed": 4}),
             lambda v, number=number: v.said(lambda: v.mode(number)))
ROWS.ask("SYSTEMID, disarmed", (FAILED, {"No axis selected, SID_AXIS = 0": 4, "Mode change to SYSTEMID failed: init failed": 4}),
         lambda v: v.said(lambda: v.mode(25)))
ROWS.ask("FOLLOW without FOLL_ENABLE", (FAILED, {"Set FOLL_ENABLE = 1": 4, "Mode change to FOLLOW failed: init failed": 4}),
         lambda v: v.said(lambda: v.mode(23)))
ROWS.ask("a mode that is not built in", (FAILED, {"No such mode 13": 4}), lambda v: v.said(lambda: v.mode(13)))
ROWS.ask("THROW, disarmed", ACCEPTED, lambda v: v.mode(18))


# ---- missions

@ROWS.row(((COPTER_AUTO, True), True, 2, FAILED))
def stands_armed_when_it_meets_the_ground_in_AUTO(v):
    """To itself it flies: MAV_LANDED_STATE_IN_AIR, and it refuses to be disarmed."""
    assert v.upload([(16, (), 0, 0, 0), (22, (), 0, 0, 8), (16, (), 200, 0, -30), (16, (), 400, 0, -30)]) == 0
    assert v.mode(COPTER_GUIDED) == ACCEPTED and v.arm() == ACCEPTED
    assert v.command(m.MAV_CMD_MISSION_START) == ACCEPTED
    v.wait(lambda h: h.get_type() == "STATUSTEXT" and h.text.startswith("SIM Hit ground"), 90, "the ground")
    first = v.next("GLOBAL_POSITION_INT")
    v.listen(6)
    later = v.next("GLOBAL_POSITION_INT")
    stands = abs(later.lat - first.lat) * 1e-7 * 111_320 < 1
    _, state = v.request("EXTENDED_SYS_STATE")
    return v.shown(), stands, state.landed_state, v.command(m.MAV_CMD_COMPONENT_ARM_DISARM, 0)


@ROWS.row((COPTER_GUIDED, True))
def stays_armed_when_it_is_sent_into_the_ground_in_GUIDED(v):
    v.climb(8)
    lat, lon = v.place(60, 0)
    v.link.mav.set_position_target_global_int_send(0, v.system, 1, 6, 0b110111111000, lat, lon, -20, 0, 0, 0, 0, 0, 0, 0, 0)
    v.wait(lambda h: h.get_type() == "STATUSTEXT" and h.text.startswith("SIM Hit ground"), 90, "the ground")
    v.listen(3)
    return v.shown()


@ROWS.row((0, 1))
def tells_mission_mode_1_in_AUTO_and_0_elsewhere(v):
    outside = v.next("MISSION_CURRENT").mission_mode
    v.mode(COPTER_AUTO)
    v.listen(0.5)
    return outside, v.next("MISSION_CURRENT").mission_mode


# ---- parameters

for name, kind in (("RTL_ALT", m.MAV_PARAM_TYPE_INT32), ("WPNAV_SPEED", m.MAV_PARAM_TYPE_REAL32)):
    ROWS.ask(f"the type of {name}", kind, lambda v, name=name: v.parameter(name).param_type)


ROWS.ask("the offsets of its gyroscope are known", True,
         lambda v: all(v.parameter(f"INS_GYROFFS_{axis}").param_value for axis in "XYZ"))


# ---- telemetry

@ROWS.row((True, True, True, True, True))
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


@ROWS.row((True, True, True))
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


@ROWS.row((True, True, True))
def hears_its_speed_controllers(v):
    """Four of them, and more often as time goes by; and it tells where it steers in every mode."""
    _, first = v.request("ESC_TELEMETRY_1_TO_4")
    _, second = v.request("ESC_TELEMETRY_1_TO_4")
    _, steering = v.request("NAV_CONTROLLER_OUTPUT")
    return min(first.voltage) > 1000, min(second.count) != min(first.count), steering is not None
