"""Trains the network that finds vehicles from above. usage:

    train.py scenes --count N --seed S --out scenes.pt          renders car parks
    train.py show --count N --seed S --out DIR                  writes some of them as files, with labels, to be looked at and to test with
    train.py learn --rows DIR --streets DIR --count N --seed S --minutes M --out b.pt
    train.py export --from b.pt --scenes others.pt --rows DIR --streets DIR --out cars.onnx
    train.py occupancy --from b.pt --scenes others.pt           fits the chance that a slot is taken: the numbers of occupancy.cpp

Minutes are of the clock on the wall. `rows` is a folder of pictures that were squeezed to squares (train, valid and test as Roboflow exports them), `streets`
one of pictures beside YOLO's labels, of which those named Munich* are kept back. `learn` goes on with what it finds in its `--out`. `export` prints how good
the network is on what was kept back and on scenes of another seed, and makes chances of its words by the streets, the one place that it never saw.
"""

from __future__ import annotations

import argparse
import copy
import json
import math
import pathlib
import pickle
import time

import numpy
import torch
from PIL import Image

import network
import pictures
import scenes

SCENES, PHOTOGRAPHS = 4, 2  # of a batch: where time is short, many small steps teach more than few large ones
FRESH = 6  # steps from one new scene to the next
STREET_SHARE = 0.5  # of the photographs' views
TILE = 512  # pixels a side of what the program shows it


class Average:
    """Of the weights over the last steps: steadier than the last of them."""

    def __init__(self, net: network.Cars):
        self.net, self.steps = copy.deepcopy(net).eval(), 0

    def add(self, net: network.Cars) -> None:
        self.steps += 1
        keep = min(0.998, (1 + self.steps) / (10 + self.steps))
        with torch.no_grad():
            for mine, other in zip(self.net.state_dict().values(), net.state_dict().values(), strict=True):
                if mine.dtype.is_floating_point:
                    mine.lerp_(other, 1 - keep)
                else:
                    mine.copy_(other)


