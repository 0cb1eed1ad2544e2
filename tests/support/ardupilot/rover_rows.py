"""What an ArduRover answers. Not a test itself."""

from ardupilot.table import Rows
from ardupilot.vehicle import ACCEPTED, FAILED, ROVER_AUTO, m

ROWS = Rows()

# ---- modes

ROWS.ask("AUTO without a mission", (FAILED, {"No Mission. Can't set AUTO.": 5, "Flight mode change failed": 4}),
         lambda v: v.said(lambda: v.mode(ROVER_AUTO)))
ROWS.ask("MISSION_START without a mission", FAILED, lambda v: v.command(m.MAV_CMD_MISSION_START))
ROWS.ask("INITIALISING", (FAILED, {"Flight mode change failed": 4}), lambda v: v.said(lambda: v.mode(16)))
ROWS.ask("a mode that is not built in", (FAILED, {"No such mode 14": 4}), lambda v: v.said(lambda: v.mode(14)))
ROWS.ask("arming", (ACCEPTED, {"Throttle armed": 6}), lambda v: v.said(v.arm))


# ---- missions



@ROWS.row(("Mission Complete", 5, (ROVER_AUTO, True), 5))
def stays_in_AUTO_and_armed_after_its_mission(v):
    assert v.upload([(16, (), 0, 0, 0), (16, (), 12, 0, 0)]) == 0
    assert v.mode(ROVER_AUTO) == ACCEPTED and v.arm() == ACCEPTED
    text = v.wait(lambda h: h.get_type() == "STATUSTEXT" and "omplete" in h.text, 60, "the end of its mission")
    v.listen(3)
    return text.text, text.severity, v.shown(), v.next("MISSION_CURRENT").mission_state


# ---- telemetry

@ROWS.row((False, True, False))
def tells_where_it_steers_in_automatic_modes_only(v):
    """And no speed controller speaks."""
    _, hold = v.request("NAV_CONTROLLER_OUTPUT")
    v.mode(15)
    _, guided = v.request("NAV_CONTROLLER_OUTPUT")
    _, controllers = v.request("ESC_TELEMETRY_1_TO_4")
    return hold is not None, guided is not None, controllers is not None
