"""`lapwing param` with vehicles of `lapwing sim`: list, get, set, save, load, compare, copy; over a bad link, too."""

import json
import os
import pathlib
import tempfile

import harness

port = harness.free_udp_port()
LINK = ("--link", f"udpin://127.0.0.1:{port}")

with tempfile.TemporaryDirectory() as folder, \
        harness.lapwing("sim", "--vehicles", "copter:2", "--out", f"udpout://127.0.0.1:{port}", "--speedup", "5"):
    environment = os.environ | {"XDG_CACHE_HOME": folder}

    def param(expected: int, *arguments: str):
        return harness.expect_exit(expected, "param", *arguments, env=environment, seconds=60)

    def told(expected: int, *arguments: str):
        return json.loads(param(expected, *arguments, *LINK, "--json")[0])

    # Reading: all, some, one. Values of vehicles that nobody chose are not changed.
    first, second = told(0, "list")["vehicles"]
    assert (first["id"], second["id"]) == (1, 2) and len(first["parameters"]) > 150, first["id"]
    assert first["confirmed"] == "vehicle" and first["firmware"] == "4.6.0", first
    values = {each["name"]: each["value"] for each in first["parameters"]}
    assert values["RTL_ALT"] == 1500 and values["SYSID_THISMAV"] == 1 and values["INS_ACCSCAL_X"] == 1.001, values
    some = told(0, "list", "wpnav_*", "--vehicle", "2")["vehicles"][0]["parameters"]
    assert {each["name"] for each in some} >= {"WPNAV_SPEED", "WPNAV_RADIUS"} and len(some) < 10, some
    assert told(0, "get", "RTL_ALT", "--vehicle", "2")["vehicles"][0]["parameters"] == [
        {"name": "RTL_ALT", "value": 1500, "type": "int32"}]
    _, err = param(2, "set", "RTL_ALT=2000", *LINK)
    assert "--vehicle ID" in err and "1, 2" in err, err
    assert "did not answer" in param(1, "get", "NO_SUCH", "--vehicle", "1", *LINK)[1]

    # Setting: what was stored is told; what its type cannot hold is not sent.
    done = told(0, "set", "RTL_ALT=2500", "WPNAV_SPEED=801.5", "RTL_SPEED=0", "--vehicle", "1")["vehicles"][0]
    assert done["changed"] == [{"name": "RTL_ALT", "before": 1500, "after": 2500},
                               {"name": "WPNAV_SPEED", "before": 1000, "after": 801.5}] and done["unchanged"] == 1, done
    failed = told(1, "set", "RTL_ALT=0.5", "RTL_ALT=20000001", "--vehicle", "1")["vehicles"][0]["failed"]
    assert "integer" in failed[0]["message"] and "floats" in failed[1]["message"], failed
    assert told(0, "get", "RTL_ALT", "--vehicle", "1")["vehicles"][0]["parameters"][0]["value"] == 2500

    # What was listed before is served when that will do, marked, and as later messages corrected it.
    old = told(0, "list", "--cached", "RTL_ALT", "--vehicle", "1")["vehicles"][0]
    assert old["confirmed"] == "no" and old["parameters"][0]["value"] == 2500, old

    # Comparing and copying: two vehicles differ in what was set and in what is their own, which stays theirs.
    found = told(1, "compare", "1", "2")["differences"]
    assert {each["name"] for each in found} == {"RTL_ALT", "WPNAV_SPEED"}, found
    everything = {each["name"] for each in told(1, "compare", "1", "2", "--all")["differences"]}
    assert everything >= {"RTL_ALT", "SYSID_THISMAV", "COMPASS_OFS_X"}, everything
    would = told(0, "copy", "1", "2", "--only", "RTL_*", "--dry-run")["vehicles"][0]
    assert [each["name"] for each in would["changed"]] == ["RTL_ALT"], would
    copied = told(0, "copy", "1", "2")["vehicles"][0]
    assert {each["name"] for each in copied["changed"]} == {"RTL_ALT", "WPNAV_SPEED"}, copied
    assert "SYSID_THISMAV" in copied["skipped"] and "COMPASS_OFS_X" in copied["skipped"], copied
    assert "the same" in param(0, "compare", "1", "2", *LINK)[0]

    # Files: QGroundControl's, and Mission Planner's by its ending.
    path, plain = str(pathlib.Path(folder, "one.params")), str(pathlib.Path(folder, "one.param"))
    param(0, "save", path, "--vehicle", "1", *LINK)
    param(0, "save", plain, "RTL_*", "--vehicle", "1", *LINK)
    lines = pathlib.Path(path).read_text().splitlines()
    assert lines[0] == "# Onboard parameters for Vehicle 1" and "1\t1\tRTL_ALT\t2500\t6" in lines, lines[:9]
    assert "RTL_ALT,2500" in pathlib.Path(plain).read_text()
    told(0, "set", "RTL_ALT=1000", "FENCE_RADIUS=77", "--vehicle", "1")
    assert len(told(1, "compare", path, "--vehicle", "1")["differences"]) == 2
    restored = told(0, "load", path, "--vehicle", "1", "--only", "RTL_*")["vehicles"][0]
    assert [each["name"] for each in restored["changed"]] == ["RTL_ALT"], restored
    told(0, "load", path, "--vehicle", "1")
    assert told(0, "compare", "1", path)["differences"] == []
    assert "the same" in param(0, "compare", path, path)[0]

    # Mistakes.
    broken = pathlib.Path(folder, "broken.param")
    broken.write_text("RTL_ALT,1500\nRTL_ALT;\n")
    assert "broken.param:2:" in param(2, "load", str(broken), "--vehicle", "1", *LINK)[1]
    assert "NAME=VALUE" in param(2, "set", "RTL_ALT", "--vehicle", "1", *LINK)[1]
    assert "heard: 1, 2" in param(3, "list", "--vehicle", "9", "--wait", "1", *LINK)[1]

# 30 % loss and 100 ms delay each way, both vehicles at once.
port = harness.free_udp_port()
with tempfile.TemporaryDirectory() as folder, \
        harness.lapwing("sim", "--vehicles", "copter:2", "--out", f"udpout://127.0.0.1:{port}", "--loss", "0.3", "--delay", "0.1"):
    environment = os.environ | {"XDG_CACHE_HOME": folder}
    out, _ = harness.expect_exit(0, "param", "list", "--json", "--link", f"udpin://127.0.0.1:{port}", env=environment)
    assert [{each["name"]: each["value"] for each in vehicle["parameters"]}["SYSID_THISMAV"]
            for vehicle in json.loads(out)["vehicles"]] == [1, 2]
print("parameters are managed")
