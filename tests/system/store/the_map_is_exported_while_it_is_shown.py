"""Files of the map over HTTP: each format, what is chosen of it, with the token alone, few at once; and what a station says that lacks the
program for it."""

import http.client
import io
import json
import pathlib
import shutil
import stat
import sys
import tempfile
import zipfile

import harness

TOKEN = "a-token-that-is-long-enough-1234"
LAPWING_MAP = pathlib.Path(harness.LAPWING).with_name("lapwing-map")
if not LAPWING_MAP.exists():
    print("skipped: lapwing-map is not built (no GDAL)")
    sys.exit(harness.SKIPPED)


class Client:
    def __init__(self, port: int, token: str = TOKEN):
        self.port = port
        self.headers = {"Content-Type": "application/json"} | ({"Authorization": f"Bearer {token}"} if token else {})

    def raw(self, method: str, path: str, body=None):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=30)
        connection.request(method, "/api/v1/" + path, None if body is None else json.dumps(body), self.headers)
        answer = connection.getresponse()
        content = answer.read()
        connection.close()
        return answer.status, content, answer.headers

    def ask(self, method: str, path: str, body=None):
        status, content, _ = self.raw(method, path, body)
        return status, json.loads(content or b"{}")

    def is_up(self):
        try:
            return self.raw("GET", "status")[0] in (200, 401)
        except OSError:
            return False

    def export(self, wish: dict):
        """(state, file) of an export that has ended."""
        status, job = self.ask("POST", "exports", wish)
        assert status == 202, job
        address = f"exports/{job['id']}"
        state = harness.wait_until(lambda: (now := self.ask("GET", address)[1])["state"] != "running" and now, 60, f"{wish} is over")
        assert 0.0 <= state["progress"] <= 1.0, state
        if state["state"] == "failed":
            return state, None
        status, content, headers = self.raw("GET", address + "/file")
        assert status == 200 and len(content) == state["bytes"], (status, state)
        assert headers["Content-Disposition"] == f'attachment; filename="{state["name"]}"', headers["Content-Disposition"]
        assert self.ask("DELETE", address)[0] == 204
        return state, content


def fill(client: Client):
    site = {"anchor": {"lat_deg": 47.4, "lon_deg": 8.5, "alt_m": 400}, "floors": [{"id": "1", "name": "First", "up_m": 3}]}
    assert client.ask("PUT", "sites/yard", site)[0] in (200, 201)
    def square(east: float):
        ring = [[8.5 + east, 47.4], [8.5 + east + 1e-5, 47.4], [8.5 + east + 1e-5, 47.40001], [8.5 + east, 47.40001], [8.5 + east, 47.4]]
        return {"type": "Polygon", "coordinates": [ring]}
    slots = [{"type": "Feature", "id": f"s{i}", "geometry": square(i * 1e-4), "properties": {"site": "yard", "state": "free"}} for i in range(20)]
    door = {"type": "Feature", "id": "-door", "geometry": {"type": "Point", "coordinates": [8.5, 47.4]},
            "properties": {"site": "yard", "floor": "1", "kind": "door", "name": "221"}}
    for layer, features in (("slots", slots), ("points_of_interest", [door])):
        status, answer = client.ask("POST", f"layers/{layer}/features?writer=tester", {"type": "FeatureCollection", "features": features})
        assert status in (200, 201), (status, answer)


def names(content: bytes) -> set[str]:
    return set(zipfile.ZipFile(io.BytesIO(content)).namelist())


def slots_in(content: bytes) -> list[str]:
    return sorted(f["id"] for f in json.loads(zipfile.ZipFile(io.BytesIO(content)).read("slots.geojson"))["features"])


