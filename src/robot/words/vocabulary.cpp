#include "robot/words/vocabulary.hpp"

#include "robot/words/drive_task.hpp"
#include "tasks/step_block.hpp"

namespace lapwing::robot {

namespace {

using tasks::Argument;
using tasks::Type;
using Arguments = std::span<Argument const>;

using Draft = tasks::StepDraft<Step>;

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

base::Result<> photograph(Draft& draft, std::size_t, Arguments) {
  draft.steps.emplace_back(PhotographStep{});
  return {};
}

}  // namespace

tasks::Vocabulary vocabulary() {
  tasks::Parameter const strategy{.name = "strategy",
                                  .type = Type::text,
                                  .fallback = Argument{std::string("tour")},
                                  .doc = "how the next place to look at is chosen",
                                  .choices = {"tour", "nearest", "right-hand"}};
  return tasks::step_block<DriveTask, Step>(
      {.name = "drive",
       .doc = "A drive: commands that one robot carries out in order, on the floor that it maps.",
       .unnamed = "Drive",
       .without_step = "a drive needs a command that drives",
       .example = "as drive { explore(); returnToStart() }"},
      {tasks::name_command<Step>("Names the drive."),
       {{"explore",
         {{{strategy}}},
         "Drives about and maps the floor until nothing open is left that the robot can reach, or its battery takes it "
         "home "
         "and little farther."},
        explore},
       {{"driveTo",
         {{{{.name = "pos", .type = Type::position, .doc = "on the floor that it is on; its altitude does not count"}}},
          {{{.name = "place", .type = Type::text, .doc = "a point of interest of the map: 'room 221', '221'"}}}},
         "Drives to a place on the floor as far as it has been mapped."},
        drive_to},
       {{"returnToStart", {{}}, "Drives back to where the robot began to map."}, return_to_start},
       {{"photograph", {{}}, "Stands, takes a picture of what is ahead, and puts it on the map."}, photograph},
       tasks::wait_command<Step, WaitStep>("Stands for so long before the next command.")});
}

}  // namespace lapwing::robot
