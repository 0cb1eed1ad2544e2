#pragma once

#include <string>
#include <utility>
#include <vector>

#include "station/operator/script_control.hpp"

namespace lapwing::station::testing {

/// Remembers what it was asked; runs nothing.
class FakeScript : public ScriptControl {
 public:
  ScriptStatus status() const override { return current; }
  std::vector<tasks::TaskView> task_trees() const override { return trees; }
  std::expected<void, StartFailure> start(std::string name, std::string source) override {
    if (current.state == ScriptState::running) {
      return std::unexpected(StartFailure{{base::ErrorKind::refused, "A script runs already.", "Stop it first."}, {}});
    }
    if (source.empty()) {
      return std::unexpected(StartFailure{{base::ErrorKind::invalid_input, "The script does not check.", ""},
                                          {{name, {1, 1}, {1, 1}, "error", "nothing here", "", {}, ""}}});
    }
    current = {std::move(name), std::move(source), ScriptState::running, "", {}};
    return {};
  }
  void stop(std::string by) override {
    stopped_by = std::move(by);
    ++stops;
    if (current.state == ScriptState::running) current.state = ScriptState::stopping;
  }

  ScriptStatus current;
  std::vector<tasks::TaskView> trees;
  int stops = 0;
  std::string stopped_by;
};

}  // namespace lapwing::station::testing
