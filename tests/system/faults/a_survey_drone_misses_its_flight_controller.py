"""The flight controller of a survey drone falls silent in flight: that is a malfunction, which is told and written down, and once it is heard again
the drone comes home. Who knows no token does not command it."""

import os
import signal

import harness
from drone import Drone, Operator, take_off
from operator_link import Refused, Station
from ros_drone import RosDrone

drone = Drone(desk='token_file = "operator.token"')
token = drone.folder / "operator.token"
token.write_text("of this drone alone\n")
token.chmod(0o600)

with drone:
    witness = RosDrone(drone.domain)
    drone.wait_for_log("operators connect to port")
    for wrong in ("", "guessed"):
        try:
            Station(drone.port, token=wrong).connect()
            raise AssertionError("it came in")
        except Refused as refused:
            assert "token" in str(refused), refused
    operator = Operator(drone.port, token="of this drone alone")
    take_off(operator)

    os.kill(drone.simulator.pid, signal.SIGSTOP)
    try:
        operator.wait_for_state("Malfunction", 8)
        operator.wait(lambda o: o.last["Health Status"] == 1 and "the flight controller has been silent" in o.last["Health Reason"], "why")
    finally:
        os.kill(drone.simulator.pid, signal.SIGCONT)
    told = drone.folder / "state/malfunction.txt"
    harness.wait_until(lambda: told.exists() and "reason: the flight controller has been silent" in told.read_text(), 10, "what happened is written")
    witness.wait(lambda w: w.state.mode in ("RTL", "LAND"), "it comes down", 15)
    operator.wait(lambda o: o.last["State"] == "Idle" and not o.last["Armed"], "it has landed", 90)
    assert drone.health()["bridge"]["restarts"] == 0, drone.health()
    operator.cut()
    print("came home in mode", witness.state.mode)
