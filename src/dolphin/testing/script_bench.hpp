#pragma once

#include <deque>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "base/async/scope.hpp"
#include "dolphin/machine/engine.hpp"
#include "missions/event_line.hpp"
#include "missions/mission_harness.hpp"

/// What the tests of the language need: a script run on the harness platform in virtual time, and everything it did as
/// one text.
namespace lapwing::dolphin::testing {

/// Writes into a text; answers come from a list.
class Transcript final : public Output {
 public:
  void write(std::string_view words) override { text += words; }
  [[nodiscard]] base::Task<base::Result<std::string>> ask(std::string prompt) override {
    text += prompt + "\n";
    if (answers.empty()) co_return base::fail(base::ErrorKind::io, "end of input");
    auto answer = answers.front();
    answers.pop_front();
    co_return answer;
  }

  std::string text;
  std::deque<std::string> answers;
};

/// A platform and what was written to the outside.
class Bench {
 public:
  base::Loop loop{{.unpaced = true}};
  missions::MissionHarness platform{loop};
  Transcript transcript;
  EngineOptions options;

  /// Runs the script to its end. The last line is how it ended, or what `load` complained about.
  std::string run(std::string const& script, std::string const& name = "test.dolphin") {
    auto const source = std::make_shared<base::SourceFile const>(name, script);
    base::Diagnostics diagnostics(*source);
    auto const program = load(source, platform.vocabulary(), diagnostics);
    if (!program) return base::render(diagnostics) + "exit 2\n";
    options.on_event = [this](tasks::TaskEvent const& event) {
      auto const vehicle = event.vehicle ? platform.find(*event.vehicle) : std::nullopt;
      auto const home = vehicle ? vehicle->position : std::nullopt;
      transcript.text += missions::event_line(event, {.home = home}) + "\n";
    };
    Engine engine(loop, platform, transcript, {}, options);
    base::Scope scope(loop);
    scope.spawn(stop_later(engine));
    auto const outcome = loop.run_until_done(engine.run(program));
    auto const at = base::to_seconds(loop.now().time_since_epoch());
    transcript.text += fmt::format("exit {} at {:.1f}", exit_code(outcome), at);
    if (outcome.kind != Outcome::Kind::done) transcript.text += ": " + to_text(outcome);
    transcript.text += '\n';
    return transcript.text;
  }

 private:
  /// A script that never ends must not hang its test.
  base::Task<void> stop_later(Engine& engine) {
    co_await loop.sleep(std::chrono::hours(10));
    engine.stop();
  }
};

/// What a script without tasks prints: everything but the last line of a `done` one.
inline std::string printed(std::string const& script) {
  Bench bench;
  auto text = bench.run(script);
  auto const end = text.rfind("exit 0");
  return end == std::string::npos ? text : text.substr(0, end);
}

}  // namespace lapwing::dolphin::testing
