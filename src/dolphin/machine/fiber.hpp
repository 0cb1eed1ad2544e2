#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dolphin/builtin/natives.hpp"
#include "dolphin/code/bytecode.hpp"
#include "dolphin/value/objects.hpp"

namespace lapwing::dolphin {

/// A builder block that is being filled: `mission { ... }`, `pick { ... }`.
class Block {
 public:
  virtual ~Block() = default;
  [[nodiscard]] virtual std::string_view name() const = 0;
  virtual Checked<void> command(std::string_view word, Arguments arguments) = 0;
  [[nodiscard]] virtual Checked<Value> finish() = 0;
};

/// One thread of control of a script: its own frames, on the heap, so that scripts can neither overflow our stack nor
/// block our loop. Not preemptive: `run` goes on until the budget is used up, an instruction has to wait, or the end.
class Fiber {
 public:
  enum class State { ready, waiting, returned, failed };
  /// What the fiber was made for decides what it may do.
  enum class Role { script, guard, action, handler };

  /// `runtime` outlives the fiber.
  Fiber(Runtime& runtime, Role role) : runtime_(runtime), role_(role) {}
  Fiber(Fiber const&) = delete;
  Fiber& operator=(Fiber const&) = delete;

  /// Begins a call. Precondition: nothing is running.
  void begin(Function const& function);
  void begin(Ref<Closure> const& closure, std::vector<Value> arguments);

  /// Runs at most `budget` instructions; takes those it ran off the budget.
  State run(int& budget);
  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] Role role() const { return role_; }

  /// When waiting: the instruction to carry out. Its result goes to `resume`.
  [[nodiscard]] base::Task<Checked<Value>> take_wait();
  void resume(Checked<Value> result);

  /// Forgets what was running, as if it had never begun. `finally` does not run.
  void abandon();
  /// Ends what is running as `halt` would: its `finally` blocks run, for at most `budget` instructions, and must not
  /// wait.
  void unwind(int budget);

  /// When returned.
  [[nodiscard]] Value const& result() const { return result_; }
  /// When failed: an `Error`.
  [[nodiscard]] Value const& error() const { return result_; }
  /// The line of the script that is being executed.
  [[nodiscard]] std::uint32_t line() const;

  bool ignores_failure = false;  ///< of a watch handler: `ignore()` was called

 private:
  struct Frame {
    Function const* function;
    Ref<Closure> closure;
    std::size_t pc = 0;
    std::size_t base = 0;  ///< of its locals in the stack
    int passed = 0;        ///< arguments
    std::size_t blocks = 0;
  };

  void execute(Instruction instruction);
  void execute_variable(Instruction instruction);
  void execute_operator(Instruction instruction);
  void execute_member(Instruction instruction);
  void execute_call(Instruction instruction);
  void execute_block(Instruction instruction);
  void execute_flow(Instruction instruction);

  void enter(Function const& function, Ref<Closure> closure, int passed);
  void leave();
  void call_value(int count);
  void call_closure(Ref<Closure> closure, int count);
  void call_method(std::string const& name, int count);
  void call_native(int index, int count);
  void filter_vehicles();
  Checked<Value> compared_with_pattern(bool finds, Value const& text, Value const& wanted);
  void compare(int op);
  void binary(int op);
  void make_closure(int index);
  void next_item(Instruction instruction);
  Checked<Value> iterable(Value const& value);
  Checked<Value> comparison(int op, Value const& left, Value const& right);
  Checked<bool> matches(Value const& subject, Value const& label);
  void spread_list(Function const& function, int& count);

  /// Pushes the value, or throws the fault.
  void give(Checked<Value> result);
  void replace(std::size_t operands, Checked<Value> result);
  void raise(Fault fault);
  [[nodiscard]] static Fault stopped();
  void raise(Value error);
  [[nodiscard]] bool is_heap_full();
  void end_early(std::string message);

  void push(Value value) { stack_.push_back(std::move(value)); }
  Value pop();
  Value& top(std::size_t below = 0) { return stack_[stack_.size() - 1 - below]; }
  void drop(std::size_t count) { stack_.resize(stack_.size() - count); }
  [[nodiscard]] Arguments arguments(int count) const;
  [[nodiscard]] Frame& frame() { return frames_.back(); }
  Value& local(int index) { return stack_[frames_.back().base + static_cast<std::size_t>(index)]; }
  [[nodiscard]] std::string const& name(int index) const;

  Runtime& runtime_;
  Role role_;
  State state_ = State::returned;
  bool is_unwinding_ = false;
  std::uint64_t busy_steps_ = 0;  ///< since it waited last
  std::vector<Value> stack_;
  std::vector<Frame> frames_;
  std::vector<std::unique_ptr<Block>> blocks_;
  Value result_;
  InstructionSpec const* waits_for_ = nullptr;
  std::vector<Value> wait_arguments_;
};

}  // namespace lapwing::dolphin
