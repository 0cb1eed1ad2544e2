// Any bytes as a mission script that is compiled and run on the platform of the conformance cases, in virtual time and
// within tight limits. Also what is typed in answer to `ask`: the first line of the script.
#include <algorithm>
#include <memory>

#include "base/async/scope.hpp"
#include "dolphin/machine/engine.hpp"
#include "missions/event_line.hpp"
#include "missions/mission_harness.hpp"
#include "scripts.hpp"

using namespace lapwing;

namespace {

/// A run takes some ten milliseconds, so that the fuzzer gets far.
constexpr dolphin::Limits limits{.heap_bytes = std::size_t{2} << 20U,
                                 .call_depth = 200,
                                 .stack_values = 20'000,
                                 .slice = 1'000,
                                 .guard_budget = 5'000,
                                 .steps = 50'000};
constexpr auto longest_run = std::chrono::seconds(30);

class Answers final : public dolphin::Output {
 public:
  explicit Answers(std::string typed) : typed_(std::move(typed)) {}
  void write(std::string_view words) override { written += words.size(); }
  [[nodiscard]] base::Task<base::Result<std::string>> ask(std::string /*prompt*/) override { co_return typed_; }
  std::size_t written = 0;

 private:
  std::string typed_;
};

base::Task<void> stop_later(base::Loop& loop, dolphin::Engine& engine) {
  co_await loop.sleep(longest_run);
  engine.stop();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  auto const text = fuzz::text_of(data, size);
  auto const source = std::make_shared<base::SourceFile const>("fuzz", text);
  base::Loop loop({.unpaced = true});
  missions::MissionHarness platform(loop);
  base::Diagnostics diagnostics(*source);
  auto const program = dolphin::load(source, platform.vocabulary(), diagnostics);
  fuzz::require((program != nullptr) != diagnostics.has_errors());
  fuzz::require_presentable(diagnostics);
  if (!program) return 0;

  Answers output(text.substr(0, text.find('\n')));
  dolphin::EngineOptions options{.limits = limits};
  options.on_event = [&](tasks::TaskEvent const& event) { output.written += missions::event_line(event).size(); };
  dolphin::Engine engine(loop, platform, output, {}, options);
  base::Scope scope(loop);
  scope.spawn(stop_later(loop, engine));
  auto const outcome = loop.run_until_done(engine.run(program));
  fuzz::require(!dolphin::to_text(outcome).empty() && !engine.is_running());
  return 0;
}
