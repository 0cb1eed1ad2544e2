"""Decisions and flight bridge of a survey drone are killed and stopped in flight: the others live on, what failed is named and started anew, and
the drone stays in hand or comes home. A supervisor that is stopped, or killed, leaves it on its way home, and no process behind."""

import os
import signal
import time

import harness
from drone import Drone, Operator, take_off
from ros_drone import RosDrone


def replaced(drone: Drone, name: str, before: int):
    """The pid of its successor."""
    return harness.wait_until(lambda: (pid := drone.pid(name)) and pid != before and pid or time.sleep(0.05), 20, f"{name} runs again")


with Drone() as drone:
    witness = RosDrone(drone.domain)
    operator = Operator(drone.port)
    take_off(operator)
    bridge, decide = drone.pid("bridge"), drone.pid("decide")

    # Decisions: their successor finds the drone flying, and goes on with it.
    os.kill(decide, signal.SIGKILL)
    drone.wait_for_log("decide killed by signal 9 (Killed); it is started again")
    replaced(drone, "decide", decide)
    operator.cut()
    operator.connect()
    operator.wait_for_state("Hover", 20)
    assert drone.pid("bridge") == bridge, "the bridge has lived on"
    assert witness.state.armed and witness.state.mode == "GUIDED" and witness.height.data > 5, (witness.state, witness.height)
    operator.command("Compulsive Move", X=10, Y=0)
    operator.wait_for_state("CompulsiveMove", 5)
    operator.wait_for_state("Hover", 40)

    # One that is stopped says nothing and does nothing: it is replaced as well.
    decide = drone.pid("decide")
    os.kill(decide, signal.SIGSTOP)
    drone.wait_for_log("decide stopped by signal 19")
    replaced(drone, "decide", decide)
    operator.cut()
    operator.connect()
    operator.wait_for_state("Hover", 20)

    # The bridge: without a flight controller there is no flying, so the drone comes home by what is heard last or next.
    decide = drone.pid("decide")
    os.kill(bridge, signal.SIGKILL)
    drone.wait_for_log("bridge killed by signal 9 (Killed); it is started again")
    replaced(drone, "bridge", bridge)
    assert drone.pid("decide") == decide, "who decides has lived on"
    harness.wait_until(lambda: operator.last["State"] in ("Hover", "Malfunction") and operator.last["Ardupilot State"] or time.sleep(0.05), 10,
                       "what became of it")
    # It may have been back before anybody missed it.
    time_out = time.monotonic() + 4
    while time.monotonic() < time_out and operator.last["State"] == "Hover":
        time.sleep(0.05)
    after = operator.last["State"]
    if after == "Hover":
        operator.command("Land")
    else:
        assert "flight controller" in (drone.folder / "state/malfunction.txt").read_text()
    operator.wait(lambda o: o.last["State"] == "Idle" and not o.last["Armed"], "it has come home", 90)
    print(f"without its bridge: {after}")

    # The supervisor is stopped in flight.
    take_off(operator)
    drone.onboard.send_signal(signal.SIGTERM)
    assert drone.onboard.wait(timeout=30) == 0
    assert any("left in mode RTL" in line for line in drone.log), drone.log[-8:]
    ends = [line for line in drone.log if " ended with exit code 0" in line]
    assert "decide" in ends[0] and "bridge" in ends[1], ends

    # It is started anew while the drone comes home by itself, and killed in the next flight.
    operator.cut()
    drone.log.clear()
    drone.start()
    harness.wait_until(lambda: drone.pid("decide") or time.sleep(0.05), 10, "it runs again")
    operator.connect()
    witness.wait(lambda w: not w.state.armed, "it has come home", 90)
    operator.wait(lambda o: o.last["State"] == "Idle" and o.last["Ardupilot State"] and not o.last["Armed"], "who decides sees it", 10)
    take_off(operator)
    children = [drone.pid("bridge"), drone.pid("decide")]
    drone.onboard.kill()
    drone.onboard.wait()
    witness.wait(lambda w: w.state.mode == "RTL", "RTL", 10)

    def are_gone() -> bool:
        return not any(os.path.exists(f"/proc/{pid}") for pid in children)

    harness.wait_until(lambda: are_gone() or time.sleep(0.1), 30, "its processes end by themselves")
