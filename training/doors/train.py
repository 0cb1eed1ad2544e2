"""Trains the network that finds doors. usage:

    train.py scenes --count N --seed S [--plain DIR] --out scenes.pt      renders pictures
    train.py show --count N --seed S [--plain DIR] --out DIR              writes some of them as files, with labels, to be looked at and to test with
    train.py begin --scenes a.pt b.pt [--plain DIR] --seconds T --out a.pt    learns from rendered pictures, and from photographs without doors
    train.py judge --from a.pt --photographs DIR [--half held-out]
    train.py cross --from a.pt --scenes scenes.pt --photographs DIR --seconds T --folds K --out cross.pt
    train.py finish --from a.pt --scenes scenes.pt --photographs DIR --seconds T --out b.pt      learns from the whole half to build with
    train.py between --from a.pt --photographs DIR --cross cross.pt --share S --out between.pt    goes a part of the way from a.pt to the networks of `cross`
    train.py join --cross between.pt --out b.pt                   instead of finish: the mean of the networks of `cross` or `between`, for nothing
    train.py export --from b.pt --cross cross.pt --out doors.onnx

DIR of --plain has photographs without doors. Seconds are of one core, not of the clock on the wall. `cross` learns from a part of the half to build
with and looks at the rest of it, in turn: its figures and its calibration come from pictures that the network in question has not seen. Nothing but
`judge --half held-out` opens the other half.
"""

from __future__ import annotations

import argparse
import copy
import math
import pathlib
import time

import numpy
import torch
from PIL import Image

import network
import pictures
import scenes

PHOTOGRAPH_SIDE, SCENE_SIDE, BEYOND_SIDE = 224, 192, 320
BATCH = 16
PASTED, HIDDEN = 0.3, 0.25  # of the views: into which a door of another one is put, of which a part is hidden


class Average:
    """Of the weights over the last steps: steadier than the last of them."""

    def __init__(self, net: network.Doors):
        self.net, self.steps = copy.deepcopy(net).eval(), 0

    def add(self, net: network.Doors) -> None:
        self.steps += 1
        keep = min(0.995, (1 + self.steps) / (10 + self.steps))
        with torch.no_grad():
            for mine, other in zip(self.net.state_dict().values(), net.state_dict().values(), strict=True):
                if mine.dtype.is_floating_point:
                    mine.lerp_(other, 1 - keep)
                else:
                    mine.copy_(other)


def learn(net: network.Doors, of_all: list[tuple[pictures.Set, int]], seconds: float, rate: float, name: str, keep: pathlib.Path | None = None) -> network.Doors:
    """`of_all`: sets, and how many of each batch come from them."""
    begun, step, last = time.process_time(), 0, 0.0
    net.train()
    average = Average(net)
    teacher = torch.optim.AdamW(net.parameters(), rate, weight_decay=2e-2)
    losses: list[float] = []
    while (done := (time.process_time() - begun) / seconds) < 1:
        for group in teacher.param_groups:
            group["lr"] = rate * min(1.0, (step + 1) / 60) * (0.5 + 0.5 * math.cos(math.pi * done) * 0.98 + 0.01)
        shown = [pictures.views(of, torch.randint(len(of), (count,)), True) for of, count in of_all if count]
        views, boxes = pictures.pasted(torch.cat([one[0] for one in shown]), torch.cat([one[1] for one in shown]), PASTED)
        views, boxes = pictures.hidden_in_part(views, boxes, HIDDEN)
        loss = network.loss_of(net(views), boxes)
        teacher.zero_grad()
        loss.backward()
        torch.nn.utils.clip_grad_norm_(net.parameters(), 5.0)
        teacher.step()
        average.add(net)
        losses.append(float(loss))
        step += 1
        if time.process_time() - last > 30:
            last = time.process_time()
            print(f"{time.strftime('%H:%M:%S')} {name}: {done:.0%}, {step} steps, loss {numpy.mean(losses[-50:]):.3f}", flush=True)
            if keep:
                torch.save(average.net.state_dict(), keep)
    return average.net.eval()


def detections(net: network.Doors, of: pictures.Set, slope: float = 1.0, offset: float = 0.0, mirrored: bool = True) -> list[tuple[torch.Tensor, torch.Tensor]]:
    """As the program does it: the picture and its mirror image, each door once."""
    found = []
    with torch.no_grad():
        for k in range(len(of)):
            shown, _ = pictures.views(of, torch.tensor([k]), False)
            boxes, sure = network.found_in(net(shown), slope, offset)[0]
            if mirrored:
                other, other_sure = network.found_in(net(shown.flip(3)), slope, offset)[0]
                other = torch.stack([pictures.INPUT - other[:, 2], other[:, 1], pictures.INPUT - other[:, 0], other[:, 3]], 1)
                boxes, sure = merged(boxes, sure, other, other_sure)
            found.append((boxes, sure))
    return found


