#pragma once

#include <string>

#include "station/feeds/whole_text_feed.hpp"
#include "station/operator/script_control.hpp"

namespace lapwing::station {

/// The station's one script, as `script` messages, whole each time.
class ScriptFeed final : public WholeTextFeed {
 public:
  explicit ScriptFeed(ScriptControl const& script) : script_(script) {}

  [[nodiscard]] std::string_view name() const override { return "script"; }

 private:
  [[nodiscard]] std::string text() const override;

  ScriptControl const& script_;
};

}  // namespace lapwing::station
