"""With a signing key: vehicles and station that share it work together, and nobody else is heard or obeyed."""

import os
import pathlib
import tempfile

from pymavlink import mavutil

import harness

SCRIPT = """
v = pick { type 'UAV'; timeout 20.seconds }
execute v: mission { home location(41.178, -8.598, 90); takeOff location(41.178, -8.598, 100); returnHomeAndLand() }
message 'flown'
"""

with tempfile.TemporaryDirectory() as folder:
    key, other, script = (pathlib.Path(folder, name) for name in ("fleet.key", "other.key", "my.dolphin"))
    key.write_text(bytes(range(32)).hex())
    other.write_text("a pass phrase of others\n")
    for path in (key, other):
        path.chmod(0o600)
    script.write_text(SCRIPT)

    # In one process, both sides with the key.
    out, _ = harness.expect_exit(0, "run", str(script), "--sim", "copter:1", "--signing-key", str(key))
    assert "flown" in out

    # Two programs with one key fly; with two keys the vehicle is never there, and the log says why.
    port = harness.free_udp_port()
    link = f"udpin://127.0.0.1:{port}"
    with harness.lapwing("sim", "--out", f"udpout://127.0.0.1:{port}", "--speedup", "20", "--signing-key", str(key)):
        code, out, err = harness.finish("run", str(script), "--link", link, "--signing-key", str(other), "--timeout", "4")
        assert code == 3 and "another key" in err, (code, err)
        out, _ = harness.expect_exit(0, "run", str(script), "--link", link, "--signing-key", str(key))
        assert "flown" in out
        out, _ = harness.expect_exit(0, "mission", "download", "--type", "mission", "--link", link, "--signing-key", str(key))
        assert "NAV_TAKEOFF" in out, out

    # pymavlink with the key is heard and obeyed, without it neither.
    port = harness.free_udp_port()
    with harness.lapwing("sim", "--out", f"udpout://127.0.0.1:{port}", "--signing-key", str(key)):
        os.environ["MAVLINK20"] = "1"
        peer = mavutil.mavlink_connection(f"udpin:127.0.0.1:{port}", source_system=255)
        assert peer.wait_heartbeat(timeout=10), "no heartbeat"

        def ask():
            peer.mav.command_long_send(1, 1, mavutil.mavlink.MAV_CMD_REQUEST_MESSAGE, 0,
                                       mavutil.mavlink.MAVLINK_MSG_ID_AUTOPILOT_VERSION, 0, 0, 0, 0, 0, 0)
            return peer.recv_match(type="COMMAND_ACK", blocking=True, timeout=2)

        assert ask() is None, "an unsigned command was answered"
        peer.setup_signing(bytes(range(32)), sign_outgoing=True)
        assert ask() is not None, "a signed command was not answered"
        assert peer.mav.signing.sig_count > 0 and peer.mav.signing.badsig_count == 0

    key.chmod(0o644)
    code, _, err = harness.finish("run", str(script), "--signing-key", str(key))
    assert code == 2 and "chmod 600" in err, (code, err)
print("strangers are not heard")
