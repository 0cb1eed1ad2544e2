#include "dolphin/machine/blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dolphin/machine/runtime.hpp"
#include "dolphin/value/operators.hpp"
#include "dolphin/value/platform_arguments.hpp"
#include "dolphin/value/text.hpp"

namespace lapwing::dolphin {
namespace {

Checked<double> number_argument(std::string_view word, Arguments arguments) {
  if (arguments.size() == 1 && arguments[0].is_number()) return arguments[0].number();
  return fault(fmt::format("{} takes one number", word), "IllegalArgumentException");
}

/// pick { count 2; type 'UAV' }: gathers the fields into a map, checked.
class PickBlock final : public Block {
 public:
  explicit PickBlock(Heap& heap) : heap_(heap), fields_(heap.make<Map>()) {}
  [[nodiscard]] std::string_view name() const override { return "pick"; }
  [[nodiscard]] Checked<Value> finish() override { return Value(fields_); }

  Checked<void> command(std::string_view word, Arguments arguments) override {
    if (word == "count") return count(arguments);
    if (word == "timeout") return timeout(arguments);
    if (word == "region") return region(arguments);
    if (word == "payload") return payload(arguments);
    bool const fits = arguments.size() == 1 &&
                      (arguments[0].is(ValueKind::text) || (word == "id" && arguments[0].is(ValueKind::integer)) ||
                       (word == "id" && arguments[0].is(ValueKind::vehicle)));
    if (!fits) return fault(fmt::format("{} takes one text", word), "IllegalArgumentException");
    set(word, Value(heap_.make<Text>(to_text(arguments[0]))));
    return {};
  }

 private:
  void set(std::string_view field, Value value) {
    fields_->set(Value(heap_.make<Text>(std::string(field))), std::move(value));
  }

  Checked<void> count(Arguments arguments) {
    if (arguments.size() != 1 || !arguments[0].is(ValueKind::integer))
      return fault("count takes one integer", "IllegalArgumentException");
    if (arguments[0].integer() <= 0) return halting("count must be greater than 0");
    set("count", arguments[0]);
    return {};
  }
  Checked<void> timeout(Arguments arguments) {
    auto const seconds = number_argument("timeout", arguments);
    if (!seconds) return std::unexpected(seconds.error());
    if (!(*seconds >= 0.0) || *seconds > 1e9) return halting("timeout must not be negative");
    set("timeout", arguments[0]);
    return {};
  }
  Checked<void> region(Arguments arguments) {
    if (arguments.size() == 1 && arguments[0].is(ValueKind::area)) {
      set("region", arguments[0]);
      return {};
    }
    bool const is_disc = arguments.size() == 2 && arguments[0].is(ValueKind::position) && arguments[1].is_number();
    if (!is_disc) return fault("region takes an area, or a position and a radius", "IllegalArgumentException");
    set("region", Value(heap_.make<Area>(geo::Disc{arguments[0].as<Position>()->value, arguments[1].number()})));
    return {};
  }
  Checked<void> payload(Arguments arguments) {
    auto names = heap_.make<List>();
    for (auto const& argument : arguments) {
      if (!argument.is(ValueKind::text)) return fault("payload takes texts", "IllegalArgumentException");
      names->push(argument);
    }
    if (arguments.empty()) return fault("payload takes at least one text", "IllegalArgumentException");
    set("payload", Value(names));
    return {};
  }

  Heap& heap_;
  Ref<Map> fields_;
};

class PositionBlock final : public Block {
 public:
  explicit PositionBlock(Heap& heap) : heap_(heap) {}
  [[nodiscard]] std::string_view name() const override { return "pos"; }
  [[nodiscard]] Checked<Value> finish() override {
    return Value(heap_.make<Position>(geo::Wgs84::from_degrees(lat_, lon_, height_)));
  }
  Checked<void> command(std::string_view word, Arguments arguments) override {
    auto const number = number_argument(word, arguments);
    if (!number) return std::unexpected(number.error());
    (word == "lat" ? lat_ : word == "lon" ? lon_ : height_) = *number;
    return {};
  }

 private:
  Heap& heap_;
  double lat_ = 0.0;
  double lon_ = 0.0;
  double height_ = 0.0;
};

class DisplacementBlock final : public Block {
 public:
  explicit DisplacementBlock(Heap& heap) : heap_(heap) {}
  [[nodiscard]] std::string_view name() const override { return "moveDistance"; }
  [[nodiscard]] Checked<Value> finish() override { return Value(heap_.make<Displacement>(offset_)); }
  Checked<void> command(std::string_view word, Arguments arguments) override {
    auto const number = number_argument(word, arguments);
    if (!number) return std::unexpected(number.error());
    (word == "north" ? offset_.north : word == "east" ? offset_.east : offset_.down) = *number;
    return {};
  }

