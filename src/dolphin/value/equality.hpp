#pragma once

#include <compare>
#include <cstddef>
#include <optional>
#include <span>

#include "dolphin/value/fault.hpp"
#include "dolphin/value/value.hpp"

namespace lapwing::dolphin {

/// Truth in conditions and guards: null, false, 0, NaN and empty texts, lists, maps, ranges and vehicle sets are false.
[[nodiscard]] bool is_true(Value const& value);

/// `a == b`. Numbers by value with a relative tolerance of 1e-12; vehicle sets by members; lists and maps by content.
[[nodiscard]] bool equal(Value const& a, Value const& b);

/// Where the first item equal to `wanted` is. Adds what it compared to `compared`, the count of one operation of the
/// script; a fault when that has become too much.
[[nodiscard]] Checked<std::optional<std::size_t>> find(std::span<Value const> items, Value const& wanted,
                                                       std::size_t& compared);

/// `a <=> b` for two numbers, texts, booleans or vehicles; other pairs are a fault. NaN is unordered.
[[nodiscard]] Checked<std::partial_ordering> compare(Value const& a, Value const& b);

}  // namespace lapwing::dolphin
