#include "robot/words/vocabulary.hpp"

#include <utility>

#include <fmt/format.h>

#include "robot/words/drive_task.hpp"

namespace lapwing::robot {

namespace {

using tasks::Argument;
using tasks::Dimension;
using tasks::Type;
using Arguments = std::span<Argument const>;

/// A block while it is read.
struct Draft {
  std::string name;
  std::vector<Step> steps;
};

using Apply = base::Result<> (*)(Draft& draft, std::size_t overload, Arguments arguments);
struct DriveCommand {
  tasks::CommandSpec spec;
  Apply apply;
};

base::Result<> name(Draft& draft, std::size_t, Arguments arguments) {
  draft.name = std::get<std::string>(arguments[0]);
  return {};
}

base::Result<> explore(Draft& draft, std::size_t, Arguments arguments) {
  draft.steps.emplace_back(ExploreStep{std::get<std::string>(arguments[0])});
  return {};
}

base::Result<> drive_to(Draft& draft, std::size_t overload, Arguments arguments) {
  if (overload == 0) {
    draft.steps.emplace_back(DriveToPlaceStep{std::get<geo::Wgs84>(arguments[0])});
    return {};
  }
  auto const& wanted = std::get<std::string>(arguments[0]);
  if (wanted.empty()) return base::fail(base::ErrorKind::invalid_input, "driveTo needs the name of a place");
  draft.steps.emplace_back(DriveToNameStep{wanted});
  return {};
}

base::Result<> return_to_start(Draft& draft, std::size_t, Arguments) {
  draft.steps.emplace_back(ReturnStep{});
  return {};
}

base::Result<> wait(Draft& draft, std::size_t, Arguments arguments) {
  auto const* const whole = std::get_if<std::int64_t>(&arguments.front());
  double const seconds = whole ? static_cast<double>(*whole) : std::get<double>(arguments[0]);
  if (!(seconds >= 0.0)) return base::fail(base::ErrorKind::invalid_input, "the time to wait must be 0 or more");
  draft.steps.emplace_back(WaitStep{seconds});
  return {};
}

std::vector<DriveCommand> drive_commands() {
  tasks::Parameter const strategy{.name = "strategy",
                                  .type = Type::text,
                                  .fallback = Argument{std::string("tour")},
                                  .doc = "how the next place to look at is chosen",
                                  .choices = {"tour", "nearest", "right-hand"}};
  return {
      {{"name",
        {{{{.name = "s", .type = Type::text, .doc = "what views and reports call the drive"}}}},
        "Names the drive."},
       name},
      {{"explore",
        {{{strategy}}},
        "Drives about and maps the floor until nothing open is left that the robot can reach."},
       explore},
      {{"driveTo",
        {{{{.name = "pos", .type = Type::position, .doc = "on the floor that it is on; its altitude does not count"}}},
         {{{.name = "place", .type = Type::text, .doc = "a point of interest of the map: 'room 221', '221'"}}}},
        "Drives to a place on the floor as far as it has been mapped."},
       drive_to},
      {{"returnToStart", {{}}, "Drives back to where the robot began to map."}, return_to_start},
      {{"wait",
        {{{{.name = "secs", .type = Type::number, .dimension = Dimension::time, .doc = "how long"}}}},
        "Stands for so long before the next command."},
       wait},
  };
}

/// Shared by the sessions of one spec.
struct Workshop {
  std::vector<Apply> apply;
  int built = 0;
};

class DriveSession final : public tasks::BuilderSession {
 public:
  explicit DriveSession(std::shared_ptr<Workshop> workshop) : workshop_(std::move(workshop)) {}

  base::Result<> add(std::size_t command, std::size_t overload, Arguments arguments) override {
    return workshop_->apply.at(command)(draft_, overload, arguments);
  }
  base::Result<std::shared_ptr<tasks::PlatformTask const>> finish() override {
    ++workshop_->built;
    if (draft_.steps.empty())
      return base::fail(base::ErrorKind::invalid_input, "a drive needs a command that drives",
                        "as drive { explore(); returnToStart() }");
    if (draft_.name.empty()) draft_.name = fmt::format("Drive_{}", workshop_->built);
    return std::make_shared<DriveTask const>(std::move(draft_.name), std::move(draft_.steps));
  }

 private:
  std::shared_ptr<Workshop> workshop_;
  Draft draft_;
};

}  // namespace

tasks::Vocabulary vocabulary() {
  auto const workshop = std::make_shared<Workshop>();
  tasks::BuilderSpec spec{.name = "drive",
                          .commands = {},
                          .doc = "A drive: commands that one robot carries out in order, on the floor that it maps.",
                          .begin = [workshop] { return std::make_unique<DriveSession>(workshop); }};
  for (auto& command : drive_commands()) {
    workshop->apply.push_back(command.apply);
    spec.commands.push_back(std::move(command.spec));
  }
  return {.builders = {std::move(spec)}, .instructions = {}};
}

}  // namespace lapwing::robot
