"""More simulated vehicles than the machine can move at the pace asked for: the simulator still ends when it is told to, and
time waits for the machine, so that nobody who shares the simulation's loop takes a vehicle for lost."""

import signal
import subprocess
import tempfile
import time

import harness

STREAMS = [f"--param=SR0_{stream}=10" for stream in ("POSITION", "EXTRA1", "EXTRA2", "EXTRA3", "EXT_STAT")]


def ends_on(number):
    port = harness.free_udp_port()
    simulator = subprocess.Popen([harness.LAPWING, "sim", "--vehicles", "copter:250", "--speedup", "1000",
                                  "--out", f"udpout://127.0.0.1:{port}", *STREAMS],
                                 stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        time.sleep(4)  # until it is as late as it will be
        assert simulator.poll() is None, "it runs"
        simulator.send_signal(number)
        asked = time.monotonic()
        simulator.wait(timeout=20)
        print(f"ended {time.monotonic() - asked:.1f} s after {signal.Signals(number).name}")
    finally:
        if simulator.poll() is None:
            simulator.kill()
            simulator.wait()


def loses_nobody():
    with tempfile.NamedTemporaryFile("w", suffix=".dolphin") as script:
        script.write("all = pick { count 60; timeout 60.seconds }\npause 120\nprint 'all are there'\n")
        script.flush()
        out, err = harness.expect_exit(0, "run", script.name, "--sim", "copter:60", "--speedup", "1000", seconds=240)
    assert "all are there" in out, out
    assert "lost" not in err, err


def main():
    ends_on(signal.SIGTERM)
    ends_on(signal.SIGINT)
    loses_nobody()


main()
