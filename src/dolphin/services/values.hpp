#pragma once

#include <cstddef>

#include "dolphin/services/document.hpp"

namespace lapwing::dolphin {

/// What is known of the value that ends before token `point`: what stands before the `.` of `10.` and `v1.`, also when
/// the line does not parse yet.
[[nodiscard]] Facts facts_of_value_before(Document const& document, std::size_t point);

}  // namespace lapwing::dolphin
