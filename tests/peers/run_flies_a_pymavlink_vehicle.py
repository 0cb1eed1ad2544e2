"""`lapwing run` flies a vehicle whose protocol side is pymavlink: its parser judges every frame that we send."""

import json
import math
import pathlib
import subprocess
import tempfile
import time

from pymavlink import mavutil
from pymavlink.dialects.v20 import ardupilotmega as mavlink

import harness

HOME = (41.1780, -8.5980, 90.0)
SCRIPT = """
v = pick { type 'UAV'; timeout 20.seconds }
there = mission {
  name 'There and back'
  home location(41.1780, -8.5980, 90)
  takeOff location(41.1780, -8.5980, 110)
  move 60, 0
  move 0, 40
  returnHomeAndLand()
}
execute v: there
message 'landed'
"""
GUIDED, AUTO, LAND, RTL, BRAKE = 4, 3, 9, 6, 17


class Vehicle:
    """A copter that teleports along its mission: small, but strict about what it is told."""

    def __init__(self, port: int):
        self.link = mavutil.mavlink_connection(f"udpout:127.0.0.1:{port}", source_system=7, source_component=1,
                                               dialect="ardupilotmega")
        self.mode, self.armed, self.lat, self.lon, self.alt = GUIDED, False, HOME[0], HOME[1], HOME[2]
        self.items, self.expected, self.current, self.landed_after_mission = [], 0, 0, False
        self.intervals, self.next_sent, self.problems = {}, {}, []
        self.uploads, self.ground_heartbeats, self.next_beat, self.next_leg = 0, [], 0.0, 0.0

    def step(self, now: float):
        while True:
            message = self.link.recv_match(blocking=False)
            if message is None:
                break
            self.receive(message, now)
        if now >= self.next_beat:
            self.next_beat = now + 1.0
            self.send_heartbeat()
        for message_id, interval in self.intervals.items():
            if now >= self.next_sent.get(message_id, 0.0):
                self.next_sent[message_id] = now + interval
                self.send_telemetry(message_id, now)
        if self.mode == AUTO and self.armed and now >= self.next_leg:
            self.next_leg = now + 0.3
            self.fly_leg()

    def send_heartbeat(self):
        base = mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED | (mavlink.MAV_MODE_FLAG_SAFETY_ARMED if self.armed else 0)
        self.link.mav.heartbeat_send(mavlink.MAV_TYPE_QUADROTOR, mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA, base, self.mode,
                                     mavlink.MAV_STATE_ACTIVE if self.armed else mavlink.MAV_STATE_STANDBY)

    def send_telemetry(self, message_id, now):
        boot_ms = int(now * 1000) & 0xFFFFFFFF
        mav = self.link.mav
        if message_id == mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT:
            mav.global_position_int_send(boot_ms, round(self.lat * 1e7), round(self.lon * 1e7), round(self.alt * 1000),
                                         round((self.alt - HOME[2]) * 1000), 0, 0, 0, 0)
        elif message_id == mavlink.MAVLINK_MSG_ID_EKF_STATUS_REPORT:
            mav.ekf_status_report_send(0x33F, 0, 0, 0, 0, 0)
        elif message_id == mavlink.MAVLINK_MSG_ID_SYS_STATUS:
            healthy = 0x1FFFFFFF
            mav.sys_status_send(healthy, healthy, healthy, 0, 12600, 100, 88, 0, 0, 0, 0, 0, 0)
        elif message_id == mavlink.MAVLINK_MSG_ID_BATTERY_STATUS:
            mav.battery_status_send(0, 0, 0, 2500, [12600] + [65535] * 9, 100, 0, 0, 88)
        elif message_id == mavlink.MAVLINK_MSG_ID_MISSION_CURRENT:
            mav.mission_current_send(self.current, max(0, len(self.items) - 1),
                                     5 if self.landed_after_mission else (3 if self.mode == AUTO else 2), 0)
        elif message_id == mavlink.MAVLINK_MSG_ID_EXTENDED_SYS_STATE:
            mav.extended_sys_state_send(0, 2 if self.alt > HOME[2] + 0.5 else 1)
        elif message_id == mavlink.MAVLINK_MSG_ID_GPS_RAW_INT:
            mav.gps_raw_int_send(0, 6, round(self.lat * 1e7), round(self.lon * 1e7), round(self.alt * 1000), 100, 100, 0,
                                 0, 10)
        elif message_id == mavlink.MAVLINK_MSG_ID_HOME_POSITION:
            mav.home_position_send(round(HOME[0] * 1e7), round(HOME[1] * 1e7), round(HOME[2] * 1000), 0, 0, 0,
                                   [1, 0, 0, 0], 0, 0, 0)

    def receive(self, message, now):
        kind = message.get_type()
        if kind == "BAD_DATA":
            self.problems.append(f"pymavlink could not parse: {message}")
            return
        if (message.get_srcSystem(), message.get_srcComponent()) != (255, 190):
            self.problems.append(f"{kind} from {message.get_srcSystem()}/{message.get_srcComponent()}")
        if kind == "HEARTBEAT":
            self.ground_heartbeats.append(now)
            if (message.type, message.autopilot) != (mavlink.MAV_TYPE_GCS, mavlink.MAV_AUTOPILOT_INVALID):
                self.problems.append(f"ground heartbeat {message}")
        elif getattr(message, "target_system", 7) not in (0, 7):
            self.problems.append(f"{kind} for system {message.target_system}")
        elif kind in ("COMMAND_LONG", "COMMAND_INT"):
            self.command(message)
        elif kind == "SET_MODE":
            self.set_mode(message.custom_mode)
        elif kind == "MISSION_COUNT":
            self.items, self.expected, self.landed_after_mission = [], message.count, False
            self.uploads += 1
            self.ask(0)
        elif kind in ("MISSION_ITEM_INT", "MISSION_ITEM") and message.seq == len(self.items) < self.expected:
            if kind == "MISSION_ITEM":
                self.problems.append("a float MISSION_ITEM: half a metre of rounding")
            self.items.append(message)
            if len(self.items) < self.expected:
                self.ask(len(self.items))
            else:
                self.link.mav.mission_ack_send(255, 190, mavlink.MAV_MISSION_ACCEPTED, 0)
        elif kind == "MISSION_REQUEST_LIST":
            self.link.mav.mission_count_send(255, 190, len(self.items), 0)
        elif kind == "MISSION_REQUEST_INT":
            item = self.items[message.seq]
            self.link.mav.mission_item_int_send(255, 190, item.seq, item.frame, item.command, 0, 1, item.param1,
                                                item.param2, item.param3, item.param4, item.x, item.y, item.z, 0)
        elif kind == "MISSION_SET_CURRENT":
            self.current = message.seq
            self.send_telemetry(mavlink.MAVLINK_MSG_ID_MISSION_CURRENT, now)

    def ask(self, seq):
        # MISSION_REQUEST for even items, MISSION_REQUEST_INT for odd ones: both kinds exist in the field.
        send = self.link.mav.mission_request_int_send if seq % 2 else self.link.mav.mission_request_send
        send(255, 190, seq, 0)

    def set_mode(self, mode):
        self.mode = mode
        self.send_heartbeat()

    def command(self, message):
        result = mavlink.MAV_RESULT_ACCEPTED
        if message.command == mavlink.MAV_CMD_SET_MESSAGE_INTERVAL:
            self.intervals[int(message.param1)] = message.param2 / 1e6
        elif message.command == mavlink.MAV_CMD_COMPONENT_ARM_DISARM:
            self.armed = message.param1 == 1
        elif message.command == mavlink.MAV_CMD_DO_SET_MODE:
            self.set_mode(int(message.param2))
        elif message.command == mavlink.MAV_CMD_MISSION_START:
            self.set_mode(AUTO)
        elif message.command in (mavlink.MAV_CMD_REQUEST_MESSAGE, mavlink.MAV_CMD_DO_SET_HOME):
            pass
        elif message.command == mavlink.MAV_CMD_DO_SET_MISSION_CURRENT:
            self.current = int(message.param1)
        else:
            result = mavlink.MAV_RESULT_UNSUPPORTED
        self.link.mav.command_ack_send(message.command, result)

    def fly_leg(self):
        if self.landed_after_mission or not self.items:
            return
        self.current = max(1, self.current)
        item = self.items[self.current]
        if item.command in (mavlink.MAV_CMD_NAV_WAYPOINT, mavlink.MAV_CMD_NAV_TAKEOFF, mavlink.MAV_CMD_NAV_LAND):
            if item.x or item.y:
                self.lat, self.lon = item.x / 1e7, item.y / 1e7
            self.alt = HOME[2] if item.command == mavlink.MAV_CMD_NAV_LAND else item.z
        self.link.mav.mission_item_reached_send(self.current)
        if self.current + 1 < len(self.items):
            self.current += 1
        else:
            self.landed_after_mission, self.armed = True, False


