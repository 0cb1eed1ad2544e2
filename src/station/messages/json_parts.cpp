#include "station/messages/json_parts.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/chrono.h>
#include <fmt/format.h>

namespace lapwing::station::internal {

std::string to_text(base::UtcTime time) {
  auto const since_epoch = std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch());
  auto const seconds = std::chrono::floor<std::chrono::seconds>(since_epoch);
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(static_cast<std::time_t>(seconds.count())),
                     (since_epoch - seconds).count());
}

std::unexpected<base::Error> wrong(std::string message) {
  return base::fail(base::ErrorKind::invalid_input, std::move(message), "See docs/reference/station-messages.md.");
}

// Nesting is bounded by the parser's own stack use only, so refuse what no message of ours needs.
base::Result<Json> parse_object(std::string_view text) {
  constexpr int deepest = 8;
  bool too_deep = false;
  auto const check_depth = [&](int depth, Json::parse_event_t, Json&) {
    too_deep = too_deep || depth > deepest;
    return !too_deep;
  };
  auto json = Json::parse(text.begin(), text.end(), check_depth, false);
  if (too_deep || json.is_discarded() || !json.is_object()) return wrong("This is no JSON object.");
  return json;
}

base::Result<std::string> text_member(Json const& object, char const* key, std::string fallback) {
  auto const found = object.find(key);
  if (found == object.end()) return fallback;
  if (!found->is_string()) return wrong(fmt::format("\"{}\" must be text.", key));
  return found->get<std::string>();
}

base::Result<std::string> operator_member(Json const& object) {
  constexpr std::size_t longest = 40;
  auto name = text_member(object, "operator", "");
  if (!name) return name;
  bool const is_plain = std::ranges::none_of(*name, [](unsigned char c) { return c < 0x20; });
  if (name->size() > longest || !is_plain || *name == "script")
    return wrong("\"operator\" must be a short name, other than script.");
  return name;
}

base::Result<std::optional<double>> number_member(Json const& object, char const* key) {
  auto const found = object.find(key);
  if (found == object.end()) return std::nullopt;
  if (!found->is_number() || !std::isfinite(found->get<double>()))
    return wrong(fmt::format("\"{}\" must be a number.", key));
  return found->get<double>();
}

}  // namespace lapwing::station::internal
