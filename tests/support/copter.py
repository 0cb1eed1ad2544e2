"""A copter whose protocol side is pymavlink: small, strict about what it is told, and broken on request. Not a test itself."""

import dataclasses
import itertools
import select

from pymavlink import mavutil
from pymavlink.dialects.v20 import ardupilotmega as mavlink

HOME = (41.1780, -8.5980, 90.0)
STABILIZE, AUTO, GUIDED, LOITER, RTL, LAND, BRAKE = 0, 3, 4, 5, 6, 9, 17
GROUND = (255, 190)

# What it is asked for and does not send.
LACKING = {mavlink.MAVLINK_MSG_ID_VFR_HUD, mavlink.MAVLINK_MSG_ID_NAV_CONTROLLER_OUTPUT, mavlink.MAVLINK_MSG_ID_RC_CHANNELS,
           mavlink.MAVLINK_MSG_ID_FENCE_STATUS, mavlink.MAVLINK_MSG_ID_WIND}


@dataclasses.dataclass
class Faults:
    """How it misbehaves. Tests change these while it flies."""

    silent: bool = False  # neither sends nor hears
    silent_from_item: int | None = None  # falls silent when this item arrives
    refused_item: int | None = None  # NACKs it with `refusal`
    refused_mission: bool = False  # takes every item and NACKs the whole at the end
    refusal: int = mavlink.MAV_MISSION_UNSUPPORTED
    arming_refusal: str = ""  # denies arming and says this
    unsent_requests: set[int] = dataclasses.field(default_factory=set)  # each is lost once, repeated after a second
    request_spacing: float = 0.0  # seconds between an item and the request for the next
    only_request_int: bool = False
    reports_mission_state: bool = True  # False: MISSION_CURRENT without it, as of old
    reports_battery: bool = True  # False: no SYS_STATUS at all
    battery: int = 88  # percent; -1: not known
    stuck: bool = False  # carries its item out for ever
    false_place: tuple[float, float] | None = None  # tells this one instead of its own, in degrees
    busy: int = 0  # so many commands to arm or to fly are "temporarily rejected"
    asks_no_further_than: int | None = None  # the last item of an upload that it asks for
    estimated: bool = True  # False: its estimator has no position


HARDWARE = itertools.count(1)


