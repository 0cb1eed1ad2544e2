"""One exchange with MAVSDK, as bench_exchange does it with Lapwing.

usage: peer_mavsdk.py PORT command|parameter|parameters|upload [ITEMS]; prints the seconds that it took and how many things went over."""

import asyncio
import socket
import sys
import time

from mavsdk import System
from mavsdk.mission_raw import MissionItem

PORT, WHAT, ITEMS = int(sys.argv[1]), sys.argv[2], int(sys.argv[3]) if len(sys.argv) > 3 else 20


async def command(drone):
    await drone.telemetry.set_rate_position(5.0)
    return 1


async def parameter(drone):
    await drone.param.set_param_int("RTL_ALT", 2500)
    return 1


async def parameters(drone):
    got = await drone.param.get_all_params()
    return len(got.int_params) + len(got.float_params) + len(got.custom_params)


async def upload(drone):
    await drone.mission_raw.upload_mission([
        MissionItem(seq, 0, 16, int(seq == 0), 1, 0.0, 0.0, 0.0, 0.0, int((41.178 + seq * 1e-4) * 1e7),
                    int(-8.598e7) + (seq % 2) * 6000, 110.0, 0) for seq in range(ITEMS)])
    return ITEMS


async def main():
    exchange = {"command": command, "parameter": parameter, "parameters": parameters, "upload": upload}[WHAT]
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        server_port = probe.getsockname()[1]
    drone = System(port=server_port)
    await drone.connect(system_address=f"udpin://127.0.0.1:{PORT}")
    async for state in drone.core.connection_state():
        if state.is_connected:
            break
    started = time.monotonic()
    count = await exchange(drone)
    print(f"{time.monotonic() - started:.4f} {count}", flush=True)


asyncio.run(asyncio.wait_for(main(), 120))
