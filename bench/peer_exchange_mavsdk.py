"""One exchange with MAVSDK. usage: peer_exchange_mavsdk.py PORT command|parameter|upload; prints the seconds."""

import asyncio
import socket
import sys
import time

from mavsdk import System
from mavsdk.mission_raw import MissionItem

PORT, WHAT, ITEMS = int(sys.argv[1]), sys.argv[2], 20


async def exchange(drone):
    if WHAT == "command":
        await drone.telemetry.set_rate_position(5.0)
    elif WHAT == "parameter":
        await drone.param.set_param_int("RTL_ALT", 2500)
    else:
        await drone.mission_raw.upload_mission([
            MissionItem(seq, 0, 16, int(seq == 0), 1, 0.0, 0.0, 0.0, 0.0, int((41.178 + seq * 1e-4) * 1e7), int(-8.598e7), 110.0, 0)
            for seq in range(ITEMS)])


async def main():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        server_port = probe.getsockname()[1]
    drone = System(port=server_port)
    await drone.connect(system_address=f"udpin://127.0.0.1:{PORT}")
    async for state in drone.core.connection_state():
        if state.is_connected:
            break
    started = time.monotonic()
    await exchange(drone)
    print(f"{time.monotonic() - started:.4f}")


asyncio.run(asyncio.wait_for(main(), 120))
