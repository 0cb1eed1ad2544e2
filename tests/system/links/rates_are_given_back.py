"""A vehicle whose protocol side is pymavlink: the station asks for what does not come, never lowers a rate, gives back at its end what it
changed, and leaves what somebody else has changed since."""

import socket

from pymavlink.dialects.v20 import ardupilotmega as mavlink

import harness
import map_client

POSITION = mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT
ATTITUDE = mavlink.MAVLINK_MSG_ID_ATTITUDE
STATUS = mavlink.MAVLINK_MSG_ID_SYS_STATUS
GPS = mavlink.MAVLINK_MSG_ID_GPS_RAW_INT


class Vehicle:
    """Sends heartbeats alone, whatever its rates: as on a link that loses the rest. Answers 510 and 511."""

    def __init__(self, port):
        self.link = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.link.connect(("127.0.0.1", port))
        self.link.settimeout(0.05)
        self.mav = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
        self.intervals = {ATTITUDE: 2_000_000, STATUS: 100_000}
        self.set = []

    def send(self, message):
        self.link.send(message.pack(self.mav))
        self.mav.seq = (self.mav.seq + 1) % 256

    def serve(self):
        """What came within a moment."""
        self.send(self.mav.heartbeat_encode(2, 3, 1, 0, 3))
        try:
            datagram = self.link.recv(65536)
        except (TimeoutError, ConnectionRefusedError):
            return
        for message in self.mav.parse_buffer(datagram) or []:
            if message.get_type() == "COMMAND_LONG":
                self.obey(message)

    def obey(self, command):
        message, result = int(command.param1), mavlink.MAV_RESULT_UNSUPPORTED
        if command.command == mavlink.MAV_CMD_GET_MESSAGE_INTERVAL:
            self.send(self.mav.message_interval_encode(message, self.intervals.get(message, -1)))
            result = mavlink.MAV_RESULT_ACCEPTED
        if command.command == mavlink.MAV_CMD_SET_MESSAGE_INTERVAL:
            self.set.append(message)
            self.intervals[message] = int(command.param2)
            result = mavlink.MAV_RESULT_ACCEPTED
        self.send(self.mav.command_ack_encode(command.command, result, 0, 0, 255, 190))


def until(vehicle, condition, seconds, what):
    def served():
        vehicle.serve()
        return condition()

    harness.wait_until(served, seconds, what, pause=0)


with map_client.station() as station:
    vehicle = Vehicle(station.link_port)
    asked = {POSITION, ATTITUDE, GPS, mavlink.MAVLINK_MSG_ID_BATTERY_STATUS}
    until(vehicle, lambda: asked <= set(vehicle.set), 20, f"asked for {asked}")
    assert vehicle.intervals[POSITION] == 200_000, vehicle.intervals
    assert vehicle.intervals[ATTITUDE] == 250_000, vehicle.intervals
    assert STATUS not in vehicle.set, "its rate was higher than ours"
    vehicle.intervals[GPS] = 50_000  # somebody else wants it faster
    station.interrupt()
    until(vehicle, lambda: station.process.poll() is not None, 20, "the station ends")
assert vehicle.intervals[ATTITUDE] == 2_000_000, vehicle.intervals
assert vehicle.intervals[POSITION] == -1, vehicle.intervals
assert vehicle.intervals[STATUS] == 100_000 and vehicle.intervals[GPS] == 50_000, vehicle.intervals
print("rates were asked for where they were missing, and given back")
