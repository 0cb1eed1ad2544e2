#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lapwing::base {

/// How many characters must be put in, taken out, replaced or swapped with their neighbour to make `b` of `a`
/// (Damerau-Levenshtein in its restricted form); more than `limit` counts as limit + 1. Bytes, not characters. Letters
/// that differ in case only count nothing unless nothing else differs: "takeoff" is 1 from "takeOff".
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t limit);

/// The candidate that `word` was most likely meant to be: within a third of its length. Of equally near ones the first
/// in the alphabet. Looks at 10,000 candidates at most.
[[nodiscard]] std::optional<std::string> closest(std::string_view word, std::span<std::string_view const> candidates);

/// "did you mean takeOff?", or nothing.
[[nodiscard]] std::string did_you_mean(std::string_view word, std::span<std::string_view const> candidates);

}  // namespace lapwing::base
