#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "dolphin/services/document.hpp"

namespace lapwing::dolphin {

/// The word at the offset, when it can be renamed: a variable, a function, a signal, or a mission's name. `refused`
/// says why not.
[[nodiscard]] base::Result<base::Span> renamable(Document const& document, std::uint32_t offset);

/// Every place that must read `new_name` from now on. Refused when the word is not the script's own, when the new name
/// is none, and when it would mean something else at one of the places, or other words would: the renamed script is
/// read again and compared, word by word.
[[nodiscard]] base::Result<std::vector<base::Span>> rename(Document const& document, std::uint32_t offset,
                                                           std::string_view new_name);

}  // namespace lapwing::dolphin
