#pragma once

#include <cstddef>
#include <string>

#include "base/time.hpp"

namespace lapwing::host {

/// How far a long job has come, on standard error: one line that changes on a terminal, else a line now and then.
class Progress {
 public:
  /// `what` as in "vehicle 1: 512 of 1350 `what`".
  Progress(std::string who, std::string what);
  Progress(Progress const&) = delete;
  Progress& operator=(Progress const&) = delete;
  /// Leaves no half line behind.
  ~Progress();

  void show(std::size_t done, std::size_t total, base::TimePoint now);

 private:
  std::string who_;
  std::string what_;
  bool is_terminal_;
  bool has_line_ = false;
  bool has_begun_ = false;
  base::TimePoint next_{};
};

}  // namespace lapwing::host
