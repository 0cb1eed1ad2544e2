"""`lapwing mission`: plans between files and vehicles, verified, on good links and bad ones, and never half."""

import json
import pathlib
import signal
import subprocess
import tempfile
import time

import harness
from mavlink_peer import Peer

HOME = "41.178,-8.598,90"
MISSION = [(22, 41.1780, -8.598, 20), (16, 41.1785, -8.598, 25), (16, 41.1785, -8.597, 25), (16, 41.1790, -8.597, 30),
           (16, 41.1790, -8.598, 30), (16, 41.1795, -8.598, 30)]


def item(number: int, command: int, lat: float, lon: float, height: float) -> dict:
    return {"type": "SimpleItem", "autoContinue": True, "command": command, "doJumpId": number, "frame": 3,
            "params": [0, 0, 0, None if command == 16 else 0, lat, lon, height]}


def plan_of(items, with_rest: bool = True) -> str:
    plan = {"fileType": "Plan", "version": 1, "groundStation": "QGroundControl",
            "mission": {"version": 2, "firmwareType": 3, "plannedHomePosition": [41.178, -8.598, 90],
                        "items": [item(i + 1, *what) for i, what in enumerate(items)]}}
    if with_rest:
        plan["geoFence"] = {
            "version": 2, "circles": [{"circle": {"center": [41.1787, -8.5975], "radius": 20}, "inclusion": False, "version": 1}],
            "polygons": [{"polygon": [[41.17, -8.61], [41.17, -8.58], [41.19, -8.58], [41.19, -8.61]], "inclusion": True, "version": 1}]}
        plan["rallyPoints"] = {"version": 2, "points": [[41.1775, -8.598, 20]]}
    return json.dumps(plan)


def expect(text: str, *words: str):
    for word in words:
        assert word in text, f"no {word!r} in\n{text}"


def upload(file: pathlib.Path, link: str, *more: str, code: int = 0) -> dict:
    out, _ = harness.expect_exit(code, "mission", "upload", str(file), "--link", link, "--vehicle", "1", "--json", *more)
    return {plan["type"]: plan for plan in json.loads(out)["plans"]}


def there_and_back(folder: pathlib.Path, *impairments: str):
    """On one simulated copter: all of a plan, nothing twice, only what changes, back again, and away."""
    port = harness.free_udp_port()
    link = f"udpin://127.0.0.1:{port}"
    whole = folder / "whole.plan"
    whole.write_text(plan_of(MISSION))
    with harness.lapwing("sim", "--vehicles", "copter:1", "--home", HOME, "--out", f"udpout://127.0.0.1:{port}", "--speedup", "5",
                         "--seed", "7", *impairments):
        done = upload(whole, link)
        assert {(plan["type"], plan["items"], plan["outcome"]) for plan in done.values()} == {
            ("mission", 7, "uploaded"), ("fence", 5, "uploaded"), ("rally", 1, "uploaded")}, done
        assert all(plan["outcome"] == "unchanged" for plan in upload(whole, link).values())
        if not impairments:
            changed = folder / "changed.plan"
            changed.write_text(plan_of(MISSION[:3] + [(16, 41.1791, -8.597, 35)] + MISSION[4:], with_rest=False))
            assert upload(changed, link)["mission"]["written"] == 1
            upload(whole, link)
        back = folder / "back.geojson"
        harness.expect_exit(0, "mission", "download", "--link", link, "--vehicle", "1", "--out", str(back))
        shown = json.loads(harness.expect_exit(0, "mission", "show", str(back), "--json")[0])
        assert [i["command"] for i in shown["items"]] == [what[0] for what in MISSION], shown
        assert [round(i["position"]["alt_m"]) for i in shown["items"]] == [what[3] for what in MISSION], shown
        assert (shown["fence_zones"], shown["rally_points"]) == (2, 1), shown
        harness.expect_exit(0, "mission", "clear", "--link", link, "--vehicle", "1", "--type", "all")
        shown = json.loads(harness.expect_exit(0, "mission", "download", "--link", link, "--vehicle", "1", "--json")[0])
        assert not shown["items"] and not shown["fence_zones"] and not shown["rally_points"], shown


def interrupted(folder: pathlib.Path):
    """Ctrl-C in the middle of a long upload puts the old plan back."""
    port = harness.free_udp_port()
    link = f"udpin://127.0.0.1:{port}"
    whole = folder / "whole.plan"
    whole.write_text(plan_of(MISSION, with_rest=False))
    long = folder / "long.plan"
    long.write_text(plan_of([(16 if i else 22, 41.17 + i * 1e-5, -8.6, 20) for i in range(400)], with_rest=False))
    with harness.lapwing("sim", "--vehicles", "copter:1", "--home", HOME, "--out", f"udpout://127.0.0.1:{port}", "--delay", "0.03"):
        upload(whole, link)
        process = subprocess.Popen([harness.LAPWING, "mission", "upload", str(long), "--link", link, "--vehicle", "1"], stderr=subprocess.PIPE, text=True)
        line = ""
        while "uploading" not in line:
            line = process.stderr.readline()
            assert line, "the upload never began"
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=60)
        assert process.returncode == 130, (process.returncode, err)
        expect(err, "mission: the vehicle still holds its old plan")
        assert upload(whole, link)["mission"]["outcome"] == "unchanged"


