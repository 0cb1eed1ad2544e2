"""A script has a survey drone survey a car park by itself, beside a robot in its building: the drone arms, takes off, explores, and comes home when
a guard has heard of enough free places. Then one that is interrupted: the drone stays where it is, and without its script it comes home."""

import pathlib
import re
import signal
import subprocess
import tempfile

import harness
import survey
from drone import Drone, Operator

SCRIPT = """
hawk = pick { type 'UAV'; payload 'Camera'; timeout 60.seconds }
robot = pick { type 'UGV'; timeout 60.seconds }
execute hawk: (lot { explore() } / { freeSlots(hawk) >= 6 }) >> lot { comeHome() }, robot: drive { wait 3 }
message "${freeSlots(hawk)} free, ${takenSlots(hawk)} taken, ${coverage(hawk) > 0.2}"
"""
ENDLESS = """
hawk = pick { type 'UAV'; payload 'Camera'; timeout 60.seconds }
execute hawk: lot { explore(); wait 600; comeHome() }
"""
OFFICE = pathlib.Path(__file__).parents[3] / "examples/buildings/office.toml"


def lapwing(folder: str, script: str, drone: Drone, *more: str) -> subprocess.Popen:
    path = pathlib.Path(folder, "survey.dolphin")
    path.write_text(script)
    return subprocess.Popen([harness.LAPWING, "run", path, "--survey", f"127.0.0.1:{drone.port}", *more, "--timeout", "240"],
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


with Drone(processes=survey.tables()) as drone, tempfile.TemporaryDirectory() as folder:
    watcher = Operator(drone.port, name="watcher")
    watcher.wait(lambda o: o.last, "the first heartbeat", 20)
    watcher.command("Configure", Min=7, Des=9, Max=12)
    run = lapwing(folder, SCRIPT, drone, "--robot", f"sim:{OFFICE}")
    out, said = run.communicate(timeout=250)
    assert run.returncode == 0, f"{run.returncode}\n{out}\n{said}"
    told = re.search(r"(\d+) free, (\d+) taken, true", out)
    assert told and int(told[1]) >= 6, out
    seen = [one["State"] for one in watcher.heartbeats]
    seen = [state for before, state in zip([None, *seen], seen) if state != before]
    wanted = ["Arm", "Takeoff", "Hover", "AutonomousExplore", "Land", "Idle"]
    assert [state for state in seen if state in wanted][-len(wanted):] == wanted, seen
    found = survey.compare(survey.found_slots(drone.folder))
    assert found["right"] >= 6, found

    run = lapwing(folder, ENDLESS, drone)
    watcher.wait_for_state("AutonomousExplore", 60)
    run.send_signal(signal.SIGINT)
    out, said = run.communicate(timeout=60)
    assert run.returncode == 130, f"{run.returncode}\n{out}\n{said}"
    watcher.wait_for_state("Hover", 10)
    watcher.command("Land")
    watcher.wait(lambda o: o.last["State"] == "Idle" and not o.last["Armed"], "it has landed", 90)
    watcher.cut()
