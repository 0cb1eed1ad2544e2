"""`lapwing detect doors`: pictures in, detections.json and drawings out; what cannot be read is named and stops nothing else. The pictures are
drawn here, and written as PNG by hand: no other program decides what is in them."""

import json
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import zlib

import harness

WALL, WOOD = (222, 220, 215), (140, 85, 45)


def png(width: int, height: int, door: tuple[int, int, int, int]) -> bytes:
    x, y, w, h = door
    wall, across = bytes(WALL) * width, bytes(WALL) * x + bytes(WOOD) * w + bytes(WALL) * (width - x - w)
    rows = b"".join(b"\0" + (across if y <= row < y + h else wall) for row in range(height))

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(rows))
            + chunk(b"IEND", b""))


def detect(*words: object) -> subprocess.CompletedProcess:
    return subprocess.run([harness.LAPWING, "detect", "doors", *map(str, words)], capture_output=True, text=True, timeout=120, check=False)


if not pathlib.Path(harness.LAPWING).with_name("lapwing-vision").exists():
    print("skipped: lapwing-vision was not built (setup/packages-vision.txt)")
    sys.exit(harness.SKIPPED)

with tempfile.TemporaryDirectory() as folder:
    here = pathlib.Path(folder)
    good = here / "corridor.png"
    good.write_bytes(png(640, 480, (250, 90, 140, 330)))
    empty = here / "wall.png"
    empty.write_bytes(png(640, 480, (0, 0, 0, 0)))

    done = detect("--method", "classic", good, empty, "--out", here / "out")
    assert done.returncode == 0, done.stderr
    found = json.loads((here / "out/detections.json").read_text())
    assert len(found) == 1 and found[0]["image"] == str(good) and found[0]["category"] == "door", found
    assert all(abs(a - b) < 8 for a, b in zip(found[0]["bbox"], (250, 90, 140, 330), strict=True)), found
    assert 0 < found[0]["score"] <= 1, found
    assert (here / "out/corridor.overlay.jpg").read_bytes()[:3] == b"\xff\xd8\xff"
    assert f"{empty}: nothing" in done.stdout.splitlines(), done.stdout

    again = detect("--method", "classic", good, empty, "--out", here / "out", "--json")
    assert json.loads(again.stdout) == found, "the same picture twice gives the same"
    red = detect("--method", "classic", good, "--out", here / "red", "--json", "--colour", "170,80,40-6,255,255")
    assert json.loads(red.stdout) == [], red.stdout

    # Outside bytes: each is named with its reason, the others are looked at all the same.
    bad = {"cut.png": good.read_bytes()[:300], "words.jpg": b"hello", "empty.jpg": b"",
           "huge.png": good.read_bytes()[:16] + struct.pack(">II", 65536, 65536) + good.read_bytes()[24:]}
    for name, content in bad.items():
        (here / name).write_bytes(content)
    done = detect("--method", "classic", *(here / name for name in bad), here / "none.jpg", here, good, "--out", here / "mixed")
    assert done.returncode == 2, done
    for name in [*bad, "none.jpg"]:
        assert str(here / name) in done.stderr, (name, done.stderr)
    assert "65536 by 65536 pixels are too many" in done.stderr and "no such file" in done.stderr, done.stderr
    assert [entry["image"] for entry in json.loads((here / "mixed/detections.json").read_text())] == [str(good)]

    # Two pictures of one name have two drawings.
    (here / "other").mkdir()
    (here / "other/corridor.png").write_bytes(good.read_bytes())
    assert detect("--method", "classic", good, here / "other/corridor.png", "--out", here / "two").returncode == 0
    assert {path.name for path in (here / "two").iterdir()} == {"corridor.overlay.jpg", "corridor-2.overlay.jpg", "detections.json"}

    # Rendered rooms and house fronts, whose doors are known (training/doors/train.py show): the default finds them, classic does not.
    rooms = pathlib.Path(__file__).resolve().parents[3] / "tests/golden/doors"
    pictures = sorted((rooms / "images").iterdir())
    done = detect(*pictures, "--out", here / "rooms", "--truth", rooms / "labels", "--no-signs")
    assert done.returncode == 0, done.stderr
    recall, wrong = (float(number) for number in re.search(r"recall ([\d.]+), ([\d.]+) false a picture", done.stdout).groups())
    assert recall >= 0.65 and wrong <= 0.6, done.stdout
    found = json.loads((here / "rooms/detections.json").read_text())
    assert all(len(door["corners"]) == 4 and 0.0 < door["score"] < 1.0 for door in found), found
    sure = detect(*pictures, "--out", here / "sure", "--no-signs", "--least-score", "0.4", "--json")
    assert json.loads(sure.stdout) == [door for door in found if door["score"] >= 0.4]

    # Bad usage.
    for words in (["--out", here / "x"], [good], [good, "--out", here / "x", "--colour", "brown"], [good, "--out", here / "x", "--least-score", "2"],
                  [good, "--out", here / "x", "--method", "magic"], [good, "--out", good]):
        assert detect(*words).returncode == 2, words
print("doors are found, and what cannot be read is named")
