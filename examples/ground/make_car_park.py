"""Draws the ground of the demo: a car park of 120 m x 80 m and the office south of it, as GeoJSON. usage: make_car_park.py > car-park.geojson

Metres are east and north of the base of examples/survey.dolphin. What a thing is stands in `kind`, by which the page colours it.
"""

import json
import math
import pathlib
import sys
import tomllib

BASE_LAT, BASE_LON = 41.1780, -8.5980
# Metres a degree at that latitude, on the WGS 84 ellipsoid (Snyder, Map Projections: A Working Manual, section 4).
E2 = 0.00669437999014
SIN = math.sin(math.radians(BASE_LAT))
NORTH = math.radians(1) * 6378137.0 * (1 - E2) / (1 - E2 * SIN * SIN) ** 1.5
EAST = math.radians(1) * 6378137.0 * math.cos(math.radians(BASE_LAT)) / math.sqrt(1 - E2 * SIN * SIN)

SLOT_WIDTH, SLOT_LENGTH, AISLE = 2.5, 5.0, 6.0
features = []


def place(x, y):
    return [round(BASE_LON + x / EAST, 8), round(BASE_LAT + y / NORTH, 8)]


def polygon(kind, corners, **properties):
    ring = [place(x, y) for x, y in corners]
    features.append({"type": "Feature", "properties": {"kind": kind, **properties}, "geometry": {"type": "Polygon", "coordinates": [ring + ring[:1]]}})


def line(kind, points, **properties):
    features.append({"type": "Feature", "properties": {"kind": kind, **properties}, "geometry": {"type": "LineString", "coordinates": [place(x, y) for x, y in points]}})


def box(kind, west, south, east, north, **properties):
    polygon(kind, [(west, south), (east, south), (east, north), (west, north)], **properties)


def tree(x, y, radius=2.2):
    corners = [(x + radius * math.cos(i * math.pi / 5), y + radius * math.sin(i * math.pi / 5)) for i in range(10)]
    polygon("tree", corners)


def row_of_slots(south, west, count, first_number):
    for i in range(count):
        x = west + i * SLOT_WIDTH
        box("slot", x, south, x + SLOT_WIDTH, south + SLOT_LENGTH, name=str(first_number + i))


def car_park():
    box("lawn", -100, -75, 100, 110)
    box("road", -100, 96, 100, 103, name="Rua do Campo")
    box("road", 72, -75, 79, 96)
    line("lane", [(-100, 99.5), (100, 99.5)])
    line("lane", [(75.5, -75), (75.5, 96)])
    box("asphalt", -60, 0, 60, 80, name="Car park")
    box("asphalt", 60, 36, 72, 44)
    # Rows in pairs, back to back, with an aisle between the pairs.
    number, south = 1, 3.0
    while south + 2 * SLOT_LENGTH <= 79:
        for row in (south, south + SLOT_LENGTH):
            row_of_slots(row, -55, 44, number)
            number += 44
        south += 2 * SLOT_LENGTH + AISLE
    for x in range(-58, 60, 12):
        tree(x, 84)
        tree(x, -4)


def office():
    """What the simulated building is made of, seen from above: its outer walls, the rooms with numbers, the doors with signs on a wall."""
    plan = tomllib.loads((pathlib.Path(__file__).parent.parent / "buildings/office.toml").read_text())
    west, south = plan["origin"]
    ground = lambda points: [(west + x, south + y) for x, y in points]
    polygon("building", ground(next(wall["line"] for wall in plan["wall"] if wall.get("closed"))), name=plan["name"])
    for room in plan["room"]:
        if room["name"].isdigit():
            polygon("room", ground(room["corners"]), name=room["name"])
            for door in plan["door"]:
                if door["id"] == room["name"]:
                    line("door", ground(sorted([door["hinge"], door["latch"]])))
    line("path", [(8, -26), (30, -26), (30, 0)], name="Footpath")


car_park()
office()
json.dump({"type": "FeatureCollection", "name": "Car park and office", "features": features}, sys.stdout, separators=(",", ":"))
sys.stdout.write("\n")
