#include <fmt/format.h>

#include <algorithm>

#include "dolphin/builtin/internal/native_lists.hpp"
#include "dolphin/machine/runtime.hpp"
#include "dolphin/names/row_parameters.hpp"
#include "dolphin/value/objects.hpp"

/// Geometry (language spec, 3.2).
namespace lapwing::dolphin::internal {
namespace {

Checked<Value> location(Runtime& runtime, Fiber& /*fiber*/, Arguments arguments) {
  if (arguments.size() < 2 || arguments.size() > 3 || !std::ranges::all_of(arguments, &Value::is_number)) {
    return fault("location takes latitude and longitude in degrees, and a height in metres",
                 "IllegalArgumentException");
  }
  double const lat = arguments[0].number();
  double const lon = arguments[1].number();
  if (!(lat >= -90 && lat <= 90 && lon >= -180 && lon <= 360)) {
    return fault(fmt::format("({}, {}) is no latitude and longitude in degrees", lat, lon), "IllegalArgumentException");
  }
  double const height = arguments.size() == 3 ? arguments[2].number() : 0.0;
  return Value(runtime.heap.make<Position>(geo::Wgs84::from_degrees(lat, lon, height)));
}

Checked<Value> area(Runtime& runtime, Fiber& /*fiber*/, Arguments arguments) {
  auto const* center = arguments[0].as<Position>();
  if (!center || !arguments[1].is_number() || !(arguments[1].number() >= 0)) {
    return fault("area takes a position and a radius", "IllegalArgumentException");
  }
  return Value(runtime.heap.make<Area>(geo::Disc{center->value, arguments[1].number()}));
}

Checked<Value> move(Runtime& runtime, Fiber& /*fiber*/, Arguments arguments) {
  auto const* from = arguments[0].as<Position>();
  auto const* by = arguments[1].as<Displacement>();
  if (!from || !by)
    return fault("move takes a position and a displacement: move(p, { north 10 })", "IllegalArgumentException");
  return Value(runtime.heap.make<Position>(geo::displaced(from->value, by->value)));
}

}  // namespace

std::vector<InstructionSpec> place_words() {
  using namespace rows;
  return {
      {.name = "location",
       .signatures = {takes({degrees("lat", "north is positive"), degrees("lon", "east is positive"),
                             maybe(metres("height", "above mean sea level, 0 if it is left out"))})},
       .result = place,
       .doc = "A place: latitude and longitude in degrees, height in metres above mean sea level.",
       .example = "base = location(41.1780, -8.5980, 90)",
       .call = location,
       .is_pure = true},
      {.name = "pos",
       .signatures = {takes({plain("fields", closure)})},
       .result = place,
       .doc = "A place from fields; those left out are 0.",
       .block = BlockKind::position,
       .example = "base = pos { lat 38.4; lon (-8.8); height 100 }"},
      {.name = "area",
       .signatures = {takes({plain("centre", place), metres("radius")})},
       .result = Kind::area,
       .doc = "All places within the radius, height included; also written `centre ^ radius`.",
       .example = "harbour = area location(41.178, -8.598), 2.km\nmessage location(41.18, -8.6) in harbour",
       .call = area,
       .is_pure = true},
      {.name = "move",
       .signatures = {takes({plain("from", place), plain("by", Kinds(Kind::displacement) | closure)})},
       .result = place,
       .doc = "The place some metres away. Not in missions, where `move` is a command of its own.",
       .block = BlockKind::displacement,
       .example = "message move(location(41.178, -8.598), { north 100; east 50 })",
       .call = move},
      {.name = "moveDistance",
       .signatures = {takes({plain("fields", closure)})},
       .result = Kind::displacement,
       .doc = "A displacement; fields left out are 0.",
       .block = BlockKind::displacement,
       .example = "step = moveDistance { north 100; down 10 }\nmessage move(location(41.178, -8.598), step)"},
  };
}

}  // namespace lapwing::dolphin::internal
