#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "lsp/positions.hpp"

/// Reading of messages that may hold anything: what is missing or of another type is null, 0 or empty.
namespace lapwing::lsp {

using Json = nlohmann::json;

[[nodiscard]] Json const& member(Json const& object, char const* name);
[[nodiscard]] std::string text(Json const& value);
[[nodiscard]] std::uint32_t natural(Json const& value);
[[nodiscard]] std::optional<Position> position(Json const& value);

}  // namespace lapwing::lsp
