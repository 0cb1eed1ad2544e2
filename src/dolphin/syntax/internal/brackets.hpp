#pragma once

#include <vector>

#include "base/text/diagnostic.hpp"
#include "dolphin/syntax/token.hpp"

namespace lapwing::dolphin {

/// Gives every bracket its partner. Reports brackets that are never closed (they keep no partner) and closing ones that
/// close nothing (they are taken out). Knowing this before parsing keeps one forgotten bracket from spoiling the rest
/// of a script.
void match_brackets(std::vector<Token>& tokens, base::Diagnostics& diagnostics);

}  // namespace lapwing::dolphin
