"""Cars and slots from above: how good `lapwing detect cars` and `detect slots` are on recorded pictures, and what a picture costs. usage: lots.py FOLDER [--out DIR]

FOLDER has, each as far as it is there: `garfield_lot` (photographs, annotations.json with turned boxes of cars, slots and whether they are taken),
`carpark_video` (carParkImg.png, slots.json), and `cats_madison` (images, labels: YOLO's lines, class 0 a car). None of them was trained with. DIR keeps the
pictures with what was found drawn in: look at these before the figures.
"""

import argparse
import json
import pathlib
import subprocess
import tempfile
import time

LAPWING = pathlib.Path(__file__).resolve().parents[2] / "build/release/bin/lapwing"
CARPARK_METRES = 0.053  # a pixel, as estimated by whoever marked it


def detect(what: str, pictures: list, out: pathlib.Path, *words: object) -> str:
    done = subprocess.run([LAPWING, "detect", what, *map(str, words), "--out", out, *pictures], capture_output=True, text=True, timeout=1200, check=True)
    return done.stdout


def told(name: str, what: str, pictures: list, out: pathlib.Path, truth: pathlib.Path, *words: object) -> None:
    said = detect(what, pictures, out / name.replace(" ", "-"), "--truth", truth, *words)
    print(f"{name}: {said.strip().splitlines()[-1]}", flush=True)


def garfield(folder: pathlib.Path, out: pathlib.Path, scratch: pathlib.Path) -> None:
    marked = json.loads((folder / "annotations.json").read_text())
    width, height, metres = marked["camera"]["width"], marked["camera"]["height"], marked["gsd_m_per_px_ref"]
    pictures = []
    for picture in marked["images"]:
        stem = pathlib.Path(picture["file"]).stem
        lines = []
        for car in picture["cars"]:
            xs, ys = zip(*car["poly"], strict=True)
            lines.append(f"0 {(min(xs) + max(xs)) / 2 / width} {(min(ys) + max(ys)) / 2 / height} {(max(xs) - min(xs)) / width} {(max(ys) - min(ys)) / height}\n")
        (scratch / f"{stem}.txt").write_text("".join(lines))
        slots = [{"corners": slot["poly"], "occupied": bool(slot["occupied"])} for slot in picture["slots"]]
        (scratch / f"{stem}.json").write_text(json.dumps({"slots": slots}))
        pictures.append(folder / "images" / picture["file"])
    for scale in (("--gsd", metres), ()):
        how = "scale told" if scale else "scale found"
        told(f"garfield cars {how}", "cars", pictures, out, scratch, *scale)
        told(f"garfield slots {how}", "slots", pictures, out, scratch, *scale)
    for picture in pictures:
        told(f"garfield slots {picture.stem}", "slots", [picture], out, scratch, "--gsd", metres)
    told("garfield taken or free", "slots", pictures, out, scratch, "--gsd", metres, "--layout", scratch)


def carpark(folder: pathlib.Path, out: pathlib.Path, scratch: pathlib.Path) -> None:
    marked = json.loads((folder / "slots.json").read_text())
    w, h = marked["slot_w"], marked["slot_h"]
    slots = [{"corners": [[x, y], [x + w, y], [x + w, y + h], [x, y + h]], "occupied": bool(taken)}
             for (x, y), taken in zip(marked["slots_xy"], marked["occupied_in_carParkImg"], strict=True)]
    (scratch / "carParkImg.json").write_text(json.dumps({"slots": slots}))
    for scale in (("--gsd", CARPARK_METRES), ()):
        how = "scale told" if scale else "scale found"
        told(f"carpark slots {how}", "slots", [folder / "carParkImg.png"], out, scratch, *scale)
        told(f"carpark taken or free {how}", "slots", [folder / "carParkImg.png"], out, scratch, "--layout", scratch, *scale)
    detect("cars", [folder / "carParkImg.png"], out / "carpark-cars", "--gsd", CARPARK_METRES)


def cost(picture: pathlib.Path, out: pathlib.Path, what: str, *words: object) -> float:
    """Seconds for one more picture, read, looked at and drawn, without start-up."""
    took = {}
    for count in (1, 4):
        begun = time.perf_counter()
        detect(what, [picture] * count, out / "cost", *words)
        took[count] = time.perf_counter() - begun
    return (took[4] - took[1]) / 3


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path)
    words = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        out = words.out or scratch / "out"
        out.mkdir(parents=True, exist_ok=True)
        if (words.folder / "carpark_video").exists():
            carpark(words.folder / "carpark_video", out, scratch)
            picture = words.folder / "carpark_video/carParkImg.png"
            for what in ("cars", "slots"):
                print(f"{what}: {cost(picture, scratch, what, '--gsd', CARPARK_METRES):.2f} s a picture of 1100 by 720 with its scale told, "
                      f"{cost(picture, scratch, what):.2f} s without", flush=True)
        if (words.folder / "garfield_lot").exists():
            garfield(words.folder / "garfield_lot", out, scratch)
        if (words.folder / "cats_madison").exists():
            told("cats_madison cars", "cars", sorted((words.folder / "cats_madison/images").iterdir()), out, words.folder / "cats_madison/labels", "--gsd", 0.049)


if __name__ == "__main__":
    main()
