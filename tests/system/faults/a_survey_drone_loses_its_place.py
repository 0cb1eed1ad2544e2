"""A survey drone loses GPS in flight: it cannot return, and lands where it is, as a Malfunction that is told and written down; it is not armed again before it knows where it
is. Then its flight bridge is stopped in flight, and replaced: the drone hovers on or comes home."""

import os
import signal
import time

import harness
from drone import Drone, Operator, take_off
from ros_drone import RosDrone, integer


def show_satellites(ros: RosDrone, are_shown: bool) -> None:
    """Newer ArduPilots have the switch the other way round."""
    is_set = any(ros.set_parameter(False, name, integer(int(value))).success
                 for name, value in (("SIM_GPS_DISABLE", not are_shown), ("SIM_GPS1_ENABLE", are_shown)))
    assert is_set, "no switch for satellites"


with Drone() as drone:
    ros = RosDrone(drone.domain)
    operator = Operator(drone.port)
    take_off(operator)
    show_satellites(ros, False)
    operator.wait_for_state("Malfunction", 15)
    operator.wait(lambda o: "does not know where it is" in o.last["Health Reason"], "why")
    written = drone.folder / "state/malfunction.txt"
    harness.wait_until(lambda: written.exists() and "does not know where it is" in written.read_text(), 5, "it is written down")
    ros.wait(lambda r: r.state.mode == "LAND", "it lands, since it cannot return", 15)
    operator.wait(lambda o: o.last["State"] == "Idle" and not o.last["Armed"], "it has landed", 60)
    told = len(operator.errors)
    operator.command("Arm")
    operator.wait(lambda o: any("Arm is refused" in one for one in o.errors[told:]), "it is not armed so", 10)
    print(operator.errors[-1])
    show_satellites(ros, True)

    take_off(operator)
    bridge, decide = drone.pid("bridge"), drone.pid("decide")
    os.kill(bridge, signal.SIGSTOP)
    drone.wait_for_log("bridge stopped by signal 19")
    harness.wait_until(lambda: (pid := drone.pid("bridge")) and pid != bridge or time.sleep(0.05), 20, "bridge runs again")
    assert drone.pid("decide") == decide, "who decides has lived on"
    heard = len(operator.heartbeats)
    operator.wait(lambda o: len(o.heartbeats) > heard + 4, "it goes on speaking", 10)
    after = operator.last["State"]
    assert after in ("Hover", "Malfunction"), operator.last
    if after == "Hover":
        operator.command("Land")
    operator.wait(lambda o: o.last["State"] == "Idle" and not o.last["Armed"], "it has come home", 60)
    operator.cut()
    print(f"without its bridge: {after}")
