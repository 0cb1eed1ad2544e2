#include <fmt/format.h>

#include <array>

#include "dolphin/builtin/internal/native_lists.hpp"
#include "dolphin/code/compiler.hpp"
#include "dolphin/machine/fiber.hpp"
#include "dolphin/machine/runtime.hpp"
#include "dolphin/names/row_parameters.hpp"
#include "dolphin/syntax/characters.hpp"
#include "dolphin/value/text.hpp"

/// Program control (language spec, 3.3).
namespace lapwing::dolphin::internal {
namespace {

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

}  // namespace

std::vector<InstructionSpec> control_words() {
  using namespace rows;
  return {
      {.name = "message",
       .signatures = {takes({plain("value", any)})},
       .doc = "Prints the value for the operator, behind `Program message:`.",
       .example = "message 'Survey begins'",
       .call = message},
      {.name = "ask",
       .signatures = {takes({plain("prompt", any)})},
       .result = any,
       .doc = "Prints the prompt and reads one line: the value of the expression in it (literals, variables, functions "
              "of numbers), or its text when it is none. Throws an IOException when there is no more input.",
       .example = "n = ask 'How many vehicles? '",
       .start = ask},
      {.name = "halt",
       .signatures = {takes({maybe(plain("reason", any))})},
       .doc = "Ends the script with exit code 3 and makes all vehicles safe. Cannot be caught; `finally` runs.",
       .example = "halt 'the wind is too strong'",
       .call = halt},
      {.name = "pause",
       .signatures = {takes({seconds("time")})},
       .doc = "Waits. In an action it holds up nobody else; in a guard it is an error.",
       .example = "pause 5.seconds",
       .start = pause},
      {.name = "println",
       .signatures = {takes({maybe(plain("value", any))})},
       .doc = "Prints the value and ends the line.",
       .call = print_line},
      {.name = "print", .signatures = {takes({plain("value", any)})}, .doc = "Prints the value.", .call = print},
  };
}

}  // namespace lapwing::dolphin::internal
