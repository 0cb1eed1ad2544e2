#include "dolphin/fiber.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ranges>

#include "dolphin/blocks.hpp"
#include "dolphin/equality.hpp"
#include "dolphin/members.hpp"
#include "dolphin/operators.hpp"
#include "dolphin/runtime.hpp"
#include "dolphin/text.hpp"

namespace lapwing::dolphin {

void Fiber::begin(Function const& function) {
  state_ = State::ready;
  enter(function, {}, 0);
}

void Fiber::begin(Ref<Closure> const& closure, std::vector<Value> arguments) {
  state_ = State::ready;
  ignores_failure = false;
  auto const count = static_cast<int>(arguments.size());
  for (auto& argument : arguments) push(std::move(argument));
  call_closure(closure, count);
}

Fiber::State Fiber::run(int& budget) {
  while (state_ == State::ready && budget > 0) {
    --budget;
    auto& frame = frames_.back();
    execute(frame.function->code[frame.pc++]);
  }
  return state_;
}

base::Task<Checked<Value>> Fiber::take_wait() {
  return waits_for_->start(runtime_, *this, std::exchange(wait_arguments_, {}));
}

void Fiber::abandon() {
  frames_.clear();
  stack_.clear();
  blocks_.clear();
  state_ = State::returned;
  result_ = Value();
}

void Fiber::resume(Checked<Value> result) {
  state_ = State::ready;
  give(std::move(result));
}

std::uint32_t Fiber::line() const {
  for (auto const& frame : frames_ | std::views::reverse) {
    if (!frame.function->is_library && frame.pc > 0) return frame.function->lines[frame.pc - 1];
  }
  return 0;
}

// ---- frames
// --------------------------------------------------------------------------------------------------------------

void Fiber::enter(Function const& function, Ref<Closure> closure, int passed) {
  std::size_t const base = stack_.size() - static_cast<std::size_t>(passed);
  bool const lacks_it = closure && function.required == 1 && passed == 0;
  if (passed > function.parameters || (passed < function.required && !lacks_it)) {
    drop(static_cast<std::size_t>(passed));
    auto const subject = function.name.empty() ? "the closure" : function.name + "()";
    return raise(
        {"MissingMethodException", fmt::format("{} takes {} arguments, not {}", subject, function.parameters, passed)});
  }
  if (frames_.size() >= runtime_.limits.call_depth) {
    drop(static_cast<std::size_t>(passed));
    return raise({"StackOverflowError", fmt::format("calls are nested more than {} deep", runtime_.limits.call_depth)});
  }
  stack_.resize(base + static_cast<std::size_t>(function.locals));
  frames_.push_back({&function, std::move(closure), 0, base, passed, blocks_.size()});
}

void Fiber::leave() {
  stack_.resize(frame().base);
  blocks_.resize(frame().blocks);
  frames_.pop_back();
}

Value Fiber::pop() {
  Value value = std::move(stack_.back());
  stack_.pop_back();
  return value;
}

Native::Arguments Fiber::arguments(int count) const {
  return {stack_.data() + stack_.size() - static_cast<std::size_t>(count), static_cast<std::size_t>(count)};
}

std::string const& Fiber::name(int index) const {
  return frames_.back().function->names[static_cast<std::size_t>(index)];
}

// ---- faults
// --------------------------------------------------------------------------------------------------------------

bool Fiber::is_heap_full() {
  if (runtime_.heap.bytes() <= runtime_.limits.heap_bytes) return false;
  raise({"OutOfMemoryError", fmt::format("the script uses more than {} MiB", runtime_.limits.heap_bytes >> 20U)});
  return true;
}

void Fiber::give(Checked<Value> result) {
  if (!result) return raise(std::move(result.error()));
  if (result->is_object() && is_heap_full()) return;
  push(std::move(*result));
}

void Fiber::replace(std::size_t operands, Checked<Value> result) {
  drop(operands);
  give(std::move(result));
}

void Fiber::raise(Fault fault) {
  if (fault.thrown.is(ValueKind::error)) return raise(std::move(fault.thrown));
  ErrorData data{std::move(fault.type), std::move(fault.message), static_cast<int>(line()), fault.ending};
  raise(Value(runtime_.heap.make<Error>(std::move(data))));
}

void Fiber::raise(Value error) {
  bool const is_halt = error.as<Error>()->value.ending == Ending::halts;
  while (!frames_.empty()) {
    auto& f = frame();
    auto const pc = static_cast<std::int32_t>(f.pc) - 1;
    auto const takes = [&](Handler const& handler) {
      return handler.begin <= pc && pc < handler.end && (handler.finally_local >= 0 || !is_halt);
    };
    auto const handler = std::ranges::find_if(f.function->handlers, takes);
    if (handler == f.function->handlers.end()) {
      leave();
      continue;
    }
    stack_.resize(f.base + static_cast<std::size_t>(f.function->locals));
    blocks_.resize(f.blocks);
    f.pc = static_cast<std::size_t>(handler->target);
    if (handler->finally_local >= 0) local(handler->finally_local) = std::move(error);
    if (handler->finally_local < 0) push(std::move(error));
    return;
  }
  stack_.clear();
  state_ = State::failed;
  result_ = std::move(error);
}

// ---- instructions
// --------------------------------------------------------------------------------------------------------

void Fiber::execute(Instruction i) {
  switch (i.op) {
    case Op::constant: return push(frame().function->constants[static_cast<std::size_t>(i.a)]);
    case Op::null: return push(Value());
    case Op::boolean: return push(Value::boolean(i.a != 0));
    case Op::load_local: return push(local(i.a));
    case Op::store_local:
    case Op::declare_local:
    case Op::load_cell:
    case Op::store_cell:
    case Op::declare_cell:
    case Op::adopt_parameter:
    case Op::adopt_cell:
    case Op::load_captured:
    case Op::store_captured:
    case Op::load_global:
    case Op::store_global: return execute_variable(i);
    case Op::pop: return drop(1);
    case Op::duplicate: return push(Value(top()));
    case Op::binary: return binary(i.a);
    case Op::compare: return compare(i.a);
    case Op::jump: frame().pc = static_cast<std::size_t>(i.a); return;
    case Op::jump_back:
    case Op::jump_if_false:
    case Op::jump_if_true:
    case Op::jump_if_null:
    case Op::jump_if_passed:
    case Op::start_iteration:
    case Op::next_item:
    case Op::call_finally:
    case Op::end_finally:
    case Op::throw_value:
    case Op::return_value: return execute_flow(i);
    case Op::call_function:
    case Op::call_native:
    case Op::call_value:
    case Op::call_method:
    case Op::call_static:
    case Op::construct: return execute_call(i);
    case Op::get_member:
    case Op::set_member:
    case Op::get_index:
    case Op::set_index:
    case Op::cast:
    case Op::instance_of: return execute_member(i);
    case Op::begin_block:
    case Op::block_command:
    case Op::end_block: return execute_block(i);
    default: return execute_operator(i);
  }
}

void Fiber::execute_variable(Instruction i) {
  auto const index = static_cast<std::size_t>(i.a);
  auto& heap = runtime_.heap;
  switch (i.op) {
    case Op::store_local: {
      auto value = pop();
      local(i.a) = std::move(value);
      return;
    }
    case Op::declare_cell: {
      auto value = pop();
      local(i.a) = heap.make<Cell>(std::move(value));
      return;
    }
    case Op::load_cell: return push(local(i.a).as<Cell>()->value);
    case Op::store_cell: {
      auto value = pop();
      local(i.a).as<Cell>()->value = std::move(value);
      return;
    }
    case Op::adopt_cell: local(i.a) = heap.make<Cell>(local(i.a)); return;
    case Op::load_captured: return push(frame().closure->captured[index]->value);
    case Op::store_captured: {
      auto value = pop();
      frame().closure->captured[index]->value = std::move(value);
      return;
    }
    case Op::load_global:
      if (!runtime_.is_defined[index]) {
        return raise({"MissingPropertyException", runtime_.program->globals[index] + " is not defined"});
      }
      return push(runtime_.globals[index]);
    case Op::store_global:
      runtime_.globals[index] = pop();
      runtime_.is_defined[index] = true;
      return;
    default: return;  // adopt_parameter of a parameter that nobody captured
  }
}

void Fiber::execute_operator(Instruction i) {
  auto& heap = runtime_.heap;
  auto const count = static_cast<std::size_t>(i.a);
  switch (i.op) {
    case Op::negate: return replace(1, negate(Value(top())));
    case Op::plus:
      if (!top().is_number()) raise({"RuntimeException", fmt::format("{} has no sign", kind_name(top()))});
      return;
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
      for (auto const& piece : arguments(i.a)) text += to_text(piece);
      return replace(count, Value(heap.make<Text>(std::move(text))));
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

/// `set | { test }` is the method findAll, whose arguments lie as it needs them.
void Fiber::filter_vehicles() {
  auto const& program = *runtime_.program;
  enter(*program.functions[static_cast<std::size_t>(program.method_index.at("findAll"))], {}, 2);
}

void Fiber::compare(int op) {
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
  if (label.is(ValueKind::list) || label.is(ValueKind::range)) return contains(label, subject);
  if (auto const* type = label.as<TypeValue>()) return is_instance(subject, type->value.name);
  return equal(subject, label);
}

void Fiber::execute_flow(Instruction i) {
  auto const target = static_cast<std::size_t>(i.a);
  switch (i.op) {
    case Op::jump_back:
      if (!is_heap_full()) frame().pc = target;
      return;
    case Op::jump_if_false:
      if (!is_true(pop())) frame().pc = target;
      return;
    case Op::jump_if_true:
      if (is_true(pop())) frame().pc = target;
      return;
    case Op::jump_if_null:
      if (top().is_null()) frame().pc = target;
      return;
    case Op::jump_if_passed:
      if (frame().passed > i.b) frame().pc = target;
      return;
    case Op::start_iteration: {
      auto items = iterable(top());
      if (!items) return raise(std::move(items.error()));
      drop(1);
      local(i.a) = std::move(*items);
      local(i.a + 1) = Value::integer(0);
      return;
    }
    case Op::next_item: return next_item(i);
    case Op::call_finally:
      local(i.b) = Value::integer(static_cast<std::int64_t>(frame().pc));
      frame().pc = target;
      return;
    case Op::end_finally: {
      Value const how = local(i.b);
      if (how.is(ValueKind::error)) return raise(how);
      frame().pc = static_cast<std::size_t>(how.integer());
      return;
    }
    case Op::throw_value: {
      auto value = pop();
      if (value.is(ValueKind::error)) return raise(std::move(value));
      return raise({"RuntimeException", to_text(value)});
    }
    case Op::return_value: {
      auto value = pop();
      leave();
      if (!frames_.empty()) return push(std::move(value));
      state_ = State::returned;
      result_ = std::move(value);
      return;
    }
    default: return;
  }
}

Checked<Value> Fiber::iterable(Value const& value) {
  auto& heap = runtime_.heap;
  switch (value.kind()) {
    case ValueKind::list:
    case ValueKind::range:
    case ValueKind::vehicles: return value;
    case ValueKind::null: return Value(heap.make<List>());
    case ValueKind::vehicle: return Value(heap.make<Vehicles>(std::vector{value.as<Vehicle>()->value}));
    case ValueKind::map: {
      auto entries = heap.make<List>();
      for (auto const& [key, held] : value.as<Map>()->items()) entries->push(heap.make<Entry>(key, held));
      return Value(entries);
    }
    case ValueKind::text: {
      auto letters = heap.make<List>();
      for (char const c : value.as<Text>()->text) letters->push(heap.make<Text>(std::string(1, c)));
      return Value(letters);
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
      return replace(i.b, std::move(result));
    }
    case Op::construct: {
      auto result = construct(runtime_, name(i.a), arguments(i.b), static_cast<int>(line()));
      return replace(i.b, std::move(result));
    }
    default: return;
  }
}

void Fiber::call_native(int index, int count) {
  auto const& native = natives()[static_cast<std::size_t>(index)];
  auto const given = arguments(count);
  if (native.call) {
    auto result = native.call(runtime_, *this, given);
    return replace(static_cast<std::size_t>(count), std::move(result));
  }
  if (role_ == Role::guard) {
    return raise({"IllegalStateException", fmt::format("a guard must not wait, so it cannot use {}", native.name)});
  }
  waits_for_ = &native;
  wait_arguments_.assign(given.begin(), given.end());
  drop(static_cast<std::size_t>(count));
  state_ = State::waiting;
}

void Fiber::call_value(int count) {
  auto const below = stack_.end() - count - 1;
  Value const callee = *below;
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
  raise({"MissingMethodException", fmt::format("{} has no method {}", kind_name(object), method)});
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
  drop(i.b);
  if (!done) return raise(done.error());
  push(Value());
}

}  // namespace lapwing::dolphin
