"""A survey drone with a simulated camera over the small car park of the examples, and what is true of that. Not a test itself."""

import json
import math
import pathlib
import tomllib

import drone

ROOT = pathlib.Path(__file__).parents[2]
WORLD = ROOT / "examples/car-park/small.toml"
M_PER_DEGREE = 111_132.954 - 559.822 * math.cos(2 * math.radians(drone.HOME[0])) + 1.175 * math.cos(4 * math.radians(drone.HOME[0]))
M_PER_DEGREE_EAST = 111_412.84 * math.cos(math.radians(drone.HOME[0])) - 93.5 * math.cos(3 * math.radians(drone.HOME[0]))


def on_globe(x: float, y: float) -> list[float]:
    """Metres east and north of home as [latitude, longitude]."""
    return [drone.HOME[0] + y / M_PER_DEGREE, drone.HOME[1] + x / M_PER_DEGREE_EAST]


def in_metres(longitude: float, latitude: float) -> tuple[float, float]:
    return (longitude - drone.HOME[1]) * M_PER_DEGREE_EAST, (latitude - drone.HOME[0]) * M_PER_DEGREE


AREA = [on_globe(*corner) for corner in ((-20, 11), (20, 11), (20, 33), (-20, 33))]


def tables(camera: str = f'kind = "simulated"\nworld = "{WORLD}"\nwidth = 640\nheight = 480', survey: str = "") -> str:
    return f"[camera]\n{camera}\n[survey]\narea = {json.dumps(AREA)}\nfolder = \"found\"\n{survey}\n"


def true_slots(world: pathlib.Path = WORLD) -> list[tuple[float, float, bool]]:
    """The middles of the world's slots, and whether they are taken; of rows that say all that are taken."""
    slots = []
    for row in tomllib.loads(world.read_text())["row"]:
        heading, slant = math.radians(row.get("heading_deg", 0)), math.radians(row.get("slant_deg", 0))
        ahead = (math.cos(heading), math.sin(heading))
        deep = (-math.sin(heading - slant), math.cos(heading - slant))
        pitch, half_length = row.get("width_m", 2.5) / math.cos(slant), 0.5 * row.get("length_m", 5.0)
        for i in range(row["count"]):
            along = pitch * (i + 0.5)
            slots.append((row["at"][0] + along * ahead[0] + half_length * deep[0], row["at"][1] + along * ahead[1] + half_length * deep[1],
                          i + 1 in row["taken"]))
    return slots


def found_slots(folder: pathlib.Path) -> dict:
    return json.loads((folder / "found/slots.geojson").read_text())


def compare(found: dict, world: pathlib.Path = WORLD) -> dict:
    """Of the true slots: how many were found within half a metre and how far off on average, of how many of those the state was told, and how
    many of these rightly."""
    seen = []
    for feature in found["features"]:
        ring = feature["geometry"]["coordinates"][0][:-1]
        corners = [in_metres(*corner) for corner in ring]
        seen.append((sum(x for x, _ in corners) / len(corners), sum(y for _, y in corners) / len(corners), feature["properties"]))
    result = {"true": 0, "found": 0, "told": 0, "right": 0, "extra": 0, "off_m": 0.0}
    used = set()
    for x, y, is_taken in true_slots(world):
        result["true"] += 1
        near = [(math.hypot(sx - x, sy - y), i) for i, (sx, sy, _) in enumerate(seen) if i not in used]
        if not near or min(near)[0] > 0.5:
            continue
        off_m, i = min(near)
        used.add(i)
        result["found"] += 1
        result["off_m"] += off_m
        chance = seen[i][2].get("taken_probability")
        if chance is not None:
            result["told"] += 1
            result["right"] += (chance > 0.5) == is_taken
    result["extra"] = len(seen) - len(used)
    result["off_m"] /= max(1, result["found"])
    return result
