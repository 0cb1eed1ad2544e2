#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace lapwing::apps {

/// What vehicles carry, by system id, in the words that scripts use.
using Equipment = std::map<int, std::vector<std::string>>;

/// Adds what a text like "3=Sidescan,Multibeam" says. Errors: invalid_input.
[[nodiscard]] base::Result<> add_payload(std::string const& text, Equipment& equipment);

/// For --payload of every verb that has it.
inline constexpr auto payload_help =
    "What the vehicle of a system id carries, by the names that scripts use: 3=Sidescan,Multibeam (may be repeated)";

}  // namespace lapwing::apps
