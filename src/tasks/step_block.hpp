#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "tasks/platform.hpp"
#include "tasks/vocabulary.hpp"

/// Block words whose commands are steps that one vehicle carries out in their order: `drive { ... }`, `lot { ... }`.
namespace lapwing::tasks {

/// A block while it is read.
template <class Step>
struct StepDraft {
  std::string name = {};
  std::vector<Step> steps = {};
};

/// A command, and what it does to the draft.
template <class Step>
struct StepCommand {
  using Apply = base::Result<> (*)(StepDraft<Step>& draft, std::size_t overload, std::span<Argument const> arguments);
  CommandSpec spec;
  Apply apply;
};

/// The command `name s`; `doc` says what it names. Texts of a vocabulary are literals: it keeps views of them.
template <class Step>
StepCommand<Step> name_command(std::string_view doc) {
  return {{"name", {{{{.name = "s", .type = Type::text, .doc = "what views and reports call it"}}}}, doc},
          [](StepDraft<Step>& draft, std::size_t, std::span<Argument const> arguments) -> base::Result<> {
            draft.name = std::get<std::string>(arguments[0]);
            return {};
          }};
}

/// The command `wait secs`, which is a `WaitStep`; `doc` says what the vehicle does meanwhile.
template <class Step, class WaitStep>
StepCommand<Step> wait_command(std::string_view doc) {
  return {{"wait", {{{{.name = "secs", .type = Type::number, .dimension = Dimension::time, .doc = "how long"}}}}, doc},
          [](StepDraft<Step>& draft, std::size_t, std::span<Argument const> arguments) -> base::Result<> {
            auto const* const whole = std::get_if<std::int64_t>(&arguments.front());
            double const seconds = whole ? static_cast<double>(*whole) : std::get<double>(arguments[0]);
            if (!(seconds >= 0.0))
              return base::fail(base::ErrorKind::invalid_input, "the time to wait must be 0 or more");
            draft.steps.emplace_back(WaitStep{seconds});
            return {};
          }};
}

/// What a block word is called, and what it says, in literals.
struct StepBlockWords {
  std::string_view name;  ///< "drive"
  std::string_view doc;
  std::string_view unnamed;       ///< "Drive": a task without a name is called Drive_N
  std::string_view without_step;  ///< the error of a block that does nothing,
  std::string_view example;       ///< and its hint
};

/// A vocabulary with this one block word. It builds tasks `Task(name, steps)`; N counts those that it has built.
template <class Task, class Step>
Vocabulary step_block(StepBlockWords words, std::vector<StepCommand<Step>> commands) {
  /// Shared by the sessions of one spec.
  struct Workshop {
    StepBlockWords words;
    std::vector<typename StepCommand<Step>::Apply> apply = {};
    int built = 0;
  };
  class Session final : public BuilderSession {
   public:
    explicit Session(std::shared_ptr<Workshop> workshop) : workshop_(std::move(workshop)) {}

    base::Result<> add(std::size_t command, std::size_t overload, std::span<Argument const> arguments) override {
      return workshop_->apply.at(command)(draft_, overload, arguments);
    }
    base::Result<std::shared_ptr<PlatformTask const>> finish() override {
      ++workshop_->built;
      auto const& words = workshop_->words;
      if (draft_.steps.empty())
        return base::fail(base::ErrorKind::invalid_input, std::string(words.without_step), std::string(words.example));
      if (draft_.name.empty()) draft_.name = fmt::format("{}_{}", words.unnamed, workshop_->built);
      return std::make_shared<Task const>(std::move(draft_.name), std::move(draft_.steps));
    }

   private:
    std::shared_ptr<Workshop> workshop_;
    StepDraft<Step> draft_;
  };

  auto const workshop = std::make_shared<Workshop>(Workshop{.words = words});
  BuilderSpec spec{.name = words.name, .commands = {}, .doc = words.doc, .begin = [workshop] {
                     return std::make_unique<Session>(workshop);
                   }};
  for (auto& command : commands) {
    workshop->apply.push_back(command.apply);
    spec.commands.push_back(std::move(command.spec));
  }
  return {.builders = {std::move(spec)}, .instructions = {}};
}

}  // namespace lapwing::tasks
