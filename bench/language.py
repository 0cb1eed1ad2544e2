"""The mission language beside the original Dolphin core: start-up, guards and task steps per second, memory.

The original is a Groovy program that is not part of this project. Its figures are taken where it was built beside it:

    DOLPHIN_ORIGINAL   class path: the compiled dolphin-core, groovy-all 2.4, and bench/dolphin_original/DolphinPeer.java compiled
                       against both

Without it only ours are printed. Both run the same scripts; both step as fast as they can (the original's `execute` sleeps 100 ms
between steps, which is left out here, in its favour).
"""

import os
import pathlib
import statistics
import subprocess
import tempfile
import time

GUARDS = 1_000_000
OPENS = [f"--add-opens=java.base/java.{package}=ALL-UNNAMED" for package in ("lang", "util", "io", "net")]

FIRST_STEP = "execute action { println 'first' }\n"


def concurrent(tasks: int, evaluations: int) -> str:
    """`tasks` conditions side by side; together they test their guards about `evaluations` times."""
    return (f"n = 0\nt = condition {{ ++n; n >= {evaluations} }}\n"
            f"for (int i = 1; i < {tasks}; i++) {{ t = t | condition {{ ++n; n >= {evaluations} }} }}\n")


class Ours:
    def __init__(self, lapwing: pathlib.Path, stepper: pathlib.Path):
        self.lapwing, self.stepper = lapwing, stepper

    def run(self, script):
        return [self.lapwing, "run", "--platform", "test", script]

    def step(self, script):
        return [self.stepper, script]


class Original:
    def __init__(self, class_path: str):
        self.java = ["java", *OPENS, "-cp", class_path, "DolphinPeer"]

    def run(self, script):
        return [*self.java, "run", script]

    def step(self, script):
        return [*self.java, "step", script]


def to_first_line(command) -> float:
    started = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    try:
        line = process.stdout.readline()
        took = time.perf_counter() - started
    finally:
        process.stdout.close()
        process.wait(timeout=30)
    if line.strip() != b"first":
        raise SystemExit(f"language: {command} printed {line!r}")
    return took


def stepping(command) -> tuple[float, float]:
    """Seconds, and peak resident MB of that process."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    peak = 0.0
    while process.poll() is None:  # not getrusage(): a child's peak there begins with that of the interpreter which forked it
        peak = max(peak, peak_resident_mb(process.pid))
        time.sleep(0.005)
    if process.returncode != 0:
        raise SystemExit(f"language: {command} ended with {process.returncode}")
    return float(process.stdout.read().split()[-1]), peak


def peak_resident_mb(pid: int) -> float:
    for line in pathlib.Path(f"/proc/{pid}/status").read_text().splitlines():
        if line.startswith("VmHWM:"):
            return int(line.split()[1]) / 1024
    return 0.0  # it has just ended


def measure(lapwing: pathlib.Path, stepper: pathlib.Path, say, repeats: int = 5) -> dict:
    sides = {"lapwing": Ours(lapwing, stepper)}
    if class_path := os.environ.get("DOLPHIN_ORIGINAL"):
        sides["original"] = Original(class_path)
    else:
        say("language: the original is not here (DOLPHIN_ORIGINAL is not set): only ours")
    figures: dict = {name: {} for name in sides}
    with tempfile.TemporaryDirectory() as folder:
        script = pathlib.Path(folder, "script.dolphin")
        script.write_text(FIRST_STEP)
        starts: dict = {name: [] for name in sides}
        for _ in range(repeats):
            for name, side in sides.items():
                starts[name].append(to_first_line(side.run(script)))
        report(figures, "start_s", {name: statistics.median(s) for name, s in starts.items()}, say,
               "start to first task step", lambda s: f"{s * 1000:9.1f} ms", smaller_is_better=True)
        for tasks in (1, 100, 1000):
            script.write_text(concurrent(tasks, GUARDS))
            rates: dict = {name: [] for name in sides}
            memory: dict = {}
            for _ in range(3):
                for name, side in sides.items():
                    seconds, megabytes = stepping(side.step(script))
                    rates[name].append(GUARDS / seconds)
                    memory[name] = megabytes
            report(figures, f"steps_per_s_{tasks}", {name: statistics.median(r) for name, r in rates.items()}, say,
                   f"guards and steps per second, {tasks} concurrent", lambda r: f"{r / 1e6:9.3f} M")
            report(figures, f"peak_mb_{tasks}", memory, say, f"peak memory, {tasks} concurrent", lambda m: f"{m:9.1f} MB", smaller_is_better=True)
    return figures


def report(figures, key, values, say, what, show, smaller_is_better=False):
    for name, value in values.items():
        figures[name][key] = value
    line = "  ".join(f"{name} {show(value)}" for name, value in values.items())
    if "original" in values:
        ratio = values["original"] / values["lapwing"] if smaller_is_better else values["lapwing"] / values["original"]
        line += f"  ours is {ratio:.1f} x better"
    say(f"language  {what:48} {line}")
