#pragma once

#include <string>

#include "station/feeds/feed.hpp"
#include "station/operator/script_control.hpp"

namespace lapwing::station {

/// The task trees of the script, as `tasks` messages, whole each time.
class TasksFeed final : public Feed {
 public:
  explicit TasksFeed(ScriptControl const& script) : script_(script) {}

  [[nodiscard]] std::string_view name() const override { return "tasks"; }
  [[nodiscard]] std::uint64_t refresh(base::TimePoint now) override;
  [[nodiscard]] News since(std::uint64_t revision, base::TimePoint now, std::size_t room) const override;

 private:
  ScriptControl const& script_;
  std::string message_;
  std::uint64_t revision_ = 0;
};

}  // namespace lapwing::station
