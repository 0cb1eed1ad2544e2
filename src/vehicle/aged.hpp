#pragma once

#include <optional>
#include <utility>

#include "base/time.hpp"

namespace lapwing::vehicle {

/// A value with the time at which it was heard; never heard is a state of its own, not zero.
template <class T>
struct Aged {
  std::optional<T> value;
  base::TimePoint heard{};

  void set(T now_known, base::TimePoint now) {
    value = std::move(now_known);
    heard = now;
  }
  [[nodiscard]] bool known() const { return value.has_value(); }
  [[nodiscard]] std::optional<base::Duration> age(base::TimePoint now) const {
    if (!value) return std::nullopt;
    return now - heard;
  }
};

}  // namespace lapwing::vehicle
