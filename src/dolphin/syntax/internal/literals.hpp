#pragma once

#include <string>

#include "base/text/diagnostic.hpp"
#include "dolphin/syntax/ast.hpp"

namespace lapwing::dolphin {

/// The text that the characters in `span` (quotes not included) stand for: escapes replaced, line ends as \n.
[[nodiscard]] std::string decode_string(base::Span span, base::Diagnostics& diagnostics);
/// The value of a number token; a number that does not fit is reported.
[[nodiscard]] ast::Expr::Node decode_number(base::Span span, bool is_decimal, base::Diagnostics& diagnostics);

}  // namespace lapwing::dolphin
