"""`lapwing detect cars` and `detect slots`: rendered car parks, whose vehicles and slots are known, with and without the scale; and what drones write into
their pictures."""

import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile

import harness

LOTS = pathlib.Path(__file__).resolve().parents[3] / "tests/golden/lots"  # rendered car parks, from before training/cars drew houses and streets
METRES = 0.08


def detect(what: str, *words: object) -> subprocess.CompletedProcess:
    return subprocess.run([harness.LAPWING, "detect", what, *map(str, words)], capture_output=True, text=True, timeout=120, check=False)


def figure(name: str, text: str) -> float:
    return float(re.search(rf"{name} ([\d.]+)", text).group(1))


def segment(body: bytes) -> bytes:
    return b"\xff\xe1" + struct.pack(">H", len(body) + 2) + body


def flown(picture: bytes) -> bytes:
    """With place, height, direction and lens as drones write them: 20.8 m of height and 24 mm are 8 cm a pixel here."""
    gps, camera, fractions = 8 + 2 + 24 + 4, 8 + 2 + 24 + 4 + 2 + 60 + 4, 8 + 2 + 24 + 4 + 2 + 60 + 4 + 2 + 12 + 4
    entry = lambda tag, kind, count, value: struct.pack("<HHII", tag, kind, count, value)
    tiff = b"II*\0" + struct.pack("<I", 8) + struct.pack("<H", 2) + entry(0x8825, 4, 1, gps) + entry(0x8769, 4, 1, camera) + bytes(4)
    tiff += struct.pack("<H", 5) + entry(1, 2, 2, ord("N")) + entry(2, 5, 3, fractions) + entry(3, 2, 2, ord("E")) + entry(4, 5, 3, fractions + 24)
    tiff += entry(6, 5, 1, fractions + 48) + bytes(4) + struct.pack("<H", 1) + entry(0xA405, 3, 1, 24) + bytes(4)
    tiff += b"".join(struct.pack("<II", value, 1) for value in (50, 0, 0, 8, 30, 0, 150))
    height = METRES * 24 * (480**2 * 2) ** 0.5 / (36**2 + 24**2) ** 0.5
    xmp = f'<rdf:Description drone-dji:RelativeAltitude="+{height:.2f}" drone-dji:GimbalYawDegree="+0.00" drone-dji:GimbalPitchDegree="-90.00"/>'
    return picture[:2] + segment(b"Exif\0\0" + tiff) + segment(b"http://ns.adobe.com/xap/1.0/\0" + xmp.encode()) + picture[2:]


if not pathlib.Path(harness.LAPWING).with_name("lapwing-vision").exists():
    print("skipped: lapwing-vision was not built (setup/packages-vision.txt)")
    sys.exit(harness.SKIPPED)

with tempfile.TemporaryDirectory() as folder:
    here = pathlib.Path(folder)
    pictures = sorted(LOTS.glob("*.jpg"))

    done = detect("cars", *pictures, "--out", here / "cars", "--gsd", METRES, "--truth", LOTS)
    assert done.returncode == 0, done.stderr
    assert figure("F1", done.stdout) >= 0.8, done.stdout
    found = json.loads((here / "cars/detections.json").read_text())
    assert all(car["category"] == "car" and len(car["corners"]) == 4 and car["gsd_m"] == METRES and 0.5 <= car["score"] <= 1 for car in found), found
    assert (here / "cars/00.overlay.jpg").exists() and not (here / "cars/detections.geojson").exists()

    # Nobody tells the scale: the vehicles do.
    many = LOTS / "03.jpg"
    done = detect("cars", many, "--out", here / "unknown", "--json")
    assert done.returncode == 0, done.stderr
    assert all(abs(car["gsd_m"] / METRES - 1) < 0.12 for car in json.loads(done.stdout)) and json.loads(done.stdout), done.stdout

    # A drone's own words do, too, and place what was found: the upper edge of the picture is north.
    (here / "flown.jpg").write_bytes(flown(many.read_bytes()))
    done = detect("cars", here / "flown.jpg", "--out", here / "flown", "--json")
    cars = json.loads(done.stdout)
    assert cars and all(abs(car["gsd_m"] - METRES) < 0.0005 for car in cars), done.stdout
    features = json.loads((here / "flown/detections.geojson").read_text())["features"]
    assert len(features) == len(cars)
    for feature, car in zip(features, cars, strict=True):
        east, north = feature["geometry"]["coordinates"]
        x, y, w, h = car["bbox"]
        assert abs((north - 50.0) * 111229 - (240 - y - h / 2) * METRES) < 0.2, (feature, car)
        assert abs((east - 8.5) * 71696 - (x + w / 2 - 240) * METRES) < 0.2, (feature, car)

    # Slots by their paint, and those that are known.
    done = detect("slots", LOTS / "02.jpg", "--out", here / "slots", "--gsd", METRES, "--truth", LOTS)
    assert done.returncode == 0, done.stderr
    assert figure("F1", done.stdout) >= 0.4, done.stdout
    done = detect("slots", *pictures, "--out", here / "known", "--gsd", METRES, "--layout", LOTS, "--truth", LOTS)
    assert float(re.search(r"told, ([\d.]+) right", done.stdout).group(1)) >= 0.88, done.stdout
    slots = json.loads((here / "known/detections.json").read_text())
    assert all((slot["occupied"] is None) == ("occupied_chance" not in slot) for slot in slots), slots
    assert any(slot["occupied"] is None for slot in slots), "the picture cuts some off"

    # Without the network's file contrast has to do, which is said.
    home = here / "home"
    shutil.copytree(LOTS, home / "lots")
    bare = subprocess.run([harness.LAPWING, "detect", "cars", many, "--out", here / "bare", "--gsd", str(METRES)], capture_output=True, text=True, timeout=120,
                          check=False, env={**os.environ, "LAPWING_HOME": str(home)})
    assert bare.returncode == 0 and "by their contrast" in bare.stderr, bare

    # A picture of nothing tells no scale.
    done = detect("cars", LOTS / "01.jpg", "--method", "classic", "--out", here / "none")
    assert done.returncode == 0 and "--gsd" in done.stderr, done

    # Bad usage.
    (here / "bad").mkdir()
    (here / "bad/00.json").write_text('{"slots": [{"corners": [[1, 2], [3, "x"]]}]}')
    for what, *words in (("cars", pictures[0], "--out", here / "x", "--gsd", "0"), ("cars", pictures[0], "--out", here / "x", "--gsd", "wide"), ("slots", pictures[0]),
                         ("slots", pictures[0], "--out", here / "x", "--layout", here / "bad"), ("slots", pictures[0], "--out", here / "x", "--truth", here / "none.txt")):
        assert detect(what, *words).returncode == 2, (what, words)
print("vehicles and slots are found from above")
