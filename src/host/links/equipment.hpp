#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "mavlink/wire/system_name.hpp"

namespace lapwing::host {

/// What vehicles carry, in the words that scripts use.
using Equipment = std::map<mavlink::SystemName, std::vector<std::string>>;

/// Adds what a text like "3=Sidescan,Multibeam" or "north/3=Sidescan" says. Errors: invalid_input.
[[nodiscard]] base::Result<> add_payload(std::string const& text, Equipment& equipment);

/// For --payload of every verb that has it.
inline constexpr auto payload_help =
    "What a vehicle carries, by the names that scripts use: 3=Sidescan,Multibeam, or north/3=Sidescan (may be "
    "repeated)";

}  // namespace lapwing::host