def main():
    port = harness.free_udp_port()
    with tempfile.TemporaryDirectory() as folder:
        script, report = pathlib.Path(folder, "there.dolphin"), pathlib.Path(folder, "report.json")
        script.write_text(SCRIPT)
        run = subprocess.Popen([harness.LAPWING, "run", str(script), "--link", f"udpin://127.0.0.1:{port}", "--report",
                                str(report), "--timeout", "100"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        vehicle, deadline = Vehicle(port), time.monotonic() + 110
        while run.poll() is None and time.monotonic() < deadline:
            vehicle.step(time.monotonic())
            time.sleep(0.005)
        if run.poll() is None:
            run.kill()
        out, err = run.communicate()
        assert run.returncode == 0, f"exit {run.returncode}\n{out}\n{err}"
        assert "landed" in out, out
        assert not vehicle.problems, "\n".join(vehicle.problems)
        assert vehicle.uploads == 1, f"{vehicle.uploads} uploads"
        commands = [item.command for item in vehicle.items]
        assert commands == [16, 22, 16, 16, 21], f"items on the wire: {commands}"
        north = math.radians(vehicle.items[2].x / 1e7 - HOME[0]) * 6378137
        assert abs(north - 60) < 1, f"move 60, 0 went {north} m north"
        beats = vehicle.ground_heartbeats
        assert len(beats) >= 3 and all(b - a < 1.6 for a, b in zip(beats, beats[1:])), f"heartbeats at {beats}"
        written = json.loads(report.read_text())
        assert written["outcome"] == "done", written
        assert written["vehicles"][0]["system_id"] == 7, written
        assert written["vehicles"][0]["missions"][0]["items"] == 5, written
    print(f"pymavlink parsed every frame of a mission of {len(commands)} items")


main()