def learn(sources, minutes: float, rate: float, seed: int, out: pathlib.Path) -> None:
    """What `out` already holds of a course that was cut off is gone on with."""
    rng, net = numpy.random.default_rng(seed), network.Cars().train()
    average = Average(net)
    teacher = torch.optim.AdamW(net.parameters(), rate, weight_decay=1e-2)
    spent = 0.0  # seconds
    if out.exists():
        kept = torch.load(out)
        net.load_state_dict(kept["net"])
        average.net.load_state_dict(kept["average"])
        teacher.load_state_dict(kept["teacher"])
        average.steps, spent = kept["steps"], kept["spent"]
        rng = numpy.random.default_rng(seed + average.steps)
    begun, told, losses = time.monotonic() - spent, time.monotonic(), []
    keep = lambda: torch.save({"net": net.state_dict(), "average": average.net.state_dict(), "teacher": teacher.state_dict(), "steps": average.steps, "spent": time.monotonic() - begun}, out)
    while (done := (time.monotonic() - begun) / (60 * minutes)) < 1:
        for group in teacher.param_groups:
            group["lr"] = rate * min(1.0, (average.steps + 1) / 100) * (0.5 + 0.5 * math.cos(math.pi * done) * 0.99 + 0.005)
        if average.steps % FRESH == 0:  # no end of scenes: what has been seen for longest gives way
            drawn = sources[0][0]
            drawn[average.steps // FRESH % len(drawn)] = pictures.rendered(rng, 1)[0]
        shown, wanted = pictures.batch(sources, rng)
        loss = network.loss_of(net(shown), wanted)
        teacher.zero_grad()
        loss.backward()
        torch.nn.utils.clip_grad_norm_(net.parameters(), 5.0)
        teacher.step()
        average.add(net)
        losses.append(float(loss))
        if time.monotonic() - told > 60:
            told = time.monotonic()
            print(f"{time.strftime('%H:%M:%S')} {done:.0%}, {average.steps} steps, loss {numpy.mean(losses[-400:]):.3f}, {time.process_time():.0f} s of one core", flush=True)
            keep()
    keep()


def answer_to(net: network.Cars, picture: pictures.Picture) -> tuple[torch.Tensor, list[int]]:
    """Of the whole picture, as the program has it: chances are the mean of the picture's and its mirror image's. And its size in the network's pixels."""
    size = [max(1, round(n * pictures.SOURCE_METRES / network.METRES)) for n in picture.pixels.size]
    square = numpy.full((math.ceil(size[1] / 32) * 32, math.ceil(size[0] / 32) * 32, 3), int(network.GREY), numpy.uint8)
    square[:size[1], :size[0]] = numpy.asarray(picture.pixels.resize(size, Image.Resampling.BOX))
    shown = pictures.normal(torch.from_numpy(square).permute(2, 0, 1)[None])
    with torch.no_grad():
        answer, mirror = net(shown), net(shown.flip(3)).flip(3)
    answer[:, network.MIDDLE] = (answer[:, network.MIDDLE] + mirror[:, network.MIDDLE]) / 2
    answer[:, network.COVERED] = torch.logit((torch.sigmoid(answer[:, network.COVERED]) + torch.sigmoid(mirror[:, network.COVERED])) / 2, eps=1e-6)
    return answer, size


def seen_by(net: network.Cars, picture: pictures.Picture) -> tuple[numpy.ndarray, numpy.ndarray]:
    """What the network finds in all of a picture, and what is there, in the network's pixels."""
    scale = pictures.SOURCE_METRES / network.METRES
    found = network.found_in(answer_to(net, picture)[0])[0].numpy()
    there = picture.cars.copy()
    there[:, :4] *= scale
    return found, there


def verdicts(net: network.Cars, of: list[pictures.Picture]) -> tuple[numpy.ndarray, numpy.ndarray, int]:
    """The logit of each vehicle that is found, whether there is one within 1.5 m that nothing surer took, and how many there are."""
    sure, right, count = [], [], 0
    for picture in of:
        found, there = seen_by(net, picture)
        blank = picture.blank * pictures.SOURCE_METRES / network.METRES
        taken = numpy.zeros(len(there), bool)
        count += len(there)
        for car in found:
            away = numpy.hypot(there[:, 0] - car[0], there[:, 1] - car[1]) + 1e9 * taken if len(there) else numpy.array([1e9])
            best = int(away.argmin())
            good = away[best] < 15
            if good:
                taken[best] = True
            elif any(x0 < car[0] < x1 and y0 < car[1] < y1 for x0, y0, x1, y1 in blank):
                continue
            sure.append(car[5])
            right.append(good)
    return numpy.array(sure), numpy.array(right), count


def tell(name: str, sure: numpy.ndarray, right: numpy.ndarray, count: int) -> None:
    order = numpy.argsort(-sure)
    hits = numpy.cumsum(right[order])
    told = numpy.arange(1, len(order) + 1)
    harmonic = 2 * hits / (told + count)
    best = int(harmonic.argmax())
    print(f"{name}: {count} vehicles, F1 {harmonic[best]:.3f} (precision {hits[best] / told[best]:.3f}, recall {hits[best] / count:.3f}) from logit {sure[order][best]:.2f}", flush=True)


def calibration(sure: numpy.ndarray, right: numpy.ndarray) -> tuple[float, float]:
    """Slope and offset that make chances of logits: logistic regression by Newton's steps."""
    rows = numpy.stack([sure, numpy.ones_like(sure)], 1)
    weights = numpy.array([1.0, 0.0])
    for _ in range(30):
        chance = 1 / (1 + numpy.exp(-rows @ weights))
        slope = rows.T @ (chance - right) + 1e-3 * (weights - [1.0, 0.0])
        bend = (rows * (chance * (1 - chance))[:, None]).T @ rows + 1e-3 * numpy.eye(2)
        weights = weights - numpy.linalg.solve(bend, slope)
    return float(weights[0]), float(weights[1])


def kept_back(words) -> dict[str, list[pictures.Picture]]:
    rows = [picture for part in ("valid", "test") for picture in pictures.photographs(words.rows / part, True)]
    streets = [picture for file in sorted(words.streets.glob("Munich*.png")) if (picture := pictures.photograph(file, file.with_suffix(".txt"), False))]
    with words.scenes.open("rb") as file:
        return {"rows": rows, "streets": streets, "scenes": pickle.load(file)[:40]}


def export(words) -> None:
    net = restored(words.start)
    apart = {name: verdicts(net, of) for name, of in kept_back(words).items()}
    for name, each in apart.items():
        tell(name, *each)
    sure, right, _ = apart["streets"]  # the others are of the lot and of the making that it learnt from: it is surer there than elsewhere
    slope, offset = calibration(sure, right.astype(float))
    print(f"chances: slope {slope:.3f}, offset {offset:.3f}")
    torch.onnx.export(network.Exported(net, slope, offset).eval(), torch.zeros(1, 3, TILE, TILE), words.out, opset_version=11, input_names=["picture"], output_names=["cars"])


def shares_of(net: network.Cars, picture: pictures.Picture, slope: float, offset: float) -> list[tuple[float, float, bool]]:
    """Of each slot that is well within the picture: how much of its middle shows a vehicle, the chance of the best one in it, and whether it is taken."""
    scale = pictures.SOURCE_METRES / network.METRES
    answer, size = answer_to(net, picture)
    covered = torch.sigmoid(answer[0, network.COVERED]).numpy()
    cars = network.found_in(answer)[0].numpy()
    chances = 1 / (1 + numpy.exp(-(cars[:, 5] * slope + offset)))
    grid = numpy.linspace(0.15, 0.85, 9)
    rows = []
    for corners, taken in zip(picture.slots * scale, picture.taken, strict=True):
        a, b, c, d = corners
        mouth, head = a + grid[:, None] * (b - a), d + grid[:, None] * (c - d)
        places = (mouth[:, None] + grid[None, :, None] * (head - mouth)[:, None]).reshape(-1, 2)
        if (places < 0).any() or (places >= size).any():
            continue
        columns, lines = (places / network.STEP).astype(int).T
        # Both ways round: a point is inside if it lies on one side of all four edges.
        edges = numpy.roll(corners, -1, 0) - corners
        sides = numpy.array([edges[k, 0] * (cars[:, 1] - corners[k, 1]) - edges[k, 1] * (cars[:, 0] - corners[k, 0]) for k in range(4)])
        inside = ((sides > 0).all(0) | (sides < 0).all(0)) & (chances >= 0.15)
        rows.append((float(covered[lines, columns].mean()), float(chances[inside].max(initial=0.0)), bool(taken)))
    return rows


def occupancy(words) -> None:
    net = restored(words.start)
    with words.scenes.open("rb") as file:
        rows = numpy.array([row for picture in pickle.load(file) for row in shares_of(net, picture, words.slope, words.offset)], float)
    shown, taken, weights = numpy.concatenate([rows[:, :2], numpy.ones((len(rows), 1))], 1), rows[:, 2], numpy.zeros(3)
    for _ in range(40):  # Newton's steps; a little towards nothing, for slots that are told apart without an error
        chance = 1 / (1 + numpy.exp(-shown @ weights))
        bend = (shown * (chance * (1 - chance))[:, None]).T @ shown + 0.3 * numpy.eye(3)
        weights = weights - numpy.linalg.solve(bend, shown.T @ (chance - taken) + 0.3 * weights)
    print(f"{len(rows)} slots, {taken.mean():.2f} taken: right {((chance > 0.5) == taken).mean():.4f}, Brier {((chance - taken) ** 2).mean():.4f}; "
          f"covered {weights[0]:.2f}, best {weights[1]:.2f}, offset {weights[2]:.2f}")


def restored(file: pathlib.Path) -> network.Cars:
    net = network.Cars()
    net.load_state_dict(torch.load(file)["average"])
    return net.eval()


def show(words) -> None:
    """Pictures, and beside each NAME.txt with its cars as YOLO has them, and NAME.json with its slots and the metres of a pixel."""
    rng = numpy.random.default_rng(words.seed)
    words.out.mkdir(parents=True, exist_ok=True)
    for k in range(words.count):
        scene = scenes.render(rng, 480, 0.08)
        Image.fromarray(scene.pixels).save(words.out / f"{k:02}.jpg", quality=88)
        side = scene.pixels.shape[0]
        lines = []
        for car in scene.cars[scene.cars[:, 5] >= 0.5]:
            corners = numpy.clip(pictures.rectangle(*car[:5]), 0, side)
            (x0, y0), (x1, y1) = corners.min(0) / side, corners.max(0) / side
            lines.append(f"0 {(x0 + x1) / 2:.5f} {(y0 + y1) / 2:.5f} {x1 - x0:.5f} {y1 - y0:.5f}\n")
        (words.out / f"{k:02}.txt").write_text("".join(lines))
        slots = [{"corners": numpy.round(corners, 1).tolist(), "occupied": bool(taken)} for corners, taken in zip(scene.slots.astype(float), scene.taken, strict=True)]
        (words.out / f"{k:02}.json").write_text(json.dumps({"gsd_m": scene.metres, "slots": slots}) + "\n")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("step", choices=["scenes", "show", "learn", "export", "occupancy"])
    for name in ("out", "scenes", "rows", "streets"):
        parser.add_argument(f"--{name}", type=pathlib.Path)
    parser.add_argument("--from", dest="start", type=pathlib.Path)
    for name, default in (("count", 400), ("seed", 1)):
        parser.add_argument(f"--{name}", type=int, default=default)
    for name, default in (("minutes", 30.0), ("rate", 2.5e-3), ("slope", 1.0), ("offset", 0.0)):
        parser.add_argument(f"--{name}", type=float, default=default)
    words = parser.parse_args()
    torch.manual_seed(words.seed)
    torch.set_num_threads(1)
    if words.step == "scenes":
        with words.out.open("wb") as file:
            pickle.dump(pictures.rendered(numpy.random.default_rng(words.seed), words.count), file)
    elif words.step == "show":
        show(words)
    elif words.step == "learn":
        drawn = pictures.rendered(numpy.random.default_rng(words.seed), words.count)
        streets = [picture for file in sorted(words.streets.glob("MOS*.png")) if (picture := pictures.photograph(file, file.with_suffix(".txt"), False))]
        rows = pictures.photographs(words.rows / "train", True)
        repeated = streets * max(1, round(STREET_SHARE / (1 - STREET_SHARE) * len(rows) / len(streets)))
        sources = [(drawn, SCENES), (rows + repeated, PHOTOGRAPHS)]
        print([len(of) for of, _ in sources], "pictures", flush=True)
        learn(sources, words.minutes, words.rate, words.seed, words.out)
    elif words.step == "occupancy":
        occupancy(words)
    else:
        export(words)
    print(f"{words.step}: {time.process_time():.0f} s of one core", flush=True)


if __name__ == "__main__":
    main()
