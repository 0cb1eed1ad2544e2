"""The emergency stop over HTTP with vehicles of `lapwing sim` on real sockets: every vehicle is stopped and says so, a script is
halted with the reason, nothing can be moved until it is released, and a vehicle that appears later is stopped too."""

import harness
from station import Station

SCRIPT = """
vs = pick { count 2; type 'UAV'; timeout 60.seconds }
m = mission {
  home location(41.1780, -8.5980, 90)
  takeOff location(41.1780, -8.5980, 110)
  move 300, 0
  returnHomeAndLand()
}
execute vs: m | m
"""


def in_the_air(station, name):
    return station.vehicle(name).get("relative_alt_m", 0) > 5


link, web = harness.free_udp_port(), harness.free_tcp_port()
station = Station(web)
simulated = ["--home", "41.1780,-8.5980,90", "--speedup", "5", "--out", f"udpout://127.0.0.1:{link}"]
with harness.lapwing("station", "--link", f"udpin://127.0.0.1:{link}", "--port", str(web)) as program, \
        harness.lapwing("sim", "--vehicles", "copter:3,rover:1", *simulated):
    harness.wait_until(station.up, 20, "the station answers")
    station.is_ready(*"1234")

    # By hand: the ack matrix of a command to three, one of which cannot do it.
    outcomes = station.command("take_off", "3", "4", "9", height_m=12)
    assert outcomes[0]["state"] == "confirmed", outcomes
    assert outcomes[1] == {"vehicle": "4", "state": "refused", "reason": "rover 4 does not fly"}, outcomes
    assert outcomes[2]["reason"] == "there is no vehicle 9", outcomes
    harness.wait_until(lambda: in_the_air(station, "3"), 30, "copter 3 climbs")
    here = station.vehicle("3")["position"]
    there = {"lat_deg": here["lat_deg"] + 0.0005, "lon_deg": here["lon_deg"]}
    assert station.command("go_to", "3", **there)[0]["state"] == "confirmed"
    harness.wait_until(lambda: station.vehicle("3")["position"]["lat_deg"] > here["lat_deg"] + 0.0003, 30, "copter 3 goes there")
    assert station.vehicle("3")["control"]["commander"] == "tester"
    assert station.ask("control/request", {"vehicle": "3", "operator": "somebody"})[0] == 202
    assert station.vehicle("3")["control"]["asked_for_by"] == "somebody"
    assert station.ask("control/keep", {"vehicle": "3", "operator": "tester"})[0] == 202
    refused = station.ask("commands", {"action": "arm", "vehicles": ["3"], "operator": "somebody"})[1]["vehicles"][0]
    assert refused["reason"] == "copter 3 is commanded by tester", refused

    # A script flies the other two.
    assert station.ask("script", {"name": "two.dolphin", "source": SCRIPT})[0] == 202
    harness.wait_until(lambda: in_the_air(station, "1") and in_the_air(station, "2"), 90, "the script's copters fly")

    status, stop = station.ask("emergency-stop", {"operator": "tester"})
    assert status == 202 and stop["latched"] and stop["action"] == "hold", stop
    harness.wait_until(lambda: all(station.stopped(v)["confirmed"] for v in "1234"), 20, "all four have confirmed their stop")
    for name in "123":
        assert station.vehicle(name)["mode"] == "BRAKE", station.vehicle(name)
        assert station.stopped(name)["acknowledged"], station.stopped(name)
    assert not station.vehicle("4")["armed"]
    harness.wait_until(lambda: station.ask("script")[1]["state"] == "stopped", 20, "the script is halted")
    assert "emergency stop by tester" in station.ask("script")[1]["message"], station.ask("script")

    # Nothing moves while it is latched.
    outcome = station.command("start_mission", "1")[0]
    assert outcome["reason"] == "emergency stop by tester: release it first", outcome
    status, answer = station.ask("script", {"source": SCRIPT})
    assert status == 409 and "emergency stop" in answer["detail"], answer
    with harness.lapwing("sim", "--vehicles", "copter:1", "--first-id", "7", *simulated):
        harness.wait_until(lambda: station.stopped("7")["confirmed"], 30, "a vehicle that appears later is stopped too")

    # Stops are let through; a release moves nothing.
    assert station.command("land", "3")[0]["state"] == "confirmed"
    status, stop = station.ask("emergency-stop/release", {"operator": "tester"})
    assert status == 202 and not stop["latched"], stop
    assert station.vehicle("1")["mode"] == "BRAKE"
    assert station.command("rtl", "1", "2", take_over=True)[0]["state"] == "confirmed"
    assert program.poll() is None
print("every vehicle stopped, and stayed until it was released")
