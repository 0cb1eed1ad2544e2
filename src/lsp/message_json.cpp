#include "lsp/message_json.hpp"

#include <algorithm>
#include <limits>

namespace lapwing::lsp {

Json const& member(Json const& object, char const* name) {
  static Json const nothing;
  if (!object.is_object()) return nothing;
  auto const found = object.find(name);
  return found == object.end() ? nothing : *found;
}

std::string text(Json const& value) {
  return value.is_string() ? value.get<std::string>() : std::string();
}

std::uint32_t natural(Json const& value) {
  if (!value.is_number_unsigned()) return 0;
  return static_cast<std::uint32_t>(
      std::min<std::uint64_t>(value.get<std::uint64_t>(), std::numeric_limits<std::uint32_t>::max()));
}

std::optional<Position> position(Json const& value) {
  auto const& line = member(value, "line");
  auto const& character = member(value, "character");
  if (!line.is_number_unsigned() || !character.is_number_unsigned()) return std::nullopt;
  return Position{natural(line), natural(character)};
}

}  // namespace lapwing::lsp
