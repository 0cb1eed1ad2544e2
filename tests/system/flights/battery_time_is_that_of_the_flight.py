"""The time that a battery lasts, as the station tells it of a copter of `lapwing sim` with 5 Ah: nothing while it stands, and from 20 s
after take-off within 15 % of what it could go on hovering, also in a second flight after it has stood."""

import harness
from station import Station

SPEEDUP = 10
HOVER_A = 16.5


def truth_s(battery):
    return (5.0 - battery["consumed_ah"]) * 3600.0 / HOVER_A


def fly(what):
    """Takes off, hovers for a minute of the vehicle's time, lands; the worst that was told, as a share of the truth."""
    station.give("take_off", "1", height_m=40)
    harness.wait_until(lambda: station.vehicle("1").get("relative_alt_m", 0) > 38.5, 30, "it is up")
    begun = station.vehicle("1")["battery"]["consumed_ah"]
    seen = []

    def has_hovered():
        battery = station.vehicle("1")["battery"]
        drawn_s = (battery["consumed_ah"] - begun) * 3600.0 / HOVER_A
        assert drawn_s < 8 or "time_left_s" in battery, (what, battery)
        if drawn_s > 4 and "time_left_s" in battery:  # it has climbed for 16 s
            told, error, truth = battery["time_left_s"], battery["time_left_error_s"], truth_s(battery)
            assert abs(told / truth - 1) < 0.15, (what, told, truth, battery)
            assert abs(told - truth) < error + 20, (what, told, error, truth)
            seen.append(told / truth)
        return drawn_s > 60

    harness.wait_until(has_hovered, 60, "it has hovered for a minute")
    station.give("land", "1")
    harness.wait_until(lambda: not station.vehicle("1")["armed"], 60, "it has landed")
    return min(seen), max(seen)


link, web = harness.free_udp_port(), harness.free_tcp_port()
station = Station(web)
with harness.lapwing("station", "--link", f"udpin://127.0.0.1:{link}", "--port", str(web)), \
        harness.lapwing("sim", "--vehicles", "copter:1", "--speedup", str(SPEEDUP), "--out", f"udpout://127.0.0.1:{link}"):
    harness.wait_until(station.up, 20, "the station answers")
    station.is_ready("1")

    def has_stood_until(drawn_ah):
        """0.5 A flow while it stands."""
        battery = station.vehicle("1").get("battery", {})
        assert "time_left_s" not in battery, battery
        return battery.get("consumed_ah", 0) >= drawn_ah

    harness.wait_until(lambda: has_stood_until(0.015), 60, "it has stood for two minutes")
    first = fly("first flight")
    drawn = station.vehicle("1")["battery"]["consumed_ah"]
    harness.wait_until(lambda: has_stood_until(drawn + 0.025), 60, "it has stood for three minutes")
    told = station.vehicle("1")["battery"]
    assert abs(told["in_flight_s"] / truth_s(told) - 1) < 0.15, told
    second = fly("second flight")
    print(f"told / true: first flight {first[0]:.2f}..{first[1]:.2f}, second {second[0]:.2f}..{second[1]:.2f}")