def merged(boxes, sure, other, other_sure) -> tuple[torch.Tensor, torch.Tensor]:
    """What both views have is as sure as their mean; what one has loses."""
    both = []
    taken = torch.zeros(len(other), dtype=torch.bool)
    for box, chance in zip(boxes, sure, strict=True):
        same = network.overlap(box[None], other)[0] * ~taken
        best = int(same.argmax())
        if same[best] > 0.5:
            taken[best] = True
            both.append(((box + other[best]) / 2, (chance + other_sure[best]) / 2))
        else:
            both.append((box, chance - 1.0))
    both += [(box, chance - 1.0) for box, chance, gone in zip(other, other_sure, taken, strict=True) if not gone]
    return torch.stack([box for box, _ in both]), torch.stack([chance for _, chance in both])


def truths(of: pictures.Set) -> list[torch.Tensor]:
    every = [pictures.views(of, torch.tensor([k]), False)[1][0] for k in range(len(of))]
    return [boxes[(boxes[:, 4] == pictures.DOOR) | (boxes[:, 4] == 2)][:, :4] for boxes in every]


def verdicts(found, truth) -> tuple[numpy.ndarray, numpy.ndarray, int]:
    """How sure of each box, whether it is right (overlap 0.5, each door once), and how many doors there are."""
    sure, right = [], []
    for (boxes, chances), there in zip(found, truth, strict=True):
        taken = torch.zeros(len(there), dtype=torch.bool)
        for k in chances.argsort(descending=True):
            same = network.overlap(boxes[k][None], there)[0] * ~taken if len(there) else torch.zeros(1)
            best = int(same.argmax())
            good = bool(same[best] >= 0.5)
            if good:
                taken[best] = True
            sure.append(float(chances[k]))
            right.append(good)
    return numpy.array(sure), numpy.array(right), sum(map(len, truth))


def tell(name: str, found, truth) -> tuple[numpy.ndarray, numpy.ndarray, int]:
    sure, right, doors = verdicts(found, truth)
    order = numpy.argsort(-sure, kind="stable")
    hits = numpy.cumsum(right[order])
    wrong = numpy.arange(1, len(order) + 1) - hits
    precision = hits / numpy.arange(1, len(order) + 1)
    best = numpy.maximum.accumulate(precision[::-1])[::-1]
    average = float((best * right[order]).sum() / doors)
    recalls = [f"{hits[wrong <= each * len(truth)].max(initial=0) / doors:.2f} at {each}" for each in (0.05, 0.2, 0.5, 1, 2)]
    print(f"{name}: {len(truth)} pictures, {doors} doors, average precision {average:.3f}, recall {', '.join(recalls)} false a picture, {hits[-1] / doors:.2f} in all", flush=True)
    return sure, right, doors


def calibration(sure: numpy.ndarray, right: numpy.ndarray) -> tuple[float, float]:
    """Slope and offset that make chances of sureness: logistic regression by Newton's steps, a little towards no slope."""
    x, w = numpy.stack([sure, numpy.ones_like(sure)], 1), numpy.zeros(2)
    for _ in range(50):
        p = 1 / (1 + numpy.exp(-x @ w))
        w -= numpy.linalg.solve(x.T @ (x * (p * (1 - p))[:, None]) + 1e-3 * numpy.eye(2), x.T @ (p - right) + 1e-3 * w)
    return float(w[0]), float(w[1])


def drawn(words) -> pictures.Set:
    return pictures.joined([torch.load(path) for path in words.scenes])


def sources(words, photographs: pictures.Set | None = None) -> list[tuple[pictures.Set, int]]:
    """What a batch is made of."""
    plain = pictures.packed(SCENE_SIDE, [(picture, []) for picture in pictures.without_doors(words.plain, SCENE_SIDE)])
    least = 2 if len(plain) else 0
    if photographs is None:
        return [(drawn(words), BATCH - least), (plain, least)]
    return [(photographs, 8), (drawn(words), 8 - least), (plain, least)]


def restored(path: pathlib.Path) -> network.Doors:
    net = network.Doors()
    net.load_state_dict(torch.load(path))
    return net.eval()


def cross(words) -> None:
    photographs = pictures.photographs(words.photographs, pictures.half_of(words.photographs, "built-with"), PHOTOGRAPH_SIDE)
    nets = []
    for fold in range(words.folds):
        rest = [k for k in range(len(photographs)) if k % words.folds != fold]
        nets.append(learn(restored(words.start), sources(words, photographs.only(rest)), words.seconds, words.rate, f"fold {fold}"))
    held_against(photographs, nets, words.out)


def between(words) -> None:
    """From what each network of `cross` has learnt back towards what all knew before: what few photographs taught is worth a part of the way only."""
    photographs = pictures.photographs(words.photographs, pictures.half_of(words.photographs, "built-with"), PHOTOGRAPH_SIDE)
    held_against(photographs, [mixed([torch.load(words.start), part], [1 - words.share, words.share]) for part in torch.load(words.cross)["nets"]], words.out)


def mixed(parts: list[dict], shares: list[float]) -> network.Doors:
    net = network.Doors()
    net.load_state_dict({name: sum(share * part[name] for part, share in zip(parts, shares, strict=True)) if value.dtype.is_floating_point else value
                         for name, value in parts[0].items()})
    return net.eval()


