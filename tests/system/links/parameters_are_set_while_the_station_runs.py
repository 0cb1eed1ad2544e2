"""Parameters over HTTP while `lapwing station` holds the link of `lapwing sim`: fetched only when somebody asks, set and read back,
refused in words; who commands the vehicle is asked as with commands."""

import json
import os
import tempfile
import urllib.error
import urllib.parse
import urllib.request

import harness


class Station:
    def __init__(self, port: int):
        self.base = f"http://127.0.0.1:{port}/api/v1/"

    def ask(self, path: str, body=None, method=None, **query: str):
        """(status, answer)"""
        url = self.base + path + ("?" + urllib.parse.urlencode(query) if query else "")
        request = urllib.request.Request(url, None if body is None else json.dumps(body).encode(),
                                         {"Content-Type": "application/json"}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=60) as answer:
                text = answer.read().decode()
                return answer.status, json.loads(text) if "json" in answer.headers["Content-Type"] else text
        except urllib.error.HTTPError as error:
            return error.code, json.load(error)

    def has(self, name: str) -> bool:
        try:
            return any(v["id"] == name and v["connection"] == "ok" for v in self.ask("vehicles")[1]["vehicles"])
        except (urllib.error.URLError, ConnectionError):
            return False

    def set(self, vehicle: str, name: str, value, **more):
        return self.ask("parameters/value", {"value": value, **more}, "PUT", vehicle=vehicle, name=name)


link, web = harness.free_udp_port(), harness.free_tcp_port()
station = Station(web)
with tempfile.TemporaryDirectory() as cache:
    os.environ["XDG_CACHE_HOME"] = cache
    with harness.lapwing("station", "--link", f"udpin://127.0.0.1:{link}", "--port", str(web)) as program, \
            harness.lapwing("sim", "--vehicles", "copter:2", "--out", f"udpout://127.0.0.1:{link}"):
        harness.wait_until(lambda: station.has("1") and station.has("2"), 30, "two vehicles are heard")

        # All of them, with types; as a file, without asking the vehicle again.
        status, found = station.ask("parameters", vehicle="1")
        assert status == 200 and found["confirmed"] == "vehicle" and len(found["parameters"]) > 150, found
        values = {each["name"]: each for each in found["parameters"]}
        assert values["RTL_ALT"] == {"name": "RTL_ALT", "value": 1500, "type": "int32"}, values["RTL_ALT"]
        assert values["INS_ACCSCAL_X"]["value"] == 1.001, values["INS_ACCSCAL_X"]
        assert station.ask("parameters/progress", vehicle="1")[1] == {"vehicle": "1", "fetching": False}
        status, file = station.ask("parameters/file", vehicle="1", cached="true")
        assert "1\t1\tRTL_ALT\t1500\t6\n" in file and "# Stack: ArduPilot" in file, file[:300]

        # One: set, read back, and the list that was fetched is corrected.
        status, set_ = station.set("1", "RTL_ALT", 2500, operator="anna")
        assert (status, set_) == (200, {"name": "RTL_ALT", "value": 2500, "type": "int32", "vehicle": "1", "before": 1500}), set_
        assert station.ask("parameters/value", vehicle="1", name="RTL_ALT")[1]["value"] == 2500
        assert station.ask("parameters/value", vehicle="2", name="RTL_ALT")[1]["value"] == 1500
        old = station.ask("parameters", vehicle="1", cached="true")[1]
        assert old["confirmed"] == "no" and {"name": "RTL_ALT", "value": 2500, "type": "int32"} in old["parameters"], old["confirmed"]

        # Refused in words.
        status, told = station.set("1", "RTL_ALT", 0.5)
        assert status == 400 and "integer" in told["detail"], told
        assert station.set("1", "RTL_ALT", "high")[0] == 400
        assert station.ask("parameters", vehicle="9") == (404, {"title": "Not Found", "status": 404, "detail": "there is no vehicle 9"})
        status, told = station.set("1", "NO_SUCH", 1)
        assert status == 504 and "did not answer about parameter NO_SUCH" in told["detail"], told
        assert station.ask("control/request", {"vehicle": "2", "operator": "anna"})[0] == 202
        status, told = station.set("2", "RTL_ALT", 2000, operator="ben")
        assert status == 409 and told["detail"] == "copter 2 is commanded by anna", told
        assert station.set("2", "RTL_ALT", 2000, operator="anna")[0] == 200
        station.ask("emergency-stop", {"operator": "ben"})
        status, told = station.set("1", "RTL_ALT", 1000)
        assert status == 409 and "emergency stop by ben" in told["detail"], told
        assert station.ask("parameters/value", vehicle="1", name="RTL_ALT")[1]["value"] == 2500
    assert program.returncode is not None
print("parameters are set while the station runs")
