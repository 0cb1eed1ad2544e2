#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tasks/vocabulary.hpp"

namespace lapwing::base {
template <class T>
class Task;
}

/// What the language knows by name: instructions, fields of blocks, units, methods, constants, types. One table for the
/// checker, hover texts, completion, the reference and the machine; what a platform adds comes as a `tasks::Vocabulary`
/// beside it. The rows stand beside the functions that carry them out, in builtin/.
namespace lapwing::dolphin {

using tasks::Dimension;

// The machine, known here by its names alone: whoever only reads a row needs none of it.
class Fiber;
class Value;
struct Fault;
struct MethodCall;
struct Runtime;
using Arguments = std::span<Value const>;
/// Carries an instruction out at once.
using NativeFunction = std::expected<Value, Fault> (*)(Runtime&, Fiber&, Arguments);
/// Suspends the calling fiber until the task has ended.
using WaitingNative = base::Task<std::expected<Value, Fault>> (*)(Runtime&, Fiber&, std::vector<Value>);
/// Carries a method or property out; nothing where it is not for this receiver or these arguments.
using MethodFunction = std::optional<std::expected<Value, Fault>> (*)(MethodCall const&, Value const& receiver);

/// Kinds of values, one bit each so that a parameter can take several.
enum class Kind : std::uint16_t {
  boolean = 1u << 0u,
  integer = 1u << 1u,
  decimal = 1u << 2u,
  text = 1u << 3u,
  position = 1u << 4u,
  displacement = 1u << 5u,
  area = 1u << 6u,
  vehicles = 1u << 7u,
  task = 1u << 8u,
  closure = 1u << 9u,
  list = 1u << 10u,
  map = 1u << 11u,
  other = 1u << 12u,  ///< ranges, exceptions, null
};

/// A set of kinds.
class Kinds {
 public:
  constexpr Kinds() = default;
  constexpr Kinds(Kind kind)
      : bits_(static_cast<std::uint16_t>(kind)) {}  // NOLINT(google-explicit-constructor): a kind is a set of one
  [[nodiscard]] static constexpr Kinds any() { return Kinds(std::uint16_t{0x1FFF}); }
  [[nodiscard]] static constexpr Kinds number() { return Kinds(Kind::integer) | Kinds(Kind::decimal); }
  [[nodiscard]] static constexpr Kinds none() { return {}; }

  [[nodiscard]] constexpr bool meets(Kinds other) const { return (bits_ & other.bits_) != 0; }
  [[nodiscard]] constexpr bool within(Kinds other) const { return (bits_ & ~other.bits_) == 0; }
  [[nodiscard]] constexpr bool is_none() const { return bits_ == 0; }
  [[nodiscard]] constexpr bool is_any() const { return *this == any(); }
  friend constexpr Kinds operator|(Kinds a, Kinds b) { return Kinds(static_cast<std::uint16_t>(a.bits_ | b.bits_)); }
  friend constexpr bool operator==(Kinds, Kinds) = default;

 private:
  explicit constexpr Kinds(std::uint16_t bits) : bits_(bits) {}
  std::uint16_t bits_ = 0;
};

/// "a number", "text or a closure".
[[nodiscard]] std::string describe(Kinds kinds);
/// "a length", "a time"; "a plain number" for none.
[[nodiscard]] std::string_view noun(Dimension dimension);

struct ParameterSpec {
  std::string_view name;
  Kinds kinds = Kinds::any();
  Dimension dimension =
      Dimension::none;    ///< numbers with another one are refused; none takes plain numbers and all others
  bool optional = false;  ///< trailing ones only
  std::vector<std::string_view> choices = {};
  std::string_view doc = {};
  Kinds items = Kinds::any();  ///< of a list: what it holds; the dimension is theirs
};

struct SignatureSpec {
  std::vector<ParameterSpec> parameters;
  bool repeats = false;  ///< the last parameter may come any number of times
};

/// What may be written as `name: value` in a call.
enum class NamedArguments {
  none,
  values,    ///< names of signals or parameters
  vehicles,  ///< variables that hold vehicle sets, or `_`
};

/// Words that are instructions only within the block of one instruction: the fields of `pick`, `when`, `ignore()`.
enum class BlockKind { none, pick, position, displacement, choice, handler, platform };

/// An instruction: what it is called and given, what is said of it, and what carries it out: `call`, `start` or both,
/// of which guards, which cannot wait, get `call`. Blocks have neither where the machine opens them.
struct InstructionSpec {
  std::string_view name;
  std::vector<SignatureSpec> signatures = {};  ///< none, for what the compiler alone calls: any arguments
  Kinds result = Kinds::none();                ///< none: used for what it does
  std::string_view doc = {};
  NamedArguments named = NamedArguments::none;
  BlockKind block = BlockKind::none;      ///< what is known inside its closure
  Dimension dimension = Dimension::none;  ///< of a number it gives
  std::string_view example = {};          ///< a script that checks
  NativeFunction call = nullptr;
  WaitingNative start = nullptr;
  std::string_view source = {};  ///< its function where it is written in the language itself
  bool is_pure = false;          ///< depends on its arguments alone: allowed in the answer to `ask`
};

struct UnitSpec {
  std::string_view name;
  double factor;  ///< to metres, seconds, degrees or 1
  Dimension dimension;
  std::string_view doc;
};

/// What stands behind a point: what it is called and given, what is said of it, and what carries it out: `call`, or for
/// what that leaves a function of the prelude. Names may have several rows; the first one that does it is it.
struct MethodSpec {
  Kinds receiver;
  std::string_view name;
  std::string_view arguments;  ///< what stands in its parentheses: "closure", "from, to?", "values..."
  Kinds result;
  std::string_view doc;
  std::string_view example = {};  ///< an expression whose value shows what it does
  MethodFunction call = nullptr;
  std::string_view source = {};  ///< its function where it is written in the language itself
  bool is_property = false;      ///< written without parentheses
  bool is_pure = false;          ///< may stand in the answer to `ask`, if what it is given may
};
///< what stands in its parentheses: "closure", "from, to?", "values..."
/// How many arguments a method or instruction takes.
struct ArgumentCount {
  std::size_t least = 0;
  std::size_t most = 0;
  [[nodiscard]] bool allows(std::size_t count) const { return count >= least && count <= most; }
};
[[nodiscard]] ArgumentCount argument_count(MethodSpec const& method);
/// Over all its signatures.
[[nodiscard]] ArgumentCount argument_count(InstructionSpec const& instruction);

struct NameSpec {
  std::string_view name;
  std::string_view doc;
};

[[nodiscard]] std::span<InstructionSpec const> instructions();
/// What stands in the closure of onError.
[[nodiscard]] std::span<InstructionSpec const> handler_words();
/// The words that are known only inside a block of that kind.
[[nodiscard]] std::span<InstructionSpec const> block_words(BlockKind kind);
[[nodiscard]] std::span<UnitSpec const> units();
[[nodiscard]] std::span<MethodSpec const> methods();
/// Values with a name: PI, NaN.
[[nodiscard]] std::span<NameSpec const> constants();
/// Types that may stand before a point, after `new`, `as`, `instanceof` and in `catch`.
[[nodiscard]] std::span<NameSpec const> types();

/// A command of a platform's block, in the form of the language's own instructions.
[[nodiscard]] InstructionSpec instruction_of(tasks::CommandSpec const& command);
/// A platform's instruction, in the same form.
[[nodiscard]] InstructionSpec instruction_of(tasks::VehicleInstruction const& instruction);

}  // namespace lapwing::dolphin
