"""Exchanges over bad links beside pymavlink and MAVSDK, in real time. For run.py. The whole matrix of badness is a unit test in
virtual time (src/sim/mavlink/exchange_matrix_test.cpp); these are a few of its cells with figures."""

import concurrent.futures
import statistics
import subprocess

CELLS = (
    ("clean", []),
    ("10 % lost, 200 ms late", ["--loss", "0.1", "--delay", "0.2"]),
    ("30 % lost, doubled, out of order", ["--loss", "0.3", "--duplicate", "0.2", "--jitter", "0.3"]),
    ("50 % lost, 200 ms late", ["--loss", "0.5", "--delay", "0.2"]),
)
EXCHANGES = ("command", "parameter", "upload")


def measure(programs: dict, simulator, free_udp_port, say, repeats: int = 12) -> list:
    rows = []
    for cell, options in CELLS:
        for exchange in EXCHANGES:
            row = {"link": cell, "exchange": exchange}
            for name, program in programs.items():
                row[name] = tried(program, [exchange], options, simulator, free_udp_port, repeats)
            rows.append(row)
            say(f"lossy   {cell:34} {exchange:10} " + "  ".join(f"{name} {text(row[name])}" for name in programs))
    return rows


def tried(program, exchange, options, simulator, free_udp_port, repeats, at_once=None, patience: float = 150) -> dict:
    """On a bad link all repeats at once: there they wait for nearly all of their time, and three would be a lottery. `exchange` is what the
    program is told behind the port."""
    def once(repeat: int, port: int):
        with simulator("--vehicles", "copter:1", "--out", f"udpout://127.0.0.1:{port}", "--seed", str(repeat + 1), *options):
            try:
                done = subprocess.run([*program, str(port), *exchange], capture_output=True, text=True, timeout=patience)
            except subprocess.TimeoutExpired:
                return None, f"no end within {patience:.0f} s"
        if done.returncode == 0:
            return float(done.stdout.split()[0]), None
        return None, (done.stderr.strip().splitlines() or ["no reason"])[-1]

    with concurrent.futures.ThreadPoolExecutor(at_once or repeats) as pool:
        results = [future.result() for future in [pool.submit(once, repeat, free_udp_port()) for repeat in range(repeats)]]
    seconds = [took for took, _ in results if took is not None]
    reasons = [reason for _, reason in results if reason]
    return {"median_s": statistics.median(seconds) if seconds else None, "failed": len(reasons), "of": repeats, "reasons": reasons}


def text(result: dict) -> str:
    figure = "       -  " if result["median_s"] is None else f"{result['median_s']:8.3f} s"
    return figure + (f" ({result['failed']}/{result['of']} failed)" if result["failed"] else "")
