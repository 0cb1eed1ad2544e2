"""Somebody who reads a guide at a terminal: saves its scripts, types its commands in order, and ends what goes on. Not a test itself.

What differs from a reader's machine: ports are free ones, so that tests run beside each other; `./lapwing` is the program that
was built; a serial device is the simulated vehicles' UDP port; simulated vehicles live twenty times as fast, unless the page has a pace of its own.
"""

import contextlib
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time
import urllib.request

import documents
import harness

SPEEDUP = 20
LONGEST_S = 240  # of a step: a survey that takes 90 s alone took more than 120 beside other tests
# Verbs that listen to vehicles on UDP port 14550 when no link is given.
LISTENERS = re.compile(r"lapwing (?:run|param|signing setup|mission (?:upload|download|clear))\b")
SERVERS = re.compile(r"lapwing (?:demo|station|replay)\b")


class Reader:
    def __init__(self, folder: pathlib.Path):
        self.folder = folder
        self.ports = {"14550": harness.free_udp_port(), "14551": harness.free_udp_port(), "8080": harness.free_tcp_port(),
                      "3000": harness.free_tcp_port()}
        self.going_on: list[tuple[str, subprocess.Popen, pathlib.Path]] = []
        (folder / "examples").symlink_to(harness.ROOT / "examples")
        (folder / "bin").mkdir()
        for place in (folder / "bin/lapwing", folder / "lapwing"):
            place.symlink_to(harness.LAPWING)
        self.environment = {**os.environ, "PATH": f"{folder / 'bin'}:{os.environ['PATH']}", "XDG_CACHE_HOME": str(folder / "cache")}

    # ---- what is typed

    def adapted(self, line: str) -> str:
        line = re.sub(r"\s+# .*$", "", line)
        is_listener = LISTENERS.search(line) and not re.search(r"--(sim|link|platform)\b", line)
        if is_listener:
            line += " --link udpin://127.0.0.1:14550"
        if re.search(r"lapwing signing", line):
            line = re.sub(r"serial://\S+", "udpin://127.0.0.1:14550", line)
        if SERVERS.search(line) and "--port" not in line:
            line += " --port 8080"
        has_simulated_time = re.search(r"lapwing sim\b", line) or re.search(r"lapwing run\b.*--link", line)
        if has_simulated_time and "--speedup" not in line:
            line += f" --speedup {SPEEDUP}"
        line = line.replace("curl ", "curl --silent --show-error --fail-with-body ")
        return re.sub(r"\b(14550|14551|8080|3000)\b", lambda port: str(self.ports[port[0]]), line)

    def shown(self, line: str) -> str:
        """A line of the page as this reader sees it."""
        return re.sub(r"\b(14550|14551|8080|3000)\b", lambda port: str(self.ports[port[0]]), line)

    def start(self, line: str, until: str):
        path = self.folder / f"output-{len(self.going_on)}-{time.monotonic_ns()}"
        with path.open("w") as output:
            process = subprocess.Popen(["bash", "-c", f"exec {self.adapted(line)}"], cwd=self.folder, env=self.environment,
                                       stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT)
        self.going_on.append((re.search(r"lapwing (\w+)", line)[1], process, path))
        harness.wait_until(lambda: until in path.read_text() or process.poll() is not None or time.sleep(0.02), 60,
                           f"{line}: {until!r} in\n{path.read_text()}")
        assert process.poll() is None, f"{line} ends with {process.returncode}\n{path.read_text()}"
        if address := re.search(r"map  (http://\S+)", path.read_text()):
            with urllib.request.urlopen(address[1], timeout=20) as page:
                assert page.status == 200, page.status
        return path.read_text()

    def end(self, verb: str | None = None):
        """Ctrl-C, and a look at how they take it."""
        for one in [one for one in reversed(self.going_on) if verb in (None, one[0])]:
            self.going_on.remove(one)
            name, process, path = one
            assert process.poll() is None, f"lapwing {name} has ended with {process.returncode}\n{path.read_text()}"
            process.send_signal(signal.SIGINT)
            code = process.wait(timeout=30)
            assert code in (0, 130), f"lapwing {name} ends with {code} after Ctrl-C\n{path.read_text()}"

    def kill(self):
        for _, process, _ in self.going_on:
            with contextlib.suppress(ProcessLookupError):
                process.kill()
            process.wait()

    # ---- the steps of a page

    def follow(self, step: documents.Block):
        if not isinstance(step, documents.Commands):
            (self.folder / step.words.get("file", "my.dolphin")).write_text(step.script)
            return
        if "skipped" in step.words:
            return
        if "ends" in step.words:
            self.end(step.words["ends"])
        if "vehicles" in step.words:
            self.start(f"lapwing sim --vehicles {step.words['vehicles']} --out udpout://127.0.0.1:14550", "Ctrl-C ends")
        beside = step.words.get("beside")
        if beside and not any(name == beside for name, _, _ in self.going_on):
            # Whoever types the next line has seen by then that the vehicles are there.
            sees = " found at " if any(name == "sim" for name, _, _ in self.going_on) else "map  "
            self.start(f"lapwing {beside} --link udpin://127.0.0.1:14550", sees)
        said = ""
        for line in step.lines:
            said += self.start(line, step.words.get("until", "")) if "background" in step.words else self.type(line, step)
        for line in step.text or []:
            assert self.shown(line).strip() in said, f"{step.place}: no {self.shown(line)!r} in\n{said}"
        if "vehicles" in step.words:
            self.end("sim")

    def type(self, line: str, step: documents.Block) -> str:
        if line.startswith("curl") and not shutil.which("curl"):
            return ""
        try:
            done = subprocess.run(["bash", "-c", self.adapted(line)], cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=LONGEST_S)
        except subprocess.TimeoutExpired as late:
            raise AssertionError(f"{step.place}: {self.adapted(line)} has not ended after {LONGEST_S} s\n{(late.stdout or b'').decode()}") from late
        allowed = [int(code) for code in step.words.get("exit", "0").split("|")]
        assert done.returncode in allowed, f"{step.place}: {self.adapted(line)} ends with {done.returncode}\n{done.stdout}"
        return done.stdout
