#pragma once

#include <string>
#include <utility>

#include "tasks/platform.hpp"

namespace lapwing::tasks {

/// A run that never began.
class FailedRun final : public TaskRun {
 public:
  explicit FailedRun(std::string error, bool vehicle_failed = false)
      : error_(std::move(error)), vehicle_failed_(vehicle_failed) {}
  [[nodiscard]] RunState state() const override { return RunState::failed; }
  [[nodiscard]] std::string error() const override { return error_; }
  [[nodiscard]] bool vehicle_failed() const override { return vehicle_failed_; }
  [[nodiscard]] std::string progress() const override { return {}; }
  void stop() override {}

 private:
  std::string error_;
  bool vehicle_failed_;
};

}  // namespace lapwing::tasks
