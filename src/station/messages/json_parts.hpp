#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "base/time.hpp"
#include "station/messages/json.hpp"

/// What reading requests and writing messages share. For .cpp files.
namespace lapwing::station::internal {

/// ISO 8601 in UTC with milliseconds.
[[nodiscard]] std::string to_text(base::UtcTime time);

/// A mistake in a request; names the page that describes them.
[[nodiscard]] std::unexpected<base::Error> wrong(std::string message);
/// An object that is not nested deeper than any request of ours.
[[nodiscard]] base::Result<Json> parse_object(std::string_view text);
/// A member that is text, or `fallback` when it is absent; an error when it is something else.
[[nodiscard]] base::Result<std::string> text_member(Json const& object, char const* key, std::string fallback);
/// Who asks, by a name that cannot be taken for the script and fits a line; empty when the client does not say.
[[nodiscard]] base::Result<std::string> operator_member(Json const& object);
/// A member that is a finite number, or nothing when it is absent.
[[nodiscard]] base::Result<std::optional<double>> number_member(Json const& object, char const* key);

}  // namespace lapwing::station::internal
