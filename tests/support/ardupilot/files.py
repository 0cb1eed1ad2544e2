"""MAVLink's file transfer, by hand. Not a test itself."""

import struct


class Files:
    """As in https://mavlink.io/en/services/ftp.html"""

    def __init__(self, vehicle):
        self.vehicle, self.seq = vehicle, 0

    def ask(self, opcode, data=b"", offset=0, size=None):
        self.seq = (self.seq + 1) % 65536
        packet = struct.pack("<HBBBBBBI", self.seq, 0, opcode, len(data) if size is None else size, 0, 0, 0, offset) + data
        self.vehicle.link.mav.file_transfer_protocol_send(0, self.vehicle.system, 1, list(packet.ljust(251, b"\0")))
        answer = self.vehicle.wait(lambda h: h.get_type() == "FILE_TRANSFER_PROTOCOL", 10, f"file operation {opcode}")
        payload = bytes(answer.payload)
        return payload[3], payload[12:12 + payload[4]]

    def read(self, path):
        self.ask(2)
        opened, _ = self.ask(4, path.encode())
        assert opened == 128, f"{path} is not there"
        content = b""
        while True:
            result, data = self.ask(5, offset=len(content), size=239)
            if result != 128:
                self.ask(1)
                return content, data
            content += data
