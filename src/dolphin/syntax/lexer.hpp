#pragma once

#include <vector>

#include "base/text/diagnostic.hpp"
#include "dolphin/syntax/limits.hpp"
#include "dolphin/syntax/token.hpp"

namespace lapwing::dolphin {

struct TokenStream {
  std::vector<Token> tokens;         ///< the last one is end_of_file
  std::vector<base::Span> comments;  ///< in order; the line end after // is not part of it
};

/// Splits the script that `diagnostics` is about into tokens (language specification 1.2). Mistakes are reported and
/// skipped, so the tokens always make sense to a parser: strings and interpolations are closed (with an empty token
/// where the text does not), and brackets match or have no partner: a closing bracket without an opening one is left
/// out. Linear in the size of the text.
[[nodiscard]] TokenStream lex(base::Diagnostics& diagnostics);

}  // namespace lapwing::dolphin
