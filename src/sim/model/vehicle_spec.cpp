#include "sim/model/vehicle_spec.hpp"

#include <fmt/core.h>

#include <charconv>

namespace lapwing::sim {

using base::ErrorKind;
using base::fail;
using vehicle::Family;

namespace {

constexpr int most_vehicles = 250;
constexpr char const* example = "write for example copter:2,rover:1,plane:1";

std::optional<Family> family_named(std::string_view name) {
  if (name == "copter" || name == "quad") return Family::copter;
  if (name == "plane") return Family::plane;
  if (name == "rover") return Family::rover;
  if (name == "boat") return Family::boat;
  if (name == "sub") return Family::sub;
  return std::nullopt;
}

/// What a name stands for: kind and autopilot.
std::optional<VehicleGroup> group_named(std::string_view name) {
  constexpr std::string_view px4 = "px4";
  VehicleGroup group;
  if (name.starts_with(px4)) {
    group.firmware = vehicle::Autopilot::px4;
    name.remove_prefix(px4.size());
    if (name.empty()) name = "-copter";
    if (!name.starts_with('-')) return std::nullopt;
    name.remove_prefix(1);
    if (name == "boat" || name == "sub") return std::nullopt;  // PX4's are of no use to anybody
  }
  auto const family = family_named(name);
  if (!family) return std::nullopt;
  group.family = *family;
  return group;
}

std::optional<int> whole_number(std::string_view text) {
  int number = 0;
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

base::Result<VehicleGroup> parse_group(std::string_view text) {
  auto const at = text.find('@');
  auto const head = text.substr(0, at);
  auto const colon = head.find(':');
  auto const name = head.substr(0, colon);
  auto const named = group_named(name);
  if (!named) {
    return fail(ErrorKind::invalid_input, fmt::format("'{}' is no kind of vehicle that can be simulated", name),
                "kinds are copter, plane, rover, boat and sub, and with PX4 px4, px4-plane and px4-rover");
  }
  auto group = *named;
  if (colon != std::string_view::npos) {
    auto const count = whole_number(head.substr(colon + 1));
    if (!count || *count < 1 || *count > most_vehicles) {
      return fail(ErrorKind::invalid_input,
                  fmt::format("'{}' is no number of vehicles from 1 to {}", head.substr(colon + 1), most_vehicles),
                  example);
    }
    group.count = *count;
  }
  if (at != std::string_view::npos) {
    auto level = text.substr(at + 1);
    if (level.ends_with('%')) level.remove_suffix(1);
    auto const percent = whole_number(level);
    if (!percent || *percent < 1 || *percent > 100) {
      return fail(ErrorKind::invalid_input, fmt::format("'{}' is no battery level", text.substr(at + 1)),
                  "write for example copter:2@80%");
    }
    group.battery_remaining = *percent / 100.0;
  }
  return group;
}

}  // namespace

base::Result<std::vector<VehicleGroup>> parse_vehicles(std::string_view text) {
  std::vector<VehicleGroup> groups;
  int total = 0;
  for (std::string_view rest = text;;) {
    auto const comma = rest.find(',');
    auto const part = trimmed(rest.substr(0, comma));
    if (part.empty()) return fail(ErrorKind::invalid_input, fmt::format("no vehicle is named in '{}'", text), example);
    auto group = parse_group(part);
    if (!group) return std::unexpected(group.error());
    total += group->count;
    groups.push_back(*group);
    if (comma == std::string_view::npos) break;
    rest = rest.substr(comma + 1);
  }
  if (total > most_vehicles) {
    return fail(ErrorKind::invalid_input, fmt::format("{} vehicles are more than one MAVLink network holds", total),
                fmt::format("simulate at most {}", most_vehicles));
  }
  return groups;
}

}  // namespace lapwing::sim
