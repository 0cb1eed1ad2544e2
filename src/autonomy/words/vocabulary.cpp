#include "autonomy/words/vocabulary.hpp"

#include "autonomy/words/lot_task.hpp"
#include "tasks/step_block.hpp"

namespace lapwing::autonomy {

namespace {

using tasks::Argument;
using tasks::Type;
using Arguments = std::span<Argument const>;

using Draft = tasks::StepDraft<Step>;

base::Result<> explore(Draft& draft, std::size_t, Arguments) {
  draft.steps.emplace_back(ExploreStep{});
  return {};
}

base::Result<> move_to(Draft& draft, std::size_t, Arguments arguments) {
  draft.steps.emplace_back(MoveStep{.place = std::get<geo::Wgs84>(arguments[0])});
  return {};
}

base::Result<> move_anyway(Draft& draft, std::size_t, Arguments arguments) {
  draft.steps.emplace_back(MoveStep{.place = std::get<geo::Wgs84>(arguments[0]), .is_anywhere = true});
  return {};
}

base::Result<> come_home(Draft& draft, std::size_t, Arguments) {
  draft.steps.emplace_back(ComeHomeStep{});
  return {};
}

}  // namespace

tasks::Vocabulary vocabulary() {
  return tasks::step_block<LotTask, Step>(
      {.name = "lot",
       .doc = "Commands that one survey drone carries out in order over its car park.",
       .unnamed = "Lot",
       .without_step = "a lot needs a command that flies",
       .example = "as lot { explore(); comeHome() }"},
      {tasks::name_command<Step>("Names the flight."),
       {{"explore", {{}}, "Surveys the car park until the drone has nothing more to learn there."}, explore},
       {{"moveTo",
         {{{{.name = "pos", .type = Type::position, .doc = "within the lot; its altitude does not count"}}}},
         "Flies to a place in the lot, at the usual hover height; fails where the drone's map does not have it in the "
         "lot."},
        move_to},
       {{"moveAnyway",
         {{{{.name = "pos", .type = Type::position, .doc = "its altitude does not count"}}}},
         "Flies to a place, whatever the drone's map says of it."},
        move_anyway},
       tasks::wait_command<Step, WaitStep>("Hovers for so long before the next command."),
       {{"comeHome", {{}}, "Returns to where the drone took off, lands and disarms."}, come_home}});
}

}  // namespace lapwing::autonomy
