"""30 % loss and 200 ms delay each way: two copters and a rover fly the example script to its end all the same."""

import json
import pathlib
import tempfile

import harness

SURVEY = harness.ROOT / "examples/survey.dolphin"

# Half a second each; the seeds after the first ones once failed, for the news of the rover's end got lost.
for seed in (1, 2, 3, 8, 21, 25, 36):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "report.json")
        out, err = harness.expect_exit(0, "run", str(SURVEY), "--sim", "copter:2,rover:1", "--loss", "0.3", "--delay",
                                       "0.2", "--seed", str(seed), "--report", str(path), seconds=240)
        report = json.loads(path.read_text())
    assert "The car park is surveyed" in out, out
    assert report["outcome"] == "done" and report["errors"] == [], report["errors"]
    for vehicle in report["vehicles"]:
        assert [mission["outcome"] for mission in vehicle["missions"]] == ["done"], vehicle
        assert vehicle["track_m"] > 100, vehicle
        # Count and items are asked for and answered one by one, 0.4 s each: the delay was real.
        first = vehicle["missions"][0]
        assert first["upload_s"] > 0.4 * (first["items"] + 1), first
print("surveyed over seven bad links")
