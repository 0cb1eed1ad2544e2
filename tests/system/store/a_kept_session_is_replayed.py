"""`lapwing replay STORE` opens the map on a session of a store: what was shown is there again, and the store stays as it is."""

import hashlib
import json
import pathlib
import tempfile
import time
import urllib.error
import urllib.request

import harness
import map_client

SLOT = {"type": "Feature", "id": "A 1", "geometry": {"type": "Point", "coordinates": [8.0, 47.0]}, "properties": {"site": "yard", "kind": "door", "name": "221"}}


def ask(address, path, method="GET", body=None):
    request = urllib.request.Request(address + path, method=method, data=json.dumps(body).encode() if body is not None else None,
                                     headers={"Content-Type": "application/json"})
    with urllib.request.urlopen(request, timeout=20) as answer:
        text = answer.read()
        return json.loads(text) if text else {}


def refused(address, path, method, body):
    try:
        ask(address, path, method, body)
    except urllib.error.HTTPError as error:
        return error.code
    return 0


with tempfile.TemporaryDirectory() as folder:
    store = pathlib.Path(folder, "store")
    with map_client.station("--store", str(store)) as live:
        ask(live.address, "/api/v1/sites/yard", "PUT", {"anchor": {"lat_deg": 47.0, "lon_deg": 8.0, "alt_m": 400.0}})
        ask(live.address, "/api/v1/layers/points_of_interest/features/A%201", "PUT", SLOT)
        time.sleep(2.5)  # a second is kept each second
        (kept,) = ask(live.address, "/api/v1/history")["sessions"]
        # While the station writes it, it can be looked back in.
        with map_client.replaying(str(store)) as past:
            assert [one["id"] for one in ask(past, "/api/v1/history")["sessions"]] == [kept["id"]]
    before = {path: hashlib.sha256(path.read_bytes()).hexdigest() for path in store.rglob("*") if path.is_file() and path.suffix == ".gpkg"}
    with map_client.replaying(str(store), "--session", kept["id"]) as past:
        viewer = map_client.Viewer(past)
        hello = viewer.receive()
        assert hello["looks_back"] == {"session": kept["id"]}, hello
        assert "operator" not in hello
        (session,) = ask(past, "/api/v1/history")["sessions"]
        frames = ask(past, f"/api/v1/history/{kept['id']}/state?at_ms={session['ended_ms']}")["frames"]
        shown = [feature for frame in frames if frame["feed"] == "map.points_of_interest" for feature in frame["message"]["features"]]
        assert [one["properties"]["name"] for one in shown] == ["221"], shown
        changes = ask(past, f"/api/v1/history/{kept['id']}/changes?from_ms={session['began_ms'] - 1}&to_ms={session['ended_ms']}")
        assert [one["id"] for one in changes["layers"][0]["added"]] == ["A 1"], changes
        assert refused(past, "/api/v1/script", "POST", {"name": "x", "source": "halt"}) == 409
    after = {path: hashlib.sha256(path.read_bytes()).hexdigest() for path in before}
    assert before == after, "a store that is looked back in is only read"

    out, err = harness.expect_exit(2, "replay", str(store), "--session", "no such")
    assert 'there is no session "no such" in it' in err and kept["id"] in err, err
    out, err = harness.expect_exit(2, "replay", str(store), "--headless")
    assert "lapwing store ls" in err, err
    out, err = harness.expect_exit(2, "replay", str(pathlib.Path(folder, "nothing")), "--session", "x")
    assert "no store" in err, err
print("a kept session is replayed")
