"""The operator's link breaks in flight: the drone returns, and is his again when he is back before it is down. Kill stops its motors in the air."""

import time

from drone import Drone, Operator, take_off
from ros_drone import RosDrone

with Drone() as drone:
    witness = RosDrone(drone.domain)
    operator = Operator(drone.port)
    take_off(operator)
    operator.command("Compulsive Move", X=60, Y=0)
    operator.wait_for_state("CompulsiveMove", 5)
    operator.wait_for_state("Hover", 60)

    operator.cut()
    lost = time.monotonic()
    heard = len(operator.heartbeats)
    witness.wait(lambda w: w.decided and w.decided.data == "CommunicationLost", "CommunicationLost")
    late_s = time.monotonic() - lost
    assert 1.5 < late_s < 4.5, late_s  # counted from the last ping, which is up to a second old
    witness.wait(lambda w: w.state.mode == "RTL", "RTL", 5)

    operator.connect()
    operator.wait_for_error("the operator is heard again", 10)
    operator.wait_for_state("Hover", 10)
    witness.wait(lambda w: w.state.mode == "GUIDED", "GUIDED again", 5)
    assert all(one["State"] != "CommunicationLost" for one in operator.heartbeats[heard:]), "no heartbeat in CommunicationLost"

    # For good this time: it comes home by itself.
    operator.cut()
    witness.wait(lambda w: w.decided.data == "CommunicationLost", "CommunicationLost")
    witness.wait(lambda w: not w.state.armed, "it has landed", 120)
    assert abs(witness.pose.pose.position.x - witness.home.position.x) < 3 and abs(witness.pose.pose.position.y - witness.home.position.y) < 3
    operator.connect()
    operator.wait_for_state("Idle", 10)

    take_off(operator)
    killed = time.monotonic()
    operator.command("Kill")
    witness.wait(lambda w: not w.state.armed, "the motors have stopped", 5)
    stopped_s = time.monotonic() - killed
    assert stopped_s < 2, stopped_s
    operator.wait(lambda o: o.last["State"] == "Idle" and not o.last["Armed"], "the operator sees it", 5)
    operator.cut()
    print(f"lost after {late_s:.1f} s, killed after {stopped_s:.2f} s")
