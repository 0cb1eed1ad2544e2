"""Commands given to a station over HTTP, and what it says of them. Not a test itself."""

import datetime
import re

import harness
from station import Station


class Watch:
    """What the station's log says of a vehicle's commands."""

    def __init__(self, station: Station):
        self.station = station

    def end(self) -> int:
        return max((line["seq"] for line in self.station.ask("log")[1]["lines"]), default=0)

    def said(self, vehicle: int, after: int, rule: str = "[a-z_]+") -> list[str]:
        return [line["text"] for line in self._lines(vehicle, after, rule)]

    def said_at(self, vehicle: int, after: int, rule: str) -> float:
        """When it was said first, in seconds of the calendar."""
        return datetime.datetime.fromisoformat(self._lines(vehicle, after, rule)[0]["time"]).timestamp()

    def _lines(self, vehicle: int, after: int, rule: str) -> list[dict]:
        lines = self.station.ask(f"log?after={after}")[1]["lines"]
        return [line for line in lines if re.search(rf"of [a-z]+ {vehicle}: .*\[{rule}\]", line["text"])]

    def over(self, vehicle: int, after: int, action: str) -> dict | None:
        """The last such command's end: that of the one before it, which it cut short, comes first."""
        lines = [line["text"] for line in self.station.ask(f"log?after={after}")[1]["lines"]]
        ends = [told for line in lines if (told := re.fullmatch(rf"{action} of vehicle {vehicle}: (\w+)(?:: (.*))?", line))]
        return {"state": ends[-1][1], "reason": ends[-1][2] or ""} if ends else None


def state_of(station: Station, vehicle: int):
    """What a command changes first."""
    now = station.vehicle(str(vehicle))
    return now["armed"], now["mode"]


def first_outcome(station: Station, watch: Watch, vehicle: int, action: str, details: dict) -> dict:
    """When it shows anything. The station forgets what is over as soon as others have something to tell; then its log has it."""
    before = watch.end()
    number = station.give(action, str(vehicle), **details)

    def shown():
        try:
            now = station.outcome(number)
        except StopIteration:
            return watch.over(vehicle, before, action)
        return now if now["state"] not in ("waiting", "accepted") else None

    return harness.wait_until(shown, 30, f"{action} of {vehicle} shows")


def is_refused(station: Station, watch: Watch, case):
    _, vehicle, action, details, rule = case
    before = state_of(station, vehicle)
    outcome = first_outcome(station, watch, vehicle, action, details)
    assert outcome["state"] == "refused" and f"[{rule}]" in outcome["reason"], outcome
    assert state_of(station, vehicle) == before, (before, state_of(station, vehicle))


def obeys(station: Station, watch: Watch, vehicle: int, action: str, details: dict):
    """It is confirmed, or on its way to that."""
    outcome = first_outcome(station, watch, vehicle, action, details)
    assert outcome["state"] in ("under_way", "confirmed"), outcome


def is_warned_of(station: Station, watch: Watch, case):
    _, vehicle, action, details, rule = case
    before = watch.end()
    obeys(station, watch, vehicle, action, details)
    assert watch.said(vehicle, before, rule), watch.said(vehicle, before)


def goes_through(station: Station, watch: Watch, case):
    _, vehicle, action, details = case
    before = watch.end()
    obeys(station, watch, vehicle, action, details)
    said = watch.said(vehicle, before)
    allowed = [f"allowed: {reason}" for reason in details.get("allow", {}).values()]
    assert len(said) == len(allowed) and all(word in line for word, line in zip(allowed, said)), said
