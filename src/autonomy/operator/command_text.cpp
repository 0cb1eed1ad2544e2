#include "autonomy/operator/command_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/text/printable.hpp"
#include "base/text/spelling.hpp"

namespace lapwing::autonomy {

namespace {

using Json = nlohmann::json;

std::unexpected<base::Error> wrong(std::string message, std::string hint = {}) {
  return base::fail(base::ErrorKind::invalid_input, std::move(message), std::move(hint));
}

struct Range {
  double least;
  double most;
};
constexpr Range metres{-furthest_number_m, furthest_number_m};

/// Reads the numbers of one object and remembers the first mistake.
class Numbers {
 public:
  Numbers(Json const& object, std::string_view type) : object_(object), type_(type) {}

  /// Nothing when it is not there, or wrong, which is remembered.
  std::optional<double> optional(std::string_view key, Range range) {
    auto const found = object_.find(key);
    if (found == object_.end()) return std::nullopt;
    if (!found->is_number()) {
      note(fmt::format("{}: {} is no number", type_, key));
      return std::nullopt;
    }
    auto const value = found->get<double>();
    if (value >= range.least && value <= range.most) return value;
    note(fmt::format("{}: {} is {}, and not from {} to {}", type_, key, value, range.least, range.most));
    return std::nullopt;
  }

  double required(std::string_view key, Range range) {
    auto const value = optional(key, range);
    if (!value) note(fmt::format("{} has no {}", type_, key));
    return value.value_or(0.0);
  }

  /// By one of two spellings.
  double either(std::string_view key, std::string_view other, Range range) {
    auto const first = optional(key, range);
    auto const second = optional(other, range);
    if (first && second && *first != *second) note(fmt::format("{} has {} and {}, which differ", type_, key, other));
    if (!first && !second) note(fmt::format("{} has neither {} nor {}", type_, key, other));
    return first ? *first : second.value_or(0.0);
  }

  [[nodiscard]] bool has(std::string_view key) const { return object_.contains(key); }
  [[nodiscard]] base::Result<Command> result(Command command) const {
    if (mistake_.empty()) return command;
    return wrong(mistake_);
  }

 private:
  void note(std::string mistake) {
    if (mistake_.empty()) mistake_ = std::move(mistake);
  }

  Json const& object_;
  std::string_view type_;
  std::string mistake_;
};

/// `w` of the original's orientation, a quaternion about the upright axis: the cosine of half the yaw, with a sine that
/// is not negative.
std::optional<double> yaw(Numbers& numbers) {
  auto const w = numbers.optional("w", {-1.0, 1.0});
  if (!w) return std::nullopt;
  return 2.0 * std::acos(*w);
}

base::Result<Command> configure(Numbers numbers) {
  command::Configure command;
  command.heights.min_m = numbers.either("Min", "MinHoverHeight", metres);
  command.heights.desired_m = numbers.either("Des", "DesiredHoverHeight", metres);
  command.heights.max_m = numbers.either("Max", "MaxHoverHeight", metres);
  return numbers.result(command);
}

geo::Point<ArmingFrame> local_place(Numbers& numbers) {
  double const x_m = numbers.required("X", metres);
  return {x_m, numbers.required("Y", metres)};
}

base::Result<Command> autonomous_move(Numbers numbers) {
  command::AutonomousMove command;
  command.place = local_place(numbers);
  command.yaw_rad = yaw(numbers);
  return numbers.result(command);
}

base::Result<Command> compulsive_move(Numbers numbers) {
  command::CompulsiveMove command;
  bool const is_global = numbers.has("Lat") || numbers.has("Long");
  if (is_global && (numbers.has("X") || numbers.has("Y")))
    return wrong("Compulsive Move has X, Y and Lat, Long", "give one of the two");
  if (is_global) {
    double const lat_deg = numbers.required("Lat", {-90.0, 90.0});
    command.place = geo::Wgs84::from_degrees(lat_deg, numbers.required("Long", {-180.0, 180.0}));
  } else {
    command.place = local_place(numbers);
  }
  command.yaw_rad = yaw(numbers);
  return numbers.result(command);
}

template <class T>
base::Result<Command> plain(Numbers /*no numbers*/) {
  return Command(T{});
}

/// In the order of the alternatives.
constexpr std::array<base::Result<Command> (*)(Numbers), command_count> readers{plain<command::Kill>,
                                                                                configure,
                                                                                plain<command::Arm>,
                                                                                plain<command::Disarm>,
                                                                                plain<command::Takeoff>,
                                                                                plain<command::Land>,
                                                                                plain<command::AutonomousExplore>,
                                                                                autonomous_move,
                                                                                compulsive_move};

std::string without_blanks(std::string_view name) {
  std::string plain_name(name);
  std::erase(plain_name, ' ');
  return plain_name;
}

std::optional<std::size_t> type_index(std::string_view name) {
  for (std::size_t i = 0; i < command_count; ++i)
    if (name == command_name(i) || name == without_blanks(command_name(i))) return i;
  return std::nullopt;
}

std::unexpected<base::Error> unknown_type(std::string const& type) {
  std::array<std::string_view, command_count> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = command_name(i);
  std::size_t constexpr enough = 40;
  return wrong(fmt::format("there is no command '{}'", base::printable(type.substr(0, enough))),
               base::did_you_mean(type.substr(0, enough), names));
}

}  // namespace

base::Result<Command> parse_command(std::string_view text) {
  if (text.size() > longest_command)
    return wrong(fmt::format("a command has at most {} bytes, and this one {}", longest_command, text.size()));
  auto const object = Json::parse(text, nullptr, false);
  if (object.is_discarded()) return wrong("a command is no JSON", R"(send {"Type":"Arm"}, for example)");
  if (!object.is_object()) return wrong("a command is no JSON object", R"(send {"Type":"Arm"}, for example)");
  auto const type = object.find("Type");
  if (type == object.end() || !type->is_string())
    return wrong("a command has no Type that is a text", R"(send {"Type":"Arm"}, for example)");
  auto const& name = type->get_ref<std::string const&>();
  auto const index = type_index(name);
  if (!index) return unknown_type(name);
  return readers[*index](Numbers(object, command_name(*index)));
}

}  // namespace lapwing::autonomy
