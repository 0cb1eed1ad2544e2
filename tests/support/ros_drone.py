"""What a program on ROS 2 with a foreign middleware (Cyclone DDS) hears of a drone and asks of it, by MAVROS' names; its types are written
down anew from the definitions in mavros_msgs. Not a test itself."""

import time
from dataclasses import dataclass

import ros_robot  # first: it sets Cyclone DDS up
from cyclonedds.domain import DomainParticipant
from cyclonedds.idl import IdlStruct
from cyclonedds.idl.types import array, float32, float64, int8, int16, int64, sequence, uint8, uint16, uint32
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from ros_robot import Header, Point, Pose, PoseStamped, Quaternion, Vector3, message


def service(package: str, name: str):
    return {"typename": f"{package}::srv::dds_::{name}_"}


@dataclass
class Bool(IdlStruct, **message("std_msgs", "Bool")):
    data: bool


@dataclass
class String(IdlStruct, **message("std_msgs", "String")):
    data: str


@dataclass
class Float64(IdlStruct, **message("std_msgs", "Float64")):
    data: float64


@dataclass
class NavSatStatus(IdlStruct, **message("sensor_msgs", "NavSatStatus")):
    status: int8
    service: uint16


@dataclass
class NavSatFix(IdlStruct, **message("sensor_msgs", "NavSatFix")):
    header: Header
    status: NavSatStatus
    latitude: float64
    longitude: float64
    altitude: float64
    position_covariance: array[float64, 9]
    position_covariance_type: uint8


@dataclass
class BatteryState(IdlStruct, **message("sensor_msgs", "BatteryState")):
    header: Header
    voltage: float32
    temperature: float32
    current: float32
    charge: float32
    capacity: float32
    design_capacity: float32
    percentage: float32
    power_supply_status: uint8
    power_supply_health: uint8
    power_supply_technology: uint8
    present: bool
    cell_voltage: sequence[float32]
    cell_temperature: sequence[float32]
    location: str
    serial_number: str


@dataclass
class KeyValue(IdlStruct, **message("diagnostic_msgs", "KeyValue")):
    key: str
    value: str


@dataclass
class DiagnosticStatus(IdlStruct, **message("diagnostic_msgs", "DiagnosticStatus")):
    level: uint8
    name: str
    message: str
    hardware_id: str
    values: sequence[KeyValue]


@dataclass
class State(IdlStruct, **message("mavros_msgs", "State")):
    header: Header
    connected: bool
    armed: bool
    guided: bool
    manual_input: bool
    mode: str
    system_status: uint8


@dataclass
class SysStatus(IdlStruct, **message("mavros_msgs", "SysStatus")):
    header: Header
    sensors_present: uint32
    sensors_enabled: uint32
    sensors_health: uint32
    load: uint16
    voltage_battery: uint16
    current_battery: int16
    battery_remaining: int8
    drop_rate_comm: uint16
    errors_comm: uint16
    errors_count1: uint16
    errors_count2: uint16
    errors_count3: uint16
    errors_count4: uint16


@dataclass
class GeoPoint(IdlStruct, **message("geographic_msgs", "GeoPoint")):
    latitude: float64
    longitude: float64
    altitude: float64


@dataclass
class GeoPose(IdlStruct, **message("geographic_msgs", "GeoPose")):
    position: GeoPoint
    orientation: Quaternion


@dataclass
class GeoPoseStamped(IdlStruct, **message("geographic_msgs", "GeoPoseStamped")):
    header: Header
    pose: GeoPose


@dataclass
class HomePosition(IdlStruct, **message("mavros_msgs", "HomePosition")):
    header: Header
    geo: GeoPoint
    position: Point
    orientation: Quaternion
    approach: Vector3


@dataclass
class CommandBoolRequest(IdlStruct, **service("mavros_msgs", "CommandBool_Request")):
    value: bool


@dataclass
class CommandBoolResponse(IdlStruct, **service("mavros_msgs", "CommandBool_Response")):
    success: bool
    result: uint8


@dataclass
class CommandTOLRequest(IdlStruct, **service("mavros_msgs", "CommandTOL_Request")):
    min_pitch: float32
    yaw: float32
    latitude: float32
    longitude: float32
    altitude: float32


@dataclass
class CommandTOLResponse(IdlStruct, **service("mavros_msgs", "CommandTOL_Response")):
    success: bool
    result: uint8


@dataclass
class SetModeRequest(IdlStruct, **service("mavros_msgs", "SetMode_Request")):
    base_mode: uint8
    custom_mode: str


