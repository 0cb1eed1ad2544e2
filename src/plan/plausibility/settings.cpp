#include "plan/plausibility/settings.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text/spelling.hpp"

namespace lapwing::plan::plausibility {

using base::ErrorKind;
using base::fail;
using base::Result;

namespace {

constexpr std::array<LimitName, 10> limits_by_name{{
    {"gps_error", "metres; less than this is no move of home", 0.0, 100.0},
    {"home_moved", "metres from where the vehicle stands to the mission's home", 0.0, 1e6},
    {"distance", "metres from the vehicle to a mission's places, and from place to place", 1.0, 2e7},
    {"go_to", "metres to where an operator sends a vehicle", 1.0, 2e7},
    {"home_height", "metres between the altitude of the mission's home and of the ground", 0.0, 9000.0},
    {"low_take_off", "metres above the ground; a lower take-off is remarked", 0.0, 1000.0},
    {"ceiling", "metres above home", 1.0, 80'000.0},
    {"highest", "metres above home; a mission with a higher place is refused", 1.0, 80'000.0},
    {"pad", "metres between two vehicles that stand", 0.0, 1000.0},
    {"endurance", "seconds that a battery lasts", 1.0, 1e7},
}};

void assign(Limits& limits, std::string_view name, double value) {
  if (name == "gps_error") limits.gps_error_m = value;
  if (name == "home_moved") limits.home_moved_m = value;
  if (name == "distance") limits.distance_m = value;
  if (name == "go_to") limits.go_to_m = value;
  if (name == "home_height") limits.home_height_m = value;
  if (name == "low_take_off") limits.low_take_off_m = value;
  if (name == "ceiling") limits.ceiling_m = value;
  if (name == "highest") limits.highest_m = value;
  if (name == "pad") limits.pad_m = value;
  if (name == "endurance") limits.endurance_s = value;
}

std::unexpected<base::Error> unknown(std::string_view what, std::string_view name,
                                     std::span<std::string_view const> known) {
  auto hint = base::did_you_mean(name, known);
  if (hint.empty()) hint = fmt::format("there are {}", fmt::join(known, ", "));
  return fail(ErrorKind::invalid_input, fmt::format("there is no {} '{}'", what, name), std::move(hint));
}

/// What stands before and behind the first "=".
std::pair<std::string_view, std::string_view> halves(std::string_view text) {
  auto const at = text.find('=');
  if (at == std::string_view::npos) return {text, {}};
  return {text.substr(0, at), text.substr(at + 1)};
}

}  // namespace

Settings Settings::with(std::map<Rule, std::string> const& more) const {
  auto both = *this;
  for (auto const& [rule, reason] : more) both.allowed.insert_or_assign(rule, reason);
  return both;
}

std::span<LimitName const> limit_names() {
  return limits_by_name;
}

Result<std::pair<Rule, std::string>> allowance(std::string_view rule, std::string_view reason) {
  auto const known = rule_from(rule);
  if (!known) return unknown("rule of plausibility", rule, rule_names());
  if (reason.find_first_not_of(" \t") == std::string_view::npos)
    return fail(ErrorKind::invalid_input, fmt::format("{} is allowed without a reason", rule),
                fmt::format("say why: {}=REASON; it is written into the log", rule));
  return std::pair(*known, std::string(reason));
}

Result<> set_limit(Limits& limits, std::string_view name, double value) {
  auto const known = std::ranges::find(limits_by_name, name, &LimitName::name);
  if (known == limits_by_name.end()) {
    std::vector<std::string_view> names;
    for (auto const& limit : limits_by_name) names.push_back(limit.name);
    return unknown("limit", name, names);
  }
  if (!(value >= known->least && value <= known->most))
    return fail(ErrorKind::invalid_input, fmt::format("the limit {} cannot be {}", name, value),
                fmt::format("{}: {} to {}", known->doc, known->least, known->most));
  assign(limits, name, value);
  return {};
}

Result<> add_allowance(Settings& settings, std::string_view text) {
  auto const [rule, reason] = halves(text);
  auto allowed = allowance(rule, reason);
  if (!allowed) return std::unexpected(allowed.error());
  settings.allowed.insert_or_assign(allowed->first, std::move(allowed->second));
  return {};
}

Result<> add_limit(Settings& settings, std::string_view text) {
  auto const [name, number] = halves(text);
  double value = 0.0;
  auto const [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error != std::errc() || end != number.data() + number.size())
    return fail(ErrorKind::invalid_input, fmt::format("'{}' sets no limit", text),
                "write NAME=NUMBER, for example ceiling=150");
  return set_limit(settings.limits, name, value);
}

Findings marked(Findings findings, Settings const& settings) {
  for (auto& finding : findings) {
    auto const found = settings.allowed.find(finding.rule);
    if (found != settings.allowed.end()) finding.allowed_because = found->second;
  }
  return findings;
}

}  // namespace lapwing::plan::plausibility
