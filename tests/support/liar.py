"""A vehicle whose messages hold what cannot be. Not a test itself."""

import math
import random

from pymavlink.dialects.v20 import ardupilotmega as mavlink

# Everything that a vehicle tells of itself and that the station reads.
TOLD = ["SYS_STATUS", "SYSTEM_TIME", "GPS_RAW_INT", "GLOBAL_POSITION_INT", "ATTITUDE", "LOCAL_POSITION_NED", "VFR_HUD",
        "NAV_CONTROLLER_OUTPUT", "WIND", "WIND_COV", "HOME_POSITION", "GPS_GLOBAL_ORIGIN", "CAMERA_FEEDBACK",
        "CAMERA_IMAGE_CAPTURED", "RC_CHANNELS", "BATTERY_STATUS", "EKF_STATUS_REPORT", "ESTIMATOR_STATUS", "FENCE_STATUS",
        "RADIO_STATUS", "MOUNT_STATUS", "GIMBAL_DEVICE_ATTITUDE_STATUS", "GIMBAL_MANAGER_INFORMATION", "MISSION_CURRENT",
        "MISSION_ITEM_REACHED", "EXTENDED_SYS_STATE"]
BITS = {"int8_t": 8, "uint8_t": 8, "int16_t": 16, "uint16_t": 16, "int32_t": 32, "uint32_t": 32, "int64_t": 64, "uint64_t": 64}


def extremes(kind: str, random_source):
    """Values that a field of this type can carry and hardly any vehicle can mean."""
    if kind == "float":
        return [math.nan, math.inf, -math.inf, 3.4e38, -3.4e38, -1.0, 0.0, random_source.uniform(-1e9, 1e9)]
    bits = BITS[kind]
    is_signed = kind.startswith("int")
    top = 2 ** (bits - is_signed) - 1
    sevens, eights = int("7f" * (bits // 8), 16), int("80" * (bits // 8), 16)
    values = [top, -top - 1 if is_signed else 0, -1 if is_signed else top - 1, 0, sevens,
              eights - 2 ** bits if is_signed else eights, random_source.randrange(top)]
    return values


def lies(seed: int = 1):
    """Messages without end of meaning: every field of every message alone, then all fields of it together."""
    source = random.Random(seed)
    by_name = {kind.msgname: kind for kind in mavlink.mavlink_map.values()}
    for name in TOLD:
        kind = by_name[name]
        lengths = dict(zip(kind.ordered_fieldnames, kind.array_lengths))
        fields = [(field, field_type, lengths[field]) for field, field_type in zip(kind.fieldnames, kind.fieldtypes)]
        honest = [b"" if field_type == "char" else [0] * max(length, 1) for _, field_type, length in fields]

        def message(values, kind=kind, fields=fields):
            return kind(*[v if isinstance(v, bytes) or length else v[0] for v, (_, _, length) in zip(values, fields)])

        numbers = [i for i, t in enumerate(kind.fieldtypes) if t != "char" and not kind.fieldnames[i].startswith("target_")]
        for at in numbers:
            for value in extremes(kind.fieldtypes[at], source):
                values = [list(v) if isinstance(v, list) else v for v in honest]
                values[at] = [value] * len(values[at])
                yield message(values)
        for step in range(7):
            values = list(honest)
            for at in numbers:
                all_of = extremes(kind.fieldtypes[at], source)
                values[at] = [all_of[step % len(all_of)]] * len(values[at])
            yield message(values)
