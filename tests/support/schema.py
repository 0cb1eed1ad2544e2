"""As much of JSON Schema (2020-12) as the schemas of docs/reference use. Not a test itself."""

import json
import pathlib

REFERENCE = pathlib.Path(__file__).parents[2] / "docs/reference"
_TYPES = {"object": dict, "array": list, "integer": int, "number": (int, float)}
_KNOWN = {"$schema", "$id", "$defs", "$ref", "title", "description", "oneOf", "type", "const", "enum", "minimum", "maximum", "properties", "required",
          "additionalProperties", "items", "prefixItems", "minItems", "maxItems"}


class Schema:
    def __init__(self, name: str):
        self._whole = json.loads((REFERENCE / name).read_text())

    def faults(self, value, definition: str = "") -> list[str]:
        """What is wrong with it, by one of the schema's `$defs` or by the whole of it."""
        return list(self._faults(value, self._whole["$defs"][definition] if definition else self._whole, "$"))

    def _faults(self, value, schema: dict, place: str):
        unknown = schema.keys() - _KNOWN
        assert not unknown, f"this reader knows nothing of {unknown}"
        if "$ref" in schema:
            yield from self._faults(value, self._whole["$defs"][schema["$ref"].removeprefix("#/$defs/")], place)
        if "oneOf" in schema and sum(not list(self._faults(value, one, place)) for one in schema["oneOf"]) != 1:
            yield f"{place} is not one of {len(schema['oneOf'])}"
        if "const" in schema and value != schema["const"] or "enum" in schema and value not in schema["enum"]:
            yield f"{place} is {value!r}"
        if "type" in schema and (not isinstance(value, _TYPES[schema["type"]]) or isinstance(value, bool)):
            yield f"{place} is no {schema['type']}"
            return
        if isinstance(value, (int, float)) and not schema.get("minimum", value) <= value <= schema.get("maximum", value):
            yield f"{place} is {value}"
        if isinstance(value, dict):
            yield from self._faults_of_object(value, schema, place)
        if isinstance(value, list):
            yield from self._faults_of_array(value, schema, place)

    def _faults_of_object(self, value: dict, schema: dict, place: str):
        known = schema.get("properties", {})
        yield from (f"{place} has no {key}" for key in schema.get("required", ()) if key not in value)
        if not schema.get("additionalProperties", True):
            yield from (f"{place} has {key}" for key in value if key not in known)
        for key in known.keys() & value.keys():
            yield from self._faults(value[key], known[key], f"{place}.{key}")

    def _faults_of_array(self, value: list, schema: dict, place: str):
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
            yield f"{place} has {len(value)} items"
        first = schema.get("prefixItems", ())
        for number, item in enumerate(value):
            yield from self._faults(item, first[number] if number < len(first) else schema.get("items", {}), f"{place}[{number}]")
