#pragma once

#include <optional>
#include <string>

#include "base/text/diagnostic.hpp"

namespace lapwing::dolphin {

/// The script that `diagnostics` is about in the one layout that all scripts share; nothing when it does not parse
/// (the errors are then in `diagnostics`).
///
/// Only blanks, indentation, blank lines and line ends (LF) change. Tokens, comments and the author's line breaks stay,
/// and so do the blanks that decide how a line is read (`lon (-8.64)`), so that the formatted script is the same
/// program; formatting it again changes nothing. Linear in the size of the text.
[[nodiscard]] std::optional<std::string> format(base::Diagnostics& diagnostics);

}  // namespace lapwing::dolphin
