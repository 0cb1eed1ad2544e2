#include "sim/building/robot/fault.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lapwing::sim::building {

namespace {

enum class Which : std::uint8_t { none, sonar, wheel };

struct Row {
  std::string_view name;
  Fault::Kind kind;
  Which which;
  std::optional<double> usual_amount;
  double most_amount;
};

using enum Fault::Kind;
constexpr std::array rows = std::to_array<Row>({
    {"sonar-stuck", sonar_stuck, Which::sonar, std::nullopt, 0.0},
    {"sonar-silent", sonar_silent, Which::sonar, std::nullopt, 0.0},
    {"sonar-jumps", sonar_jumps, Which::sonar, std::nullopt, 0.0},
    {"laser-silent", laser_silent, Which::none, std::nullopt, 0.0},
    {"imu-silent", imu_silent, Which::none, std::nullopt, 0.0},
    {"wheel-slips", wheel_slips, Which::wheel, 0.5, 1.0},
    {"encoder-dead", encoder_dead, Which::wheel, std::nullopt, 0.0},
    {"unplugged", unplugged, Which::none, std::nullopt, 0.0},
    {"halted", halted, Which::none, std::nullopt, 0.0},
    {"battery-low", battery_low, Which::none, 0.1, 1.0},
    {"camera-dark", camera_dark, Which::none, 0.1, 1.0},
    {"camera-blurred", camera_blurred, Which::none, 3.0, 20.0},
    {"camera-silent", camera_silent, Which::none, std::nullopt, 0.0},
});

std::unexpected<base::Error> wrong(std::string_view text, std::string_view why, std::string hint) {
  return base::fail(base::ErrorKind::invalid_input, fmt::format("the fault {} {}", text, why), std::move(hint));
}

std::optional<int> which_of(std::string_view text, Which which) {
  if (which == Which::wheel && text == "left") return 0;
  if (which == Which::wheel && text == "right") return 1;
  constexpr int most = 8;
  int number = 0;
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  bool const is_number = error == std::errc() && end == text.data() + text.size() && number >= 0 && number < most;
  return which == Which::sonar && is_number ? std::optional(number) : std::nullopt;
}

}  // namespace

std::string_view to_string(Fault::Kind kind) {
  return std::ranges::find(rows, kind, &Row::kind)->name;
}

base::Result<Fault> parse_fault(std::string_view text) {
  auto const name = text.substr(0, text.find_first_of(":="));
  auto const row = std::ranges::find(rows, name, &Row::name);
  if (row == rows.end()) {
    std::vector<std::string_view> names;
    for (auto const& one : rows) names.push_back(one.name);
    return wrong(text, "is not known", fmt::format("known: {}", fmt::join(names, ", ")));
  }
  Fault fault{.kind = row->kind, .which = 0, .amount = row->usual_amount};
  auto rest = text.substr(name.size());
  if (rest.starts_with(':')) {
    auto const end = std::min(rest.find('='), rest.size());
    auto const which = which_of(rest.substr(1, end - 1), row->which);
    if (!which) return wrong(text, "names no part", "sonars have numbers from 0, wheels are left and right");
    fault.which = *which;
    rest = rest.substr(end);
  } else if (row->which != Which::none) {
    return wrong(text, "does not say which",
                 fmt::format("as in {}:{}", name, row->which == Which::wheel ? "left" : "2"));
  }
  if (rest.starts_with('=')) {
    double amount = 0.0;
    auto const [end, error] = std::from_chars(rest.data() + 1, rest.data() + rest.size(), amount);
    if (error != std::errc() || end != rest.data() + rest.size() || !(amount >= 0.0 && amount <= row->most_amount) ||
        !row->usual_amount)
      return wrong(text, "has an amount that cannot be",
                   row->usual_amount ? fmt::format("from 0 to {}", row->most_amount) : "it takes none");
    fault.amount = amount;
  }
  return fault;
}

}  // namespace lapwing::sim::building
