#include "dolphin/signals.hpp"

#include <algorithm>

#include "dolphin/equality.hpp"

namespace lapwing::dolphin {

void Signals::post(std::string const& name, Value const& value) {
  if (!contains(name, value)) posted_[name].push_back(value);
}

bool Signals::contains(std::string const& name, Value const& value) const {
  auto const found = posted_.find(name);
  return found != posted_.end() &&
         std::ranges::any_of(found->second, [&](Value const& held) { return equal(held, value); });
}

bool Signals::consume(Wanted const& wanted) {
  if (!std::ranges::all_of(wanted, [&](auto const& pair) { return contains(pair.first, pair.second); })) return false;
  for (auto const& [name, value] : wanted) {
    std::erase_if(posted_[name], [&](Value const& held) { return equal(held, value); });
  }
  return true;
}

std::vector<Value> Signals::values(std::string const& name) const {
  auto const found = posted_.find(name);
  return found == posted_.end() ? std::vector<Value>() : found->second;
}

}  // namespace lapwing::dolphin
