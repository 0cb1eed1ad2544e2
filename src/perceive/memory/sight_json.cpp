#include "perceive/memory/sight_json.hpp"

#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/text/utc_text.hpp"

namespace lapwing::perceive {

using geo::Json;

namespace {

constexpr int millimetres = 3;
constexpr int of_chances = 4;
constexpr int of_rotations = 6;
constexpr int of_lenses = 8;
/// Of slots and of cars, each: a picture has a few dozen.
constexpr std::size_t most_things = 1'000;
constexpr std::size_t longest_name = 200;
constexpr double farthest = 100'000.0;
constexpr std::size_t corner_numbers = 8;

void add(Json& to, std::initializer_list<double> numbers, int decimals) {
  for (double const number : numbers) to.push_back(geo::rounded(number, decimals));
}

Json json_of(geo::Lens const& lens) {
  auto json = Json::array({lens.width_px, lens.height_px});
  add(json,
      {lens.focal_x_px, lens.focal_y_px, lens.middle.x, lens.middle.y, lens.k1, lens.k2, lens.k3, lens.p1, lens.p2},
      of_lenses);
  return json;
}

Json json_of(geo::CameraPlace const& place) {
  auto json = Json::array();
  auto const at = place.origin();
  add(json, {at.x(), at.y(), at.z()}, millimetres);
  auto const turned = place.rotation();
  add(json, {turned.w(), turned.x(), turned.y(), turned.z()}, of_rotations);
  return json;
}

Json json_of(explore::Corners const& outline) {
  auto json = Json::array();
  for (auto const& corner : outline) add(json, {corner.x(), corner.y()}, millimetres);
  return json;
}

std::unexpected<base::Error> misfit(std::string_view why) {
  return base::fail(base::ErrorKind::invalid_input, fmt::format("a sight {}", why));
}

/// So many numbers, none beyond any car park; nothing for anything else.
template <std::size_t count>
std::optional<std::array<double, count>> numbers_in(Json const& json) {
  if (!json.is_array() || json.size() != count) return std::nullopt;
  std::array<double, count> numbers{};
  for (std::size_t i = 0; i < count; ++i) {
    if (!json[i].is_number()) return std::nullopt;
    numbers[i] = json[i].template get<double>();
    if (!(std::abs(numbers[i]) <= farthest)) return std::nullopt;
  }
  return numbers;
}

template <std::size_t count>
std::optional<std::array<double, count>> numbers_at(Json const& json, char const* key) {
  auto const found = json.find(key);
  return found == json.end() ? std::nullopt : numbers_in<count>(*found);
}

bool is_chance(double value) {
  return value >= 0.0 && value <= 1.0;
}

explore::Corners outline_of(std::span<double const> numbers) {
  explore::Corners outline;
  for (std::size_t i = 0; i < outline.size(); ++i) outline[i] = {numbers[2 * i], numbers[2 * i + 1]};
  return outline;
}

std::optional<geo::GroundView> view_in(Json const& json) {
  auto const lens = numbers_at<11>(json, "lens");
  auto const camera = numbers_at<7>(json, "camera");
  auto const ground = numbers_at<1>(json, "ground");
  if (!lens || !camera || !ground) return std::nullopt;
  auto const& l = *lens;
  auto const& c = *camera;
  Eigen::Quaterniond const turned(c[3], c[4], c[5], c[6]);
  constexpr double least = 0.5;  // of a rotation it is one; numbers are rounded
  if (turned.norm() < least) return std::nullopt;
  geo::GroundView view{.lens = {.width_px = static_cast<int>(l[0]),
                                .height_px = static_cast<int>(l[1]),
                                .focal_x_px = l[2],
                                .focal_y_px = l[3],
                                .middle = {l[4], l[5]},
                                .k1 = l[6],
                                .k2 = l[7],
                                .k3 = l[8],
                                .p1 = l[9],
                                .p2 = l[10]},
                       .site_from_camera = geo::CameraPlace({c[0], c[1], c[2]}, turned),
                       .ground_up_m = (*ground)[0]};
  if (geo::lens_fault(view.lens)) return std::nullopt;
  return view;
}

std::optional<explore::SlotSight> slot_in(Json const& json) {
  if (auto const numbers = numbers_in<corner_numbers + 1>(json); numbers && is_chance(numbers->back()))
    return explore::SlotSight{.outline = outline_of(*numbers), .surety = numbers->back()};
  auto const numbers = numbers_in<corner_numbers + 2>(json);
  if (!numbers || !is_chance((*numbers)[corner_numbers]) || !is_chance(numbers->back())) return std::nullopt;
  return explore::SlotSight{
      .outline = outline_of(*numbers), .surety = (*numbers)[corner_numbers], .taken_chance = numbers->back()};
}

std::optional<explore::CarSight> car_in(Json const& json) {
  auto const numbers = numbers_in<corner_numbers + 1>(json);
  if (!numbers || !is_chance(numbers->back())) return std::nullopt;
  return explore::CarSight{.outline = outline_of(*numbers), .chance = numbers->back()};
}

template <class Thing>
bool read_things(Json const& json, char const* key, std::optional<Thing> (*read)(Json const&),
                 std::vector<Thing>& into) {
  auto const found = json.find(key);
  if (found == json.end() || !found->is_array() || found->size() > most_things) return false;
  for (auto const& one : *found) {
    auto thing = read(one);
    if (!thing) return false;
    into.push_back(*std::move(thing));
  }
  return true;
}

std::optional<std::string> text_at(Json const& json, char const* key) {
  auto const found = json.find(key);
  if (found == json.end() || !found->is_string()) return std::nullopt;
  auto text = found->get<std::string>();
  return text.size() <= longest_name ? std::optional(std::move(text)) : std::nullopt;
}

}  // namespace

Json sight_json(explore::LotSight const& sight) {
  auto slots = Json::array();
  for (auto const& slot : sight.slots) {
    auto json = json_of(slot.outline);
    add(json, {slot.surety}, of_chances);
    if (slot.taken_chance) add(json, {*slot.taken_chance}, of_chances);
    slots.push_back(std::move(json));
  }
  auto cars = Json::array();
  for (auto const& car : sight.cars) {
    auto json = json_of(car.outline);
    add(json, {car.chance}, of_chances);
    cars.push_back(std::move(json));
  }
  return {{"at", base::utc_text(sight.at)},
          {"vehicle", sight.vehicle},
          {"lens", json_of(sight.view.lens)},
          {"camera", json_of(sight.view.site_from_camera)},
          {"ground", Json::array({geo::rounded(sight.view.ground_up_m, millimetres)})},
          {"slots", std::move(slots)},
          {"cars", std::move(cars)}};
}

base::Result<explore::LotSight> read_sight(Json const& json) {
  if (!json.is_object()) return misfit("is no object");
  auto const at = text_at(json, "at");
  auto const time = at ? base::utc_from_text(*at) : std::nullopt;
  auto vehicle = text_at(json, "vehicle");
  if (!time || !vehicle) return misfit("without a time or a vehicle");
  auto const view = view_in(json);
  if (!view) return misfit("without a sound camera");
  explore::LotSight sight{.vehicle = *std::move(vehicle), .at = *time, .view = *view};
  if (!read_things(json, "slots", slot_in, sight.slots)) return misfit("with a slot that is none");
  if (!read_things(json, "cars", car_in, sight.cars)) return misfit("with a car that is none");
  return sight;
}

}  // namespace lapwing::perceive
