"""What a fleet costs the station, and how long it takes until all of it is shown. For run.py.

cost   10, 100 and 250 vehicles that send all their streams at 10 Hz to one station, and four networks of 250 with a station each
       (a MAVLink network has 255 ids): processor time and memory of the stations and of the simulators. Of the 250 once more while
       20 viewers hear all that the station tells, in a process of their own on the same machine.
shown  from the power-on of 100 vehicles to the moment when a viewer of the station has been told of all, and has all their
       places; MAVSDK's server on the same port says in its log when it has discovered each.
"""

import contextlib
import pathlib
import re
import select
import statistics
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.append(str(ROOT / "tests/support"))

import ground  # noqa: E402
import harness  # noqa: E402

TEN_HERTZ = [f"--param=SR0_{stream}=10" for stream in ("EXT_STAT", "POSITION", "EXTRA1", "EXTRA2", "EXTRA3")]
SETTLING_S, MEASURED_S = 10.0, 20.0


@contextlib.contextmanager
def fleet(vehicles: int, port: int, *arguments: str):
    process = subprocess.Popen([harness.LAPWING, "sim", "--vehicles", f"copter:{vehicles}", "--out", f"udpout://127.0.0.1:{port}",
                                *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        yield process
    finally:
        process.terminate()
        process.wait(timeout=20)


def datagrams() -> dict:
    """Of the whole machine since it started: taken, and dropped because nobody took them in time."""
    header, values = [line.split() for line in pathlib.Path("/proc/net/snmp").read_text().splitlines() if line.startswith("Udp:")]
    return {name: int(values[header.index(field)]) for name, field in (("taken", "InDatagrams"), ("dropped", "RcvbufErrors"))}


@contextlib.contextmanager
def viewers(url: str, count: int):
    if count == 0:
        yield
        return
    process = subprocess.Popen(["node", ROOT / "bench/map_load/viewers.mjs", url, str(count), "plain"])
    try:
        yield
    finally:
        process.terminate()
        process.wait(timeout=20)


def cost(say) -> list:
    rows = []
    for networks, vehicles, watching in ((1, 10, 0), (1, 100, 0), (1, 250, 0), (1, 250, 20), (4, 250, 0)):
        with contextlib.ExitStack() as stack:
            stations = [stack.enter_context(ground.station()) for _ in range(networks)]
            sims = [stack.enter_context(fleet(vehicles, station.link_ports[0], *TEN_HERTZ)) for station in stations]
            for station in stations:
                harness.wait_until(lambda: station.get("/api/v1/status")["vehicles"] == vehicles, 90, f"{vehicles} vehicles")
            stack.enter_context(viewers(f"http://127.0.0.1:{stations[0].port}/", watching))
            harness.wait_until(lambda: stations[0].get("/api/v1/status")["viewers"] == watching, 30, f"{watching} viewers")
            rows.append({"viewers": watching, **steady_state(networks, vehicles, stations, sims)})
        row = rows[-1]
        say(f"fleet   {row['vehicles']:5} vehicles at 10 Hz, {watching:2} viewers, {row['messages_per_s']:7.0f} messages/s, {row['dropped']} dropped: station{'s' if networks > 1 else ' '} "
            f"{row['station_cpu_percent']:5.1f} % of a core ({row['station_cpu_percent_per_vehicle']:.3f} % a vehicle), "
            f"{row['station_mb']:5.1f} MB; sim {row['sim_cpu_percent']:5.1f} %, {row['sim_mb']:5.1f} MB")
    return rows


def steady_state(networks: int, vehicles: int, stations, sims) -> dict:
    time.sleep(SETTLING_S)
    pids = {"station": [station.process.pid for station in stations], "sim": [sim.pid for sim in sims]}
    before = {name: sum(map(ground.cpu_seconds, each)) for name, each in pids.items()}
    sent, begun = datagrams(), time.monotonic()
    time.sleep(MEASURED_S)
    elapsed = time.monotonic() - begun
    after = datagrams()
    percent = {name: 100 * (sum(map(ground.cpu_seconds, each)) - before[name]) / elapsed for name, each in pids.items()}
    return {"networks": networks, "vehicles": networks * vehicles, "messages_per_s": (after["taken"] - sent["taken"]) / elapsed,
            "dropped": after["dropped"] - sent["dropped"],
            "station_cpu_percent": percent["station"],
            "station_cpu_percent_per_vehicle": percent["station"] / (networks * vehicles),
            "station_mb": sum(map(ground.resident_mb, pids["station"])), "sim_cpu_percent": percent["sim"],
            "sim_cpu_percent_per_vehicle": percent["sim"] / (networks * vehicles),
            "sim_mb": sum(map(ground.resident_mb, pids["sim"]))}


def shown(say, vehicles: int = 100, repeats: int = 3) -> dict:
    ours, theirs = [], []
    for _ in range(repeats):
        ours.append(shown_by_the_station(vehicles))
        theirs.append(discovered_by_mavsdk(vehicles))
    result = {"vehicles": vehicles,
              "listed_s": statistics.median(listed for listed, _ in ours),
              "with_place_s": statistics.median(placed for _, placed in ours),
              "mavsdk_discovered": statistics.median(count for count, _ in theirs),
              "mavsdk_s": statistics.median(seconds for _, seconds in theirs)}
    say(f"shown   {vehicles} vehicles from power-on: all listed {result['listed_s']:6.2f} s, all with their places "
        f"{result['with_place_s']:6.2f} s (which the vehicles know 1.2 s after it)")
    say(f"shown   MAVSDK: {result['mavsdk_discovered']:.0f} discovered after {result['mavsdk_s']:6.2f} s")
    return result


def shown_by_the_station(vehicles: int) -> tuple[float, float]:
    """Seconds until a viewer has heard of all, and of all their places."""
    with ground.station() as station:
        viewer = station.viewer()
        begun = time.monotonic()
        known, placed, listed = set(), set(), None
        with fleet(vehicles, station.link_ports[0]):
            while len(placed) < vehicles:
                message = viewer.message(60)
                for vehicle in message.get("vehicles", []):
                    known.add(vehicle["id"])
                    if "position" in vehicle:
                        placed.add(vehicle["id"])
                if listed is None and len(known) == vehicles:
                    listed = time.monotonic() - begun
            return listed, time.monotonic() - begun


def discovered_by_mavsdk(vehicles: int, limit_s: float = 60.0) -> tuple[int, float]:
    """How many systems its server speaks of on one port, and when it spoke of the last: Python's API binds to the first of them."""
    import mavsdk

    server = pathlib.Path(mavsdk.__file__).parent / "bin/mavsdk_server"
    port = harness.free_udp_port()
    process = subprocess.Popen([server, "-p", str(harness.free_tcp_port()), f"udpin://127.0.0.1:{port}"], stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT)
    found, last = set(), 0.0
    try:
        time.sleep(1.0)  # until it listens
        begun = time.monotonic()
        with fleet(vehicles, port):
            while len(found) < vehicles and time.monotonic() - begun < limit_s:
                if not select.select([process.stdout], [], [], 1.0)[0]:
                    continue
                line = process.stdout.readline().decode(errors="replace")
                numbers = re.findall(r"(?:[Ss]ystem ID|sysid)[: ]+(\d+)", line) if "ystem" in line else []
                if numbers and int(numbers[0]) not in found:
                    found.add(int(numbers[0]))
                    last = time.monotonic() - begun
    finally:
        process.kill()
        process.wait()
    return len(found), last


def measure(say) -> dict:
    return {"cost": cost(say), "shown": shown(say)}
