"""Kill, by an operator, in each of some states of a survey drone: from the press until the motors have stopped. Not a test itself."""

import time

from drone import Drone, Operator, arm, take_off
from drone_faults.drone_states import LED, begin, lead_into
from drone_faults.played_survey import Survey
from ros_drone import RosDrone

MOST_S = 1.5  # the flight controller's heartbeats, by which it is seen, are a second apart


def _enter(state: str, operator: Operator, ros: RosDrone, survey: Survey) -> None:
    """From Idle."""
    (arm if state in ("Arm", "Takeoff") else take_off)(operator)
    if state == "Takeoff":
        operator.command("Takeoff")
    elif state in LED:
        lead_into(state, operator, ros, survey)
    elif state == "Land":
        operator.command("Land")
    elif state == "Malfunction":
        survey.level, survey.words = 2, "the camera is gone"
    ros.wait(lambda r: r.decided.data == state, state, 10)


def _press(state: str, operator: Operator, ros: RosDrone) -> float:
    """Seconds until the flight controller says that it is disarmed."""
    assert ros.state.armed, (state, ros.state)
    pressed = time.monotonic()
    operator.command("Kill")
    ros.wait(lambda r: not r.state.armed, f"the motors have stopped, from {state}", 5)
    took_s = time.monotonic() - pressed
    operator.wait(lambda o: o.last["State"] == "Idle" and not o.last["Armed"], "the operator sees it", 5)
    print(f"{state}: {took_s:.2f} s")
    return took_s


def kill_in(*states: str) -> None:
    """Each in a flight of its own: soon after the press the motors have stopped and the drone is in Idle, takes nothing else until that is sure, and flies again when told."""
    took = {}
    with Drone(decide='relies_on = ["vision", "planner"]') as drone:
        ros = RosDrone(drone.domain)
        with Survey(ros) as survey:
            operator = Operator(drone.port)
            begin(operator, desired_m=7.5)
            for state in states:
                survey.level = 0
                _enter(state, operator, ros, survey)
                took[state] = _press(state, operator, ros)
                told = len(operator.errors)
                operator.command("Arm")
                operator.wait(lambda o, since=told: any("Kill stops the motors" in one for one in o.errors[since:]), "Arm is refused until it is sure", 10)
        operator.cut()
        assert all(one["restarts"] == 0 for one in drone.health().values()), drone.health()
    assert max(took.values()) < MOST_S, took
