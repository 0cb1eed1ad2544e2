"""GDAL's programs open the GeoPackage as it is, while a station writes it: every layer, its index, no complaint."""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

import harness
import store_hand

if shutil.which("ogrinfo") is None:
    print("skipped: no ogrinfo (apt install gdal-bin)")
    sys.exit(harness.SKIPPED)


def ogr(*words: str) -> str:
    done = subprocess.run(words, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0 and done.stderr == "", f"{words}: {done.stderr}"
    return done.stdout


LAYERS = {"slots": "Polygon", "walls": "Line String", "points_of_interest": "Point", "pictures": None, "tracks": "Line String",
          "areas": "Polygon"}

with tempfile.TemporaryDirectory() as folder:
    store = pathlib.Path(folder, "store")
    file = str(store / "map.gpkg")
    hand = store_hand.Hand(str(store), "robot")
    try:
        hand.wait(lambda hand: hand.accepted >= 200, "there is something in it")
        told = ogr("ogrinfo", "-ro", file)
        for layer, kind in LAYERS.items():
            assert f": {layer}" + (f" ({kind})" if kind else "") in told, told
        accepted = hand.accepted
        slots = ogr("ogrinfo", "-ro", "-so", file, "slots")
        count = int(next(line for line in slots.splitlines() if line.startswith("Feature Count")).split(":")[1])
        assert count >= accepted, f"{count} of {accepted}"
        assert 'ID["EPSG",4326]' in slots and "FID Column = fid" in slots and "seen_at: DateTime" in slots, slots
        # By the index: a few metres round the second slot of the first row.
        near = json.loads(ogr("ogr2ogr", "-f", "GeoJSON", "/vsistdout/", file, "slots", "-spat", "8.50000", "47.399999", "8.50002", "47.40001"))
        assert near["features"] and len(near["features"]) < count, len(near["features"])
        assert {"id", "site", "writer", "at", "state", "name"} <= near["features"][0]["properties"].keys()
        assert hand.process.poll() is None, "and it writes on"
        before = hand.accepted
        hand.wait(lambda hand: hand.accepted > before, "it writes on")
    finally:
        hand.kill()
    print(f"{count} slots read of {accepted} that had been accepted")
