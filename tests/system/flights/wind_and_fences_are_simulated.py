"""`lapwing sim`: the wind that was asked for blows, and a vehicle that leaves its fence comes back, as a foreign ground station
sees it."""

from pymavlink import mavutil

import harness

SPEEDUP = 10
OUT = 60.0  # the fence's radius


class Ground:
    def __init__(self, port: int):
        self.link = mavutil.mavlink_connection(f"udpin:127.0.0.1:{port}", source_system=255, source_component=190)
        assert self.link.wait_heartbeat(timeout=20), "no vehicle"
        self.link.mav.heartbeat_send(6, 8, 0, 0, 4)

    def next(self, kind: str, fits=lambda message: True, seconds: float = 20):
        def found():
            message = self.link.recv_match(type=kind, blocking=True, timeout=0.2)
            return message if message is not None and fits(message) else None

        return harness.wait_until(found, seconds, f"{kind} as it should be", pause=0)

    def command(self, number: int, *params):
        self.link.mav.command_long_send(1, 1, number, 0, *params, *[0] * (7 - len(params)))
        ack = self.next("COMMAND_ACK", lambda message: message.command == number)
        assert ack.result == 0, ack

    def set(self, name: str, value: float):
        self.link.mav.param_set_send(1, 1, name.encode(), value, 9)
        self.next("PARAM_VALUE", lambda message: message.param_id == name and message.param_value == value)


port = harness.free_udp_port()
with harness.lapwing("sim", "--vehicles", "copter:1", "--out", f"udpout://127.0.0.1:{port}", "--speedup", str(SPEEDUP), "--wind",
                     "6,270", "--seed", "5"):
    ground = Ground(port)
    for message in ("WIND", "FENCE_STATUS", "EKF_STATUS_REPORT"):
        ground.command(511, getattr(mavutil.mavlink, f"MAVLINK_MSG_ID_{message}"), 100_000)
    wind = ground.next("WIND")
    assert abs(wind.speed - 6) < 0.1 and abs(wind.direction % 360 - 270) < 1, wind

    ground.set("AVOID_ENABLE", 0)  # else it would stop at the margin
    ground.set("FENCE_RADIUS", OUT)
    ground.set("FENCE_ENABLE", 1)
    ground.next("EKF_STATUS_REPORT", lambda report: report.flags & 0x10 and not report.flags & 0x80)
    ground.command(176, 1, 4)
    ground.command(400, 1)
    ground.command(22, 0, 0, 0, 0, 0, 0, 10)
    ground.next("HEARTBEAT", lambda beat: beat.system_status == 4)
    mask = 0b110111000111

    def breached():
        """Keeps flying north until the vehicle says that it has left its fence."""
        ground.link.mav.set_position_target_global_int_send(0, 1, 1, 6, mask, 0, 0, 0, 8, 0, 0, 0, 0, 0, 0, 0)
        status = ground.link.recv_match(type="FENCE_STATUS", blocking=True, timeout=0.1)
        return status if status is not None and status.breach_status else None

    status = harness.wait_until(breached, 30, "a breach", pause=0)
    assert (status.breach_count, status.breach_type) == (1, mavutil.mavlink.FENCE_BREACH_BOUNDARY), status
    beat = ground.next("HEARTBEAT", lambda message: message.custom_mode == 6)
    assert beat.system_status == 4, "a breach is not a critical state"
    cleared = ground.next("FENCE_STATUS", lambda message: not message.breach_status)
    assert cleared.breach_count == 1, cleared
    ground.next("HEARTBEAT", lambda message: not message.base_mode & 0x80, seconds=30)
print("the wind blows and the fence holds")
