"""Commands over HTTP to a copter of `lapwing sim` on real sockets that falls silent, is stopped and is sent far away: only what it has
shown since the command and of this command alone is told as done."""

import signal

import harness
from station import Station

link, web = harness.free_udp_port(), harness.free_tcp_port()
station = Station(web)
with harness.lapwing("station", "--link", f"udpin://127.0.0.1:{link}", "--port", str(web)), \
        harness.lapwing("sim", "--vehicles", "copter:1", "--home", "41.1780,-8.5980,90", "--speedup", "5",
                        "--out", f"udpout://127.0.0.1:{link}") as copter:
    harness.wait_until(station.up, 20, "the station answers")
    station.is_ready("1")

    # A take-off is done at its height, and says before how far it is.
    number = station.give("take_off", "1", height_m=40)
    under_way = station.comes_to(number, "under_way")
    assert under_way["reason"].endswith(" of 40 m") and under_way["left_m"] > 1, under_way
    done = station.comes_to(number, "confirmed")
    assert station.vehicle("1")["relative_alt_m"] > 38 and done["reason"] in ("at 39 m", "at 40 m"), done

    # On the way to a place it keeps its height.
    here = station.vehicle("1")["position"]
    there = {"lat_deg": here["lat_deg"] + 0.002, "lon_deg": here["lon_deg"]}  # 222 m
    number = station.give("go_to", "1", **there)
    under_way = station.comes_to(number, "under_way")
    assert under_way["reason"].endswith(" m to go") and 20 < under_way["left_m"] < 230, under_way
    assert station.comes_to(number, "confirmed")["reason"] == "there"
    assert abs(station.vehicle("1")["position"]["lat_deg"] - there["lat_deg"]) < 0.00003
    assert abs(station.vehicle("1")["relative_alt_m"] - 40) < 1.5, station.vehicle("1")

    # Being guided is no proof of going there; a stop cuts it short, and says so.
    number = station.give("go_to", "1", lat_deg=here["lat_deg"], lon_deg=here["lon_deg"] + 0.01)
    station.comes_to(number, "under_way")
    station.ask("emergency-stop", {"operator": "tester"})
    cut = station.comes_to(number, "cut_short")
    assert cut["reason"].startswith("emergency stop by tester, ") and cut["reason"].endswith(" to go"), cut
    harness.wait_until(lambda: station.stopped("1")["confirmed"], 20, "it is stopped")
    station.ask("emergency-stop/release", {"operator": "tester"})

    # Nothing of a silent vehicle counts: it was armed before.
    copter.send_signal(signal.SIGSTOP)
    harness.wait_until(lambda: station.vehicle("1")["age_s"]["heartbeat"] > 3, 20, "it is silent")
    assert station.vehicle("1")["armed"]
    arm = station.give("arm", "1")
    harness.wait_until(lambda: station.outcome(arm)["state"] not in ("waiting", "accepted"), 30, "the arming is over")
    assert station.outcome(arm)["state"] in ("expired", "timed_out"), station.outcome(arm)
    land = station.give("land", "1")
    assert station.comes_to(land, "timed_out", 60)["reason"], station.outcome(land)

    # It had the command in its socket, and lands when it goes on: that is corrected.
    copter.send_signal(signal.SIGCONT)
    station.comes_to(land, "under_way")
    assert station.comes_to(land, "confirmed", 90)["reason"] == "on the ground, motors off"
    assert not station.vehicle("1")["armed"]
print("what is told as done was done")
