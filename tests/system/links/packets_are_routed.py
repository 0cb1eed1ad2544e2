"""`lapwing route` between a ground station and two vehicles whose protocol side is pymavlink: routing, filters, rate limits,
garbage, far ends that come and go, settings read anew, metrics."""

import contextlib
import pathlib
import re
import signal
import subprocess
import tempfile
import threading
import urllib.request

import harness
from mavlink_peer import Peer, mavlink

try:
    from prometheus_client.openmetrics.parser import text_string_to_metric_families
except ImportError:
    text_string_to_metric_families = None


class Router:
    """The program, with what it says read aside."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen([harness.LAPWING, "route", *arguments], stderr=subprocess.PIPE, text=True)
        self.said, self.changed = [], threading.Condition()
        threading.Thread(target=self._read, daemon=True).start()
        self.says("routing; Ctrl-C ends")
        found = re.search(r"http://\S+/metrics", "".join(self.said))
        self.metrics_url = found and found[0]

    def _read(self):
        for line in self.process.stderr:
            with self.changed:
                self.said.append(line)
                self.changed.notify_all()

    def says(self, text, times=1):
        with self.changed:
            assert self.changed.wait_for(lambda: "".join(self.said).count(text) >= times, 20), (text, self.said)

    def metrics(self):
        with urllib.request.urlopen(self.metrics_url, timeout=10) as answer:
            assert answer.headers["Content-Type"].startswith("application/openmetrics-text; version=1.0.0")
            text = answer.read().decode()
        if text_string_to_metric_families:
            list(text_string_to_metric_families(text))  # raises what the format does not allow
        return {name: float(value) for name, value in re.findall(r"^([^#]\S*(?: \S+)*?) (\S+)$", text, re.MULTILINE)}

    def metric(self, name, **labels):
        inside = ",".join(f'{key}="{value}"' for key, value in labels.items())
        return self.metrics()[f"{name}{{{inside}}}"]


@contextlib.contextmanager
def router(*arguments):
    program = Router(*arguments)
    try:
        yield program
    finally:
        program.process.send_signal(signal.SIGINT)
        code = program.process.wait(timeout=10)
    assert code == 0, code


def routed_by_the_rules():
    vehicles_port, ground_port = harness.free_udp_port(), harness.free_udp_port()
    with router("--endpoint", f"udpin://127.0.0.1:{vehicles_port}", "--endpoint", f"udpout://127.0.0.1:{ground_port}",
                "--metrics-port", "0") as program:
        vehicles = f"udpin://127.0.0.1:{vehicles_port}"
        ground = Peer(ground_port, 255, 190, listens=True)
        one, two = Peer(vehicles_port, 1), Peer(vehicles_port, 2)
        # What vehicles send to all reaches the ground station byte for byte, in both versions and signed.
        packets = [one.heartbeat(), two.heartbeat()]
        one.mav.signing.secret_key, one.mav.signing.sign_outgoing = bytes(range(32)), True
        one.mav.signing.link_id, one.mav.signing.timestamp = 1, 1
        packets.append(one.heartbeat())
        one.mav.signing.sign_outgoing, one.mav.signing.secret_key = False, None
        unknown = bytearray(one.mav.attitude_encode(0, 0, 0, 0, 0, 0, 0).pack(one.mav))
        unknown[7:10] = (70_000).to_bytes(3, "little")
        unknown[4] = 77
        crc = mavlink.x25crc(unknown[1:-2])
        crc.accumulate(b"\x63")  # the seed that only its makers know
        unknown[-2:] = crc.crc.to_bytes(2, "little")
        one.say_bytes(bytes(unknown))
        packets.append(bytes(unknown))
        # Several may share a datagram.
        sent = b"".join(packets)
        harness.wait_until(lambda: ground.listen(1) and len(b"".join(ground.raw)) >= len(sent), 10, "all packets", pause=0)
        assert b"".join(ground.raw) == sent, (ground.raw, packets)

        # What the ground station sends to one reaches that one alone; the answer comes back.
        ground.heartbeat(mavlink.MAV_TYPE_GCS)
        for vehicle in (one, two):
            vehicle.hears_type("HEARTBEAT", 255)
            vehicle.forget()
        ground.say(ground.mav.command_long_encode(2, 1, 400, 0, 1, 0, 0, 0, 0, 0, 0))
        assert two.hears_type("COMMAND_LONG", 255).target_system == 2
        two.say(two.mav.command_ack_encode(400, 0, 0, 0, 255, 190))
        ground.hears_type("COMMAND_ACK", 2)
        ground.say(ground.mav.param_request_list_encode(9, 1))
        ground.heartbeat(mavlink.MAV_TYPE_GCS)  # behind the others, so that what comes before it has come
        assert [m.get_type() for m in (one.hears_type("HEARTBEAT"), *one.heard)].count("COMMAND_LONG") == 0
        assert program.metric("lapwing_router_dropped_frames_total", endpoint=f"udpout://127.0.0.1:{ground_port}",
                              direction="in", reason="unroutable") == 1

        # Vehicles on one endpoint are not shown each other; garbage harms nobody and is counted.
        assert all(m.get_srcSystem() == 255 for m in one.heard), one.heard
        stranger = Peer(vehicles_port, 3)
        stranger.say_bytes(b"\xfd" + bytes(range(200)))
        stranger.say_bytes(b"GET / HTTP/1.1\r\n\r\n")
        ground.forget()
        one.heartbeat()
        ground.hears_type("HEARTBEAT", 1)
        assert program.metric("lapwing_router_junk_bytes_total", endpoint=vehicles) == 219
        assert program.metric("lapwing_router_far_ends", endpoint=vehicles) == 2

        # The vehicle restarts: another address, and at once commands go there, too.
        one.close()
        ground.forget()
        again = Peer(vehicles_port, 1)
        again.mav.seq = 100  # what is the same as a moment ago is a copy
        again.heartbeat()
        ground.hears_type("HEARTBEAT", 1)
        ground.say(ground.mav.command_long_encode(1, 1, 400, 0, 1, 0, 0, 0, 0, 0, 0))
        again.hears_type("COMMAND_LONG", 255)


CONFIG = """
metrics_port = 0
[[endpoint]]
name = "vehicles"
url = "udpin://127.0.0.1:{vehicles}"
[endpoint.in]
block_messages = ["VFR_HUD"]
[[endpoint]]
name = "ground"
url = "tcpin://127.0.0.1:{ground}"
[endpoint.out]
block_systems = [2]
[[endpoint]]
name = "radio"
url = "udpout://127.0.0.1:{radio}"
messages_per_s = 20
[[endpoint]]
name = "sniffer"
url = "udpout://127.0.0.1:{sniffer}"
sniffer = true
"""


def filtered_and_limited(folder):
    ports = {"vehicles": harness.free_udp_port(), "ground": harness.free_tcp_port(), "radio": harness.free_udp_port(),
             "sniffer": harness.free_udp_port()}
    file = pathlib.Path(folder, "router.toml")
    file.write_text(CONFIG.format(**ports))
    with router("--config", str(file)) as program:
        from pymavlink import mavutil

        one, two = Peer(ports["vehicles"], 1), Peer(ports["vehicles"], 2)
        radio, sniffer = Peer(ports["radio"], 254, listens=True), Peer(ports["sniffer"], 253, listens=True)
        ground = mavutil.mavlink_connection(f"tcp:127.0.0.1:{ports['ground']}", source_system=255)
        program.says("ground: 127.0.0.1:")
        one.heartbeat()
        assert ground.recv_match(type="HEARTBEAT", blocking=True, timeout=10).get_srcSystem() == 1
        one.say(one.mav.vfr_hud_encode(1, 2, 3, 4, 5, 6))
        two.say(two.mav.attitude_encode(1, 2, 3, 4, 5, 6, 7))
        one.say(one.mav.attitude_encode(9, 2, 3, 4, 5, 6, 7))
        first = ground.recv_match(blocking=True, timeout=10)
        assert (first.get_type(), first.get_srcSystem()) == ("ATTITUDE", 1), first
        assert sniffer.hears_type("ATTITUDE", 1).time_boot_ms == 9
        assert not any(m.get_type() == "VFR_HUD" for m in sniffer.heard)

        # Five hundred attitudes at once: of them the radio gets some, and the last.
        for count in range(500):
            one.say(one.mav.attitude_encode(1000 + count, 2, 3, 4, 5, 6, 7))
        radio.hears(lambda m: m.get_type() == "ATTITUDE" and m.time_boot_ms == 1499, what="the newest attitude")
        sniffer.hears(lambda m: m.get_type() == "ATTITUDE" and m.time_boot_ms == 1499, what="the newest attitude")
        heard = [m for m in radio.heard if m.get_type() == "ATTITUDE"]
        assert len(heard) < 60, len(heard)
        superseded = program.metric("lapwing_router_dropped_frames_total", endpoint="radio", direction="out", reason="superseded")
        assert superseded + len(heard) == 502, (superseded, len(heard))  # with those of before

        # A ground station that leaves is noticed, and one that comes is served.
        ground.close()
        program.says(" is gone")
        ground = mavutil.mavlink_connection(f"tcp:127.0.0.1:{ports['ground']}", source_system=255)
        program.says("ground: 127.0.0.1:", times=3)
        one.heartbeat()
        assert ground.recv_match(type="HEARTBEAT", blocking=True, timeout=10).get_srcSystem() == 1
        # What a sniffer says goes nowhere.
        sniffer.say(sniffer.mav.command_long_encode(1, 1, 400, 0, 1, 0, 0, 0, 0, 0, 0))
        harness.wait_until(lambda: program.metric("lapwing_router_dropped_frames_total", endpoint="sniffer", direction="in",
                                                  reason="read_only") == 1, 10, "the sniffer's command counted")
        ground.close()

        # Settings are read anew; those with mistakes change nothing.
        file.write_text(CONFIG.format(**ports).replace("VFR_HUD", "VFR_HAD"))
        program.process.send_signal(signal.SIGHUP)
        program.says("the settings stay as they were")
        assert any("there is no message VFR_HAD" in line for line in program.said)
        file.write_text(CONFIG.format(**ports).replace("VFR_HUD", "ATTITUDE"))
        program.process.send_signal(signal.SIGHUP)
        program.says("settings read anew, 4 endpoints")
        sniffer.forget()
        one.say(one.mav.attitude_encode(1, 2, 3, 4, 5, 6, 7))
        one.say(one.mav.vfr_hud_encode(1, 2, 3, 4, 5, 6))
        sniffer.hears_type("VFR_HUD", 1)
        assert not any(m.get_type() == "ATTITUDE" for m in sniffer.heard)


def mistakes_are_told(folder):
    file = pathlib.Path(folder, "wrong.toml")
    file.write_text("[[endpoint]]\nurl = 'udpin://127.0.0.1:14550'\nsnifer = true\n")
    _, err = harness.expect_exit(2, "route", "--config", str(file))
    assert f"{file}:3:1: error: there is no setting snifer" in err and "did you mean sniffer?" in err, err
    _, err = harness.expect_exit(2, "route")
    assert "a router needs endpoints" in err and "--endpoint" in err, err
    _, err = harness.expect_exit(2, "route", "--endpoint", "udpin://0.0.0.0")
    assert "the port is missing" in err, err


routed_by_the_rules()
with tempfile.TemporaryDirectory() as scratch:
    filtered_and_limited(scratch)
    mistakes_are_told(scratch)
print("packets are routed")
