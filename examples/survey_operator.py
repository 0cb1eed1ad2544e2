"""An operator of a survey drone in plain Python: configures it, takes off, flies somewhere or lets it survey by itself, and lands. The drone:
docs/guide/survey-drone.md.

    python3 survey_operator.py 3000
    python3 survey_operator.py 3000 survey
"""

import json
import socket
import sys
import time

link = socket.create_connection(("127.0.0.1", int(sys.argv[1]) if len(sys.argv) > 1 else 3000), timeout=120)
lines = link.makefile("r")


def say(kind, **fields):
    link.sendall((json.dumps({"Type": kind, **fields}) + "\n").encode())


def wait(state, is_armed=None):
    """Until a heartbeat tells it. A copter that was just switched on refuses to arm for a while, so it is asked again."""
    for line in lines:
        message = json.loads(line)
        if message["Type"] == "ErrorLog":
            print("drone:", message["Message"])
            if "Arm is refused" in message["Message"]:
                time.sleep(1)
                say("Arm")
        elif message["State"] == state and is_armed in (None, message["Armed"]):
            print(state)
            return message
    raise SystemExit("the drone has closed the link")


def wait_for_words(words):
    for line in lines:
        message = json.loads(line)
        if message["Type"] == "ErrorLog":
            print("drone:", message["Message"])
            if words in message["Message"]:
                return
    raise SystemExit("the drone has closed the link")


say("Configure", Min=7, Des=10, Max=20)
say("Arm")
wait("Arm", is_armed=True)
say("Takeoff")
wait("Hover")
if sys.argv[2:] == ["survey"]:
    say("Autonomous Explore")
    wait("AutonomousExplore")
    wait_for_words("the survey is over")
else:
    say("Compulsive Move", X=20, Y=10)
    wait("CompulsiveMove")
    there = wait("Hover")
    print(f"there: {there['Local Position X']:.0f} m east, {there['Local Position Y']:.0f} m north, {there['Relative Altitude']:.0f} m up")
say("Land")
wait("Idle", is_armed=False)
