"""`lapwing run` with pymavlink's copters on the other end, to its end. Not a test itself."""

import dataclasses
import json
import pathlib
import subprocess
import tempfile
import time

import copter
import harness

# Fast enough for a test, slow enough for a busy machine: a second of the vehicles is a fifth of ours.
SPEEDUP = 5

# A place, then out and back in legs of a second: long enough to break something on the way.
MISSION = """
there = mission {
  name 'There and back'
  home location(41.1780, -8.5980, 90)
  takeOff location(41.1780, -8.5980, 110)
  move 60, 0
  move 0, 40
  move 60, 0
  move 0, 40
  returnHomeAndLand()
}
"""
ITEMS = 7  # of it on the wire, home included


@dataclasses.dataclass
class Flight:
    """How a run ended."""

    code: int
    out: str
    err: str
    report: dict

    def __str__(self):
        return f"exit {self.code}\n--- out\n{self.out}\n--- err\n{self.err}\n--- errors\n{self.report.get('errors')}"

    def expect(self, code: int, *words: str):
        """The exit code, and each of the words among what people read. Returns itself."""
        assert self.code == code, f"expected exit {code}: {self}"
        for word in words:
            assert word in self.out + self.err, f"no {word!r} in {self}"
        return self

    def missions(self) -> list[dict]:
        return [mission for vehicle in self.report["vehicles"] for mission in vehicle["missions"]]


class Field:
    """A UDP port with copters that send to it; time in their seconds."""

    def __init__(self, speedup: float = SPEEDUP, leg_time: float = 1.0):
        self.port, self.speedup, self.leg_time, self.copters = harness.free_udp_port(), speedup, leg_time, []

    def add(self, system_id: int = 7) -> copter.Copter:
        self.copters.append(copter.Copter(self.port, system_id, self.speedup, self.leg_time))
        return self.copters[-1]

    def now(self) -> float:
        return time.monotonic() * self.speedup

    def step(self):
        for each in self.copters:
            each.step(self.now())
        copter.wait_for_traffic(self.copters, 0.02 / self.speedup) if self.copters else time.sleep(0.02)

    def stay(self, seconds: float):
        """Goes on after the run, for what must not come any more."""
        end = self.now() + seconds
        while self.now() < end:
            self.step()

    def fly(self, script: str, *arguments: str, happens=lambda now: None, limit: float = 100) -> Flight:
        """Runs the script; `happens` is called at every turn with the vehicles' time. `limit` in our seconds."""
        with tempfile.TemporaryDirectory() as folder:
            path, report = pathlib.Path(folder, "script.dolphin"), pathlib.Path(folder, "report.json")
            out, err = pathlib.Path(folder, "out"), pathlib.Path(folder, "err")
            path.write_text(script)
            with out.open("w") as out_file, err.open("w") as err_file:
                run = subprocess.Popen([harness.LAPWING, "run", str(path), "--link", f"udpin://127.0.0.1:{self.port}",
                                        "--speedup", str(self.speedup), "--report", str(report), *arguments],
                                       stdout=out_file, stderr=err_file)
                try:
                    deadline = time.monotonic() + limit
                    while run.poll() is None and time.monotonic() < deadline:
                        self.step()
                        happens(self.now())
                finally:
                    in_time = run.poll() is not None
                    if not in_time:
                        run.kill()
                    run.wait()
            written = json.loads(report.read_text()) if report.exists() else {}
            flight = Flight(run.returncode, out.read_text(), err.read_text(), written)
        assert in_time, f"the run did not end within {limit} s: {flight}"
        for each in self.copters:
            assert not each.problems, "\n".join(each.problems)
        return flight
