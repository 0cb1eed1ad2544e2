#include "robot/seed_text/payload.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace lapwing::robot::seed_text {

namespace {

/// The seed's displacements: five kilometres.
double constexpr furthest_m = 5'000;
std::size_t constexpr longest_text = 200;

template <class T>
struct Word {
  T meaning;
  std::string_view text;
};
auto constexpr speeds = std::to_array<Word<Speed>>({{Speed::stop, "Stop"},
                                                    {Speed::low, "Low"},
                                                    {Speed::medium, "Medium"},
                                                    {Speed::high, "High"},
                                                    {Speed::reverse, "Reverse"}});
auto constexpr overrides = std::to_array<Word<Override>>(
    {{Override::stop, "STOP"}, {Override::reverse, "REVERSE"}, {Override::go_on, "CONTINUE"}});
auto constexpr kinds = std::to_array<Word<PointOfInterest::Kind>>(
    {{PointOfInterest::Kind::door, "Door"}, {PointOfInterest::Kind::name_tag, "Name Tag"}});
auto constexpr states = std::to_array<Word<ModuleState>>(
    {{ModuleState::starting, "starting"}, {ModuleState::ready, "ready"}, {ModuleState::failed, "failed"}});

template <class Words, class T>
std::string_view word_of(Words const& words, T meaning) {
  return words[static_cast<std::size_t>(meaning)].text;
}

template <class T, std::size_t n>
std::optional<T> meaning_of(std::array<Word<T>, n> const& words, std::string_view text) {
  auto const found = std::ranges::find(words, text, &Word<T>::text);
  if (found == words.end()) return std::nullopt;
  return found->meaning;
}

template <class T = std::int64_t>
std::optional<T> whole_number(std::string_view text) {
  T value{};
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<double> metres(std::string_view text) {
  auto const centimetres = whole_number(text);
  if (!centimetres || std::abs(static_cast<double>(*centimetres)) > furthest_m * 100) return std::nullopt;
  return static_cast<double>(*centimetres) / 100;
}

std::optional<double> radians(std::string_view text) {
  auto const degrees = whole_number(text);
  if (!degrees || *degrees < -360 || *degrees > 360) return std::nullopt;
  return static_cast<double>(*degrees) * std::numbers::pi / 180;
}

long long centimetres(double value_m) {
  return std::llround(value_m * 100);
}

/// From 0 to 359.
long long degrees(double angle_rad) {
  auto const whole = std::llround(std::remainder(angle_rad, 2 * std::numbers::pi) * 180 / std::numbers::pi);
  return (whole + 360) % 360;
}

bool is_possible(double value_m) {
  return std::isfinite(value_m) && std::abs(value_m) <= furthest_m;
}

using Three = std::array<std::string_view, 3>;

/// Cut at `separator`; a `-` that begins a number is none.
std::optional<Three> three(std::string_view text, char separator) {
  Three parts;
  for (std::size_t i = 0; i < 2; ++i) {
    auto const end = text.find(separator, 1);
    if (text.empty() || end == std::string_view::npos) return std::nullopt;
    parts[i] = text.substr(0, end);
    text.remove_prefix(end + 1);
  }
  parts[2] = text;
  return parts;
}

base::Result<std::string> too_far() {
  return base::fail(base::ErrorKind::invalid_input, "a place or an angle is no number, or beyond 5 km");
}

// ---- written ----

base::Result<std::string> text_of(Pose const& pose) {
  if (!is_possible(pose.x_m) || !is_possible(pose.y_m) || !std::isfinite(pose.yaw_rad)) return too_far();
  return fmt::format("{}:{}:{}", centimetres(pose.x_m), centimetres(pose.y_m), degrees(pose.yaw_rad));
}

base::Result<std::string> text_of(Distances const& distances) {
  std::string text;
  for (auto const& distance : {distances.left_m, distances.right_m, distances.front_m}) {
    if (distance && (!is_possible(*distance) || *distance < 0)) return too_far();
    if (!text.empty()) text += ':';
    text += distance ? fmt::format("{}", centimetres(*distance)) : "-";
  }
  return text;
}

base::Result<std::string> text_of(Speed speed) {
  return std::string(word_of(speeds, speed));
}
base::Result<std::string> text_of(Override what) {
  return std::string(word_of(overrides, what));
}
base::Result<std::string> text_of(Completed) {
  return std::string("Completed");
}
base::Result<std::string> text_of(Kill) {
  return std::string("Kill");
}

base::Result<std::string> text_of(Angle angle) {
  if (!std::isfinite(angle.rad)) return too_far();
  return fmt::format("{}", degrees(angle.rad));
}

base::Result<std::string> text_of(PointOfInterest const& point) {
  if (!is_possible(point.x_m) || !is_possible(point.y_m)) return too_far();
  if (point.text.size() > longest_text || point.text.contains('"'))
    return base::fail(
        base::ErrorKind::invalid_input,
        fmt::format("the text is longer than {} characters, or has a quotation mark in it", longest_text));
  return fmt::format("\"{}\", \"{}\", {}, {}", word_of(kinds, point.kind), point.text, centimetres(point.x_m),
                     centimetres(point.y_m));
}

base::Result<std::string> text_of(LogEntry const& entry) {
  return fmt::format("{}:{}:{}", word_of(states, entry.state), entry.error_code, entry.memory_bytes);
}

// ---- read ----

std::optional<Payload> pose(std::string_view text) {
  for (char const separator : {':', '_', '-'}) {
    auto const parts = three(text, separator);
    if (!parts) continue;
    auto const x = metres((*parts)[0]);
    auto const y = metres((*parts)[1]);
    auto const yaw = radians((*parts)[2]);
    if (x && y && yaw) return Pose{.x_m = *x, .y_m = *y, .yaw_rad = *yaw};
  }
  return std::nullopt;
}

std::optional<Payload> distances(std::string_view text) {
  auto const parts = three(text, ':');
  if (!parts) return std::nullopt;
  std::array<std::optional<double>, 3> values;
  for (std::size_t i = 0; i < 3; ++i) {
    if ((*parts)[i] == "-") continue;
    values[i] = metres((*parts)[i]);
    if (!values[i] || *values[i] < 0) return std::nullopt;
  }
  return Distances{.left_m = values[0], .right_m = values[1], .front_m = values[2]};
}

std::optional<Payload> speed_or_angle(std::string_view text) {
  if (auto const speed = meaning_of(speeds, text)) return *speed;
  if (auto const angle = radians(text); angle && *angle >= 0) return Angle{.rad = *angle};
  return std::nullopt;
}

std::optional<Payload> override_or_pose(std::string_view text) {
  if (auto const what = meaning_of(overrides, text)) return *what;
  return pose(text);
}

/// Up to the closing quotation mark, with the `, ` behind it.
std::optional<std::string_view> quoted(std::string_view& text) {
  if (!text.starts_with('"')) return std::nullopt;
  auto const end = text.find("\", ", 1);
  if (end == std::string_view::npos) return std::nullopt;
  auto const found = text.substr(1, end - 1);
  text.remove_prefix(end + 3);
  return found;
}

std::optional<Payload> point_of_interest(std::string_view text) {
  auto const name = quoted(text);
  auto const label = name ? quoted(text) : std::nullopt;
  if (!label || label->size() > longest_text || label->contains('"')) return std::nullopt;
  auto const kind = meaning_of(kinds, *name);
  auto const comma = text.find(", ");
  if (!kind || comma == std::string_view::npos) return std::nullopt;
  auto const x = metres(text.substr(0, comma));
  auto const y = metres(text.substr(comma + 2));
  if (!x || !y) return std::nullopt;
  return PointOfInterest{.kind = *kind, .text = std::string(*label), .x_m = *x, .y_m = *y};
}

std::optional<Payload> log_entry(std::string_view text) {
  auto const parts = three(text, ':');
  if (!parts) return std::nullopt;
  auto const state = meaning_of(states, (*parts)[0]);
  auto const code = whole_number<std::uint16_t>((*parts)[1]);
  auto const memory = whole_number<std::uint64_t>((*parts)[2]);
  if (!state || !code || !memory) return std::nullopt;
  return LogEntry{.state = *state, .error_code = *code, .memory_bytes = *memory};
}

std::optional<Payload> said(Line const& line) {
  auto const& text = line.message;
  using enum Module;
  if (line.to == carrier && (text == "Kill" || text == "e-Stop")) return Kill{};
  if (line.from == carrier && text == "Completed") return Completed{};
  if (line.from == planner && line.to == carrier) return speed_or_angle(text);
  if (line.from == sensors && line.to == planner) return distances(text);
  if (line.from == points_of_interest && line.to == planner) return override_or_pose(text);
  if (line.from == command_centre && line.to == planner)
    if (auto const what = meaning_of(overrides, text)) return *what;
  if (line.from == points_of_interest)
    if (auto const point = point_of_interest(text)) return point;
  if (line.to == communication || line.to == command_centre)
    if (auto const entry = log_entry(text)) return entry;
  if (line.from == mapping || line.from == sensors) return pose(text);
  return std::nullopt;
}

}  // namespace

base::Result<std::string> write(Payload const& payload) {
  return std::visit([](auto const& what) { return text_of(what); }, payload);
}

base::Result<Payload> read_payload(Line const& line) {
  if (auto payload = said(line)) return *std::move(payload);
  return base::fail(
      base::ErrorKind::invalid_input,
      fmt::format("{} says nothing of that kind to {}", name_of(line.from).short_name, name_of(line.to).short_name),
      "docs/reference/robot-serial.md has what goes which way");
}

}  // namespace lapwing::robot::seed_text
