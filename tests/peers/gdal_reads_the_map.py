"""GDAL opens the map of a station by its URL: features as OGC API Features, page by page and by rectangle, with a token, and grids as tiles."""

import contextlib
import json
import os
import shutil
import subprocess
import sys
import urllib.request

import harness

TOKEN = "not-a-secret"


def run(*arguments: str, **environment: str) -> str:
    # What a test before this one fetched from the same address must not be shown again.
    done = subprocess.run(arguments, env=os.environ | {"GDAL_HTTP_TIMEOUT": "20"} | environment, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, f"{arguments}: {done.stdout}{done.stderr}"
    return done.stdout


@contextlib.contextmanager
def station(*more: str):
    """The address of a station with something in each layer of its map."""
    port = harness.free_tcp_port()
    process = subprocess.Popen([os.environ["STATION_DEMO"], str(port), "/nonexistent", *more], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    try:
        yield process.stdout.readline().strip()
    finally:
        process.terminate()
        process.wait(timeout=10)


def count(listing: str) -> int:
    return int(next(line for line in listing.splitlines() if line.startswith("Feature Count:")).split(":")[1])


def features(url: str):
    source = f"OAPIF:{url}ogc"
    layers = run("ogrinfo", source)
    for name in ("slots", "walls", "points_of_interest", "pictures", "tracks", "areas"):
        assert name in layers, layers
    assert "grid" not in layers, f"a grid is no layer of features: {layers}"

    slots = run("ogrinfo", "-al", "-so", source, "slots")
    assert count(slots) == 60 and "Polygon" in slots and "taken_probability: Real" in slots, slots
    assert 'ID["OGC","CRS84"]' in slots or "WGS 84" in slots, slots

    # 60 slots, 7 at a time: what comes is all of them, each once.
    paged = json.loads(run("ogr2ogr", "-f", "GeoJSON", "/vsistdout/", source, "slots", "-oo", "PAGE_SIZE=7"))
    assert len({feature["properties"]["name"] for feature in paged["features"]}) == 60

    one = next(feature for feature in paged["features"] if feature["properties"]["name"] == "101")
    west, south = (min(corner[axis] for corner in one["geometry"]["coordinates"][0]) for axis in (0, 1))
    assert 149 < west < 150 and -36 < south < -35, f"the axes are the other way round: {one}"
    box = [str(value) for value in (west + 1e-6, south + 1e-6, west + 2e-6, south + 2e-6)]
    assert count(run("ogrinfo", "-al", "-so", "-spat", *box, source, "slots")) == 1
    assert count(run("ogrinfo", "-al", "-so", "-where", "state = 'taken'", source, "slots")) == 20


def needs_the_token(url: str):
    refused = subprocess.run(["ogrinfo", f"OAPIF:{url}ogc"], capture_output=True, text=True, timeout=120)
    assert refused.returncode != 0 and "token" in refused.stdout + refused.stderr, refused
    listing = run("ogrinfo", "-al", "-so", f"OAPIF:{url}ogc", "slots", GDAL_HTTP_HEADERS=f"Authorization: Bearer {TOKEN}")
    assert count(listing) == 60, listing


def tiles(url: str):
    # By the address that QGIS and others take: the wall is black and the floor is white.
    with urllib.request.urlopen(f"{url}api/v1/grids/demo/1/floor/tiles.json", timeout=10) as answer:
        tile_json = json.load(answer)
    west, south, east, north = tile_json["bounds"]
    address = tile_json["tiles"][0].replace("{z}", "${z}").replace("{x}", "${x}").replace("{y}", "${y}").replace("&", "&amp;")
    tms = (f'<GDAL_WMS><Service name="TMS"><ServerUrl>{address}</ServerUrl></Service><DataWindow><UpperLeftX>-20037508.34</UpperLeftX>'
           '<UpperLeftY>20037508.34</UpperLeftY><LowerRightX>20037508.34</LowerRightX><LowerRightY>-20037508.34</LowerRightY>'
           f'<TileLevel>{tile_json["maxzoom"]}</TileLevel><TileCountX>1</TileCountX><TileCountY>1</TileCountY><YOrigin>top</YOrigin></DataWindow>'
           '<Projection>EPSG:3857</Projection><BlockSizeX>256</BlockSizeX><BlockSizeY>256</BlockSizeY><BandsCount>4</BandsCount></GDAL_WMS>')
    assert harness.ROOT.exists()
    picture = subprocess.run(["gdal_translate", "-q", "-of", "AAIGrid", "-b", "1", "-projwin", str(west), str(north), str(east), str(south),
                              "-projwin_srs", "EPSG:4326", "-outsize", "100", "0", tms, "/vsistdout/"], capture_output=True, text=True, timeout=120)
    assert picture.returncode == 0, picture.stderr
    shades = [int(float(value)) for line in picture.stdout.splitlines() if line[:1] in " 0123456789" for value in line.split()]
    assert min(shades) < 40 and max(shades) > 220, sorted(set(shades))


def main():
    if not shutil.which("ogrinfo"):
        print("gdal-bin is not installed")
        sys.exit(harness.SKIPPED)
    with station() as url:
        features(url)
        tiles(url)
    with station(TOKEN) as url:
        needs_the_token(url)


main()
