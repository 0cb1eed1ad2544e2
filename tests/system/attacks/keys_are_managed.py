"""`lapwing signing`: keys are given to vehicles, changed and taken away without anybody being locked out or any key being seen;
pymavlink on either end."""

import os
import pathlib
import stat
import tempfile
import threading
import time
import tomllib

from pymavlink import mavutil
from pymavlink.dialects.v20 import ardupilotmega as mavlink

import harness

os.environ["MAVLINK20"] = "1"
said = []


def lapwing(expected: int, *arguments: str) -> str:
    out, err = harness.expect_exit(expected, *arguments, seconds=60)
    said.append(out + err)
    return out + err


def key_of(store: pathlib.Path, name: str) -> bytes:
    return bytes.fromhex(tomllib.loads(store.read_text())["keys"][name])


def is_obeyed(port: int, key: bytes) -> bool:
    """Whether pymavlink with this key gets an answer from the vehicle."""
    peer = mavutil.mavlink_connection(f"udpin:127.0.0.1:{port}", source_system=255)
    try:
        assert peer.wait_heartbeat(timeout=10), "no heartbeat"
        peer.setup_signing(key, sign_outgoing=True, allow_unsigned_callback=lambda *_: True)
        # The same packet with the same number would be one that came twice.
        peer.mav.seq = int(time.monotonic() * 10) % 256
        peer.mav.command_long_send(1, 1, mavlink.MAV_CMD_REQUEST_MESSAGE, 0, mavlink.MAVLINK_MSG_ID_AUTOPILOT_VERSION,
                                   0, 0, 0, 0, 0, 0)
        return peer.recv_match(type="COMMAND_ACK", blocking=True, timeout=1) is not None
    finally:
        peer.close()


class SigningVehicle:
    """A vehicle that pymavlink signs for, and which hears nothing without a signature. It has one parameter."""

    def __init__(self, port: int, key: bytes):
        self.link = mavutil.mavlink_connection(f"udpout:127.0.0.1:{port}", source_system=9, source_component=1)
        self.link.setup_signing(key, sign_outgoing=True)
        self.times, self.ended = [], threading.Event()
        self.thread = threading.Thread(target=self.serve)

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.ended.set()
        self.thread.join()
        self.link.close()

    def serve(self):
        beat = 0.0
        while not self.ended.is_set():
            if time.monotonic() >= beat:
                self.link.mav.heartbeat_send(2, 3, 0x51, 0, 3)
                beat = time.monotonic() + 0.2
            message = self.link.recv_match(blocking=True, timeout=0.05)
            if message is None or message.get_srcSystem() != 255 or not message.get_signed():
                continue
            self.times.append(int.from_bytes(message.get_msgbuf()[-12:-6], "little"))
            if message.get_type() == "PARAM_REQUEST_READ":
                self.link.mav.param_value_send(b"ONE", 7, 9, 1, 0)


with tempfile.TemporaryDirectory() as folder:
    store = pathlib.Path(folder, "fleet.keys")
    keys = ("--keys", str(store))
    key = ("--signing-key", str(store))

    # The store: made with a first key, seen by nobody else.
    assert "for everybody" in lapwing(0, "signing", "new", "fleet", *keys)
    lapwing(0, "signing", "new", "next", *keys)
    assert stat.S_IMODE(store.stat().st_mode) == 0o600
    assert "already" in lapwing(2, "signing", "new", "fleet", *keys)
    store.chmod(0o640)
    assert "chmod 600" in lapwing(2, "signing", "show", *keys)
    store.chmod(0o600)

    port = harness.free_udp_port()
    link = ("--link", f"udpin://127.0.0.1:{port}")
    with harness.lapwing("sim", "--out", f"udpout://127.0.0.1:{port}"):
        get = ("param", "get", "RTL_ALT", "--vehicle", "1", *link, "--wait", "3")
        # Where others may listen, no key is sent.
        assert "--insecure-setup" in lapwing(2, "signing", "setup", "--vehicle", "1", "--key", "fleet", "--link",
                                             f"udpin://0.0.0.0:{port}", *keys)
        assert "vehicle 1 signs with fleet" in lapwing(0, "signing", "setup", "--vehicle", "1", "--key", "fleet",
                                                       "--overlap", "1", *link, *keys)
        assert "1500" in lapwing(0, *get, *key)
        lapwing(1, *get)  # without the key it is not obeyed
        assert is_obeyed(port, key_of(store, "fleet")) and not is_obeyed(port, bytes(32))

        # The key is changed; the old one is of no use any more, on either side.
        lapwing(0, "signing", "rotate", "--vehicle", "1", "--key", "next", "--overlap", "1", *link, *keys)
        assert tomllib.loads(store.read_text())["use"]["vehicles"] == {"1": ["next"]}
        assert "1500" in lapwing(0, *get, *key)
        assert is_obeyed(port, key_of(store, "next")) and not is_obeyed(port, key_of(store, "fleet"))

        # A run that was broken off between store and vehicle: both keys are known, so nobody is locked out.
        text = store.read_text()
        store.write_text(text.replace('1 = ["next"]', '1 = ["fleet", "next"]'))
        assert "under way" in lapwing(0, "signing", "show", *keys)
        assert "1500" in lapwing(0, *get, *key)
        assert "only key of vehicle" not in lapwing(0, "signing", "drop", "fleet", *keys)
        assert "only key of vehicle 1" in lapwing(2, "signing", "drop", "next", *keys)
        assert "1500" in lapwing(0, *get, *key)

        lapwing(0, "signing", "off", "--vehicle", "1", *link, *keys)
        assert "1500" in lapwing(0, *get)
    secrets = {value for value in tomllib.loads(text)["keys"].values()}
    assert len(secrets) == 2 and not any(secret in words for secret in secrets for words in said), "a key was told"

    # A vehicle that pymavlink signs for: heard and obeyed, run after run; the time of signatures never goes back.
    plain = pathlib.Path(folder, "plain.key")
    plain.write_text(bytes(range(32)).hex())
    plain.chmod(0o600)
    port = harness.free_udp_port()
    get = ("param", "get", "ONE", "--link", f"udpin://127.0.0.1:{port}", "--signing-key", str(plain))
    with SigningVehicle(port, bytes(range(32))) as vehicle:
        assert " 7 " in lapwing(0, *get)
        written = pathlib.Path(f"{plain}.time")
        first = int(written.read_text())
        assert vehicle.times == sorted(set(vehicle.times)) and vehicle.times[-1] <= first
        # As if they had spoken an hour from now, and this machine's clock had been set back since.
        later = first + 360_000_000
        written.write_text(f"{later}\n")
        vehicle.link.mav.signing.timestamp = later
        count = len(vehicle.times)
        assert " 7 " in lapwing(0, *get)
        assert vehicle.times[count] > later and int(written.read_text()) >= vehicle.times[-1]
        assert stat.S_IMODE(written.stat().st_mode) == 0o600
        written.write_text("yesterday\n")
        assert "no time of a signature" in lapwing(2, *get)
        written.unlink()
        plain.write_text(bytes(range(1, 33)).hex())
        assert "no vehicle was heard" in lapwing(3, *get, "--wait", "1")
print("keys are managed")
