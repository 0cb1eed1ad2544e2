#include "video/world/car_park_file.hpp"

#include <limits>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/config.hpp"
#include "geo/anchor.hpp"
#include "video/files/file_bytes.hpp"
#include "video/world/car_park_parts.hpp"
#include "video/world/row_of_slots.hpp"

namespace lapwing::video {

namespace {

using base::ConfigReader;
using base::Placed;
using base::config_kinds::invalid_value;

constexpr double full_turn_deg = 360.0;
constexpr int most_number = 2 * static_cast<int>(most_slots);

void read_anchor(WorldParts& parts, ConfigReader& reader, CarPark& park) {
  if (auto const anchor = geo::read_anchor(reader)) park.anchor = *anchor;
  if (!reader.has("anchor"))
    parts.missing({0, 1}, "a car park", "a place on Earth: anchor = [latitude, longitude, altitude]");
}

void read_light(WorldParts& parts, ConfigReader& reader, Light& light) {
  auto table = reader.table("light");
  if (!table) return;
  parts.angle(*table, "sun_azimuth_deg", -full_turn_deg, full_turn_deg, light.sun_azimuth_rad);
  parts.angle(*table, "sun_height_deg", 10.0, 90.0, light.sun_height_rad);
  parts.number(*table, "shadow", 0.0, 0.9, light.shadow);
  parts.number(*table, "brightness", 0.2, 1.5, light.brightness);
  table->refuse_unknown();
}

void read_ground(WorldParts& parts, ConfigReader& reader, CarPark& park) {
  auto table = reader.table("ground");
  if (!table) return;
  parts.number(*table, "pixel_m", 0.02, 0.5, park.pixel_m);
  parts.number(*table, "wear", 0.0, 1.0, park.wear);
  auto const file = table->text("picture");
  auto const box = table->numbers("picture_box", 4, -most_far_m, most_far_m);
  if (file && box) {
    auto const& b = box->value;
    if (b[2] - b[0] < 1.0 || b[3] - b[1] < 1.0)
      parts.wrong(invalid_value, box->span, "the picture's box is smaller than a metre",
                  "picture_box = [west, south, east, north]");
    park.picture = GroundPicture{file->value, Spot(b[0], b[1]), Spot(b[2], b[3])};
  } else if (file.has_value() != box.has_value()) {
    parts.wrong(car_park_kinds::misfit, file ? file->span : box->span,
                "a picture of the ground needs both picture and picture_box",
                "picture_box = [west, south, east, north], in metres");
  }
  table->refuse_unknown();
}

void read_cars(WorldParts& parts, ConfigReader& reader, CarPark& park, double& share) {
  auto table = reader.table("cars");
  if (!table) return;
  parts.number(*table, "share", 0.0, 1.0, share);
  constexpr double longest_min = 100'000.0;
  double stay_min = 0.0;
  parts.number(*table, "stay_min", 0.0, longest_min, stay_min);
  constexpr double minute_s = 60.0;
  park.stay_s = stay_min * minute_s;
  parts.number(*table, "slip_m", 0.0, 1.0, park.slip_m);
  table->refuse_unknown();
}

void read_paint(WorldParts& parts, ConfigReader& reader, RowOfSlots& row) {
  parts.number(reader, "line_width_m", 0.02, 0.5, row.line_m);
  parts.colour(reader, "colour", row.colour);
  auto const words = reader.texts("paint");
  if (!words) return;
  row.has_sides = row.has_heads = row.has_mouths = false;
  for (auto const& word : *words) {
    if (word.value == "sides")
      row.has_sides = true;
    else if (word.value == "heads")
      row.has_heads = true;
    else if (word.value == "mouths")
      row.has_mouths = true;
    else
      parts.wrong(invalid_value, word.span, "nothing of a slot that is painted has this name",
                  "it can be sides, heads, mouths");
  }
}

/// What a row and a single slot have in common.
void read_size(WorldParts& parts, ConfigReader& reader, RowOfSlots& row) {
  parts.angle(reader, "heading_deg", -full_turn_deg, full_turn_deg, row.heading_rad);
  parts.number(reader, "width_m", 1.0, 20.0, row.width_m);
  parts.number(reader, "length_m", 1.0, 20.0, row.length_m);
  parts.angle(reader, "slant_deg", -70.0, 70.0, row.slant_rad);
  parts.number(reader, "share", 0.0, 1.0, row.share);
  read_paint(parts, reader, row);
}

void add_if_room(WorldParts& parts, CarPark& park, RowOfSlots const& row, base::Span span) {
  if (park.slots.size() + static_cast<std::size_t>(row.count) > most_slots)
    parts.wrong(car_park_kinds::too_large, span, fmt::format("there are more than {} slots", most_slots));
  else
    add_row(park, row);
}

void read_row(WorldParts& parts, Placed<ConfigReader>& part, double share, int number, CarPark& park) {
  auto& reader = part.value;
  RowOfSlots row{.name = parts.name(reader, "name", fmt::format("{}-", number)), .at = {}, .share = share};
  auto const at = parts.spot(part, "a row");
  read_size(parts, reader, row);
  parts.whole(reader, "count", 1, static_cast<int>(most_slots), row.count);
  if (!reader.has("count")) parts.missing(part.span, "a row", "the number of its slots: count = 12");
  parts.whole(reader, "first", 0, most_number, row.first);
  parts.number(reader, "gap_m", 0.0, 100.0, row.gap_m);
  parts.numbers_of_slots(reader, "taken", row.taken);
  parts.numbers_of_slots(reader, "free", row.free);
  parts.numbers_of_slots(reader, "left_out", row.left_out);
  if (!at) return;
  row.at = *at;
  add_if_room(parts, park, row, part.span);
}

void read_slot(WorldParts& parts, Placed<ConfigReader>& part, double share, int number, CarPark& park) {
  auto& reader = part.value;
  RowOfSlots row{.name = {}, .at = {}, .first = number, .share = share};
  auto const at = parts.spot(part, "a slot");
  read_size(parts, reader, row);
  if (auto const taken = reader.flag("taken")) (taken->value ? row.taken : row.free).insert(number);
  auto const name = parts.name(reader, "name", fmt::format("S{}", number));
  if (!at) return;
  row.at = *at;
  auto const before = park.slots.size();
  add_if_room(parts, park, row, part.span);
  if (park.slots.size() > before) park.slots.back().id = name;
}

void read_car(WorldParts& parts, Placed<ConfigReader>& part, CarPark& park) {
  auto const at = parts.spot(part, "a car");
  Dice dice(park.seed, park.cars.size() + 1, 77);
  constexpr double any_m = 20.0;
  ListedCar car{.at = at.value_or(Spot()), .look = drawn_vehicle(dice, any_m)};
  parts.angle(part.value, "heading_deg", -full_turn_deg, full_turn_deg, car.heading_rad);
  parts.colour(part.value, "colour", car.look.paint);
  if (auto const name = part.value.text("kind")) {
    if (auto const* const kind = vehicle_kind(name->value)) {
      car.look.kind = kind;
      car.look.length_m = 0.5 * (kind->length_m[0] + kind->length_m[1]);
      car.look.width_m = 0.5 * (kind->width_m[0] + kind->width_m[1]);
      car.look.height_m = 0.5 * (kind->height_m[0] + kind->height_m[1]);
    } else {
      std::vector<std::string_view> names;
      for (auto const& known : vehicle_kinds) names.push_back(known.name);
      parts.wrong(invalid_value, name->span, "no kind of vehicle has this name",
                  fmt::format("it can be {}", fmt::join(names, ", ")));
    }
  }
  if (!at) return;
  for (std::size_t i = 0; i < park.slots.size() && !car.slot; ++i)
    if (park.slots[i].contains(*at)) car.slot = i;
  if (car.slot) park.slots[*car.slot].habit = Slot::Habit::left_to_listed;
  park.cars.push_back(car);
}

void read_area(WorldParts& parts, Placed<ConfigReader>& part, CarPark& park) {
  Patch patch;
  if (auto const word = part.value.text("ground")) {
    if (word->value == "grass")
      patch.ground = Ground::grass;
    else if (word->value == "concrete")
      patch.ground = Ground::concrete;
    else if (word->value == "gravel")
      patch.ground = Ground::gravel;
    else if (word->value != "asphalt")
      parts.wrong(invalid_value, word->span, "no kind of ground has this name",
                  "it can be asphalt, concrete, gravel, grass");
  }
  if (auto const kerb = part.value.flag("kerb")) patch.has_kerb = kerb->value;
  auto const corners = parts.corners(part, "an area");
  if (!corners) return;
  patch.corners = *corners;
  park.patches.push_back(patch);
}

void read_line(WorldParts& parts, Placed<ConfigReader>& part, CarPark& park) {
  Stripe stripe{.points = parts.spots(part, "points", "a line", 2)};
  parts.number(part.value, "width_m", 0.02, 2.0, stripe.width_m);
  parts.colour(part.value, "colour", stripe.colour);
  if (!stripe.points.empty()) park.stripes.push_back(stripe);
}

void read_lane(WorldParts& parts, Placed<ConfigReader>& part, CarPark& park) {
  Lane lane{.points = parts.spots(part, "points", "a lane", 2)};
  parts.number(part.value, "speed_m_s", 0.5, 20.0, lane.speed_m_s);
  parts.number(part.value, "every_s", 5.0, 100'000.0, lane.every_s);
  if (!lane.points.empty()) park.lanes.push_back(lane);
}

void read_tree(WorldParts& parts, Placed<ConfigReader>& part, CarPark& park) {
  auto const at = parts.spot(part, "a tree");
  Tree tree{.at = at.value_or(Spot())};
  parts.number(part.value, "radius_m", 0.3, 10.0, tree.radius_m);
  parts.number(part.value, "height_m", 0.5, 30.0, tree.height_m);
  if (at) park.trees.push_back(tree);
}

void read_building(WorldParts& parts, Placed<ConfigReader>& part, CarPark& park) {
  Block block;
  parts.number(part.value, "height_m", 0.1, 60.0, block.height_m);
  parts.colour(part.value, "colour", block.roof);
  auto const corners = parts.corners(part, "a building");
  if (!corners) return;
  block.corners = *corners;
  park.blocks.push_back(block);
}

void check_names(WorldParts& parts, CarPark const& park) {
  std::set<std::string_view> names;
  for (auto const& slot : park.slots)
    if (!names.insert(slot.id).second)
      parts.wrong(car_park_kinds::misfit, {0, 1}, fmt::format("two slots are called {}", slot.id),
                  "rows need names, or first numbers, that differ");
}

}  // namespace

CarPark read_car_park(base::SourceFile const& source, base::Diagnostics& diagnostics) {
  CarPark park;
  WorldParts parts(diagnostics);
  if (source.text().size() > most_world_bytes) {
    parts.wrong(car_park_kinds::too_large, {0, 1},
                fmt::format("the file has {} bytes, {} at most are read", source.text().size(), most_world_bytes));
    return park;
  }
  auto const table = base::parse_config(source, diagnostics);
  ConfigReader reader(table, diagnostics);
  if (diagnostics.has_errors()) return park;
  park.name = parts.name(reader, "name", "car park");
  read_anchor(parts, reader, park);
  if (auto const seed = reader.integer("seed", 0, std::numeric_limits<std::int64_t>::max()))
    park.seed = static_cast<std::uint64_t>(seed->value);
  read_light(parts, reader, park.light);
  read_ground(parts, reader, park);
  double share = 0.6;
  read_cars(parts, reader, park, share);
  parts.each(reader, "area", [&](auto& part) { read_area(parts, part, park); });
  int number = 0;
  parts.each(reader, "row", [&](auto& part) { read_row(parts, part, share, ++number, park); });
  number = 0;
  parts.each(reader, "slot", [&](auto& part) { read_slot(parts, part, share, ++number, park); });
  parts.each(reader, "car", [&](auto& part) { read_car(parts, part, park); });
  parts.each(reader, "line", [&](auto& part) { read_line(parts, part, park); });
  parts.each(reader, "lane", [&](auto& part) { read_lane(parts, part, park); });
  parts.each(reader, "tree", [&](auto& part) { read_tree(parts, part, park); });
  parts.each(reader, "building", [&](auto& part) { read_building(parts, part, park); });
  reader.refuse_unknown();
  check_names(parts, park);
  return park;
}

base::Result<CarPark> car_park_of(std::string name, std::string text) {
  base::SourceFile const source(std::move(name), std::move(text));
  base::Diagnostics diagnostics(source);
  auto park = read_car_park(source, diagnostics);
  if (!diagnostics.has_errors()) return park;
  return base::fail(base::ErrorKind::invalid_input, base::render(diagnostics));
}

base::Result<CarPark> load_car_park(std::filesystem::path const& file) {
  auto text = bytes_of(file, most_world_bytes);
  if (!text) return std::unexpected(text.error());
  auto park = car_park_of(file.string(), std::move(*text));
  if (park && park->picture) park->picture->file = file.parent_path() / park->picture->file;
  return park;
}

}  // namespace lapwing::video
