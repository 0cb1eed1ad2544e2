"""What an ArduPlane answers. Not a test itself."""

from ardupilot.table import Rows
from ardupilot.vehicle import ACCEPTED, FAILED, m

FBWA, AUTO, RTL, TAKEOFF, GUIDED = 5, 10, 11, 13, 15
ENDED = {"Mission complete, changing mode to RTL": 6}

ROWS = Rows()

# ---- modes

ROWS.ask("AUTO without a mission", ((ACCEPTED, ENDED), (RTL, False)), lambda v: (v.said(lambda: v.mode(AUTO)), v.shown()))
ROWS.ask("MISSION_START without a mission", ((ACCEPTED, ENDED), (RTL, False)),
         lambda v: (v.said(lambda: v.command(m.MAV_CMD_MISSION_START)), v.shown()))
ROWS.ask("arming in RTL", (FAILED, {"Arm: RTL mode not armable": 2}), lambda v: (v.mode(RTL), v.said(v.arm))[1])
for name, number in (("QSTABILIZE", 17), ("QLOITER", 19), ("QLAND", 20), ("QRTL", 21)):
    ROWS.ask(f"{name} of one that does not hover", (FAILED, {"Q_ENABLE 0": 6}),
             lambda v, number=number: v.said(lambda: v.mode(number)))
ROWS.ask("THERMAL without soaring", (FAILED, {"Flight mode change failed": 4}), lambda v: v.said(lambda: v.mode(24)))
ROWS.ask("INITIALISING", (FAILED, {"Flight mode change failed": 4}), lambda v: v.said(lambda: v.mode(16)))
ROWS.ask("a mode that is not built in", (FAILED, {"No such mode 9": 4}), lambda v: v.said(lambda: v.mode(9)))
ROWS.ask("arming", (ACCEPTED, {"Throttle armed": 6}), lambda v: (v.mode(FBWA), v.said(v.arm))[1])
ROWS.ask("disarming", (ACCEPTED, {"Throttle disarmed": 6}),
         lambda v: (v.mode(FBWA), v.arm(), v.listen(1), v.said(lambda: v.command(m.MAV_CMD_COMPONENT_ARM_DISARM, 0)))[-1])
ROWS.ask("NAV_TAKEOFF on the ground", FAILED,
         lambda v: (v.mode(GUIDED), v.arm(), v.command(m.MAV_CMD_NAV_TAKEOFF, 0, 0, 0, 0, 0, 0, 30))[-1])
ROWS.ask("DO_LAND_START without a landing", (FAILED, {"Unable to start landing sequence": 4}),
         lambda v: v.said(lambda: v.command(m.MAV_CMD_DO_LAND_START)))


# ---- telemetry

@ROWS.row((False, True, [2]))
def tells_where_it_steers_in_every_mode_but_MANUAL(v):
    """And the speed controller of its only motor speaks, that on the third output."""
    _, manual = v.request("NAV_CONTROLLER_OUTPUT")
    v.mode(FBWA)
    _, fly_by_wire = v.request("NAV_CONTROLLER_OUTPUT")
    _, controllers = v.request("ESC_TELEMETRY_1_TO_4")
    return manual is not None, fly_by_wire is not None, [n for n in range(4) if controllers.voltage[n] > 1000]


@ROWS.row((True, True))
def tells_its_airspeed_error_in_hundredths(v):
    """Nearly none on the ground; hundreds while it takes off and lacks some metres a second."""
    v.mode(TAKEOFF)
    _, ground = v.request("NAV_CONTROLLER_OUTPUT")
    v.command(m.MAV_CMD_SET_MESSAGE_INTERVAL, m.MAVLINK_MSG_ID_NAV_CONTROLLER_OUTPUT, 20_000)
    v.arm()
    rolling = v.wait(lambda h: h.get_type() == "NAV_CONTROLLER_OUTPUT" and h.aspd_error > 100, 20, "a great error of its airspeed")
    v.command(m.MAV_CMD_SET_MESSAGE_INTERVAL, m.MAVLINK_MSG_ID_NAV_CONTROLLER_OUTPUT, -1)
    return abs(ground.aspd_error) < 100, rolling.aspd_error < 3000


# ---- missions: last, for they leave it elsewhere

@ROWS.row((("Mission complete, changing mode to RTL", 6), (RTL, True)))
def returns_after_its_mission(v):
    assert v.upload([(16, (), 0, 0, 0), (22, (12,), 0, 0, 30), (16, (), 400, 0, 40)]) == 0
    assert v.mode(AUTO) == ACCEPTED and v.arm() == ACCEPTED
    end = v.wait(lambda h: h.get_type() == "STATUSTEXT" and "omplete, ch" in h.text, 90, "the end of its mission")
    v.listen(1)
    return (end.text, end.severity), v.shown()
