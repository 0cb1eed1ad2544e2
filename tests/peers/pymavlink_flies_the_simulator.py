"""pymavlink as a foreign ground station: arms, takes off, uploads and flies a mission on `lapwing sim`."""

from pymavlink import mavutil

import harness

SPEEDUP = 10
HOME_LAT, HOME_LON = 41.1780, -8.5980


class Ground:
    def __init__(self, port: int):
        self.link = mavutil.mavlink_connection(f"udpin:127.0.0.1:{port}", source_system=255, source_component=190)

    def receive(self, *types, seconds=10):
        return harness.wait_until(lambda: self._next(types), seconds, f"a message of {types}", pause=0)

    def _next(self, types):
        message = self.link.recv_match(blocking=True, timeout=0.2)
        return message if message is not None and message.get_type() in types else None

    def command(self, command, *params, expect=mavutil.mavlink.MAV_RESULT_ACCEPTED):
        params = list(params) + [0] * (7 - len(params))
        self.link.mav.command_long_send(1, 1, command, 0, *params)

        def answered():
            ack = self._next(("COMMAND_ACK",))
            return ack if ack and ack.command == command else None

        ack = harness.wait_until(answered, 10, f"the answer to command {command}", pause=0)
        assert ack.result == expect, f"command {command}: result {ack.result}, expected {expect}"

    def wait_for_position(self):
        """The estimator is ready when it has an absolute position (0x10) and is not in constant-position mode (0x80)."""

        def ready():
            report = self._next(("EKF_STATUS_REPORT",))
            return report and report.flags & 0x10 and not report.flags & 0x80

        harness.wait_until(ready, 60, "the estimator's position", pause=0)

    def upload(self, items):
        """Answers whatever the vehicle asks, as any ground station does."""
        self.link.mav.mission_count_send(1, 1, len(items), mavutil.mavlink.MAV_MISSION_TYPE_MISSION)
        requested = []
        while True:
            message = self.receive("MISSION_REQUEST", "MISSION_REQUEST_INT", "MISSION_ACK")
            if message.get_type() == "MISSION_ACK":
                assert message.type == mavutil.mavlink.MAV_MISSION_ACCEPTED, f"mission refused: {message}"
                return requested
            requested.append(message.seq)
            command, params, lat, lon, alt = items[message.seq]
            self.link.mav.mission_item_int_send(
                1, 1, message.seq, mavutil.mavlink.MAV_FRAME_GLOBAL_RELATIVE_ALT_INT, command, 0, 1,
                *params, int(round(lat * 1e7)), int(round(lon * 1e7)), alt, mavutil.mavlink.MAV_MISSION_TYPE_MISSION)


def main():
    port = harness.free_udp_port()
    with harness.lapwing("sim", "--vehicles", "copter:1", "--home", f"{HOME_LAT},{HOME_LON},90", "--out",
                      f"udpout://127.0.0.1:{port}", "--speedup", str(SPEEDUP)):
        ground = Ground(port)
        heartbeat = ground.receive("HEARTBEAT")
        assert heartbeat.type == mavutil.mavlink.MAV_TYPE_QUADROTOR
        assert heartbeat.autopilot == mavutil.mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA
        ground.link.mav.heartbeat_send(6, 8, 0, 0, 4)
        for message_id in (mavutil.mavlink.MAVLINK_MSG_ID_EKF_STATUS_REPORT,
                           mavutil.mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT,
                           mavutil.mavlink.MAVLINK_MSG_ID_MISSION_CURRENT):
            ground.command(mavutil.mavlink.MAV_CMD_SET_MESSAGE_INTERVAL, message_id, 100_000)
        ground.wait_for_position()

        guided, auto = 4, 3
        ground.command(mavutil.mavlink.MAV_CMD_DO_SET_MODE, 1, guided)
        ground.command(mavutil.mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 1)
        ground.command(mavutil.mavlink.MAV_CMD_NAV_TAKEOFF, 0, 0, 0, 0, 0, 0, 20)
        harness.wait_until(lambda: (m := ground._next(("GLOBAL_POSITION_INT",))) and m.relative_alt > 19_000, 30,
                        "the copter at 20 m", pause=0)

        waypoint, rtl = mavutil.mavlink.MAV_CMD_NAV_WAYPOINT, mavutil.mavlink.MAV_CMD_NAV_RETURN_TO_LAUNCH
        items = [
            (waypoint, (0, 0, 0, 0), HOME_LAT, HOME_LON, 0),  # item 0 is home
            (waypoint, (0, 0, 0, 0), HOME_LAT + 0.0005, HOME_LON, 25),
            (waypoint, (0, 0, 0, 0), HOME_LAT + 0.0005, HOME_LON + 0.0005, 25),
            (rtl, (0, 0, 0, 0), 0, 0, 0),
        ]
        assert ground.upload(items) == [0, 1, 2, 3], "the vehicle asks for each item once, in order"
        ground.command(mavutil.mavlink.MAV_CMD_DO_SET_MODE, 1, auto)

        farthest = 0.0

        def landed():
            nonlocal farthest
            message = ground._next(("GLOBAL_POSITION_INT", "HEARTBEAT"))
            if message is None:
                return False
            if message.get_type() == "GLOBAL_POSITION_INT":
                farthest = max(farthest, message.lat / 1e7 - HOME_LAT)
                return False
            ground.link.mav.heartbeat_send(6, 8, 0, 0, 4)
            return not message.base_mode & mavutil.mavlink.MAV_MODE_FLAG_SAFETY_ARMED

        harness.wait_until(landed, 90, "the copter back on the ground, disarmed", pause=0)
        assert farthest > 0.00045, f"the copter went {farthest:.6f} degrees north, the waypoints are at 0.0005"
        print("pymavlink armed, took off, uploaded and flew a mission on the simulator")


main()
