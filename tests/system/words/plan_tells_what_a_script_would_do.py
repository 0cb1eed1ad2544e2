"""`lapwing plan` flies scripts on the simulator: what it prints, writes and exits with."""

import json
import pathlib
import tempfile
import xml.etree.ElementTree

import harness

SQUARE = """
base = location(41.1780, -8.5980, 90)
there = mission { name 'There'; home base; takeOff location(41.1780, -8.5980, 110); move 60, 0; returnHomeAndLand() }
v = pick { type 'UAV'; timeout 30.seconds }
execute v: there
message 'back'
"""


def fence(east_m: float, **properties):
    """A rectangle 200 m north and south of home that ends so far east of it."""
    lat, lon, deg_lat, deg_lon = 41.1780, -8.5980, 1 / 111_060, 1 / 83_900
    corners = [(-200, -200), (-200, east_m), (200, east_m), (200, -200), (-200, -200)]
    ring = [[lon + east * deg_lon, lat + north * deg_lat] for north, east in corners]
    return json.dumps({"type": "Feature", "properties": properties, "geometry": {"type": "Polygon", "coordinates": [ring]}})


def expect(text: str, *words: str):
    for word in words:
        assert word in text, f"no {word!r} in\n{text}"


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)

    def script(text: str) -> str:
        path = folder / "script.dolphin"
        path.write_text(text)
        return str(path)

    def write(file: str, text: str) -> str:
        (folder / file).write_text(text)
        return str(folder / file)

    # The same flight each time, with the vehicles that the script picks, at its home.
    report, picture = folder / "plan.json", folder / "plan.svg"
    out, _ = harness.expect_exit(0, "plan", script(SQUARE), "--json", str(report), "--svg", str(picture))
    expect(out, "--vehicles copter:1", "done after", "There", "NAV_TAKEOFF", "back", "battery 100 ->", "Wh")
    first = report.read_text()
    again, _ = harness.expect_exit(0, "plan", script(SQUARE), "--json", str(report))
    assert again == out and report.read_text() == first, "two dry runs of one script differ"
    assert xml.etree.ElementTree.fromstring(picture.read_text()).tag.endswith("svg")
    plan = json.loads(first)
    copter = plan["vehicles"][0]
    assert plan["outcome"] == "done" and abs(plan["home"]["lat_deg"] - 41.1780) < 1e-9
    assert 150 < copter["track_m"] < 180, copter["track_m"]
    assert 19 < copter["highest_m"] < 22 and not copter["ends_in_the_air"]
    assert 0 < copter["battery_used"] < 0.2 and copter["energy_wh"] > 1
    assert [mission["name"] for mission in copter["missions"]] == ["There"]
    times = [row[0] for row in copter["track"]]
    assert times == sorted(times) and len(times) > 100

    # Fences.
    out, _ = harness.expect_exit(0, "plan", script(SQUARE), "--fence", write("wide.geojson", fence(100)))
    expect(out, "fence: kept by all")
    out, _ = harness.expect_exit(1, "plan", script(SQUARE), "--fence", write("low.geojson", fence(100, max_height_m=15)))
    expect(out, "fence: 1 breach", "5.0", "in height")
    out, _ = harness.expect_exit(1, "plan", script(SQUARE.replace("60, 0", "0, 60")), "--fence", write("narrow.geojson", fence(30)))
    expect(out, "copter 1 leaves 'zone 1'", "m outside")
    _, err = harness.expect_exit(2, "plan", script(SQUARE), "--fence", write("bad.geojson", '{"type":"Point"}'))
    expect(err, "bad.geojson", "coordinates")

    # Scripts that never end, and those that let no time pass.
    patrol = SQUARE.replace("execute v: there", "while (true) { execute v: there }")
    out, _ = harness.expect_exit(3, "plan", script(patrol), "--timeout", "600")
    expect(out, "unfinished after 10:0", "at the end:", "There")
    out, _ = harness.expect_exit(3, "plan", script("while (true) { x = 1 }"))
    expect(out, "no time pass")

    # What goes wrong in the script, and before it.
    out, _ = harness.expect_exit(1, "plan", script("throw new Exception('no')"))
    expect(out, "error")
    _, err = harness.expect_exit(2, "plan", script("messag 'x'"))
    expect(err, "message")
    _, err = harness.expect_exit(2, "plan", script("v = pick { id '7' }"))
    expect(err, "script.dolphin:1", "--vehicles")
    _, err = harness.expect_exit(2, "plan", script("v = pick { type 'Balloon' }"))
    expect(err, "UUV", "copters")
    for wrong in (["--wind", "5"], ["--wind", "-5,0"], ["--home", "1"], ["--vehicles", "ship"], ["--timeout", "0"]):
        _, err = harness.expect_exit(2, "plan", script(SQUARE), *wrong)
        expect(err, wrong[1])
    expect(harness.expect_exit(2, "plan", script(SQUARE), "--wind", "0,5")[1], "SPEED,FROM", "5,270")
    out, _ = harness.expect_exit(0, "plan", script(SQUARE), "--wind", "5,270,1")
    expect(out, "wind 5.0 m/s from 270°, gusts 1.0 m/s")

    # Questions are answered from a file.
    asking = "who = ask('who? ')\nmessage who"
    out, _ = harness.expect_exit(0, "plan", script(asking), "--answers", write("answers.txt", "me\n"))
    expect(out, "who? me", "Program message: me")
    out, _ = harness.expect_exit(1, "plan", script(asking))
    expect(out, "--answers")
print("plans tell what scripts would do")
