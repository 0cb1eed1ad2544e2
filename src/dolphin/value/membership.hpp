#pragma once

#include <optional>
#include <span>
#include <unordered_set>
#include <vector>

#include "dolphin/value/fault.hpp"
#include "dolphin/value/objects.hpp"

namespace lapwing::dolphin::internal {

/// Which values are in a list, for many questions of one operation: `list - list`, `unique`, `intersect`. Texts, whole
/// numbers and the like are looked up; all others are compared one by one, until that has become too much.
class Membership {
 public:
  Membership() = default;
  explicit Membership(std::span<Value const> items) {
    for (auto const& item : items) add(item);
  }

  void add(Value const& item);
  /// False from the first question on that took too much.
  [[nodiscard]] bool holds(Value const& wanted);
  [[nodiscard]] bool gave_up() const { return error_.has_value(); }
  /// What the operation gives, or the fault that it took too much.
  [[nodiscard]] Checked<Value> result(Value value) const {
    if (error_) return std::unexpected(*error_);
    return value;
  }

 private:
  std::unordered_set<Value, KeyHash, KeyEqual> plain_;
  std::vector<Value> others_;
  std::vector<Value> all_;
  std::size_t compared_ = 0;
  std::optional<Fault> error_;
};

}  // namespace lapwing::dolphin::internal
