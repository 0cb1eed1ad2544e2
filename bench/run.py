"""Run the benchmarks beside their peers and write build/bench-results.json. usage: run.py [decode] [pool] [feed] [start] [scale] [fleet] [language] [upload] [lossy] [params] [router] [page] [load] [store] [explore] [robots] [kill] [slam] [survey]

Every figure is taken in this one run on this machine, ours and the peer's alternating; quote ratios rather than absolute times.
"""

import contextlib
import json
import os
import pathlib
import platform
import socket
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
BENCH_BIN = ROOT / "build/bench/bin"
LAPWING = ROOT / "build/release/bin/lapwing"
PYTHON = sys.executable


def free_udp_port() -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@contextlib.contextmanager
def simulator(*arguments):
    process = subprocess.Popen([LAPWING, "sim", *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        yield process
    finally:
        process.terminate()
        process.wait(timeout=10)


def say(text: str):
    print(text, flush=True)


# ---- decode rate -------------------------------------------------------------------------------------------------------------

def decode() -> dict:
    done = subprocess.run([BENCH_BIN / "bench_decode", "--benchmark_format=json", "--benchmark_repetitions=5",
                           "--benchmark_report_aggregates_only=true"], capture_output=True, text=True, check=True)
    rates = {}
    for row in json.loads(done.stdout)["benchmarks"]:
        if row["aggregate_name"] == "median":
            rates[row["run_name"]] = row["items_per_second"]
    with tempfile.TemporaryDirectory() as folder:
        capture = pathlib.Path(folder, "capture.bin")
        subprocess.run([BENCH_BIN / "bench_decode", f"--capture={capture}"], check=True)
        rates["pymavlink/frames_and_fields"] = pymavlink_rate(capture.read_bytes())
    for name, rate in rates.items():
        say(f"decode  {name:32} {rate / 1e6:8.3f} M messages/s")
    say(f"decode  ours / C library, frames            {rates['ours/frames'] / rates['c_library/frames']:8.2f} x")
    say(f"decode  ours / C library, frames and fields {rates['ours/frames_and_fields'] / rates['c_library/frames_and_fields']:8.2f} x")
    return rates


def pymavlink_rate(data: bytes) -> float:
    from pymavlink.dialects.v20 import ardupilotmega

    rates = []
    for _ in range(3):
        parser = ardupilotmega.MAVLink(None)
        started = time.perf_counter()
        messages = parser.parse_buffer(data)
        rates.append(len(messages) / (time.perf_counter() - started))
    return statistics.median(rates)


# Each does one exchange with vehicle 1: PORT command|parameter|parameters|upload [ITEMS].
EXCHANGERS = {
    "lapwing": [BENCH_BIN / "bench_exchange"],
    "pymavlink": [PYTHON, ROOT / "bench/peer_pymavlink.py"],
    "mavsdk": [PYTHON, ROOT / "bench/peer_mavsdk.py"],
}

# ---- mission upload ----------------------------------------------------------------------------------------------------------


def upload(repeats: int = 3) -> list:
    """Without loss one after the other: there the processor sets the pace."""
    import lossy as bad_links

    rows = []
    for items in (100, 500):
        for loss in (0.0, 0.1, 0.3):
            row = {"items": items, "loss": loss}
            for name, program in EXCHANGERS.items():
                row[name] = bad_links.tried(program, ["upload", str(items)], ["--loss", str(loss)], simulator, free_udp_port, repeats,
                                        at_once=1 if loss == 0.0 else None, patience=400)
            rows.append(row)
            say(f"upload  {items:4} items {loss:4.0%} loss  " + "  ".join(f"{name} {bad_links.text(row[name])}" for name in EXCHANGERS))
    return rows


# ---- every parameter of a vehicle -------------------------------------------------------------------------------------------


def params(repeats: int = 3) -> list:
    """With the simulator, and with the vehicle that sends to UDP port LAPWING_BENCH_VEHICLE (an ArduPilot SITL of system id 1), if that is
    set."""
    rows = []
    vehicles = ["simulator"] + (["vehicle"] if "LAPWING_BENCH_VEHICLE" in os.environ else [])
    for vehicle in vehicles:
        for loss in (0.0, 0.1, 0.3):
            row = {"vehicle": vehicle, "loss": loss}
            for name, program in EXCHANGERS.items():
                row[name] = reading_time(vehicle, loss, program, repeats)
            rows.append(row)
            say(f"params  {vehicle:9} {loss:4.0%} loss  " + "  ".join(
                f"{name} {row[name]['median_s']:8.3f} s for {row[name]['parameters']}" if row[name]["median_s"] is not None
                else f"{name}   failed {row[name]['failed']}/{repeats}" for name in EXCHANGERS))
    return rows


def reading_time(vehicle: str, loss: float, program, repeats: int) -> dict:
    import lossy_relay

    seconds, failures, count = [], 0, 0
    for repeat in range(repeats):
        port = free_udp_port()
        given = int(os.environ["LAPWING_BENCH_VEHICLE"]) if vehicle == "vehicle" else 0
        with lossy_relay.LossyRelay(port, loss, repeat + 1, given) as relay, contextlib.ExitStack() as stack:
            if vehicle == "simulator":
                stack.enter_context(simulator("--vehicles", "copter:1", "--out", f"udpout://127.0.0.1:{relay.port}"))
            try:
                done = subprocess.run([*program, str(port), "parameters"], capture_output=True, text=True, timeout=150)
            except subprocess.TimeoutExpired:
                failures += 1
                continue
        if done.returncode == 0:
            seconds.append(float(done.stdout.split()[0]))
            count = int(done.stdout.split()[1])
        else:
            failures += 1
    return {"median_s": statistics.median(seconds) if seconds else None, "parameters": count, "failed": failures, "of": repeats}


# ---- time from `run` to the first vehicle command -----------------------------------------------------------------------------

SHORT = """
v = pick { type 'UAV'; timeout 60.seconds }
execute v: mission { home location(41.178, -8.598, 90); takeOff location(41.178, -8.598, 100); returnHomeAndLand() }
"""


def start(repeats: int = 5) -> dict:
    """A vehicle that is already up and sends to a port; the clock runs from exec to the first MISSION_COUNT or COMMAND_*."""
    from pymavlink.dialects.v20 import ardupilotmega

    seconds = []
    with tempfile.TemporaryDirectory() as folder:
        script = pathlib.Path(folder, "short.dolphin")
        script.write_text(SHORT)
        for _ in range(repeats):
            seconds.append(first_command(script, ardupilotmega.MAVLink(None)))
    median = statistics.median(seconds)
    say(f"start   run to first mission or arming message    {median * 1000:8.1f} ms (of {repeats}: "
        + ", ".join(f"{s * 1000:.0f}" for s in sorted(seconds)) + ")")
    return {"median_s": median, "all_s": seconds}


def first_command(script, parser) -> float:
    parser.robust_parsing = True
    run_port = free_udp_port()
    relay = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    relay.bind(("127.0.0.1", 0))
    relay.settimeout(0.001)
    up = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    up.settimeout(0.001)
    vehicle = None
    with simulator("--vehicles", "copter:1", "--out", f"udpout://127.0.0.1:{relay.getsockname()[1]}"):
        # Let the vehicle come up first: the figure is for one that is ready to arm.
        ready = time.monotonic() + 60
        run, started = None, 0.0
        asked, flags = False, 0
        ground = ardupilot_ground(parser)
        try:
            while time.monotonic() < ready:
                with contextlib.suppress(TimeoutError, ConnectionRefusedError):
                    data, vehicle = relay.recvfrom(4096)
                    if run is not None:
                        up.sendto(data, ("127.0.0.1", run_port))
                    for message in parser.parse_buffer(data) or []:
                        if message.get_type() == "EKF_STATUS_REPORT":
                            flags = message.flags
                if vehicle and not asked:
                    for message_id in (193, 33, 1):
                        relay.sendto(ground(message_id), vehicle)
                    asked = True
                if run is None and flags & 0x10 and not flags & 0x80:
                    started = time.perf_counter()
                    run = subprocess.Popen([LAPWING, "run", script, "--link", f"udpin://127.0.0.1:{run_port}"],
                                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                with contextlib.suppress(TimeoutError, ConnectionRefusedError):
                    data = up.recv(4096)
                    relay.sendto(data, vehicle)
                    for message in parser.parse_buffer(data) or []:
                        mission = message.get_type() in ("MISSION_COUNT", "SET_MODE")
                        command = message.get_type() in ("COMMAND_LONG", "COMMAND_INT") and message.command in (176, 300, 400)
                        if mission or command:
                            return time.perf_counter() - started
        finally:
            if run is not None:
                run.terminate()
                run.wait(timeout=15)
            relay.close()
            up.close()
    raise SystemExit("start: no command within 60 s")


def ardupilot_ground(parser):
    from pymavlink.dialects.v20 import ardupilotmega

    packer = ardupilotmega.MAVLink(None, srcSystem=255, srcComponent=190)
    return lambda message_id: packer.command_long_encode(1, 1, 511, 0, message_id, 100_000, 0, 0, 0, 0, 0).pack(packer)


# ---- CPU and memory of `run` with a fleet -------------------------------------------------------------------------------------

TEN_HERTZ = [f"--param=SR0_{stream}=10" for stream in ("EXT_STAT", "POSITION", "EXTRA1", "EXTRA2", "EXTRA3")]


def scale(seconds: float = 20.0) -> list:
    """Every vehicle sends ATTITUDE, GLOBAL_POSITION_INT, VFR_HUD, SYS_STATUS and the rest of its streams at 10 Hz; the script has
    picked them all, so all are known to be there."""
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        script = pathlib.Path(folder, "watch.dolphin")
        for vehicles in (2, 20, 100):
            script.write_text(f"pick {{ count {vehicles}; timeout 60.seconds }}\nprintln 'all here'\nexecute idle(1000)\n")
            port = free_udp_port()
            with simulator("--vehicles", f"copter:{vehicles}", "--out", f"udpout://127.0.0.1:{port}", *TEN_HERTZ) as sim:
                run = subprocess.Popen([LAPWING, "run", script, "--link", f"udpin://127.0.0.1:{port}"],
                                       stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
                try:
                    if run.stdout.readline().strip() != b"all here":
                        raise SystemExit(f"scale: {vehicles} vehicles were not found")
                    time.sleep(8)  # the asking for intervals; the figure is the steady state
                    before, sim_before, sent, wall = cpu_seconds(run.pid), cpu_seconds(sim.pid), datagrams(), time.monotonic()
                    time.sleep(seconds)
                    elapsed = time.monotonic() - wall
                    row = {"vehicles": vehicles, "run_cpu_percent": 100 * (cpu_seconds(run.pid) - before) / elapsed,
                           "sim_cpu_percent": 100 * (cpu_seconds(sim.pid) - sim_before) / elapsed,
                           "run_rss_mb": resident_mb(run.pid), "sim_rss_mb": resident_mb(sim.pid),
                           "messages_per_s": (datagrams() - sent) / elapsed}
                finally:
                    run.terminate()
                    run.wait(timeout=15)
            rows.append(row)
            say(f"scale   {vehicles:4} vehicles at 10 Hz, {row['messages_per_s']:7.0f} messages/s: run {row['run_cpu_percent']:5.1f} % of a core, "
                f"{row['run_rss_mb']:5.1f} MB; sim {row['sim_cpu_percent']:5.1f} %, {row['sim_rss_mb']:5.1f} MB")
    return rows


def datagrams() -> int:
    """UDP datagrams that this machine has received since it started: one message each here."""
    header, values = [line.split() for line in pathlib.Path("/proc/net/snmp").read_text().splitlines() if line.startswith("Udp:")]
    return int(values[header.index("InDatagrams")])


def cpu_seconds(pid: int) -> float:
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def resident_mb(pid: int) -> float:
    for line in pathlib.Path(f"/proc/{pid}/status").read_text().splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1]) / 1024
    return 0.0


def fleet() -> dict:
    os.environ.setdefault("LAPWING", str(LAPWING))
    import fleet as whole_fleet

    return whole_fleet.measure(say)


def page() -> list:
    with tempfile.TemporaryDirectory() as folder:
        rows = pathlib.Path(folder, "page.json")
        subprocess.run(["node", ROOT / "bench/page.mjs", "--json", rows], check=True)
        return json.loads(rows.read_text())


def load() -> list:
    """A station with a full map: what it costs, and how late those are who watch; then a page at it, and one that looks back."""
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for parts, more in (("viewers", []), ("viewers", ["--compression", "deflate"]), ("page,past", [])):
            found = pathlib.Path(folder, "load.json")
            subprocess.run(["node", ROOT / "bench/map_load/load.mjs", BENCH_BIN / "bench_map_station", "--part", parts, "--json", found, *more], check=True)
            rows += json.loads(found.read_text())
    return rows


def lossy() -> list:
    import lossy as bad_links

    return bad_links.measure(EXCHANGERS, simulator, free_udp_port, say)


def feed() -> dict:
    """Microseconds of processor time for one vehicle, whenever the station looks for news of it."""
    done = subprocess.run([BENCH_BIN / "bench_feed", "--benchmark_format=json", "--benchmark_repetitions=5",
                           "--benchmark_report_aggregates_only=true"], capture_output=True, text=True, check=True)
    took = {row["run_name"]: 1e6 / row["items_per_second"] for row in json.loads(done.stdout)["benchmarks"] if row["aggregate_name"] == "median"}
    for name, us in took.items():
        say(f"feed    {name:24} {us:8.2f} us a vehicle")
    return took


def pool() -> dict:
    """Microseconds for an empty job beside the loop and back."""
    done = subprocess.run([BENCH_BIN / "bench_pool", "--benchmark_format=json", "--benchmark_repetitions=5",
                           "--benchmark_report_aggregates_only=true"], capture_output=True, text=True, check=True)
    took = {row["run_name"].removesuffix("/real_time"): 1e6 / row["items_per_second"]
            for row in json.loads(done.stdout)["benchmarks"] if row["aggregate_name"] == "median"}
    for name, us in took.items():
        say(f"pool    {name:24} {us:8.2f} us a job")
    for way in ("one_by_one", "together"):
        say(f"pool    ours / asio, {way:11} {took[f'ours/{way}'] / took[f'asio/{way}']:8.2f} x")
    return took


def of_the_map(program: str, part: str, time: str) -> dict:
    """Milliseconds for each job."""
    done = subprocess.run([BENCH_BIN / program, "--benchmark_format=json", "--benchmark_repetitions=3",
                           "--benchmark_report_aggregates_only=true"], capture_output=True, text=True, check=True)
    to_ms = {"ms": 1.0, "us": 1e-3, "ns": 1e-6}
    took = {row["run_name"]: row[time] * to_ms[row["time_unit"]]
            for row in json.loads(done.stdout)["benchmarks"] if row["aggregate_name"] == "median"}
    for name, ms in took.items():
        say(f"{part:7} {name:40} {ms:9.3f} ms")
    return took


def live_map() -> dict:
    return of_the_map("bench_map", "map", "cpu_time")


def map_feeds() -> dict:
    """Pictures are drawn beside the loop, so that what counts is how long one waits for them."""
    return of_the_map("bench_map_feeds", "shown", "real_time")


def language() -> dict:
    import language as beside_the_original

    return beside_the_original.measure(LAPWING, BENCH_BIN / "bench_language", say)


def router() -> list:
    import router as routers

    return routers.measure(LAPWING, BENCH_BIN / "bench_router_load", say)


def store() -> dict:
    import store as stores

    return stores.measure(BENCH_BIN, say)


def explore() -> list:
    import explore as strategies

    return strategies.measure(LAPWING, say)


def robots() -> list:
    import robots as buildings

    return buildings.measure(LAPWING, say)


def kill() -> dict:
    sys.path.insert(0, str(ROOT / "bench/kill_switch"))
    import kill as kills

    return kills.measure(LAPWING, BENCH_BIN / "bench_kill_board", say)


def slam() -> list:
    sys.path.insert(0, str(ROOT / "bench/slam"))
    import speed

    return speed.measure(LAPWING, say)


def survey() -> str:
    """The figures are of simulated flights: the same build gives the same on every machine."""
    done = subprocess.run([BENCH_BIN / "bench_survey", os.environ.get("LAPWING_BENCH_LOTS", "20")], capture_output=True, text=True, check=True)
    say(done.stdout)
    return done.stdout


def machine() -> dict:
    cpu = next((line.split(":", 1)[1].strip() for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines()
                if line.startswith("model name")), platform.machine())
    commit = subprocess.run(["git", "-C", ROOT, "rev-parse", "--short", "HEAD"], capture_output=True, text=True).stdout.strip()
    return {"cpu": cpu, "cores": os.cpu_count(), "system": platform.platform(), "commit": commit, "load": os.getloadavg()[0]}


def earlier(path: pathlib.Path) -> dict:
    """What other runs found of the same commit on the same machine: parts can be run one by one."""
    if not path.exists():
        return {}
    found, now = json.loads(path.read_text()), machine()
    return found if all(found["machine"][key] == now[key] for key in ("cpu", "cores", "commit")) else {}


def main():
    wanted = sys.argv[1:] or ["decode", "pool", "feed", "map", "shown", "start", "scale", "fleet", "language", "upload", "lossy", "params", "router", "page", "load", "store"]
    path = ROOT / "build/bench-results.json"
    results = earlier(path) | {"machine": machine(), "taken": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())}
    say(f"machine {results['machine']}")
    for name in wanted:
        results[name] = {"decode": decode, "pool": pool, "feed": feed, "map": live_map, "shown": map_feeds, "upload": upload, "start": start,
                         "scale": scale, "fleet": fleet, "lossy": lossy, "params": params, "router": router, "language": language, "page": page, "load": load, "store": store,
                         "explore": explore, "robots": robots, "kill": kill, "slam": slam, "survey": survey}[name]()
    path.write_text(json.dumps(results, indent=2) + "\n")
    say(f"written to {path.relative_to(ROOT)}")


if __name__ == "__main__":
    main()
