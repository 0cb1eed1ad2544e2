#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tasks/platform.hpp"

namespace lapwing::autonomy {

/// The steps of a `lot` block, as scripts give them. A drone on the ground arms and takes off before each of them but
/// the last kind.
struct ExploreStep {
  friend bool operator==(ExploreStep const&, ExploreStep const&) = default;
};
struct MoveStep {
  geo::Wgs84 place;          ///< its altitude does not count
  bool is_anywhere = false;  ///< also where the map says that it is not in the lot
  friend bool operator==(MoveStep const&, MoveStep const&) = default;
};
struct WaitStep {
  double seconds = 0.0;
  friend bool operator==(WaitStep const&, WaitStep const&) = default;
};
struct ComeHomeStep {
  friend bool operator==(ComeHomeStep const&, ComeHomeStep const&) = default;
};
using Step = std::variant<ExploreStep, MoveStep, WaitStep, ComeHomeStep>;

/// "explore", "move to 43.258500, -79.920100".
[[nodiscard]] std::string to_text(Step const& step);

/// What `lot { ... }` builds: for one survey drone, step by step.
class LotTask final : public tasks::PlatformTask {
 public:
  LotTask(std::string name, std::vector<Step> steps) : name_(std::move(name)), steps_(std::move(steps)) {}
  [[nodiscard]] std::vector<Step> const& steps() const { return steps_; }

  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] std::string kind() const override { return "lot"; }
  [[nodiscard]] std::size_t bytes() const override { return 256 + steps_.size() * sizeof(Step); }
  /// What does not fly.
  [[nodiscard]] std::optional<std::string> unsuited(tasks::VehicleInfo const& vehicle) const override;
  /// The first place that it flies to; nothing where it begins with the drone's own car park.
  [[nodiscard]] std::optional<geo::Wgs84> reference_position() const override;

 private:
  std::string name_;
  std::vector<Step> steps_;
};

}  // namespace lapwing::autonomy
