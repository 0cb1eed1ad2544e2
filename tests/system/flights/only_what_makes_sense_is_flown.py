"""What no pilot would fly is refused, or warned of, before the vehicle is armed; what people fly is not remarked on. Through the
whole program, on simulated copters, planes, rovers, boats, submarines and PX4."""

import json
import pathlib

import cases
import harness
from plausibility import flights
from plausibility.flights import IMPLAUSIBLE, PLAUSIBLE


def fly(vehicles: str, script: str, *options: str) -> flights.Flight:
    home = () if "--home" in options else ("--home", flights.HOME)
    return flights.fly(harness.finish, script, "--sim", vehicles, *home, *options)


assert len(IMPLAUSIBLE) >= 40 and len(PLAUSIBLE) >= 40
bad = cases.failures(lambda case: flights.refused_or_warned(case, fly(case[1], case[2], *case[5:])), IMPLAUSIBLE)
bad += cases.failures(lambda case: flights.not_remarked(case, fly(*case[1:])), PLAUSIBLE)
assert not bad, f"{len(bad)} of {len(IMPLAUSIBLE) + len(PLAUSIBLE)}:\n" + "\n".join(bad)

# ---- no false alarm over what is shipped

def doubts(*arguments: str) -> list[str]:
    """What `check` finds implausible, as file:line."""
    _, out, _ = harness.finish("check", "--json", *arguments)
    return [f"{pathlib.Path(record['file']).name}:{record['line']}" for record in json.loads(out) if record.get("code") == "implausible-mission"]


SCRIPTS = [str(path) for place in ("examples", "tests/conformance") for path in sorted((harness.ROOT / place).rglob("*.dolphin"))]
assert len(SCRIPTS) > 300, len(SCRIPTS)
# One script, in the style of those that people publish, takes off to its home itself and surveys at the height of the ground.
TRUE_ALARMS = ["mission_survey.dolphin:5", "mission_survey.dolphin:6"]
assert doubts(*SCRIPTS) == TRUE_ALARMS, doubts(*SCRIPTS)
# Nor is the check blind: the same words find what is wrong, until it is allowed by name with a reason.
ODD = str(harness.ROOT / "tests/golden/codes/implausible-mission.dolphin")
assert doubts(ODD) == [f"implausible-mission.dolphin:{line}" for line in (2, 4, 6)], doubts(ODD)
assert doubts(ODD, "--allow", "no_take_off=thrown by hand") == ["implausible-mission.dolphin:2"]
assert not doubts(ODD, "--allow", "no_take_off=thrown by hand", "--allow", "take_off_height=from a cliff")
for name in ("survey", "relay", "patrol", "rover_and_drone", "error_handling"):
    _, err = harness.expect_exit(0, "plan", str(harness.ROOT / f"examples/{name}.dolphin"))
    assert "warning" not in err, f"{name}: {err}"
print(f"{len(IMPLAUSIBLE)} implausible flights refused or warned of, {len(PLAUSIBLE)} plausible ones flown, no false alarm")
