"""Doors in photographs: precision and recall at an overlap of 0.5, for the half that was built with and the half that was held out, by each way to find
them; and what a picture costs. usage: doors.py FOLDER [--half built-with|held-out|both] [--method network|classic|both] [--out DIR]

FOLDER has `images` and `labels` (YOLO's lines, class 0 a door). Halves go by file names in order: the first, third, ... were built with. DIR keeps the
pictures with what was found drawn in, to be looked at.
"""

import argparse
import pathlib
import re
import struct
import subprocess
import tempfile
import time
import zlib

LAPWING = pathlib.Path(__file__).resolve().parents[2] / "build/release/bin/lapwing"
FIGURES = re.compile(r"doors: (\d+) pictures, (\d+) doors: precision ([\d.]+), recall ([\d.]+), ([\d.]+) false a picture, average precision ([\d.]+)")
CHANCES = (0.1, 0.2, 0.4, 0.6)


def detect(method: str, pictures: list, out: pathlib.Path, *words: str) -> str:
    done = subprocess.run([LAPWING, "detect", "doors", "--method", method, "--no-signs", *words, "--out", out, *pictures], capture_output=True, text=True,
                          timeout=600, check=True)
    return done.stdout


def judge(folder: pathlib.Path, half: str, method: str, out: pathlib.Path) -> None:
    pictures = sorted((folder / "images").iterdir())[0 if half == "built-with" else 1::2]
    for least in (None, *(CHANCES if method == "network" else ())):
        words = ["--truth", str(folder / "labels"), *(["--least-score", str(least)] if least is not None else [])]
        count, doors, precision, recall, wrong, average = FIGURES.search(detect(method, pictures, out / f"{method}-{half}", *words)).groups()
        print(f"{method:8} {half:10} {'as set' if least is None else f'from {least}':9} {count} pictures, {doors} doors: recall {recall}, precision {precision}, "
              f"{wrong} false a picture, average precision {average}", flush=True)


def grey_picture(width: int, height: int) -> bytes:
    """What a picture shows does not change what it costs."""
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + bytes((x * y + y) % 251 for x in range(3 * width)) for y in range(height))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(rows, 1)) + chunk(b"IEND", b"")


def cost(method: str, out: pathlib.Path) -> float:
    """Seconds for one more picture of 1280 by 720, read, looked at and drawn, without start-up."""
    picture = out / "grey.png"
    picture.write_bytes(grey_picture(1280, 720))
    took = {}
    for count in (1, 21):
        begun = time.perf_counter()
        detect(method, [picture] * count, out / "cost")
        took[count] = time.perf_counter() - begun
    return (took[21] - took[1]) / 20


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--half", choices=["built-with", "held-out", "both"], default="both")
    parser.add_argument("--method", choices=["network", "classic", "both"], default="both")
    parser.add_argument("--out", type=pathlib.Path)
    words = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        out = words.out or pathlib.Path(scratch)
        out.mkdir(parents=True, exist_ok=True)
        for method in ("network", "classic") if words.method == "both" else (words.method,):
            for half in ("built-with", "held-out") if words.half == "both" else (words.half,):
                judge(words.folder, half, method, out)
            print(f"{method:8} {1000 * cost(method, pathlib.Path(scratch)):.0f} ms a picture of 1280 by 720", flush=True)


if __name__ == "__main__":
    main()
