"""The router beside mavlink-router and beside no router at all: messages a second without loss, latency, processor time.

Each candidate gets the same load from bench_router_load: one sender, one or three receivers. The receivers' own losses are told
apart. The binary of mavlink-router is named by the environment variable MAVLINK_ROUTERD; docs/reference/benchmarks.md tells how it is built.
"""

import contextlib
import json
import os
import pathlib
import socket
import subprocess
import tempfile
import time

RATES = (10_000, 35_000, 50_000, 75_000, 100_000)
SECONDS = 5.0


def free_ports(count: int) -> list[int]:
    with contextlib.ExitStack() as stack:
        probes = [stack.enter_context(socket.socket(socket.AF_INET, socket.SOCK_DGRAM)) for _ in range(count)]
        for probe in probes:
            probe.bind(("127.0.0.1", 0))
        return [probe.getsockname()[1] for probe in probes]


def is_bound(port: int) -> bool:
    return any(line.split()[1].endswith(f":{port:04X}") for line in pathlib.Path("/proc/net/udp").read_text().splitlines()[1:])


def cpu_seconds(pid: int) -> float:
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def lapwing_command(program, folder, entry, sinks):
    endpoints = [f"--endpoint=udpin://127.0.0.1:{entry}", *(f"--endpoint=udpout://127.0.0.1:{sink}" for sink in sinks)]
    return [program, "route", *endpoints]


def mavlink_router_command(program, folder, entry, sinks):
    config = pathlib.Path(folder, "main.conf")
    lines = ["[General]", "TcpServerPort=0", "[UdpEndpoint in]", "Mode=Server", "Address=127.0.0.1", f"Port={entry}"]
    for number, sink in enumerate(sinks):
        lines += [f"[UdpEndpoint out{number}]", "Mode=Normal", "Address=127.0.0.1", f"Port={sink}"]
    config.write_text("\n".join(lines) + "\n")
    return [program, "-c", str(config)]


@contextlib.contextmanager
def running(command, entry):
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        deadline = time.monotonic() + 10
        while not is_bound(entry):
            if process.poll() is not None or time.monotonic() > deadline:
                raise SystemExit(f"{command[0]} does not listen on UDP port {entry}")
            time.sleep(0.02)
        yield process
    finally:
        process.terminate()
        process.wait(timeout=10)


def measure_one(load, make_command, program, sinks: int, rate: int) -> dict:
    entry, *outs = free_ports(1 + sinks)
    with tempfile.TemporaryDirectory() as folder, contextlib.ExitStack() as stack:
        process = None
        if make_command:
            process = stack.enter_context(running(make_command(program, folder, entry, outs), entry))
        before = cpu_seconds(process.pid) if process else 0.0
        target = entry if process else outs[0]
        done = subprocess.run([load, str(target), ",".join(map(str, outs)), str(rate), str(SECONDS)], capture_output=True,
                              text=True, check=True, timeout=120)
        row = json.loads(done.stdout)
        row["loss"] = 1 - row["received"] / row["expected"]
        if process:
            row["cpu_us_per_message"] = 1e6 * (cpu_seconds(process.pid) - before) / (rate * (SECONDS + 0.5))
        return row


def measure(lapwing, load, say) -> list:
    candidates = [("direct", None, None), ("lapwing", lapwing_command, lapwing)]
    peer = os.environ.get("MAVLINK_ROUTERD")
    if peer:
        candidates.append(("mavlink-router", mavlink_router_command, peer))
    else:
        say("router  MAVLINK_ROUTERD is not set: figures without mavlink-router (docs/reference/benchmarks.md)")
    rows = []
    for sinks in (1, 3):
        for rate in RATES:
            for name, make_command, program in candidates:
                if name == "direct" and sinks > 1:
                    continue
                row = {"candidate": name, "sinks": sinks, "rate": rate} | measure_one(load, make_command, program, sinks, rate)
                rows.append(row)
                cpu = f"{row['cpu_us_per_message']:6.2f} us CPU/message" if "cpu_us_per_message" in row else ""
                say(f"router  1 to {sinks} {rate:7} messages/s  {name:15} loss {row['loss']:9.4%}  p50 {row['p50_us']:9.1f} us  "
                    f"p99 {row['p99_us']:9.1f} us  {cpu}" + (f"  ({row['sink_overruns']} lost by the receiver)" if row["sink_overruns"] else ""))
    return rows