with tempfile.TemporaryDirectory() as folder:
    token_file = pathlib.Path(folder, "token")
    token_file.write_text(TOKEN)
    token_file.chmod(stat.S_IRUSR | stat.S_IWUSR)
    port = harness.free_tcp_port()
    words = ("station", "--link", f"udpin://127.0.0.1:{harness.free_udp_port()}", "--store", str(pathlib.Path(folder, "store")),
             "--token-file", str(token_file))
    with harness.lapwing(*words, "--port", str(port)):
        client = Client(port)
        harness.wait_until(client.is_up, 20, "the station is up")
        for method, path in (("GET", "exports"), ("POST", "exports"), ("GET", "exports/1"), ("GET", "exports/1/file"), ("DELETE", "exports/1")):
            assert Client(port, "").raw(method, path, {} if method == "POST" else None)[0] == 401, f"{method} {path} wants the token"
        fill(client)
        told = client.ask("GET", "exports")[1]
        assert told["available"], told
        formats = {one["name"]: one for one in told["formats"]}
        assert set(formats) == {"geopackage", "geojson", "kml", "kmz", "csv", "geotiff", "ros", "svg", "pdf"}, set(formats)

        # What has just been put on the map is in the file, whether or not it was on the disk already.
        state, content = client.export({"format": "geojson"})
        assert names(content) == {"slots.geojson", "points_of_interest.geojson", "sites.geojson"}, names(content)
        assert len(slots_in(content)) == 20
        begins = {"geopackage": b"SQLite format 3", "kml": b"<", "kmz": b"PK", "csv": b"PK", "svg": b"<?xml", "pdf": b"%PDF"}
        for name, magic in begins.items():
            state, content = client.export({"format": name, **({"site": "yard", "floor": "1"} if name in ("svg", "pdf") else {})})
            assert content and content.startswith(magic), (name, state, content and content[:40])
            assert state["name"].endswith(formats[name]["extension"]), state

        # Parts of it.
        _, content = client.export({"format": "geojson", "layers": ["slots"], "within_deg": [8.4999, 47.3, 8.50025, 47.5]})
        assert names(content) == {"slots.geojson", "sites.geojson"} and slots_in(content) == ["s0", "s1", "s2"], slots_in(content)
        _, content = client.export({"format": "csv", "site": "yard", "floor": "1"})
        assert names(content) == {"points_of_interest.csv", "sites.csv"}, names(content)

        # Mistakes, with their reasons.
        state, content = client.export({"format": "ros"})
        assert state["state"] == "failed" and "nothing in the map" in state["reason"], state
        assert client.ask("POST", "exports", {"format": "dwg"})[0] == 400
        assert client.ask("POST", "exports", {"format": "csv", "site": "--help"})[0] == 400

        # Few at once: however fast they are asked for, some are refused or all are done, and none stays.
        answers = [client.ask("POST", "exports", {"format": "pdf", "site": "yard", "floor": "1"}) for _ in range(12)]
        assert {status for status, _ in answers} <= {202, 429} and answers[0][0] == 202, answers
        kept = [job["id"] for status, job in answers if status == 202]
        harness.wait_until(lambda: all(client.ask("GET", f"exports/{one}")[1].get("state") != "running" for one in kept), 60, "all are over")
        assert sum(client.ask("GET", f"exports/{one}")[0] == 200 for one in kept) <= 6, "the oldest files go"
        print(f"{len(kept)} of 12 exports taken at once")

    # A station that has no lapwing-map beside it says so, and goes on.
    alone = pathlib.Path(folder, "bin")
    alone.mkdir()
    shutil.copy(pathlib.Path(harness.LAPWING).with_name("lapwing-vehicles"), alone / "lapwing-vehicles")
    harness.LAPWING = str(alone / "lapwing-vehicles")
    port = harness.free_tcp_port()
    with harness.lapwing(*words, "--port", str(port)):
        client = Client(port)
        harness.wait_until(client.is_up, 20, "the station is up")
        told = client.ask("GET", "exports")[1]
        assert not told["available"] and "lapwing-map is not there" in told["reason"] and told["hint"], told
        assert client.ask("POST", "exports", {"format": "kml"})[0] == 503
        assert len(client.ask("GET", "layers/slots/features")[1]["features"]) == 20, "the map is there all the same"
