"""Leads a survey drone into each of its states, with vision and planner played. Not a test itself."""

from drone import Operator
from drone_faults.played_survey import Survey
from ros_drone import RosDrone
from ros_robot import Point

LED = ("AutonomousExplore", "AutonomousMove", "CompulsiveMove", "DesiredLocationError", "NoParkingLotDetected")


def begin(operator: Operator, desired_m: float) -> None:
    """To the first heartbeat of a drone that may be armed soon."""
    operator.wait(lambda o: o.last, "the first heartbeat", 40)
    operator.command("Configure", Min=7, Des=desired_m, Max=desired_m + 10)


def lead_into(state: str, operator: Operator, ros: RosDrone, survey: Survey) -> None:
    """From Hover: by what operator, planner and vision say."""
    home = ros.home.position
    survey.sees_lot = True if state == "AutonomousExplore" else None
    survey.setpoint = survey.place_in_lot = None
    if state == "AutonomousExplore":
        operator.command("Autonomous Explore")
        survey.setpoint = Point(home.x + 40, home.y - 30, home.z + 10)
    elif state == "AutonomousMove":
        survey.place_in_lot = True
        operator.command("Autonomous Move", X=40, Y=30)
    elif state == "CompulsiveMove":
        operator.command("Compulsive Move", X=-60, Y=0)
    elif state == "DesiredLocationError":
        survey.place_in_lot = False
        operator.command("Autonomous Move", X=-30, Y=30)
    elif state == "NoParkingLotDetected":
        survey.sees_lot = False
        operator.command("Autonomous Explore")
    operator.wait_for_state(state, 15)
