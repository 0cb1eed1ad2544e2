"""Write the names of a MAVLink dialect as C++ initialisers: messages with their fields, and entries of enumerations.

usage: generate_message_tables.py DIALECT OUT_DIR

Writes OUT_DIR/dialect_messages.inc, dialect_fields.inc and dialect_names.inc, which src/mavlink/wire/dialect_names.cpp includes.
Rows are sorted by name, fields by message and place on the wire. Also dialect_instances.inc for src/mavlink/wire/message_table.cpp: of
messages about one of several things, the place of the field that says which.
"""

import pathlib
import sys

import pymavlink
from pymavlink.generator import mavparse

FOLDER = pathlib.Path(pymavlink.__file__).parent / "dialects" / "v20"

# Fields that say which of several things a message is about, where the XML does not mark them (instance="true").
UNMARKED_INSTANCES = {
    "ADSB_VEHICLE": "ICAO_address",
    "AIS_VESSEL": "MMSI",
    "COLLISION": "id",
    "ESC_INFO": "index",
    "ESC_STATUS": "index",
    "RC_CHANNELS_RAW": "port",
    "RC_CHANNELS_SCALED": "port",
}


def dialect_with_includes(name: str, seen: dict[str, mavparse.MAVXML]) -> None:
    if name in seen:
        return
    parsed = mavparse.MAVXML(str(FOLDER / name), "2.0")
    seen[name] = parsed
    for included in parsed.include:
        dialect_with_includes(included, seen)


def instance_row(message) -> str | None:
    for field in message.ordered_fields:
        if field.instance or UNMARKED_INSTANCES.get(message.name) == field.name:
            return f"{{{message.id}, {field.wire_offset}, {field.wire_length}}},"
    return None


def main() -> int:
    dialect, out = sys.argv[1], pathlib.Path(sys.argv[2])
    seen: dict[str, mavparse.MAVXML] = {}
    dialect_with_includes(f"{dialect}.xml", seen)
    messages = {m.name: m for xml in seen.values() for m in xml.message}
    names = {e.name: int(e.value) for xml in seen.values() for group in xml.enum for e in group.entry}

    message_rows, field_rows = [], []
    for name in sorted(messages):
        message = messages[name]
        fields = message.ordered_fields
        message_rows.append(f'{{"{name}", {message.id}, {len(field_rows)}, {len(fields)}}},')
        for field in fields:
            kind = field.type.removesuffix("_t") if field.type != "uint8_t_mavlink_version" else "uint8"
            length = field.array_length
            field_rows.append(f'{{"{field.name}", WireType::{kind}_, {field.wire_offset}, {length}}},')
    name_rows = [f'{{"{name}", {names[name]}}},' for name in sorted(names) if not name.endswith("_ENUM_END")]

    instance_rows = [row for row in map(instance_row, messages.values()) if row]

    out.mkdir(parents=True, exist_ok=True)
    for file, rows in (("messages", message_rows), ("fields", field_rows), ("names", name_rows), ("instances", instance_rows)):
        (out / f"dialect_{file}.inc").write_text("\n".join(rows) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
