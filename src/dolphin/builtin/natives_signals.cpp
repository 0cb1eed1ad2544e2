#include <fmt/format.h>

#include "dolphin/builtin/internal/native_lists.hpp"
#include "dolphin/machine/runtime.hpp"
#include "dolphin/names/row_parameters.hpp"
#include "dolphin/value/text.hpp"

/// Signals (language spec, 3.5).
namespace lapwing::dolphin::internal {
namespace {

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

std::vector<InstructionSpec> signal_words() {
  using namespace rows;
  return {
      {.name = "post",
       .signatures = {takes({plain("signals", Kind::map)})},
       .doc = "Posts each value under its name; one that is there already changes nothing.",
       .named = NamedArguments::values,
       .example = "post ready: 1, place: 'north'",
       .call = post},
      {.name = "consume",
       .signatures = {takes({plain("signals", Kind::map)})},
       .result = Kind::boolean,
       .doc = "Takes the signals when all are there, or none; whether they were there.",
       .named = NamedArguments::values,
       .example = "post ready: 1\nif (consume(ready: 1)) { message 'ready' }",
       .call = consume},
      {.name = "poll",
       .signatures = {takes({plain("name", Kinds(Kind::text) | Kind::map)})},
       .result = Kind::boolean,
       .doc = "Whether there is a signal of that name, or one with that value, or one for which the closure is true. "
              "Takes nothing away.",
       .named = NamedArguments::values,
       .example =
           "post height: 40\nmessage poll('height')\nmessage poll(height: 40)\nmessage poll(height: { it > 30 })",
       .source = R"(def poll(wanted) {
  if (!(wanted instanceof Map)) { return signalValues(wanted).size() > 0 }
  for (pair in wanted) {
    def test = pair.value
    def posted = signalValues(pair.key)
    if (test instanceof Closure ? !posted.any(test) : !(test in posted)) { return false }
  }
  return true
})"},
  };
}

std::vector<InstructionSpec> signal_helpers() {
  return {
      {.name = "signalValues", .call = signal_values},
  };
}

}  // namespace lapwing::dolphin::internal
