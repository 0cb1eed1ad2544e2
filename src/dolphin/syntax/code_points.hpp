#pragma once

#include <string>
#include <string_view>
#include <vector>

/// Texts are UTF-8 inside and sequences of Unicode code points to scripts: 'ä' has length 1.
namespace lapwing::dolphin {

[[nodiscard]] std::size_t count_code_points(std::string_view text);
/// Bytes of the first one, at least 1. Precondition: the text is not empty.
[[nodiscard]] std::size_t first_code_point_size(std::string_view text);
/// The pieces of `text`, one a code point. A byte that is no UTF-8 (it may come from `ask`) is a piece of its own.
[[nodiscard]] std::vector<std::string_view> code_points(std::string_view text);

[[nodiscard]] std::string in_capitals(std::string_view text);
[[nodiscard]] std::string in_small_letters(std::string_view text);

}  // namespace lapwing::dolphin