def held_against(photographs: pictures.Set, nets: list[network.Doors], out: pathlib.Path) -> None:
    """Each network looks at the photographs that it has not learnt from: the k-th at the k-th of every so many."""
    there, alone, everything = truths(photographs), [None] * len(photographs), [None] * len(photographs)
    seen = [list(range(fold, len(photographs), len(nets))) for fold in range(len(nets))]
    for net, mine in zip(nets, seen, strict=True):
        for k, found in zip(mine, detections(net, photographs.only(mine), mirrored=False), strict=True):
            alone[k] = found
    slope, offset = calibration(*verdicts(alone, there)[:2])
    print(f"calibration: slope {slope:.4f}, offset {offset:.4f}")
    for fold, (net, mine) in enumerate(zip(nets, seen, strict=True)):
        for k, found in zip(mine, detections(net, photographs.only(mine), slope, offset), strict=True):
            everything[k] = found
        tell(f"fold {fold}", [everything[k] for k in mine], [there[k] for k in mine])
    sure, right, doors = tell("all folds", everything, there)
    for least in (0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.7):
        told = 1 / (1 + numpy.exp(-sure)) >= least
        recall, precision = right[told].sum() / doors, right[told].mean() if told.any() else 0
        f1 = 2 * recall * precision / max(recall + precision, 1e-9)
        print(f"from {least}: recall {recall:.2f}, precision {precision:.2f}, F1 {f1:.2f}, {(~right[told]).sum() / len(photographs):.2f} false a picture")
    torch.save({"slope": slope, "offset": offset, "found": everything, "nets": [net.state_dict() for net in nets]}, out)


def join(words) -> None:
    """The mean of weights that began as the same ones and learnt from different photographs."""
    parts = torch.load(words.cross)["nets"]
    torch.save(mixed(parts, [1 / len(parts)] * len(parts)).state_dict(), words.out)


def show(words) -> None:
    for part in ("images", "labels"):
        (words.out / part).mkdir(parents=True, exist_ok=True)
    rng = numpy.random.default_rng(words.seed)
    for k, scene in enumerate(scenes.rendered(rng, words.count, 480, pictures.without_doors(words.plain, BEYOND_SIDE))):
        height, width = scene.pixels.shape[:2]
        Image.fromarray(scene.pixels).save(words.out / "images" / f"{k:02}.jpg", quality=88)
        lines = [f"0 {(x0 + x1) / 2 / width:.5f} {(y0 + y1) / 2 / height:.5f} {(x1 - x0) / width:.5f} {(y1 - y0) / height:.5f}" for x0, y0, x1, y1, enough in scene.doors if enough]
        (words.out / "labels" / f"{k:02}.txt").write_text("".join(line + "\n" for line in lines))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("step", choices=["scenes", "show", "begin", "judge", "cross", "between", "finish", "join", "export"])
    for name in ("out", "plain", "photographs", "cross"):
        parser.add_argument(f"--{name}", type=pathlib.Path)
    parser.add_argument("--scenes", type=pathlib.Path, nargs="+")
    parser.add_argument("--from", dest="start", type=pathlib.Path)
    parser.add_argument("--half", default="built-with")
    for name, default in (("count", 3000), ("seed", 1), ("folds", 3)):
        parser.add_argument(f"--{name}", type=int, default=default)
    for name, default in (("seconds", 600.0), ("rate", 2e-3), ("share", 0.5)):
        parser.add_argument(f"--{name}", type=float, default=default)
    words = parser.parse_args()
    torch.manual_seed(words.seed)
    torch.set_num_threads(1)
    if words.step == "scenes":
        torch.save(pictures.rendered(words.seed, words.count, SCENE_SIDE, pictures.without_doors(words.plain, BEYOND_SIDE)), words.out)
    elif words.step == "show":
        show(words)
    elif words.step == "begin":
        start = restored(words.start) if words.start else network.Doors()
        torch.save(learn(start, sources(words), words.seconds, words.rate, "rendered", words.out).state_dict(), words.out)
    elif words.step == "judge":
        of = pictures.photographs(words.photographs, pictures.half_of(words.photographs, words.half), PHOTOGRAPH_SIDE)
        tell(words.half, detections(restored(words.start), of), truths(of))
    elif words.step == "cross":
        cross(words)
    elif words.step == "between":
        between(words)
    elif words.step == "join":
        join(words)
    elif words.step == "finish":
        of = pictures.photographs(words.photographs, pictures.half_of(words.photographs, "built-with"), PHOTOGRAPH_SIDE)
        torch.save(learn(restored(words.start), sources(words, of), words.seconds, words.rate, "photographs", words.out).state_dict(), words.out)
    else:
        learnt = torch.load(words.cross)
        net = network.Exported(restored(words.start), learnt["slope"], learnt["offset"]).eval()
        torch.onnx.export(net, torch.zeros(1, 3, pictures.INPUT, pictures.INPUT), words.out, opset_version=11, input_names=["picture"], output_names=["doors"])
    print(f"{words.step}: {time.process_time():.0f} s of one core", flush=True)


if __name__ == "__main__":
    main()
