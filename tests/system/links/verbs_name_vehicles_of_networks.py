"""`mission`, `param` and `signing` name vehicles of any network: a copter 1 and a rover north/1 at once, neither taken for the other."""

import json
import os
import pathlib
import tempfile
import tomllib

import harness

ports = harness.free_udp_port(), harness.free_udp_port()
LINKS = ("--link", f"udpin://127.0.0.1:{ports[0]}", "--link", f"north=udpin://127.0.0.1:{ports[1]}")


def points(*lats: float) -> str:
    coordinates = [[-8.598, lat, 0] for lat in lats]
    return json.dumps({"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": coordinates}}]})


with tempfile.TemporaryDirectory() as name, \
        harness.lapwing("sim", "--vehicles", "copter:1", "--out", f"udpout://127.0.0.1:{ports[0]}", "--speedup", "5"), \
        harness.lapwing("sim", "--vehicles", "rover:1", "--out", f"udpout://127.0.0.1:{ports[1]}", "--speedup", "5"):
    folder = pathlib.Path(name)
    environment = os.environ | {"XDG_CACHE_HOME": name}

    def lapwing(expected: int, *arguments: str) -> str:
        out, err = harness.expect_exit(expected, *arguments, env=environment, seconds=60)
        return out if expected == 0 else out + err

    # Who is meant has to be said where there are several, and what there is not is refused.
    said = lapwing(2, "param", "set", "SYSID_THISMAV=1", *LINKS)
    assert "there are 2 vehicles: 1, north/1" in said, said
    for verb in (("param", "list"), ("mission", "download"), ("mission", "clear", "--type", "all")):
        assert "there is no network south" in lapwing(2, *verb, "--vehicle", "south/1", *LINKS), verb
        assert "'north/0' names no vehicle" in lapwing(2, *verb, "--vehicle", "north/0", *LINKS), verb
    said = lapwing(3, "mission", "download", "--vehicle", "north/9", "--wait", "1.5", *LINKS)
    assert "vehicle north/9 was not heard within 1.5 s (heard: 1, north/1)" in said, said

    # Parameters, of all networks or of one.
    vehicles = json.loads(lapwing(0, "param", "list", "WP_SPEED", "WPNAV_SPEED", "--json", *LINKS))["vehicles"]
    assert [(each["id"], each.get("network")) for each in vehicles] == [(1, None), (1, "north")], vehicles
    assert [each["name"] for each in vehicles[1]["parameters"]] == ["WP_SPEED"], vehicles
    assert "vehicle north/1: WP_SPEED = 3" in lapwing(0, "param", "set", "WP_SPEED=3", "--vehicle", "north/1", *LINKS)
    both = json.loads(lapwing(1, "param", "compare", "1", "north/1", "--only", "WP_SPEED", "--json", *LINKS))
    assert both["second"] == "vehicle north/1" and both["differences"] == [{"name": "WP_SPEED", "first": None, "second": 3}], both

    # Plans.
    plan = folder / "line.geojson"
    plan.write_text(points(41.1781, 41.1782, 41.1783))
    lapwing(0, "mission", "upload", str(plan), "--altitude", "0", "--vehicle", "north/1", *LINKS)
    held = {vehicle: json.loads(lapwing(0, "mission", "download", "--type", "mission", "--vehicle", vehicle, "--json", *LINKS))
            for vehicle in ("1", "north/1")}
    assert (held["north/1"]["vehicle"], held["north/1"]["network"]) == (1, "north") and held["north/1"]["items"], held
    assert "network" not in held["1"] and not held["1"]["items"], held

    # Keys.
    store = folder / "fleet.keys"
    keys = ("--keys", str(store))
    for key in ("fleet", "own"):
        lapwing(0, "signing", "new", key, *keys)
    setup = ("signing", "setup", "--key", "own", "--overlap", "1", "--insecure-setup", *keys, *LINKS, "--vehicle")
    assert "there is no network south" in lapwing(2, *setup, "south/1")
    assert "vehicle north/1 signs with own" in lapwing(0, *setup, "north/1")
    assert tomllib.loads(store.read_text())["use"]["vehicles"] == {"north/1": ["own"]}, "the copter's key is not touched"
    assert "vehicle north/1: own" in lapwing(0, "signing", "show", *keys)
    assert "WP_SPEED" in lapwing(0, "param", "get", "WP_SPEED", "--vehicle", "north/1", "--signing-key", str(store), *LINKS)
    lapwing(1, "param", "get", "WP_SPEED", "--vehicle", "north/1", *LINKS)  # without the key it is not obeyed

# A script finds what a vehicle of a network carries.
with tempfile.TemporaryDirectory() as name, \
        harness.lapwing("sim", "--vehicles", "rover:1", "--out", f"udpout://127.0.0.1:{ports[1]}"):
    script = pathlib.Path(name, "pick.dolphin")
    script.write_text("v = pick { payload 'Sonar'; timeout 20.seconds }\nmessage 'found'\n")
    run = harness.expect_exit(0, "run", str(script), *LINKS, "--payload", "north/1=Sonar")
    assert "Selected nodes: { north/1 }" in run[0] + run[1], run
    _, err = harness.expect_exit(2, "run", str(script), *LINKS, "--forward", "south=udpout://127.0.0.1:9")
    assert "there is no network south" in err, err
print("each verb found its vehicle")
