"""Listing 4 of the report on simulated copters: pairs take turns, and a missing vehicle halts the program."""

import json
import pathlib
import tempfile

import harness

# Two of its names are misspelt as printed.
LISTING = (harness.ROOT / "examples/listing4.dolphin").read_text()
MENDED = LISTING.replace("surveyAreaNorth", "surveyNorth").replace("surveyAreaSouth", "surveySouth")


def relay(copters, folder):
    path, report = pathlib.Path(folder, "listing4.dolphin"), pathlib.Path(folder, "report.json")
    path.write_text(MENDED)
    out, err = harness.expect_exit(3, "run", str(path), "--sim", f"copter:{copters}", "--home",
                                   "40.444233,-7.375234,820", "--timeout", "7200", "--report", str(report), seconds=280)
    written = json.loads(report.read_text())
    flown = {vehicle["id"]: [(mission["name"], mission["outcome"]) for mission in vehicle["missions"]]
             for vehicle in written["vehicles"]}
    return out, err, written, flown


def round_trip(survey):
    return [(survey, "stopped"), ("Return to base", "done")]


with tempfile.TemporaryDirectory() as folder:
    # 98: the second pair is picked before the first is released, and flies the second round.
    out, err, report, flown = relay(4, folder)
    assert "time-out" in err, err
    assert flown["1"] == flown["3"] == round_trip("Survey Area 1"), flown
    assert flown["2"] == flown["4"] == round_trip("Survey Area 2"), flown
    picks = [line.rsplit("Selected nodes: ")[1] for line in err.splitlines() if "Selected nodes" in line]
    assert picks[:6] == ["{ 1 }", "{ 2 }", "{ 3 }", "{ 4 }", "{ 1 }", "{ 2 }"], picks

    # 99: nobody is there to relieve the second: halted after 30 s, with the first pair landed.
    out, err, report, flown = relay(3, folder)
    assert "Could not find required vehicles!" in err, err
    assert flown == {"1": round_trip("Survey Area 1"), "2": round_trip("Survey Area 2"), "3": []}, flown
    assert report["outcome"] == "halted", report["outcome"]
print("the pairs took turns")
