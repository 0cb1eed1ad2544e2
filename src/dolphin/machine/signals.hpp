#pragma once

#include <map>
#include <string>
#include <vector>

#include "dolphin/value/fault.hpp"
#include "dolphin/value/value.hpp"

namespace lapwing::dolphin {

/// The signals of one program: for each name the set of the values that were posted and not yet consumed.
class Signals {
 public:
  using Wanted = std::vector<std::pair<std::string, Value>>;

  /// Posting a value that is there already changes nothing. Numbers are the same by value (REC-48).
  /// A fault when too many wait to be consumed.
  Checked<void> post(std::string const& name, Value const& value);
  /// Removes all pairs and returns true if every one is there; else changes nothing.
  bool consume(Wanted const& wanted);
  [[nodiscard]] bool contains(std::string const& name, Value const& value) const;
  /// In the order in which they were posted.
  [[nodiscard]] std::vector<Value> values(std::string const& name) const;

 private:
  std::map<std::string, std::vector<Value>> posted_;
  std::size_t count_ = 0;
};

}  // namespace lapwing::dolphin
