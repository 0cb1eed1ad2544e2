#pragma once

#include <optional>
#include <set>
#include <string_view>

#include "base/error.hpp"
#include "base/log.hpp"
#include "plan/plausibility/finding.hpp"

namespace lapwing::fleet {

/// Says what a look at a mission or a command has found, each rule once however often it is looked at.
class Doubts {
 public:
  /// Logs warnings, and with its reason what is allowed. Error: invalid_input with the first finding that refuses.
  /// `subject`: "copter 1: 'West'".
  [[nodiscard]] base::Result<> heed(plan::plausibility::Findings const& findings, std::string_view subject,
                                    base::Logger const& log);
  /// The rule of that finding, at the last look.
  [[nodiscard]] std::optional<plan::plausibility::Rule> refused_by() const { return refused_by_; }

 private:
  std::optional<plan::plausibility::Rule> refused_by_;
  std::set<plan::plausibility::Rule> said_;
};

}  // namespace lapwing::fleet
