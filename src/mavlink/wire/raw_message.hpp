#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "base/error.hpp"
#include "mavlink/wire/frame.hpp"

namespace lapwing::mavlink {

/// A value as a person writes it: a number in the dialect's own units (degE7, centimetres, ...), or a text, which is
/// the content of a text field and elsewhere the name of an enumeration's entry.
using RawValue = std::variant<std::int64_t, double, std::string>;

struct RawField {
  std::string name;
  RawValue value;
};

/// The message `name` ("COMMAND_LONG") of the dialect with these fields, the others zero, addressed to `target` if it
/// has an addressee (`target_component` may be given another value; `target_system` may not). Errors: not_found for a
/// name that there is not, with what may have been meant; invalid_input for a value that its field cannot hold.
[[nodiscard]] base::Result<Frame> raw_message(std::string_view name, std::span<RawField const> fields, Address self,
                                              Address target);

}  // namespace lapwing::mavlink
