#include <fmt/format.h>

#include <algorithm>
#include <ranges>
#include <utility>

#include "dolphin/builtin/members.hpp"
#include "dolphin/machine/blocks.hpp"
#include "dolphin/machine/fiber.hpp"
#include "dolphin/machine/runtime.hpp"
#include "dolphin/names/declared_type.hpp"
#include "dolphin/names/signatures.hpp"
#include "dolphin/syntax/code_points.hpp"
#include "dolphin/syntax/limits.hpp"
#include "dolphin/value/equality.hpp"
#include "dolphin/value/operators.hpp"
#include "dolphin/value/text.hpp"

/// The instructions of a fiber that work on values: operators, members, calls, blocks. Frames and control flow are in
/// fiber.cpp.
namespace lapwing::dolphin {

void Fiber::execute_operator(Instruction i) {
  auto& heap = runtime_.heap;
  auto const count = static_cast<std::size_t>(i.a);
  switch (i.op) {
    case Op::negate: return replace(1, negate(Value(top())));
    case Op::plus:
      if (!top().is_number()) raise({"RuntimeException", fmt::format("{} has no sign", kind_name(top()))});
      return;
    case Op::complement: {
      if (top().is(ValueKind::integer)) {
        top() = Value::integer(~top().integer());
        return;
      }
      return replace(1, make_pattern(heap, runtime_.patterns, Value(top())));
    }
    case Op::logical_not: top() = Value::boolean(!is_true(top())); return;
    case Op::truth: top() = Value::boolean(is_true(top())); return;
    case Op::make_list: {
      auto const items = arguments(i.a);
      return replace(count, Value(heap.make<List>(std::vector<Value>(items.begin(), items.end()))));
    }
    case Op::make_map: {
      auto const items = arguments(2 * i.a);
      auto map = heap.make<Map>();
      for (std::size_t k = 0; k < items.size(); k += 2) map->set(items[k], items[k + 1]);
      return replace(2 * count, Value(map));
    }
    case Op::make_range: return replace(2, make_range(heap, top(1), top(), i.a != 0));
    case Op::concatenate: {
      std::string text;
      for (auto const& piece : arguments(i.a)) {
        if (text.size() <= max_text_size) text += to_text(piece);
      }
      return replace(count, make_text(heap, std::move(text)));
    }
    case Op::make_closure: return make_closure(i.a);
    default: return;
  }
}

void Fiber::make_closure(int index) {
  auto const& code = frame().function->closures[static_cast<std::size_t>(index)];
  std::vector<Ref<Cell>> cells;
  cells.reserve(code->captures.size());
  for (auto const& capture : code->captures) {
    if (capture.is_local) cells.emplace_back(local(capture.index).as<Cell>());
    if (!capture.is_local) cells.push_back(frame().closure->captured[static_cast<std::size_t>(capture.index)]);
  }
  give(Value(runtime_.heap.make<Closure>(code, std::move(cells))));
}

void Fiber::binary(int op) {
  auto const operation = static_cast<ast::BinaryOp>(op);
  if (operation == ast::BinaryOp::find || operation == ast::BinaryOp::match) {
    return replace(2, compared_with_pattern(operation == ast::BinaryOp::find, Value(top(1)), Value(top())));
  }
  if (top().is(ValueKind::closure)) {
    if (operation == ast::BinaryOp::bit_or && top(1).is(ValueKind::vehicles)) return filter_vehicles();
    if (operation == ast::BinaryOp::divide && top(1).is(ValueKind::task)) {
      auto guard = make_guard(runtime_, Ref<Closure>(top().as<Closure>()));
      auto tree = tasks::until(top(1).as<TaskValue>()->value, std::move(guard), {.line = static_cast<int>(line())});
      return replace(2, task_value(runtime_.heap, std::move(tree)));
    }
  }
  auto result = apply(runtime_.heap, operation, top(1), top(), {.line = static_cast<int>(line())});
  replace(2, std::move(result));
}

/// `text =~ pattern`, `text ==~ pattern`.
Checked<Value> Fiber::compared_with_pattern(bool finds, Value const& text, Value const& wanted) {
  auto const* held = text.as<Text>();
  if (!held) {
    return fault(fmt::format("{} has no operator {} with a pattern", kind_name(text), finds ? "=~" : "==~"),
                 "MissingMethodException");
  }
  auto const pattern = runtime_.patterns.of(wanted);
  if (!pattern) return std::unexpected(pattern.error());
  if (finds) return found_in(runtime_.heap, **pattern, held->text);
  return Value::boolean((*pattern)->matches(held->text));
}

/// `set | { test }` is the method findAll, whose arguments lie as it needs them.
void Fiber::filter_vehicles() {
  auto const& program = *runtime_.program;
  enter(*program.functions[static_cast<std::size_t>(program.method_index.at("findAll"))], {}, 2);
}

void Fiber::compare(int op) {
  if (op == matches_case && top().is(ValueKind::closure)) {  // case { it > 5 }
    Value const test = pop();
    return call_closure(Ref<Closure>(test.as<Closure>()), 1);
  }
  auto result = comparison(op, top(1), top());
  replace(2, std::move(result));
}

Checked<Value> Fiber::comparison(int op, Value const& left, Value const& right) {
  auto const as_value = [](Checked<bool> const& truth) -> Checked<Value> {
    if (!truth) return std::unexpected(truth.error());
    return Value::boolean(*truth);
  };
  if (op == matches_case) return as_value(matches(left, right));
  auto const operation = static_cast<ast::BinaryOp>(op);
  if (operation == ast::BinaryOp::equal) return Value::boolean(equal(left, right));
  if (operation == ast::BinaryOp::not_equal) return Value::boolean(!equal(left, right));
  if (operation == ast::BinaryOp::in) return as_value(contains(right, left));
  auto const order = dolphin::compare(left, right);
  if (!order) return std::unexpected(order.error());
  switch (operation) {
    case ast::BinaryOp::less: return Value::boolean(*order < 0);
    case ast::BinaryOp::less_equal: return Value::boolean(*order <= 0);
    case ast::BinaryOp::greater: return Value::boolean(*order > 0);
    case ast::BinaryOp::greater_equal: return Value::boolean(*order >= 0);
    default: return Value::integer(*order < 0 ? -1 : *order > 0 ? 1 : 0);
  }
}

Checked<bool> Fiber::matches(Value const& subject, Value const& label) {
  bool const holds_it = label.is(ValueKind::list) || label.is(ValueKind::range) ||
                        (label.is(ValueKind::vehicles) && subject.is(ValueKind::vehicle)) ||
                        (label.is(ValueKind::area) && subject.is(ValueKind::position));
  if (holds_it) return contains(label, subject);
  if (auto const* type = label.as<TypeValue>()) return is_instance(subject, type->value.name);
  auto const* pattern = label.as<PatternValue>();
  if (pattern && subject.is(ValueKind::text)) return pattern->value->matches(subject.as<Text>()->text);
  return equal(subject, label);
}

Checked<Value> Fiber::iterable(Value const& value) {
  auto& heap = runtime_.heap;
  switch (value.kind()) {
    case ValueKind::list:
    case ValueKind::range:
    case ValueKind::vehicles:
    case ValueKind::text: return value;
    case ValueKind::null: return Value(heap.make<List>());
    case ValueKind::vehicle: return Value(heap.make<Vehicles>(std::vector{value.as<Vehicle>()->value}));
    case ValueKind::map: {
      auto entries = heap.make<List>();
      for (auto const& [key, held] : value.as<Map>()->items()) entries->push(heap.make<Entry>(key, held));
      return Value(entries);
    }
    default: return fault(fmt::format("{} cannot be walked through", kind_name(value)), "IllegalArgumentException");
  }
}

void Fiber::next_item(Instruction i) {
  Value const items = local(i.b);
  auto const index = local(i.b + 1).integer();
  auto const at = static_cast<std::size_t>(index);
  local(i.b + 1) = Value::integer(index + 1);
  if (auto const* list = items.as<List>(); list && at < list->items.size()) return push(list->items[at]);
  if (auto const* range = items.as<Range>(); range && index < range->size)
    return push(Value::integer(range->at(index)));
  if (auto const* set = items.as<Vehicles>(); set && at < set->ids.size()) {
    return push(Value(runtime_.heap.make<Vehicle>(set->ids[at])));
  }
  if (auto const* text = items.as<Text>(); text && at < text->text.size()) {
    // For texts the place is counted in bytes.
    auto const size = first_code_point_size(std::string_view(text->text).substr(at));
    local(i.b + 1) = Value::integer(index + static_cast<std::int64_t>(size));
    return give(Value(runtime_.heap.make<Text>(text->text.substr(at, size))));
  }
  frame().pc = static_cast<std::size_t>(i.a);
}

void Fiber::execute_member(Instruction i) {
  switch (i.op) {
    case Op::get_member: return replace(1, member(runtime_, Value(top()), name(i.a)));
    case Op::set_member: {
      auto const done = set_member(runtime_, top(1), name(i.a), top());
      drop(2);
      if (!done) raise(done.error());
      return;
    }
    case Op::get_index: {
      auto result = element(runtime_.heap, top(1), top(), {.line = static_cast<int>(line())});
      return replace(2, std::move(result));
    }
    case Op::set_index: {
      auto const done = set_element(top(2), top(1), top());
      drop(3);
      if (!done) raise(done.error());
      return;
    }
    case Op::cast: return replace(1, cast(runtime_, Value(top()), name(i.a)));
    case Op::hold:
      return replace(1, held(runtime_, Value(top()), name(i.a), i.b != 0 ? Holder::parameter : Holder::variable));
    case Op::instance_of: top() = Value::boolean(is_instance(top(), name(i.a))); return;
    default: return;
  }
}

void Fiber::execute_call(Instruction i) {
  switch (i.op) {
    case Op::call_function: return enter(*runtime_.program->functions[static_cast<std::size_t>(i.a)], {}, i.b);
    case Op::call_native: return call_native(i.a, i.b);
    case Op::call_value: return call_value(i.b);
    case Op::call_method: return call_method(name(i.a), i.b);
    case Op::call_static: {
      auto result = call_static(runtime_, *this, name(i.a), arguments(i.b));
      return replace(static_cast<std::size_t>(i.b), std::move(result));
    }
    case Op::construct: {
      auto result = construct(runtime_, name(i.a), arguments(i.b), static_cast<int>(line()));
      return replace(static_cast<std::size_t>(i.b), std::move(result));
    }
    default: return;
  }
}

void Fiber::call_native(int index, int count) {
  auto const& native = natives()[static_cast<std::size_t>(index)];
  auto const given = arguments(count);
  busy_steps_ += steps_of_native;
  bool const must_not_wait = role_ == Role::guard || is_unwinding_;
  if (native.call && (must_not_wait || !native.start)) {
    auto result = native.call(runtime_, *this, given);
    return replace(static_cast<std::size_t>(count), std::move(result));
  }
  if (must_not_wait) {
    return raise({"IllegalStateException", fmt::format("a guard must not wait, so it cannot use {}", native.name)});
  }
  if (is_unwinding_) return raise(stopped());
  waits_for_ = &native;
  wait_arguments_.assign(given.begin(), given.end());
  drop(static_cast<std::size_t>(count));
  state_ = State::waiting;
}

void Fiber::call_value(int count) {
  auto const below = stack_.end() - count - 1;
  Value const callee = std::move(*below);
  auto* closure = callee.as<Closure>();
  if (!closure) {
    return raise({"MissingMethodException", fmt::format("{} cannot be called", kind_name(callee))});
  }
  stack_.erase(below);
  call_closure(Ref<Closure>(closure), count);
}

void Fiber::call_closure(Ref<Closure> closure, int count) {
  auto const& function = *closure->function;
  if (function.spreads_lists && count == 1) spread_list(function, count);
  enter(function, std::move(closure), count);
}

/// `pairs.each { a, b -> ... }`: one list or map entry for several parameters is taken apart.
void Fiber::spread_list(Function const& function, int& count) {
  Value const packed = top();
  if (auto const* entry = packed.as<Entry>()) {
    drop(1);
    push(entry->key);
    push(entry->value);
    count = 2;
  } else if (auto const* list = packed.as<List>(); list && static_cast<int>(list->items.size()) >= function.required &&
                                                   static_cast<int>(list->items.size()) <= function.parameters) {
    drop(1);
    for (auto const& item : list->items) push(item);
    count = static_cast<int>(list->items.size());
  }
}

void Fiber::call_method(std::string const& method, int count) {
  Value const object = top(static_cast<std::size_t>(count));
  auto const operands = static_cast<std::size_t>(count) + 1;
  if (object.is_null()) {
    return raise({"NullPointerException", fmt::format("cannot call {}() on null", method)});
  }
  if (object.is(ValueKind::closure) && method == "call") return call_value(count);
  if (auto result = dolphin::call_method(runtime_, object, method, arguments(count))) {
    return replace(operands, std::move(*result));
  }
  auto const& program = *runtime_.program;
  if (auto const found = program.method_index.find(method); found != program.method_index.end()) {
    return enter(*program.functions[static_cast<std::size_t>(found->second)], {}, count + 1);
  }
  if (auto const* map = object.as<Map>()) {
    auto const held = map->at(Value(runtime_.heap.make<Text>(method)));
    if (held.is(ValueKind::closure)) {
      stack_[stack_.size() - operands] = held;
      return call_value(count);
    }
  }
  bool const is_a_word = std::ranges::find(methods(), method, &MethodSpec::name) != methods().end();
  auto const with = is_a_word ? fmt::format(" with {} argument{}", count, count == 1 ? "" : "s") : std::string();
  raise({"MissingMethodException", fmt::format("{} has no method {}{}", kind_name(object), method, with)});
}

void Fiber::execute_block(Instruction i) {
  if (i.op == Op::begin_block) {
    auto block = open_block(runtime_, name(i.a), static_cast<int>(line()));
    if (!block) return raise(std::move(block.error()));
    blocks_.push_back(std::move(*block));
    return;
  }
  if (i.op == Op::end_block) {
    auto const block = std::move(blocks_.back());
    blocks_.pop_back();
    return give(block->finish());
  }
  auto const& wanted = frame().function->commands[static_cast<std::size_t>(i.a)];
  auto const is_wanted = [&](auto const& block) { return block->name() == wanted.block; };
  auto const found = std::ranges::find_if(blocks_ | std::views::reverse, is_wanted);
  if (found == blocks_.rend()) {
    return raise({"IllegalStateException",
                  fmt::format("{} is used after its {} block has ended", wanted.command, wanted.block)});
  }
  auto const done = (*found)->command(wanted.command, arguments(i.b));
  drop(static_cast<std::size_t>(i.b));
  if (!done) return raise(done.error());
  push(Value());
}

}  // namespace lapwing::dolphin
