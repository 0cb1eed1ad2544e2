#include "tasks/mission_builder.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "tasks/internal/mission_commands.hpp"

namespace lapwing::tasks {

namespace internal {

double number(Argument const& argument) {
  if (auto const* const whole = std::get_if<std::int64_t>(&argument)) return static_cast<double>(*whole);
  return std::get<double>(argument);
}
int integer(Argument const& argument) {
  using Limits = std::numeric_limits<int>;
  auto const value = std::get<std::int64_t>(argument);
  return static_cast<int>(std::clamp<std::int64_t>(value, Limits::min(), Limits::max()));
}
std::string const& text(Argument const& argument) {
  return std::get<std::string>(argument);
}
geo::Wgs84 position(Argument const& argument) {
  return std::get<geo::Wgs84>(argument);
}

}  // namespace internal

namespace {

/// Shared by the sessions of one spec.
struct Workshop {
  std::vector<internal::Apply> apply;  ///< by place in the table of commands
  int built = 0;
};

class MissionSession final : public BuilderSession {
 public:
  explicit MissionSession(std::shared_ptr<Workshop> workshop) : workshop_(std::move(workshop)) {}

  base::Result<> add(std::size_t command, std::size_t overload, std::span<Argument const> arguments) override {
    return workshop_->apply.at(command)(builder_, overload, arguments);
  }
  base::Result<std::shared_ptr<PlatformTask const>> finish() override {
    auto mission = builder_.finish(fmt::format("MissionPlan_{}", ++workshop_->built));
    if (!mission) return std::unexpected(mission.error());
    return std::make_shared<MissionTask const>(*std::move(mission));
  }

 private:
  std::shared_ptr<Workshop> workshop_;
  plan::MissionBuilder builder_;
};

}  // namespace

BuilderSpec mission_builder() {
  auto commands = internal::movement_commands();
  std::ranges::move(internal::other_commands(), std::back_inserter(commands));
  auto const workshop = std::make_shared<Workshop>();
  BuilderSpec spec{.name = "mission",
                   .commands = {},
                   .doc = "A mission: commands that one vehicle carries out in order, by itself.",
                   .begin = [workshop] { return std::make_unique<MissionSession>(workshop); }};
  for (auto& command : commands) {
    workshop->apply.push_back(command.apply);
    spec.commands.push_back(std::move(command.spec));
  }
  return spec;
}

}  // namespace lapwing::tasks
