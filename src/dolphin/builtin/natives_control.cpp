#include <fmt/format.h>

#include <array>

#include "dolphin/builtin/internal/native_lists.hpp"
#include "dolphin/code/compiler.hpp"
#include "dolphin/machine/fiber.hpp"
#include "dolphin/machine/runtime.hpp"
#include "dolphin/syntax/characters.hpp"
#include "dolphin/value/text.hpp"

/// Program control (language spec, 3.3) and signals (3.5).
namespace lapwing::dolphin::internal {
namespace {

using Arguments = Native::Arguments;

/// Computations in an answer to `ask` end here.
constexpr int answer_budget = 100'000;

Checked<Value> message(Runtime& runtime, Fiber& /*fiber*/, Arguments arguments) {
  runtime.output.write("Program message: " + to_text(arguments[0]) + "\n");
  return Value();
}

Checked<Value> print(Runtime& runtime, Fiber& /*fiber*/, Arguments arguments) {
  if (!arguments.empty()) runtime.output.write(to_text(arguments[0]));
  return Value();
}

Checked<Value> print_line(Runtime& runtime, Fiber& /*fiber*/, Arguments arguments) {
  runtime.output.write((arguments.empty() ? std::string() : to_text(arguments[0])) + "\n");
  return Value();
}

Checked<Value> halt(Runtime& /*runtime*/, Fiber& /*fiber*/, Arguments arguments) {
  std::string text = arguments.empty() ? std::string() : to_text(arguments[0]);
  return std::unexpected(Fault{"HaltException", std::move(text), Ending::halts});
}

Checked<base::Duration> seconds_argument(Value const& value, std::string_view what) {
  if (!value.is_number() || !(value.number() >= 0.0) || value.number() > 1e9) {
    return fault(fmt::format("{} takes seconds, 0 or more", what), "IllegalArgumentException");
  }
  return base::from_seconds(value.number());
}

base::Task<Checked<Value>> pause(Runtime& runtime, Fiber& /*fiber*/, std::vector<Value> arguments) {
  auto const length = seconds_argument(arguments[0], "pause");
  if (!length) co_return std::unexpected(length.error());
  runtime.log.info(fmt::format("Pausing for {:f} s ...", base::to_seconds(*length)));
  co_await runtime.loop.sleep(*length);
  co_return Value();
}

/// The value of what was typed, or the text itself.
Value answer_value(Runtime& runtime, std::string const& typed) {
  if (auto const function = compile_answer(typed, *runtime.program)) {
    Fiber fiber(runtime, Fiber::Role::guard);
    int budget = answer_budget;
    fiber.begin(*function);
    if (fiber.run(budget) == Fiber::State::returned) return fiber.result();
  }
  return Value(runtime.heap.make<Text>(typed));
}

base::Task<Checked<Value>> ask(Runtime& runtime, Fiber& /*fiber*/, std::vector<Value> arguments) {
  std::string const prompt = arguments.empty() ? std::string() : to_text(arguments[0]);
  auto asking = runtime.output.ask(prompt);
  auto const typed = co_await asking;
  if (!typed) co_return fault(fmt::format("ask: {}", typed.error().message), "IOException");
  auto const answer = as_utf8(*typed);
  co_return answer_value(runtime, answer);
}

Checked<Signals::Wanted> wanted(Value const& value, std::string_view what) {
  auto const* map = value.as<Map>();
  if (!map)
    return fault(fmt::format("{} takes names with values: {} ready: 1", what, what), "IllegalArgumentException");
  Signals::Wanted pairs;
  for (auto const& [name, held] : map->items()) pairs.emplace_back(to_text(name), held);
  return pairs;
}

std::string as_log_text(Signals::Wanted const& pairs) {
  std::string text;
  for (auto const& [name, value] : pairs)
    text += fmt::format("{}{}={}", text.empty() ? "" : ", ", name, to_text(value));
  return "{" + text + "}";
}

Checked<Value> post(Runtime& runtime, Fiber& /*fiber*/, Arguments arguments) {
  auto const pairs = wanted(arguments[0], "post");
  if (!pairs) return std::unexpected(pairs.error());
  for (auto const& [name, value] : *pairs) {
    if (auto const posted = runtime.signals.post(name, value); !posted) return std::unexpected(posted.error());
  }
  runtime.log.info(fmt::format("Posting '{}'", as_log_text(*pairs)));
  return Value();
}

Checked<Value> consume(Runtime& runtime, Fiber& /*fiber*/, Arguments arguments) {
  auto const pairs = wanted(arguments[0], "consume");
  if (!pairs) return std::unexpected(pairs.error());
  bool const is_consumed = runtime.signals.consume(*pairs);
  if (is_consumed) runtime.log.info(fmt::format("Consumed '{}'", as_log_text(*pairs)));
  return Value::boolean(is_consumed);
}

/// What `poll` of the prelude looks at.
Checked<Value> signal_values(Runtime& runtime, Fiber& /*fiber*/, Arguments arguments) {
  return Value(runtime.heap.make<List>(runtime.signals.values(to_text(arguments[0]))));
}

}  // namespace

std::span<Native const> control_natives() {
  static std::array const table = {
      Native{.name = "message", .least = 1, .most = 1, .call = message},
      Native{.name = "print", .least = 0, .most = 1, .call = print},
      Native{.name = "println", .least = 0, .most = 1, .call = print_line},
      Native{.name = "halt", .least = 0, .most = 1, .call = halt},
      Native{.name = "pause", .least = 1, .most = 1, .start = pause},
      Native{.name = "ask", .least = 0, .most = 1, .start = ask},
      Native{.name = "post", .least = 1, .most = 1, .call = post},
      Native{.name = "consume", .least = 1, .most = 1, .call = consume},
      Native{.name = "signalValues", .least = 1, .most = 1, .call = signal_values},
  };
  return table;
}

}  // namespace lapwing::dolphin::internal
