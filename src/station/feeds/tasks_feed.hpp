#pragma once

#include <string>

#include "station/feeds/whole_text_feed.hpp"
#include "station/operator/script_control.hpp"

namespace lapwing::station {

/// The task trees of the script, as `tasks` messages, whole each time.
class TasksFeed final : public WholeTextFeed {
 public:
  explicit TasksFeed(ScriptControl const& script) : script_(script) {}

  [[nodiscard]] std::string_view name() const override { return "tasks"; }

 private:
  [[nodiscard]] std::string text() const override;

  ScriptControl const& script_;
};

}  // namespace lapwing::station
