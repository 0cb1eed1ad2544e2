#include "station/messages/request_reader.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace lapwing::station::internal {

RequestReader::RequestReader(std::string_view text) {
  // What reads and writes a value calls itself for each level of it: deeper than any request of ours is refused.
  constexpr int deepest = 8;
  bool too_deep = false;
  auto const check_depth = [&](int depth, Json::parse_event_t, Json&) {
    too_deep = too_deep || depth > deepest;
    return !too_deep;
  };
  auto json = Json::parse(text.begin(), text.end(), check_depth, false);
  if (!too_deep && json.is_object()) {
    object_ = std::move(json);
  } else {
    refuse("This is no JSON object.");
  }
}

RequestReader::Json const* RequestReader::find(char const* key) const {
  auto const found = object_.find(key);
  return found == object_.end() ? nullptr : &*found;
}

std::string RequestReader::text(char const* key, std::string fallback) {
  auto const* const found = find(key);
  if (found && found->is_string()) return found->get<std::string>();
  if (found) refuse(fmt::format("\"{}\" must be text.", key));
  return fallback;
}

std::optional<double> RequestReader::number(char const* key) {
  auto const* const found = find(key);
  if (!found) return std::nullopt;
  if (found->is_number() && std::isfinite(found->get<double>())) return found->get<double>();
  refuse(fmt::format("\"{}\" must be a number.", key));
  return std::nullopt;
}

bool RequestReader::flag(char const* key) {
  auto const* const found = find(key);
  if (found && !found->is_boolean()) refuse(fmt::format("\"{}\" must be true or false.", key));
  return found && found->is_boolean() && found->get<bool>();
}

std::string RequestReader::operator_name() {
  constexpr std::size_t longest = 40;
  auto name = text("operator");
  bool const is_plain = std::ranges::none_of(name, [](unsigned char c) { return c < 0x20; });
  if (name.size() > longest || !is_plain || name == "script")
    refuse("\"operator\" must be a short name, other than script.");
  return name;
}

std::vector<std::string> RequestReader::texts(char const* key, std::size_t most, std::size_t longest,
                                              char const* must) {
  std::vector<std::string> values;
  auto const* const found = list(key, most, must);
  if (!found) return values;
  for (auto const& value : *found) {
    if (!value.is_string() || value.get_ref<std::string const&>().size() > longest) return refuse(must), values;
    values.push_back(value.get<std::string>());
  }
  return values;
}

std::vector<std::uint64_t> RequestReader::naturals(char const* key, std::size_t most, char const* must) {
  std::vector<std::uint64_t> values;
  auto const* const found = list(key, most, must);
  if (!found) return values;
  for (auto const& value : *found) {
    if (!value.is_number_unsigned()) return refuse(must), values;
    values.push_back(value.get<std::uint64_t>());
  }
  return values;
}

void RequestReader::refuse(std::string message) {
  if (error_) return;
  error_ = base::Error{base::ErrorKind::invalid_input, std::move(message), "See docs/reference/station-messages.md."};
}

RequestReader::Json const* RequestReader::list(char const* key, std::size_t most, char const* must) {
  auto const* const found = find(key);
  if (found && found->is_array() && found->size() <= most) return found;
  refuse(must);
  return nullptr;
}

}  // namespace lapwing::station::internal
