#pragma once

#include <functional>
#include <optional>

#include "base/async/scope.hpp"
#include "base/descriptor.hpp"

namespace lapwing::onboard {

/// The variable by which a supervised process learns the number of its end of the line.
inline constexpr auto life_variable = "LAPWING_LIFE_FD";
inline constexpr base::Duration life_period = std::chrono::milliseconds(500);

/// By which a process says that it lives: a byte now and then, from the loop that does its work, so that a process that
/// hangs says nothing. It learns as well when its supervisor has gone.
class LifeLine {
 public:
  /// As the supervisor has left it in the environment, from which it is removed; nothing for a process that was started
  /// by hand.
  [[nodiscard]] static std::optional<base::Descriptor> from_environment();

  /// `orphaned` is called once, when nobody is at the other end any more.
  LifeLine(base::Loop& loop, base::Descriptor end, std::function<void()> orphaned);
  LifeLine(LifeLine const&) = delete;
  LifeLine& operator=(LifeLine const&) = delete;

 private:
  base::Task<> live();

  base::Loop& loop_;
  base::Descriptor end_;
  std::function<void()> orphaned_;
  base::Scope scope_;
};

}  // namespace lapwing::onboard
