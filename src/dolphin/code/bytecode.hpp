#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/text/source.hpp"
#include "dolphin/value/value.hpp"

namespace lapwing::dolphin {

/// `compare` with this operand: does the value belong to the `case`?
inline constexpr int matches_case = -1;

/// What the machine can do. `a` and `b` are the operands of the instruction; "pops" and "pushes" speak of the operand
/// stack.
enum class Op : std::uint8_t {
  constant,         ///< pushes constants[a]
  null,             ///< pushes null
  boolean,          ///< pushes a != 0
  load_local,       ///< pushes locals[a]
  store_local,      ///< pops into locals[a]
  declare_local,    ///< as store_local, as the variable's beginning
  adopt_parameter,  ///< nothing, unless the parameter is captured
  load_cell,        ///< the same four for captured variables
  store_cell,
  declare_cell,
  adopt_cell,
  load_captured,  ///< pushes captured[a]
  store_captured,
  load_global,  ///< pushes globals[a]; a fault when it has no value yet
  store_global,
  pop,
  duplicate,
  binary,   ///< pops two, pushes left op right; a: ast::BinaryOp
  compare,  ///< pops two, pushes a boolean; a: ast::BinaryOp (less .. not_equal, in) or compare
  negate,
  plus,        ///< a fault unless the operand is a number
  complement,  ///< all bits of an integer; of a text the pattern that it is
  logical_not,
  truth,            ///< pops a value, pushes whether it counts as true
  jump,             ///< to a
  jump_back,        ///< to a, which closes a loop: the machine may pause here
  jump_if_false,    ///< pops; to a
  jump_if_true,     ///< pops; to a
  jump_if_null,     ///< keeps the value; to a
  jump_if_passed,   ///< to a when the call gave more than b arguments
  make_list,        ///< pops a values
  make_map,         ///< pops a keys and values in turn
  make_range,       ///< pops two; a: last included
  concatenate,      ///< pops a values, pushes their text
  make_closure,     ///< pushes a closure of functions[a]
  get_member,       ///< pops an object, pushes its member names[a]
  set_member,       ///< pops object, value
  get_index,        ///< pops object, index
  set_index,        ///< pops object, index, value
  cast,             ///< pops, pushes the value as type names[a]
  hold,             ///< pops, pushes what a variable of that type holds; names[a] "int n", b: a parameter
  instance_of,      ///< pops, pushes whether it is a names[a]
  call_function,    ///< pops b arguments; program.functions[a]
  call_native,      ///< pops b arguments; natives()[a]
  call_value,       ///< pops b arguments and, below them, the closure
  call_method,      ///< pops b arguments and, below them, the object; names[a]
  call_static,      ///< pops b arguments; static_names[a] "Math.abs"
  construct,        ///< pops b arguments; new names[a]
  begin_block,      ///< opens the builder block names[a]
  block_command,    ///< pops b arguments; commands[a]
  end_block,        ///< closes the innermost block, pushes what it built
  start_iteration,  ///< pops; locals[a] = what to walk through, locals[a + 1] = 0
  next_item,        ///< pushes the next item of locals[b], or jumps to a
  call_finally,     ///< locals[b] = next instruction; jumps to a
  end_finally,      ///< goes on at locals[b], or throws it again
  throw_value,      ///< pops
  return_value,     ///< pops
};

struct Instruction {
  Op op;
  std::int32_t b = 0;  ///< a local, or a number of arguments
  std::int32_t a = 0;
};

/// An exception in [begin, end) goes to `target`: `catch` code with the exception on the stack, `finally` code with it
/// in a local.
struct Handler {
  std::int32_t begin = 0;
  std::int32_t end = 0;
  std::int32_t target = 0;
  std::int32_t finally_local = -1;  ///< -1: a catch, which `halt` does not enter
};

/// Where a closure finds a variable of the function round it when it is made.
struct Capture {
  bool is_local = true;  ///< a local of that function, else one that it captured itself
  std::int32_t index = 0;
};

/// One word of a builder block: `takeOff` of `mission`.
struct BlockCommand {
  std::string block;
  std::string command;
};

/// A function, a closure or the script itself, compiled.
struct Function {
  std::string name;  ///< empty for closures
  int required = 0;  ///< parameters without a default
  int parameters = 0;
  bool spreads_lists = false;  ///< one list given for several parameters is taken apart
  bool is_library = false;     ///< of the prelude: faults are reported at its caller
  int locals = 0;              ///< parameters included
  std::vector<Instruction> code;
  std::vector<std::uint32_t> lines;  ///< of each instruction
  std::vector<Value> constants;
  std::vector<std::string> names;
  std::vector<BlockCommand> commands;
  std::vector<std::shared_ptr<Function const>> closures;
  std::vector<Capture> captures;
  std::vector<Handler> handlers;  ///< innermost first
};

/// A script ready to run. Immutable; any number of runs may share it.
struct Program {
  Heap texts;  ///< of the constants
  std::shared_ptr<base::SourceFile const> source;
  std::shared_ptr<Function const> main;
  std::vector<std::shared_ptr<Function const>> functions;  ///< those of the prelude first
  std::unordered_map<std::string, int> function_index;     ///< those of the script
  std::unordered_map<std::string, int> method_index;       ///< those of the prelude: methods, the receiver comes first
  std::vector<std::string> globals;
};

}  // namespace lapwing::dolphin