class Copter:
    """Teleports along its mission, one leg every `leg_time` seconds of its own time, which passes `speedup` times faster."""

    def __init__(self, port: int, system_id: int = 7, speedup: float = 1.0, leg_time: float = 0.3):
        self.port, self.system_id, self.speedup, self.leg_time = port, system_id, speedup, leg_time
        self.faults = Faults()
        self.items, self.uploads, self.heard, self.problems, self.ground_heartbeats = [], 0, [], [], []
        self.link, self.hardware = None, next(HARDWARE)
        self.power_on(0.0)

    def power_on(self, now: float):
        """A new source port, disarmed, STABILIZE, its clock at zero; no message rates and nothing half uploaded."""
        if self.link:
            self.link.close()
        self.link = mavutil.mavlink_connection(f"udpout:127.0.0.1:{self.port}", source_system=self.system_id,
                                               source_component=1, dialect="ardupilotmega")
        self.booted, self.mode, self.armed = now, STABILIZE, False
        self.lat, self.lon, self.alt = HOME
        self.expected, self.incoming, self.current, self.complete = 0, [], 0, False
        self.intervals, self.next_sent, self.next_beat, self.next_leg = {}, {}, 0.0, 0.0
        self.next_request = None

    def reboot(self, now: float, keeps_mission: bool = True):
        self.power_on(now)
        if not keeps_mission:
            self.items = []

    def is_flying(self) -> bool:
        return self.alt > HOME[2] + 0.5

    def pilot_sets_mode(self, mode: int):
        self.mode = mode
        self.send_heartbeat()

    def commands(self, command: int) -> list:
        return [m for m in self.heard if m.get_type() in ("COMMAND_LONG", "COMMAND_INT") and m.command == command]

    def modes_commanded(self) -> list[int]:
        by_command = [int(m.param2) for m in self.commands(mavlink.MAV_CMD_DO_SET_MODE)]
        return by_command + [m.custom_mode for m in self.heard if m.get_type() == "SET_MODE"]

    def was_told_to_fly(self) -> bool:
        arms = [m for m in self.commands(mavlink.MAV_CMD_COMPONENT_ARM_DISARM) if m.param1 == 1]
        return bool(arms or self.commands(mavlink.MAV_CMD_MISSION_START) or AUTO in self.modes_commanded())

    # ---- its life -------------------------------------------------------------------------------------------------

    def step(self, now: float):
        while True:
            message = self.link.recv_match(blocking=False)
            if message is None:
                break
            if not self.faults.silent:
                self.receive(message, now)
        self.live(now)

    def live(self, now: float):
        """What it does by itself."""
        if self.next_request is not None and now >= self.next_request:
            self.ask(now)
        if now >= self.next_beat:
            self.next_beat = now + 1.0
            self.send_heartbeat()
        for message_id, interval in self.intervals.items():
            if now >= self.next_sent.get(message_id, 0.0):
                self.next_sent[message_id] = now + interval
                self.send_telemetry(message_id, now)
        if self.mode == AUTO and self.armed and not self.faults.stuck and now >= self.next_leg:
            self.next_leg = now + self.leg_time
            self.fly_leg()

    @property
    def mav(self):
        return Silence() if self.faults.silent else self.link.mav

    def say(self, text: str, severity: int = mavlink.MAV_SEVERITY_CRITICAL):
        self.mav.statustext_send(severity, text.encode())

    def send_heartbeat(self):
        base = mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED | (mavlink.MAV_MODE_FLAG_SAFETY_ARMED if self.armed else 0)
        self.mav.heartbeat_send(mavlink.MAV_TYPE_QUADROTOR, mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA, base, self.mode,
                                mavlink.MAV_STATE_ACTIVE if self.armed else mavlink.MAV_STATE_STANDBY)

    def send_heartbeat_of(self, component: int, kind: int, mode: int):
        """Of another component of this system, over the same link."""
        mav = self.mav
        mav.srcComponent = component
        mav.heartbeat_send(kind, mavlink.MAV_AUTOPILOT_INVALID, mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED, mode,
                           mavlink.MAV_STATE_ACTIVE)
        mav.srcComponent = 1

    def send_telemetry(self, message_id: int, now: float):
        boot_ms, mav, battery = int((now - self.booted) * 1000) & 0xFFFFFFFF, self.mav, self.faults.battery
        place = self.faults.false_place or (self.lat, self.lon)
        lat, lon, alt_mm = round(place[0] * 1e7), round(place[1] * 1e7), round(self.alt * 1000)
        if message_id == mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT:
            mav.global_position_int_send(boot_ms, lat, lon, alt_mm, round((self.alt - HOME[2]) * 1000), 0, 0, 0, 0)
        elif message_id == mavlink.MAVLINK_MSG_ID_ATTITUDE:
            mav.attitude_send(boot_ms, 0, 0, 0, 0, 0, 0)
        elif message_id == mavlink.MAVLINK_MSG_ID_EKF_STATUS_REPORT:
            mav.ekf_status_report_send(0x33F if self.faults.estimated else 0xA7, 0, 0, 0, 0, 0)
        elif message_id == mavlink.MAVLINK_MSG_ID_SYS_STATUS and self.faults.reports_battery:
            healthy = 0x1FFFFFFF
            mav.sys_status_send(healthy, healthy, healthy, 0, 12600, 100, battery, 0, 0, 0, 0, 0, 0)
        elif message_id == mavlink.MAVLINK_MSG_ID_BATTERY_STATUS and self.faults.reports_battery:
            mav.battery_status_send(0, 0, 0, 2500, [12600] + [65535] * 9, 100, 0, 0, battery)
        elif message_id == mavlink.MAVLINK_MSG_ID_MISSION_CURRENT:
            state = 5 if self.complete else (3 if self.mode == AUTO else 2)
            mav.mission_current_send(self.current, max(0, len(self.items) - 1),
                                     state if self.faults.reports_mission_state else 0, 0)
        elif message_id == mavlink.MAVLINK_MSG_ID_EXTENDED_SYS_STATE:
            mav.extended_sys_state_send(0, 2 if self.is_flying() else 1)
        elif message_id == mavlink.MAVLINK_MSG_ID_GPS_RAW_INT:
            mav.gps_raw_int_send(0, 6, lat, lon, alt_mm, 100, 100, 0, 0, 10)
        elif message_id == mavlink.MAVLINK_MSG_ID_HOME_POSITION:
            mav.home_position_send(round(HOME[0] * 1e7), round(HOME[1] * 1e7), round(HOME[2] * 1000), 0, 0, 0,
                                   [1, 0, 0, 0], 0, 0, 0)

    # ---- what it is told ------------------------------------------------------------------------------------------

    def receive(self, message, now: float):
        kind = message.get_type()
        if kind == "BAD_DATA":
            self.problems.append(f"pymavlink could not parse: {message}")
            return
        if (message.get_srcSystem(), message.get_srcComponent()) != GROUND:
            self.problems.append(f"{kind} from {message.get_srcSystem()}/{message.get_srcComponent()}")
        if kind == "HEARTBEAT":
            self.ground_heartbeats.append(now)
            if (message.type, message.autopilot) != (mavlink.MAV_TYPE_GCS, mavlink.MAV_AUTOPILOT_INVALID):
                self.problems.append(f"ground heartbeat {message}")
            return
        if self.tells_who_it_is(kind, message, now):
            return
        self.heard.append(message)
        if getattr(message, "target_system", self.system_id) not in (0, self.system_id):
            self.problems.append(f"{kind} for system {message.target_system}")
        elif kind in ("COMMAND_LONG", "COMMAND_INT"):
            self.command(message)
        elif kind == "SET_MODE":
            self.pilot_sets_mode(message.custom_mode)
        elif kind.startswith("MISSION_"):
            self.mission_message(kind, message, now)

    def tells_who_it_is(self, kind: str, message, now: float) -> bool:
        """Answers what the ground asks to know links, vehicles and their fences."""
        if kind == "TIMESYNC":
            if message.tc1 == 0:
                self.mav.timesync_send(round((now - self.booted) * 1e9) + 1, message.ts1)
            return True
        if kind == "PARAM_REQUEST_READ":
            if message.param_id in ("FENCE_ENABLE", "FENCE_AUTOENABLE"):
                self.mav.param_value_send(message.param_id.encode(), 0, mavlink.MAV_PARAM_TYPE_INT8, 900, 65535)
            return True
        if kind != "COMMAND_LONG" or message.command != mavlink.MAV_CMD_REQUEST_MESSAGE:
            return False
        if message.param1 == mavlink.MAVLINK_MSG_ID_AUTOPILOT_VERSION:
            self.mav.autopilot_version_send(0, 0, 0, 0, 0, [0] * 8, [0] * 8, [0] * 8, 0, 0, self.hardware)
        else:
            self.send_telemetry(int(message.param1), now)
        return True

    def command(self, message):
        result = mavlink.MAV_RESULT_ACCEPTED
        if self.faults.busy and message.command in (mavlink.MAV_CMD_COMPONENT_ARM_DISARM, mavlink.MAV_CMD_MISSION_START):
            self.faults.busy -= 1
            result = mavlink.MAV_RESULT_TEMPORARILY_REJECTED
        elif message.command == mavlink.MAV_CMD_SET_MESSAGE_INTERVAL and int(message.param1) in LACKING:
            result = mavlink.MAV_RESULT_DENIED
        elif message.command == mavlink.MAV_CMD_SET_MESSAGE_INTERVAL:
            self.intervals[int(message.param1)] = message.param2 / 1e6
        elif message.command == mavlink.MAV_CMD_COMPONENT_ARM_DISARM:
            result = self.arm(message.param1 == 1)
        elif message.command == mavlink.MAV_CMD_DO_SET_MODE:
            self.mode = int(message.param2)
        elif message.command == mavlink.MAV_CMD_MISSION_START:
            self.mode = AUTO
        elif message.command == mavlink.MAV_CMD_DO_SET_MISSION_CURRENT:
            self.current = int(message.param1)
        elif message.command not in (mavlink.MAV_CMD_REQUEST_MESSAGE, mavlink.MAV_CMD_DO_SET_HOME):
            result = mavlink.MAV_RESULT_UNSUPPORTED
        self.mav.command_ack_send(message.command, result)
        self.send_heartbeat()

    def arm(self, wanted: bool) -> int:
        if wanted and self.faults.arming_refusal:
            self.say(self.faults.arming_refusal)
            return mavlink.MAV_RESULT_FAILED
        self.armed = wanted
        return mavlink.MAV_RESULT_ACCEPTED

    def mission_message(self, kind: str, message, now: float):
        if kind == "MISSION_CLEAR_ALL" or (kind == "MISSION_COUNT" and message.count == 0):
            self.items, self.expected, self.next_request = [], 0, None
            self.mav.mission_ack_send(*GROUND, mavlink.MAV_MISSION_ACCEPTED, message.mission_type)
        elif kind == "MISSION_COUNT":
            self.incoming, self.expected, self.complete = [], message.count, False
            self.uploads += 1
            self.next_request = now
        elif kind in ("MISSION_ITEM_INT", "MISSION_ITEM") and message.seq == len(self.incoming) < self.expected:
            if kind == "MISSION_ITEM":
                self.problems.append("a float MISSION_ITEM: half a metre of rounding")
            self.take_item(message, now)
        elif kind == "MISSION_REQUEST_LIST":
            self.mav.mission_count_send(*GROUND, len(self.items), 0)
        elif kind == "MISSION_REQUEST_INT" and message.seq < len(self.items):
            item = self.items[message.seq]
            self.mav.mission_item_int_send(*GROUND, item.seq, item.frame, item.command, 0, 1, item.param1, item.param2,
                                           item.param3, item.param4, item.x, item.y, item.z, 0)
        elif kind == "MISSION_SET_CURRENT":
            self.current = message.seq
            self.send_telemetry(mavlink.MAVLINK_MSG_ID_MISSION_CURRENT, now)
        elif kind == "MISSION_ACK":
            self.expected, self.next_request = 0, None  # the ground has given up

    def take_item(self, item, now: float):
        if item.seq == self.faults.silent_from_item:
            self.faults.silent = True
            return
        self.incoming.append(item)
        is_last = len(self.incoming) == self.expected
        self.next_request = None if is_last else now + self.faults.request_spacing
        if item.seq == self.faults.refused_item or (is_last and self.faults.refused_mission):
            self.mav.mission_ack_send(*GROUND, self.faults.refusal, 0)
            self.expected, self.next_request = 0, None
        elif is_last:
            self.items = self.incoming
            self.mav.mission_ack_send(*GROUND, mavlink.MAV_MISSION_ACCEPTED, 0)

    def ask(self, now: float):
        """MISSION_REQUEST for even items, MISSION_REQUEST_INT for odd ones: both kinds exist in the field."""
        seq = len(self.incoming)
        self.next_request = now + 1.0
        if self.faults.asks_no_further_than is not None and seq > self.faults.asks_no_further_than:
            return
        if seq in self.faults.unsent_requests:
            self.faults.unsent_requests.remove(seq)
            return
        by_int = seq % 2 or self.faults.only_request_int
        send = self.mav.mission_request_int_send if by_int else self.mav.mission_request_send
        send(*GROUND, seq, 0)

    def fly_leg(self):
        if self.complete or not self.items:
            return
        self.current = max(1, self.current)
        item = self.items[self.current]
        if item.command in (mavlink.MAV_CMD_NAV_WAYPOINT, mavlink.MAV_CMD_NAV_TAKEOFF, mavlink.MAV_CMD_NAV_LAND):
            if item.x or item.y:
                self.lat, self.lon = item.x / 1e7, item.y / 1e7
            self.alt = HOME[2] if item.command == mavlink.MAV_CMD_NAV_LAND else item.z
        self.mav.mission_item_reached_send(self.current)
        if self.current + 1 < len(self.items):
            self.current += 1
        else:
            self.complete, self.armed = True, False


class Silence:
    """What a silent vehicle sends with: every `..._send` does nothing."""

    def __getattr__(self, name: str):
        return lambda *arguments, **named: None


def wait_for_traffic(copters, seconds: float):
    """Until something arrives for one of them, at most that long."""
    select.select([copter.link.port for copter in copters], [], [], seconds)
