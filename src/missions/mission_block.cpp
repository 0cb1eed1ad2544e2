#include "missions/mission_block.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "missions/internal/mission_commands.hpp"
#include "plan/plausibility/judge.hpp"

namespace lapwing::missions {

namespace internal {

double number(tasks::Argument const& argument) {
  if (auto const* const whole = std::get_if<std::int64_t>(&argument)) return static_cast<double>(*whole);
  return std::get<double>(argument);
}
int integer(tasks::Argument const& argument) {
  using Limits = std::numeric_limits<int>;
  auto const value = std::get<std::int64_t>(argument);
  return static_cast<int>(std::clamp<std::int64_t>(value, Limits::min(), Limits::max()));
}
std::string const& text(tasks::Argument const& argument) {
  return std::get<std::string>(argument);
}
geo::Wgs84 position(tasks::Argument const& argument) {
  return std::get<geo::Wgs84>(argument);
}

}  // namespace internal

namespace {

/// Shared by the sessions of one spec.
struct Workshop {
  std::vector<internal::Apply> apply;  ///< by place in the table of commands
  plan::plausibility::Settings settings;
  int built = 0;
};

class MissionSession final : public tasks::BuilderSession {
 public:
  explicit MissionSession(std::shared_ptr<Workshop> workshop) : workshop_(std::move(workshop)) {}

  base::Result<> add(std::size_t command, std::size_t overload, std::span<tasks::Argument const> arguments) override {
    auto added = workshop_->apply.at(command)(builder_, overload, arguments);
    call_of_item_.resize(builder_.mission().items.size(), calls_);
    if (builder_.mission().home && !home_call_) home_call_ = calls_;
    ++calls_;
    return added;
  }
  base::Result<std::shared_ptr<tasks::PlatformTask const>> finish() override {
    auto mission = builder_.finish(fmt::format("MissionPlan_{}", ++workshop_->built));
    if (!mission) return std::unexpected(mission.error());
    return std::make_shared<MissionTask const>(*std::move(mission), workshop_->settings);
  }
  [[nodiscard]] std::vector<tasks::Doubt> doubts() const override {
    std::vector<tasks::Doubt> doubts;
    for (auto const& finding : judge_alone(builder_.mission(), workshop_->settings)) {
      if (finding.allowed_because) continue;
      auto const call = finding.item ? std::optional(call_of_item_.at(*finding.item)) : home_call_;
      doubts.push_back(
          {.call = call, .what = fmt::format("{} [{}]", finding.what, to_string(finding.rule)), .hint = finding.meant});
    }
    return doubts;
  }

 private:
  std::shared_ptr<Workshop> workshop_;
  plan::MissionBuilder builder_;
  std::vector<std::size_t> call_of_item_;  ///< which `add` made it
  std::optional<std::size_t> home_call_;
  std::size_t calls_ = 0;
};

}  // namespace

tasks::BuilderSpec mission_block(plan::plausibility::Settings settings) {
  auto commands = internal::movement_commands();
  std::ranges::move(internal::other_commands(), std::back_inserter(commands));
  auto const workshop = std::make_shared<Workshop>();
  workshop->settings = std::move(settings);
  tasks::BuilderSpec spec{.name = "mission",
                          .commands = {},
                          .doc = "A mission: commands that one vehicle carries out in order, by itself.",
                          .begin = [workshop] { return std::make_unique<MissionSession>(workshop); }};
  for (auto& command : commands) {
    workshop->apply.push_back(command.apply);
    spec.commands.push_back(std::move(command.spec));
  }
  return spec;
}

}  // namespace lapwing::missions
