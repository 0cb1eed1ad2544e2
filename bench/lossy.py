"""Exchanges over bad links beside pymavlink and MAVSDK, in real time. For run.py. The whole matrix of badness is a unit test in
virtual time (src/sim/exchange_matrix_test.cpp); these are a few of its cells with figures."""

import statistics
import subprocess

CELLS = (
    ("clean", []),
    ("10 % lost, 200 ms late", ["--loss", "0.1", "--delay", "0.2"]),
    ("30 % lost, doubled, out of order", ["--loss", "0.3", "--duplicate", "0.2", "--jitter", "0.3"]),
    ("50 % lost, 200 ms late", ["--loss", "0.5", "--delay", "0.2"]),
)
EXCHANGES = ("command", "parameter", "upload")


def measure(programs: dict, simulator, free_udp_port, say, repeats: int = 3) -> list:
    rows = []
    for cell, options in CELLS:
        for exchange in EXCHANGES:
            row = {"link": cell, "exchange": exchange}
            for name, program in programs.items():
                row[name] = tried(program, exchange, options, simulator, free_udp_port, repeats)
            rows.append(row)
            say(f"lossy   {cell:34} {exchange:10} " + "  ".join(f"{name} {text(row[name])}" for name in programs))
    return rows


def tried(program, exchange, options, simulator, free_udp_port, repeats) -> dict:
    seconds, reasons = [], []
    for repeat in range(repeats):
        port = free_udp_port()
        with simulator("--vehicles", "copter:1", "--out", f"udpout://127.0.0.1:{port}", "--seed", str(repeat + 1), *options):
            try:
                done = subprocess.run([*program, str(port), exchange], capture_output=True, text=True, timeout=150)
            except subprocess.TimeoutExpired:
                reasons.append("no end within 150 s")
                continue
        if done.returncode == 0:
            seconds.append(float(done.stdout.split()[0]))
        else:
            reasons.append((done.stderr.strip().splitlines() or ["no reason"])[-1])
    return {"median_s": statistics.median(seconds) if seconds else None, "failed": len(reasons), "of": repeats, "reasons": reasons}


def text(result: dict) -> str:
    figure = "      -  " if result["median_s"] is None else f"{result['median_s']:7.2f} s"
    return figure + (f" ({result['failed']}/{result['of']} failed)" if result["failed"] else "")
