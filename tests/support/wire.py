"""A relay between vehicles and ground station that writes down what passes. Not a test itself."""

import contextlib
import dataclasses
import select
import socket
import struct
import subprocess
import threading

from pymavlink.dialects.v20 import ardupilotmega as mavlink

import harness

# Of the vehicles' many messages only these are read: the others are passed on unseen.
READ_FROM_VEHICLES = {mavlink.MAVLINK_MSG_ID_HEARTBEAT, mavlink.MAVLINK_MSG_ID_SYS_STATUS,
                      mavlink.MAVLINK_MSG_ID_BATTERY_STATUS, mavlink.MAVLINK_MSG_ID_MISSION_ACK}


SO_TIMESTAMPNS = 35  # Linux; Python has no name for it


def taken(link) -> tuple[float, bytes]:
    """The next datagram, and when it came to this end: by the kernel, however long nobody had time to take it."""
    datagram, extra, _, _ = link.recvmsg(65536, 64)
    seconds, nanoseconds = struct.unpack("qq", extra[0][2])
    return seconds + nanoseconds / 1e9, datagram


def frames(datagram: bytes):
    """The MAVLink 2 frames of a datagram, as (message id, bytes)."""
    at = 0
    while at + 12 <= len(datagram) and datagram[at] == 0xFD:
        length = 12 + datagram[at + 1] + (13 if datagram[at + 2] & 1 else 0)
        yield int.from_bytes(datagram[at + 7:at + 10], "little"), datagram[at:at + length]
        at += length


@dataclasses.dataclass
class Seen:
    """One message: who it is from or for, what it was, and when it came to the vehicle (`time.time`; 0 from a vehicle)."""

    vehicle: int
    to_vehicle: bool
    message: object
    at: float = 0.0


class Wire:
    """Vehicles send to `vehicle_port`; the station listens on `station_port`."""

    def __init__(self, station_port: int | None = None):
        self.vehicle_port, self.station_port = harness.free_udp_port(), station_port or harness.free_udp_port()
        self.seen: list[Seen] = []
        self._field = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._field.setblocking(False)
        self._field.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 22)
        self._field.bind(("127.0.0.1", self.vehicle_port))
        self._up: dict[tuple, socket.socket] = {}
        self._parser = mavlink.MAVLink(None)
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._relay, daemon=True)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._ended.set()
        self._thread.join()
        for link in (self._field, *self._up.values()):
            link.close()

    def _relay(self):
        while not self._ended.is_set():
            ready, _, _ = select.select([self._field, *self._up.values()], [], [], 0.1)
            for link in ready:
                # Nobody listens yet or any more: the datagram is lost, as on any network. Or what was ready was that error.
                with contextlib.suppress(ConnectionRefusedError, BlockingIOError):
                    self._pass_on(link)

    def _pass_on(self, link):
        if link is not self._field:
            vehicle = next(address for address, up in self._up.items() if up is link)
            at, datagram = taken(link)
            self._note(datagram, to_vehicle=True, at=at)
            self._field.sendto(datagram, vehicle)
            return
        datagram, vehicle = link.recvfrom(65536)
        if vehicle not in self._up:
            self._up[vehicle] = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
            self._up[vehicle].setblocking(False)
            self._up[vehicle].setsockopt(socket.SOL_SOCKET, SO_TIMESTAMPNS, 1)
            self._up[vehicle].connect(("127.0.0.1", self.station_port))
        self._note(datagram, to_vehicle=False)
        self._up[vehicle].send(datagram)

    def _note(self, datagram: bytes, to_vehicle: bool, at: float = 0.0):
        for kind, frame in frames(datagram):
            if not to_vehicle and kind not in READ_FROM_VEHICLES:
                continue
            message = self._parser.decode(bytearray(frame))
            vehicle = getattr(message, "target_system", 0) if to_vehicle else message.get_srcSystem()
            self.keep(Seen(vehicle, to_vehicle, message, at))

    def keep(self, seen: Seen):
        self.seen.append(seen)

    def missions(self, vehicle: int) -> list[list]:
        """The missions that were uploaded to the vehicle, in order: their items by sequence number, each as it was sent
        last. One that is sent again after the vehicle has all of them belongs to no mission."""
        missions, items, is_under_way = [], {}, False
        for seen in self.of(vehicle, "MISSION_COUNT", "MISSION_ITEM_INT", "MISSION_ACK"):
            kind = seen.message.get_type()
            if seen.to_vehicle and kind == "MISSION_COUNT" and seen.message.mission_type == 0:
                is_under_way = True
            elif seen.to_vehicle and kind == "MISSION_ITEM_INT" and seen.message.mission_type == 0 and is_under_way:
                items[seen.message.seq] = seen.message
            elif not seen.to_vehicle and kind == "MISSION_ACK" and seen.message.type == 0 and items:
                missions.append([items[number] for number in sorted(items)])
                items, is_under_way = {}, False
        return missions

    def of(self, vehicle: int, *kinds: str) -> list[Seen]:
        """Its messages of these types, in the order in which they passed."""
        return [seen for seen in self.seen if seen.vehicle == vehicle and seen.message.get_type() in kinds]

    def modes(self, vehicle: int) -> list[int]:
        """The flight modes of the vehicle's heartbeats, repetitions left out."""
        modes = []
        for seen in self.of(vehicle, "HEARTBEAT"):
            if not seen.to_vehicle and modes[-1:] != [seen.message.custom_mode]:
                modes.append(seen.message.custom_mode)
        return modes


def flown(script: str, vehicles: str, home: str, *options: str, sim: tuple[str, ...] = (), speedup: float = 40,
          seconds: float = 250) -> tuple[Wire, subprocess.CompletedProcess]:
    """`lapwing run SCRIPT` with vehicles of `lapwing sim` on the other end of a relay, to the script's end."""
    with Wire() as wire, harness.lapwing("sim", "--vehicles", vehicles, "--home", home, "--speedup", str(speedup), "--out",
                                         f"udpout://127.0.0.1:{wire.vehicle_port}", *sim):
        run = subprocess.run([harness.LAPWING, "run", script, "--link", f"udpin://127.0.0.1:{wire.station_port}",
                              "--speedup", str(speedup), *options], capture_output=True, text=True, timeout=seconds)
    return wire, run
