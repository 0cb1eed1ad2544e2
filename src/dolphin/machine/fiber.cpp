#include "dolphin/machine/fiber.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ranges>

#include "base/assert.hpp"
#include "dolphin/machine/runtime.hpp"
#include "dolphin/value/equality.hpp"
#include "dolphin/value/text.hpp"

namespace lapwing::dolphin {

namespace {

/// "survey() takes 1 to 2 arguments, not 3". Methods of the prelude have what they are called on as first parameter.
std::string wrong_count(Function const& function, int passed) {
  int const receiver = function.is_library ? 1 : 0;
  auto const name = function.name.empty() ? "the closure" : function.name + "()";
  int const most = function.parameters - receiver;
  int const least = function.required - receiver;
  auto const from = least < most ? fmt::format("{} to ", least) : "";
  return fmt::format("{} takes {}{} argument{}, not {}", name, from, most, most == 1 ? "" : "s", passed - receiver);
}

}  // namespace

void Fiber::begin(Function const& function) {
  LAPWING_ASSERT(frames_.empty(), frames_.size());
  state_ = State::ready;
  enter(function, {}, 0);
}

void Fiber::begin(Ref<Closure> const& closure, std::vector<Value> arguments) {
  LAPWING_ASSERT(frames_.empty(), frames_.size());
  state_ = State::ready;
  busy_steps_ = 0;
  ignores_failure = false;
  auto const count = static_cast<int>(arguments.size());
  for (auto& argument : arguments) push(std::move(argument));
  call_closure(closure, count);
}

Fiber::State Fiber::run(int& budget) {
  int const given = budget;
  while (state_ == State::ready && budget > 0) {
    --budget;
    auto& frame = frames_.back();
    execute(frame.function->code[frame.pc++]);
  }
  auto const taken = static_cast<std::uint64_t>(given - budget);
  runtime_.steps += taken;
  busy_steps_ += taken;
  auto const& limits = runtime_.limits;
  if (state_ != State::failed && runtime_.steps > limits.steps)
    end_early(fmt::format("the script took more than {} steps", limits.steps));
  if (state_ == State::ready && busy_steps_ > limits.busy_steps)
    end_early(fmt::format("the script let no time pass for {} steps: it waits for nothing and never ends",
                          limits.busy_steps));
  return state_;
}

/// The fiber has taken its steps. Nothing catches it, `finally` does not run.
void Fiber::end_early(std::string message) {
  ErrorData data{"TimeoutException", std::move(message), static_cast<int>(line()), Ending::halts};
  abandon();
  state_ = State::failed;
  result_ = Value(runtime_.heap.make<Error>(std::move(data)));
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

void Fiber::unwind(int budget) {
  if (state_ == State::returned || state_ == State::failed) return;
  is_unwinding_ = true;
  state_ = State::ready;
  raise(stopped());
  if (run(budget) == State::ready) abandon();
}

Fault Fiber::stopped() {
  return {"HaltException", "the script is being stopped", Ending::halts};
}

void Fiber::resume(Checked<Value> result) {
  busy_steps_ = 0;
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

void Fiber::enter(Function const& function, Ref<Closure> closure, int passed) {
  std::size_t const base = stack_.size() - static_cast<std::size_t>(passed);
  bool const lacks_it = closure && function.required == 1 && passed == 0;
  auto const& limits = runtime_.limits;
  auto const refuse = [&](std::string type, std::string message) {
    drop(static_cast<std::size_t>(passed));
    // A closure that a task calls has no caller: its own line tells where it is.
    auto const place = frames_.empty() && !function.lines.empty() ? function.lines.front() : line();
    raise(Value(runtime_.heap.make<Error>(
        ErrorData{std::move(type), std::move(message), static_cast<int>(place), Ending::error})));
  };
  if (passed > function.parameters || (passed < function.required && !lacks_it))
    return refuse("MissingMethodException", wrong_count(function, passed));
  if (frames_.size() >= limits.call_depth)
    return refuse("StackOverflowError", fmt::format("calls are nested more than {} deep", limits.call_depth));
  if (base + static_cast<std::size_t>(function.locals) > limits.stack_values) {
    return refuse("StackOverflowError", fmt::format("calls under way hold more than {} values", limits.stack_values));
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

Arguments Fiber::arguments(int count) const {
  return {stack_.data() + stack_.size() - static_cast<std::size_t>(count), static_cast<std::size_t>(count)};
}

std::string const& Fiber::name(int index) const {
  return frames_.back().function->names[static_cast<std::size_t>(index)];
}

// ---- faults

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
    if (handler->finally_local >= 0) {
      local(handler->finally_local) = std::move(error);
    } else {
      push(std::move(error));
    }
    return;
  }
  stack_.clear();
  state_ = State::failed;
  result_ = std::move(error);
}

// ---- instructions

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
    case Op::hold:
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

}  // namespace lapwing::dolphin
