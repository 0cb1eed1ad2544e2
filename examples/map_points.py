#!/usr/bin/env python3
"""Puts points of interest on the map of a running station, and says which parking slots are free.

    python3 examples/map_points.py                                     the station on this machine
    python3 examples/map_points.py http://hawk.local:8080 --token-file token.txt

Needs nothing but Python. The API is described in docs/reference/openapi.yaml.
"""

import argparse
import json
import pathlib
import sys
import urllib.error
import urllib.parse
import urllib.request

WRITER = "map_points.py"


class Station:
    def __init__(self, url: str, token: str):
        self.url = url.rstrip("/")
        self.headers = {"Authorization": f"Bearer {token}"} if token else {}

    def ask(self, method: str, path: str, body=None):
        """The answer, read; what goes wrong says so in words (RFC 9457)."""
        address = path if path.startswith("http") else self.url + path
        data = None if body is None else json.dumps(body).encode()
        headers = self.headers | ({"Content-Type": "application/geo+json"} if data else {})
        try:
            with urllib.request.urlopen(urllib.request.Request(address, data, headers, method=method), timeout=10) as answer:
                return json.load(answer)
        except urllib.error.HTTPError as error:
            problem = json.load(error)
            sys.exit(f"{method} {path}: {problem['detail']} {problem.get('hint', '')}")

    def features(self, layer: str, **filters):
        """All that fit, page after page."""
        address = f"/api/v1/layers/{layer}/features?" + urllib.parse.urlencode(filters, quote_via=urllib.parse.quote)
        while address:
            page = self.ask("GET", address)
            yield from page["features"]
            address = next((link["href"] for link in page["links"] if link["rel"] == "next"), None)


def point(lon_deg: float, lat_deg: float, **properties):
    return {"type": "Feature", "geometry": {"type": "Point", "coordinates": [lon_deg, lat_deg]}, "properties": properties}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("url", nargs="?", default="http://127.0.0.1:8080")
    parser.add_argument("--token-file", type=pathlib.Path, help="holds the station's token, where it asks for one")
    options = parser.parse_args()
    station = Station(options.url, options.token_file.read_text().strip() if options.token_file else "")

    sites = station.ask("GET", "/api/v1/sites")["sites"]
    if not sites:
        sites = [station.ask("PUT", "/api/v1/sites/field", {"anchor": {"lat_deg": 47.3977, "lon_deg": 8.5456, "alt_m": 488}})]
    site = sites[0]
    lon, lat = site["anchor"]["lon_deg"], site["anchor"]["lat_deg"]

    # One, under an id of your own: the same again tells of it anew.
    query = urllib.parse.urlencode({"site": site["id"], "writer": WRITER})
    station.ask("PUT", f"/api/v1/layers/points_of_interest/features/gate?{query}", point(lon + 0.0002, lat, kind="gate", name="North gate"))

    # Many: all of them or none.
    hydrants = [dict(point(lon + 0.0001 * i, lat + 0.0001, kind="hydrant", name=f"H{i}"), id=f"hydrant {i}") for i in range(5)]
    station.ask("POST", f"/api/v1/layers/points_of_interest/features?{query}", {"type": "FeatureCollection", "features": hydrants})

    for feature in station.features("points_of_interest", writer=WRITER):
        lon_deg, lat_deg = feature["geometry"]["coordinates"]
        print(f"{feature['properties']['name']} at {lat_deg:.6f}, {lon_deg:.6f}")
    free = [feature["properties"].get("name", feature["id"]) for feature in station.features("slots", state="free")]
    print(f"{len(free)} free slots{': ' if free else ''}{', '.join(free)}")


if __name__ == "__main__":
    main()
