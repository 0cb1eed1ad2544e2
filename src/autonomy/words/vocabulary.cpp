#include "autonomy/words/vocabulary.hpp"

#include <utility>

#include <fmt/format.h>

#include "autonomy/words/lot_task.hpp"

namespace lapwing::autonomy {

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

using Apply = base::Result<> (*)(Draft& draft, Arguments arguments);
struct LotCommand {
  tasks::CommandSpec spec;
  Apply apply;
};

base::Result<> name(Draft& draft, Arguments arguments) {
  draft.name = std::get<std::string>(arguments[0]);
  return {};
}

base::Result<> explore(Draft& draft, Arguments) {
  draft.steps.emplace_back(ExploreStep{});
  return {};
}

base::Result<> move_to(Draft& draft, Arguments arguments) {
  draft.steps.emplace_back(MoveStep{.place = std::get<geo::Wgs84>(arguments[0])});
  return {};
}

base::Result<> move_anyway(Draft& draft, Arguments arguments) {
  draft.steps.emplace_back(MoveStep{.place = std::get<geo::Wgs84>(arguments[0]), .is_anywhere = true});
  return {};
}

base::Result<> wait(Draft& draft, Arguments arguments) {
  auto const* const whole = std::get_if<std::int64_t>(&arguments.front());
  double const seconds = whole ? static_cast<double>(*whole) : std::get<double>(arguments[0]);
  if (!(seconds >= 0.0)) return base::fail(base::ErrorKind::invalid_input, "the time to wait must be 0 or more");
  draft.steps.emplace_back(WaitStep{seconds});
  return {};
}

base::Result<> come_home(Draft& draft, Arguments) {
  draft.steps.emplace_back(ComeHomeStep{});
  return {};
}

std::vector<LotCommand> lot_commands() {
  return {
      {{"name", {{{{.name = "s", .type = Type::text, .doc = "what views and reports call it"}}}}, "Names it."}, name},
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
      {{"wait",
        {{{{.name = "secs", .type = Type::number, .dimension = Dimension::time, .doc = "how long"}}}},
        "Hovers for so long before the next command."},
       wait},
      {{"comeHome", {{}}, "Returns to where the drone took off, lands and disarms."}, come_home},
  };
}

/// Shared by the sessions of one spec.
struct Workshop {
  std::vector<Apply> apply;
  int built = 0;
};

class LotSession final : public tasks::BuilderSession {
 public:
  explicit LotSession(std::shared_ptr<Workshop> workshop) : workshop_(std::move(workshop)) {}

  base::Result<> add(std::size_t command, std::size_t /*overload*/, Arguments arguments) override {
    return workshop_->apply.at(command)(draft_, arguments);
  }
  base::Result<std::shared_ptr<tasks::PlatformTask const>> finish() override {
    ++workshop_->built;
    if (draft_.steps.empty())
      return base::fail(base::ErrorKind::invalid_input, "a lot needs a command that flies",
                        "as lot { explore(); comeHome() }");
    if (draft_.name.empty()) draft_.name = fmt::format("Lot_{}", workshop_->built);
    return std::make_shared<LotTask const>(std::move(draft_.name), std::move(draft_.steps));
  }

 private:
  std::shared_ptr<Workshop> workshop_;
  Draft draft_;
};

}  // namespace

tasks::Vocabulary vocabulary() {
  auto const workshop = std::make_shared<Workshop>();
  tasks::BuilderSpec spec{.name = "lot",
                          .commands = {},
                          .doc = "Commands that one survey drone carries out in order over its car park.",
                          .begin = [workshop] { return std::make_unique<LotSession>(workshop); }};
  for (auto& command : lot_commands()) {
    workshop->apply.push_back(command.apply);
    spec.commands.push_back(std::move(command.spec));
  }
  return {.builders = {std::move(spec)}, .instructions = {}};
}

}  // namespace lapwing::autonomy