def unanswered():
    """A vehicle that is heard and answers nothing is not waited for like a bad link."""
    port = harness.free_udp_port()
    process = subprocess.Popen([harness.LAPWING, "mission", "download", "--link", f"udpin://127.0.0.1:{port}"], stderr=subprocess.PIPE, text=True)
    vehicle, began = Peer(port, 1), time.monotonic()
    while process.poll() is None:
        vehicle.heartbeat()
        time.sleep(0.2)
        assert time.monotonic() - began < 20, "it is waited for"
    expect(process.stderr.read(), "vehicle 1 is heard, but answers nothing about its fence items", "does the link carry both ways?")
    assert process.returncode == 3, process.returncode


def refused(folder: pathlib.Path):
    """What is wrong is said before anything is sent, or with what became of the vehicle."""
    link = ("--link", f"udpin://127.0.0.1:{harness.free_udp_port()}")
    plan = folder / "whole.plan"
    _, err = harness.expect_exit(3, "mission", "upload", str(plan), *link, "--wait", "0.2")
    expect(err, "no vehicle was heard")
    _, err = harness.expect_exit(2, "mission", "upload", str(plan), "--sim", "copter:2")
    expect(err, "there are 2 vehicles: 1, 2", "--vehicle ID")
    _, err = harness.expect_exit(2, "mission", "upload", str(plan), "--sim", "rover:1")
    expect(err, "whole.plan: item 1, NAV_TAKEOFF: a rover with ArduPilot would skip it")
    fence = folder / "fence.kml"
    fence.write_text("<kml><Placemark><Polygon><outerBoundaryIs><LinearRing><coordinates>-8,41 -7,41 -7,42</coordinates></LinearRing>"
                     "</outerBoundaryIs></Polygon></Placemark></kml>")
    out, err = harness.expect_exit(0, "mission", "upload", str(fence), "--sim", "copter:1")
    expect(out, "fence: 3 items uploaded")
    expect(err, "the area '' is taken as one to stay in")
    _, err = harness.expect_exit(2, "mission", "upload", str(fence), "--sim", "copter:1", "--type", "mission")
    expect(err, "there is nothing in it to upload")
    harness.expect_exit(2, "mission", "clear", *link)  # which list has to be said


def converted(folder: pathlib.Path):
    """Every format comes back; what one cannot hold is said."""
    whole = folder / "whole.plan"
    plan = json.loads(plan_of(MISSION))
    plan["mission"]["items"].insert(3, {**item(4, 183, 0, 0, 0), "frame": 2, "params": [9, 1500, 0, 0, 0, 0, 0]})
    whole.write_text(json.dumps(plan))
    kml = folder / "out.kml"
    _, err = harness.expect_exit(0, "mission", "convert", str(whole), str(kml))
    expect(err, "lost: item 4: DO_SET_SERVO has no place, and KML holds places", "lost: what vehicle it was drawn for")
    strict = folder / "strict.kml"
    _, err = harness.expect_exit(1, "mission", "convert", str(whole), str(strict), "--strict")
    expect(err, "was not written: something would be lost")
    assert not strict.exists()
    previous = whole
    for name in ("a.geojson", "b.plan", "c.geojson"):
        _, err = harness.expect_exit(0, "mission", "convert", str(previous), str(folder / name), "--strict")
        assert not err, err
        previous = folder / name
    assert (folder / "a.geojson").read_text() == (folder / "c.geojson").read_text()
    out, _ = harness.expect_exit(0, "mission", "show", str(previous))
    expect(out, "mission 7 items", "DO_SET_SERVO", "stay out of: a circle of 20 m", "rally   1 points")
    for name in ("d.kmz", "e.waypoints"):
        harness.expect_exit(0, "mission", "convert", str(whole), str(folder / name))
        harness.expect_exit(0, "mission", "show", str(folder / name))
    _, err = harness.expect_exit(2, "mission", "convert", str(whole), str(folder / "out.doc"))
    expect(err, "out.doc: the ending is that of no plan file")


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    there_and_back(folder)
    there_and_back(folder, "--loss", "0.3")
    interrupted(folder)
    unanswered()
    refused(folder)
    converted(folder)
