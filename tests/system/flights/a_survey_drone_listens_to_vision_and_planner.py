"""Vision and planner of a survey drone are played by a program on a foreign middleware: without them it does not arm, it explores by the planner's
setpoints, asks it about places, shows the map, and comes home when vision reports that it has failed."""

import math
import time

from drone import Drone, Operator, take_off
from drone_faults.played_survey import NO_TURN, Survey, header
from ros_drone import RosDrone
from ros_robot import MapMetaData, OccupancyGrid, Point, Pose, Time


def far_m(heartbeat: dict, x: float, y: float) -> float:
    return math.hypot(heartbeat["Local Position X"] - x, heartbeat["Local Position Y"] - y)


with Drone(decide='relies_on = ["vision", "planner"]') as drone:
    ros = RosDrone(drone.domain)
    operator = Operator(drone.port)
    operator.wait(lambda o: o.last and "vision has not reported yet" in o.last["Health Reason"], "vision is missed", 20)
    operator.wait(lambda o: o.last["Latitude"] is not None and o.last["Battery Percentage"], "the drone itself is ready", 40)
    operator.command("Arm")
    operator.wait_for_error("Arm is refused: vision has not reported yet")

    with Survey(ros) as survey:
        take_off(operator)
        home = ros.home.position
        survey.sees_lot = True
        operator.command("Autonomous Explore")
        operator.wait_for_state("AutonomousExplore", 5)
        survey.setpoint = Point(home.x + 12, home.y - 5, home.z + 11)
        operator.wait(lambda o: far_m(o.last, 12, -5) < 1.5 and abs(o.last["Relative Altitude"] - 11) < 1, "it is where the planner wants it", 40)
        # One that makes no sense is not flown.
        survey.setpoint = Point(home.x + 12, home.y - 5, home.z + 500)
        operator.wait_for_error("the planner's setpoint is refused")
        survey.sees_lot = False
        operator.wait_for_state("NoParkingLotDetected", 5)
        operator.wait(lambda o: o.last["User Error"] == 2, "No_Lot_Detected")
        survey.setpoint = survey.sees_lot = None

        operator.command("Autonomous Move", X=5, Y=6)
        operator.wait_for_state("AutonomousMove", 5)
        ros.wait(lambda r: r.wanted and math.hypot(r.wanted.pose.position.x - home.x - 5, r.wanted.pose.position.y - home.y - 6) < 0.1, "the planner is asked")
        survey.place_in_lot = True
        there = operator.wait_for_state("Hover", 40)
        assert far_m(there, 5, 6) < 2, there
        survey.place_in_lot = False
        operator.command("AutonomousMove", X=30, Y=30)
        operator.wait_for_state("DesiredLocationError", 5)
        operator.wait(lambda o: o.last["User Error"] == 1, "Desired_Location_Out_Of_Bounds")
        assert far_m(operator.last, 5, 6) < 3, operator.last

        info = MapMetaData(Time(0, 0), 0.5, 3, 2, Pose(Point(home.x - 1, home.y + 2, 0.0), NO_TURN))
        survey.maps.write(OccupancyGrid(header(), info, [0, 100, -1, 50, 0, 0]))
        operator.wait(lambda o: o.last["Occupancy Map"], "the map", 5)
        shown = operator.last["Occupancy Map"]
        assert (shown["Columns"], shown["Rows"], shown["Cells"]) == (3, 2, [0, 100, -1, 50, 0, 0]), shown
        assert abs(shown["Origin X"] + 1) < 0.01 and abs(shown["Origin Y"] - 2) < 0.01, shown

        operator.command("Autonomous Move", X=300, Y=0)
        operator.wait_for_error("Autonomous Move is refused")  # too far from what was seen of the lot

        survey.level, survey.words = 2, "the camera is gone"
        operator.wait_for_state("Malfunction", 5)
        operator.wait(lambda o: o.last["Health Status"] == 1 and "vision has failed: the camera is gone" in o.last["Health Reason"], "why")
        ros.wait(lambda r: r.state.mode == "RTL", "RTL", 5)
        drone.wait_for_log("diagnostics are in")  # a thread beside the decisions writes them
        assert "the camera is gone" in (drone.folder / "state/malfunction.txt").read_text()
        survey.level = 0
        operator.wait(lambda o: o.last["State"] == "Idle" and not o.last["Armed"], "it has landed", 90)
    operator.cut()
    print(f"{time.strftime('%H:%M:%S')}: flown with vision and planner of somebody else")
