#pragma once

#include <optional>
#include <span>

#include "mavlink/path/link_report.hpp"

namespace lapwing::mavlink::internal {

struct Candidate {
  PeerRef peer;
  double cost_s = 0.0;
};

/// The path in use among those that lead to one vehicle, without flapping: another takes its place at once when it is
/// no candidate any more, and otherwise only after having been better by two fifths for 3 s.
class PathSelector {
 public:
  /// Call twice a second with the paths that are alive.
  void consider(std::span<Candidate const> candidates, base::TimePoint now);
  [[nodiscard]] std::optional<PeerRef> current() const { return current_; }

 private:
  std::optional<PeerRef> current_;
  std::optional<PeerRef> challenger_;
  base::TimePoint challenged_{};
};

}  // namespace lapwing::mavlink::internal
