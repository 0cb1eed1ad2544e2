#include "dolphin/machine/signals.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "dolphin/syntax/limits.hpp"
#include "dolphin/value/equality.hpp"

namespace lapwing::dolphin {

Checked<void> Signals::post(std::string const& name, Value const& value) {
  if (contains(name, value)) return {};
  if (count_ >= max_signals) {
    return fault(fmt::format("more than {} signals wait to be consumed", max_signals), "OutOfMemoryError");
  }
  posted_[name].push_back(value);
  ++count_;
  return {};
}

bool Signals::contains(std::string const& name, Value const& value) const {
  auto const found = posted_.find(name);
  return found != posted_.end() &&
         std::ranges::any_of(found->second, [&](Value const& held) { return equal(held, value); });
}

bool Signals::consume(Wanted const& wanted) {
  if (!std::ranges::all_of(wanted, [&](auto const& pair) { return contains(pair.first, pair.second); })) return false;
  for (auto const& [name, value] : wanted) {
    auto& held = posted_[name];
    count_ -= std::erase_if(held, [&](Value const& one) { return equal(one, value); });
    if (held.empty()) posted_.erase(name);
  }
  return true;
}

std::vector<Value> Signals::values(std::string const& name) const {
  auto const found = posted_.find(name);
  return found == posted_.end() ? std::vector<Value>() : found->second;
}

}  // namespace lapwing::dolphin
