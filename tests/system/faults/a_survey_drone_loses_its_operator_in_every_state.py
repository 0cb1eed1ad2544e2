"""The operator's link breaks in each state in turn: on the ground the motors stop, in the air the drone is on its way home within seconds, in nothing but CommunicationLost, and
his again when he is back; a drone that lands goes on landing. What comes over the link and makes no sense, in flight, is answered or refused, and changes nothing."""

import contextlib
import socket

from drone import Drone, Operator, arm
from drone_faults.drone_states import LED, begin, lead_into
from drone_faults.played_survey import Survey
from ros_drone import RosDrone

BACK = "the operator is heard again"


def lose(operator: Operator, ros: RosDrone) -> None:
    """Without a word, until the drone has noticed."""
    operator.cut()
    ros.wait(lambda r: r.decided.data == "CommunicationLost", "CommunicationLost", 8)
    ros.wait(lambda r: r.state.mode == "RTL" or not r.state.armed, "it returns", 8)


def come_back(operator: Operator, state: str) -> None:
    heard, told = len(operator.heartbeats), operator.errors.count(BACK)
    operator.connect()
    operator.wait_for_state(state, 10)
    assert all(one["State"] != "CommunicationLost" for one in operator.heartbeats[heard:]), "no heartbeat in CommunicationLost"
    if state == "Hover":
        operator.wait(lambda o: sum(BACK in one for one in o.errors) > told, "it is said", 5)


def talk_nonsense(operator: Operator) -> None:
    """In Hover, which it stays in."""
    for wrong, words in (("no json", "no JSON"), ('{"Type":"Fly"}', "there is no command 'Fly'"), ('{"Type":"Compulsive Move","X":1e999,"Y":0}', ""),
                         ('{"Type":"Compulsive Move","X":"far","Y":[]}', ""), ('{"Type":"Autonomous Move","X":5}', "Y"), ("[" * 3000, ""), ("", ""),
                         ('{"Type":"Configure","Min":-1,"Des":5,"Max":"high"}', ""), ('{"Type":"Arm"}', "Arm is not taken in Hover")):
        answered = len(operator.errors)
        operator.say(wrong)
        operator.wait(lambda o, since=answered: len(o.errors) > since, f"an answer to {wrong[:40]!r}", 10)
        assert words in operator.errors[-1], (wrong, operator.errors[-1])
    # What is no operator is shown the door.
    for garbage in (b"GET / HTTP/1.1\r\n\r\n", bytes(range(256)) * 64, b"LW\1\4\xff\xff\xff\xff"):
        with socket.create_connection(("127.0.0.1", operator.port), timeout=10) as stranger:
            with contextlib.suppress(OSError):
                stranger.sendall(garbage)
                stranger.shutdown(socket.SHUT_WR)
                while stranger.recv(65536):
                    pass
    assert operator.wait_for_state("Hover", 5)["Health Status"] == 0, operator.last


with Drone(decide="link_lost_s = 2") as drone:
    ros = RosDrone(drone.domain)
    operator = Operator(drone.port)
    begin(operator, desired_m=15)
    with Survey(ros) as survey:
        arm(operator)
        lose(operator, ros)
        ros.wait(lambda r: not r.state.armed and r.decided.data == "Idle", "the motors have stopped on the ground", 10)
        come_back(operator, "Idle")

        arm(operator)
        operator.command("Takeoff")
        operator.wait(lambda o: o.last["State"] == "Takeoff" and o.last["Relative Altitude"] > 2.5, "it climbs", 15)
        lose(operator, ros)
        come_back(operator, "Hover")
        assert operator.last["Relative Altitude"] > 2, operator.last
        for state in ("Hover", *LED):
            if state == "Hover":
                talk_nonsense(operator)
            else:
                lead_into(state, operator, ros, survey)
            lose(operator, ros)
            come_back(operator, "Hover")
            ros.wait(lambda r: r.state.mode == "GUIDED", "GUIDED again", 8)
            assert operator.last["User Error"] == 0, (state, operator.last)
            print(state)

    operator.command("Land")
    operator.wait_for_state("Land", 5)
    operator.cut()
    seen = set()
    ros.wait(lambda r: seen.add(r.decided.data) or not r.state.armed, "it has landed", 60)
    ros.wait(lambda r: r.decided.data == "Idle", "Idle", 5)
    assert seen <= {"Land", "Idle"}, seen
    come_back(operator, "Idle")
    operator.cut()
    assert all(one["restarts"] == 0 for one in drone.health().values()), drone.health()