 private:
  Heap& heap_;
  geo::Ned offset_;
};

/// oneOf { when { c } then t }, allOf { ... }
class ChoiceBlock final : public Block {
 public:
  ChoiceBlock(Runtime& runtime, bool is_all, int line) : runtime_(runtime), is_all_(is_all), line_(line) {}
  [[nodiscard]] std::string_view name() const override { return "choice"; }
  Checked<void> command(std::string_view /*word*/, Arguments arguments) override {
    auto* guard = arguments[0].as<Closure>();
    auto const* body = arguments[1].as<TaskValue>();
    if (!guard)
      return fault(fmt::format("when takes a closure, not {}", kind_name(arguments[0])), "IllegalArgumentException");
    if (!body)
      return fault(fmt::format("then takes a task, not {}", kind_name(arguments[1])), "IllegalArgumentException");
    if (branches_.size() >= static_cast<std::size_t>(tasks::max_task_size)) {
      return fault(fmt::format("more than {} choices", tasks::max_task_size), "IllegalArgumentException");
    }
    branches_.push_back({make_guard(runtime_, Ref<Closure>(guard)), body->value});
    return {};
  }
  [[nodiscard]] Checked<Value> finish() override {
    if (branches_.empty()) return halting("No choices were defined!", "TaskError");
    tasks::Origin const origin{.line = line_};
    if (is_all_) return task_value(runtime_.heap, tasks::all_of(std::move(branches_), origin));
    auto tree = tasks::one_of(std::move(branches_), origin);
    if (!tree) return halting(tree.error().message, "TaskError");
    return task_value(runtime_.heap, std::move(*tree));
  }

 private:
  Runtime& runtime_;
  bool is_all_;
  int line_;
  std::vector<tasks::Branch> branches_;
};

// ---- blocks of the platform

std::string forms(tasks::CommandSpec const& command) {
  std::string text;
  for (auto const& overload : command.overloads) {
    if (!text.empty()) text += " or ";
    text += '(';
    for (std::size_t i = 0; i < overload.parameters.size(); ++i) {
      auto const& parameter = overload.parameters[i];
      text += fmt::format("{}{}{}: {}", i == 0 ? "" : ", ", parameter.name, parameter.fallback ? "?" : "",
                          type_name(parameter.type));
    }
    text += ')';
  }
  return text;
}

Fault as_fault(base::Error const& error) {
  return {"MissionError", error.hint.empty() ? error.message : fmt::format("{} ({})", error.message, error.hint)};
}

class PlatformBlock final : public Block {
 public:
  PlatformBlock(Runtime& runtime, tasks::BuilderSpec const& spec, int line)
      : runtime_(runtime), spec_(spec), session_(spec.begin()), line_(line) {}
  [[nodiscard]] std::string_view name() const override { return spec_.name; }

  Checked<void> command(std::string_view word, Arguments arguments) override {
    auto const known = std::ranges::find(spec_.commands, word, &tasks::CommandSpec::name);
    for (std::size_t i = 0; i < known->overloads.size(); ++i) {
      auto const given = fitted(known->overloads[i].parameters, arguments);
      if (!given) continue;
      if (auto const wrong = wrong_value(known->overloads[i].parameters, *given))
        return fault(fmt::format("{}: {}", word, *wrong), "MissionError");
      warn_of_rounding(*known, known->overloads[i], arguments);
      auto const added = session_->add(static_cast<std::size_t>(known - spec_.commands.begin()), i, *given);
      if (!added) return std::unexpected(as_fault(added.error()));
      return {};
    }
    return fault(fmt::format("{} takes {}, not ({})", word, forms(*known), kinds(arguments)), "MissionError");
  }

  [[nodiscard]] Checked<Value> finish() override {
    auto task = session_->finish();
    if (!task) return std::unexpected(as_fault(task.error()));
    auto const name = (*task)->name();
    auto value = task_value(runtime_.heap, tasks::performed(std::move(*task), {.line = line_}));
    if (value) runtime_.plans[name] = Ref<TaskValue>(value->as<TaskValue>());
    return value;
  }

 private:
  static std::string kinds(Arguments arguments) {
    std::string text;
    for (auto const& argument : arguments) text += fmt::format("{}{}", text.empty() ? "" : ", ", kind_name(argument));
    return text;
  }
  void warn_of_rounding(tasks::CommandSpec const& command, tasks::Overload const& overload, Arguments arguments) const {
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      if (overload.parameters[i].type != tasks::Type::integer || !arguments[i].is(ValueKind::real)) continue;
      if (arguments[i].real() == std::round(arguments[i].real())) continue;
      runtime_.log.warn(fmt::format("{}: {} is rounded to a whole number from {}", command.name,
                                    overload.parameters[i].name, to_text(arguments[i])));
    }
  }

  Runtime& runtime_;
  tasks::BuilderSpec const& spec_;
  std::unique_ptr<tasks::BuilderSession> session_;
  int line_;
};

}  // namespace

Checked<std::unique_ptr<Block>> open_block(Runtime& runtime, std::string_view word, int line) {
  std::unique_ptr<Block> block;
  auto const& builders = runtime.platform.vocabulary().builders;
  auto const builder = std::ranges::find(builders, word, &tasks::BuilderSpec::name);
  if (word == "pick") block = std::make_unique<PickBlock>(runtime.heap);
  if (word == "pos") block = std::make_unique<PositionBlock>(runtime.heap);
  if (word == "moveDistance") block = std::make_unique<DisplacementBlock>(runtime.heap);
  if (word == "allOf") block = std::make_unique<ChoiceBlock>(runtime, true, line);
  if (word == "oneOf" || word == "choose") block = std::make_unique<ChoiceBlock>(runtime, false, line);
  if (!block && builder != builders.end()) block = std::make_unique<PlatformBlock>(runtime, *builder, line);
  if (!block) return fault(fmt::format("this platform cannot build {}", word), "MissingMethodException");
  return block;
}

}  // namespace lapwing::dolphin