@dataclass
class SetModeResponse(IdlStruct, **service("mavros_msgs", "SetMode_Response")):
    mode_sent: bool


@dataclass
class ParameterValue(IdlStruct, **message("rcl_interfaces", "ParameterValue")):
    type: uint8
    bool_value: bool
    integer_value: int64
    double_value: float64
    string_value: str
    byte_array_value: sequence[uint8]
    bool_array_value: sequence[bool]
    integer_array_value: sequence[int64]
    double_array_value: sequence[float64]
    string_array_value: sequence[str]


@dataclass
class ParamSetRequest(IdlStruct, **service("mavros_msgs", "ParamSetV2_Request")):
    force_set: bool
    param_id: str
    value: ParameterValue


@dataclass
class ParamSetResponse(IdlStruct, **service("mavros_msgs", "ParamSetV2_Response")):
    success: bool
    value: ParameterValue


def integer(value: int) -> ParameterValue:
    return ParameterValue(2, False, value, 0.0, "", [], [], [], [], [])


class Asker:
    """Asks one service, one thing at a time. Cyclone DDS for Python has no related sample identity, so an answer is known by its coming: what others were answered
    before is passed over, and nobody else may ask meanwhile."""

    def __init__(self, participant, name: str, request, response):
        self._requests = DataWriter(participant, Topic(participant, f"rq{name}Request", request), qos=ros_robot._STANDARD)
        self._replies = DataReader(participant, Topic(participant, f"rr{name}Reply", response), qos=ros_robot._STANDARD)
        self._request = request

    def __call__(self, *fields, seconds: float = 10):
        deadline = time.monotonic() + seconds
        while not (self._requests.get_matched_subscriptions() and self._replies.get_matched_publications()):
            assert time.monotonic() < deadline, f"nobody offers {self._request.__name__}"
            time.sleep(0.02)
        while self._replies.take(50):
            pass
        self._requests.write(self._request(*fields))
        while time.monotonic() < deadline:
            for reply in self._replies.take(1):
                return reply
            time.sleep(0.02)
        raise AssertionError(f"no answer to {self._request.__name__}{fields}")


class RosDrone:
    """Hears what the bridge says."""

    _TOPICS = {"state": ("/mavros/state", State), "system_status": ("/mavros/sys_status", SysStatus),
               "battery": ("/mavros/battery", BatteryState), "fix": ("/mavros/global_position/global", NavSatFix),
               "height": ("/mavros/global_position/rel_alt", Float64), "pose": ("/mavros/local_position/pose", PoseStamped),
               "home": ("/mavros/home_position/home", HomePosition), "decided": ("/curr_state", String), "wanted": ("/des_pose", PoseStamped)}
    _LATCHED = ("state", "home", "decided")

    def __init__(self, domain: int):
        participant = DomainParticipant(domain)
        self._participant = participant
        self._last = {}
        self._readers = {}
        for key, (topic, kind) in self._TOPICS.items():
            qos = ros_robot._LATCHED if key in self._LATCHED else ros_robot._STANDARD
            self._readers[key] = DataReader(participant, Topic(participant, f"rt{topic}", kind), qos=qos)
        self.arming = Asker(participant, "/mavros/cmd/arming", CommandBoolRequest, CommandBoolResponse)
        self.takeoff = Asker(participant, "/mavros/cmd/takeoff", CommandTOLRequest, CommandTOLResponse)
        self.set_mode = Asker(participant, "/mavros/set_mode", SetModeRequest, SetModeResponse)
        self.set_parameter = Asker(participant, "/mavros/param/set", ParamSetRequest, ParamSetResponse)

    def writer(self, topic: str, kind) -> DataWriter:
        return DataWriter(self._participant, Topic(self._participant, f"rt{topic}", kind), qos=ros_robot._STANDARD)

    def reader(self, topic: str, kind) -> DataReader:
        return DataReader(self._participant, Topic(self._participant, f"rt{topic}", kind), qos=ros_robot._STANDARD)

    def __getattr__(self, key: str):
        """The last message of that topic, None before the first."""
        reader = self.__dict__["_readers"].get(key)
        if reader is None:
            raise AttributeError(key)
        while taken := reader.take(50):
            self._last[key] = next((one for one in reversed(taken) if isinstance(one, IdlStruct)), self._last.get(key))
        return self._last.get(key)

    def wait(self, condition, what: str, seconds: float = 30):
        deadline = time.monotonic() + seconds
        while not condition(self):
            assert time.monotonic() < deadline, f"not within {seconds} s: {what}; {self.state}, {self.height}, {self.decided}"
            time.sleep(0.05)
