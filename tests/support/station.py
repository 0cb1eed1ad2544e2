"""A running station asked over HTTP. Not a test itself."""

import json
import urllib.error
import urllib.request

import harness

OPEN = ("waiting", "accepted", "under_way")


class Station:
    def __init__(self, port: int):
        self.base = f"http://127.0.0.1:{port}/api/v1/"

    def ask(self, path: str, body=None, method: str | None = None):
        """(status, answer)"""
        request = urllib.request.Request(self.base + path, None if body is None else json.dumps(body).encode(),
                                         {"Content-Type": "application/json"}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=10) as answer:
                return answer.status, json.load(answer)
        except urllib.error.HTTPError as error:
            return error.code, json.load(error)

    def up(self):
        try:
            return self.ask("status")[0] == 200
        except (urllib.error.URLError, ConnectionError):
            return False

    def vehicle(self, name: str):
        return next((v for v in self.ask("vehicles")[1]["vehicles"] if v["id"] == name), {})

    def is_ready(self, *names: str):
        """Waits until the vehicles know where they are and would arm."""
        harness.wait_until(lambda: all(self.vehicle(v).get("position") and self.vehicle(v).get("health", {}).get("prearm_ok")
                                       for v in names), 60, f"{names} are ready")

    def stopped(self, name: str):
        return next((v for v in self.ask("emergency-stop")[1]["vehicles"] if v["vehicle"] == name), {"confirmed": False})

    def give(self, action: str, *vehicles: str, **details):
        """The number of the command."""
        status, record = self.ask("commands", {"action": action, "vehicles": vehicles, "operator": "tester", **details})
        assert status == 202, record
        return record["number"]

    def set_parameter(self, vehicle: str, name: str, value: float):
        status, answer = self.ask(f"parameters/value?vehicle={vehicle}&name={name}", {"value": value, "operator": "tester"}, "PUT")
        assert status == 200, answer

    def outcomes(self, number: int):
        return next(c for c in self.ask("commands")[1]["commands"] if c["number"] == number)["vehicles"]

    def outcome(self, number: int):
        return self.outcomes(number)[0]

    def comes_to(self, number: int, state: str, seconds: float = 40):
        """The outcome of the only vehicle, once it is in that state."""
        harness.wait_until(lambda: self.outcome(number)["state"] == state, seconds, f"{state}; it is {self.outcome(number)}")
        return self.outcome(number)

    def command(self, action: str, *vehicles: str, **details):
        """The outcome of each vehicle, once all are over."""
        number = self.give(action, *vehicles, **details)
        return harness.wait_until(lambda: all(o["state"] not in OPEN for o in self.outcomes(number)) and self.outcomes(number), 60,
                                  f"{action} is over")
