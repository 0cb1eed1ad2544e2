"""What the tests of the whole program share: starting Lapwing, free ports, deadlines. Not a test itself."""

import atexit
import contextlib
import itertools
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
# A station keeps its map in its user's folder: no test may find there what another one has left.
if "LAPWING_TESTS_DATA" not in os.environ:
    os.environ["LAPWING_TESTS_DATA"] = os.environ["XDG_DATA_HOME"] = tempfile.mkdtemp(prefix="lapwing-tests-")
    atexit.register(shutil.rmtree, os.environ["XDG_DATA_HOME"], ignore_errors=True)
LAPWING = os.environ.get("LAPWING", str(ROOT / "build/release/bin/lapwing"))
SKIPPED = 77  # ctest's SKIP_RETURN_CODE


# Ports of this process alone: what the system hands out itself (from 32768 on) may be another test's or another program's a moment
# after it was looked at. A process holds the first port of each block that it took, which keeps other processes out of the block, and
# no port is given twice, since whoever got it may not have bound it yet. Below them are those of the domains of ROS 2 that tests have.
PORTS = range(20480, 32480)
PORTS_EACH = 32
_claims: list[socket.socket] = []
_lock = threading.Lock()


def _claimed(ports: range):
    """Those of them that nobody holds, each held from then on until this process ends; processes begin at different ones."""
    begin = os.getpid() % len(ports)
    for port in [*ports[begin:], *ports[:begin]]:
        claim = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            claim.bind(("127.0.0.1", port))
        except OSError:
            claim.close()
            continue
        _claims.append(claim)
        yield port
    raise OSError("all ports for tests are taken")


def _blocks():
    return (range(first + 1, first + PORTS_EACH) for first in _claimed(PORTS[::PORTS_EACH]))


_ports = itertools.chain.from_iterable(_blocks())


def _is_free(port: int, kind: socket.SocketKind) -> bool:
    with socket.socket(socket.AF_INET, kind) as probe:
        if kind == socket.SOCK_STREAM:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)  # one of a server that has ended is free
        try:
            probe.bind(("127.0.0.1", port))
        except OSError:
            return False
        return True


def _free_port(kind: socket.SocketKind) -> int:
    with _lock:
        return next(port for port in _ports if _is_free(port, kind))


def free_udp_port() -> int:
    return _free_port(socket.SOCK_DGRAM)


def free_tcp_port() -> int:
    return _free_port(socket.SOCK_STREAM)


def own_domain() -> int:
    """A domain of ROS 2 that no other test has while this process lives: src/bus/testing/own_domain.hpp holds them in the same way."""
    first_port, ports_each, domains = 7400, 250, 50
    last = ports_each - 1
    held = next(_claimed(range(first_port + ports_each + last, first_port + ports_each * domains + last + 1, ports_each)))
    return (held - first_port) // ports_each


@contextlib.contextmanager
def lapwing(*arguments: str):
    """Run the program until the block ends; its standard error is shown when the test fails."""
    process = subprocess.Popen([LAPWING, *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    try:
        yield process
    except BaseException:
        process.send_signal(signal.SIGINT)
        with contextlib.suppress(subprocess.TimeoutExpired):
            print(process.communicate(timeout=10)[0], file=sys.stderr)
        raise
    finally:
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
            try:
                process.wait(timeout=10)
            except subprocess.TimeoutExpired:
                process.kill()
                raise AssertionError("lapwing did not end within 10 s of an interrupt") from None


PAUSE = 0.005  # who asks without end takes the processor from who is asked, and from other tests


def wait_until(condition, seconds: float, what: str, pause: float = PAUSE):
    """Poll `condition` until it is true; fail with `what` after `seconds`.

    A condition that itself waits for one message after the other passes `pause=0`: with a pause after each it falls behind who
    sends many.
    """
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        result = condition()
        if result:
            return result
        if pause:
            time.sleep(pause)
    raise AssertionError(f"not within {seconds} s: {what}")


def finish(*arguments: str, seconds: float = 120, **popen):
    """Run the program to its end: (exit code, standard output, standard error)."""
    done = subprocess.run([LAPWING, *arguments], capture_output=True, text=True, timeout=seconds, **popen)
    return done.returncode, done.stdout, done.stderr


def expect_exit(expected: int, *arguments: str, **keywords):
    """Run to the end, demand the exit code, return (standard output, standard error)."""
    code, out, err = finish(*arguments, **keywords)
    assert code == expected, f"lapwing {' '.join(arguments)}: exit {code}, expected {expected}\n{out}\n{err}"
    return out, err
