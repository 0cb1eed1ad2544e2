"""What it costs to keep a map: our GeoPackage, PostGIS where it is installed, and GDAL's own writer of GeoPackages."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests/support"))

FEATURES = int(os.environ.get("LAPWING_BENCH_FEATURES", "1000000"))
FRAMES = int(os.environ.get("LAPWING_BENCH_FRAMES", "1000000"))


def figures(*words) -> list:
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


def measure(programs: pathlib.Path, say) -> dict:
    results = {}

    def take(name, *words):
        results[name] = figures(*words)
        for line in results[name]:
            say(f"store  {name:32} {line}")

    with tempfile.TemporaryDirectory() as folder:
        take("geopackage/writes", programs / "bench_store", f"{folder}/writes", "writes")
        take("geopackage/viewports", programs / "bench_store", f"{folder}/viewports", "viewports", FEATURES)
        take("geopackage/records", programs / "bench_store", f"{folder}/records", "records", FRAMES)
        if (programs / "bench_store_ogr").exists():
            take("ogr/writes", programs / "bench_store_ogr", f"{folder}/writes.gpkg", "writes")
            take("ogr/viewports", programs / "bench_store_ogr", f"{folder}/viewports.gpkg", "viewports", FEATURES)
    import postgres
    if (postgres.PROGRAMS / "initdb").exists() and postgres.EXTENSION.exists():
        with postgres.cluster(durable=True) as server:
            for part, count in (("writes", ()), ("viewports", (FEATURES,)), ("records", (FRAMES,))):
                server.query(f"CREATE DATABASE {part}")
                take(f"postgis/{part}", programs / "bench_store", server.address(part), part, *count)
    return results
