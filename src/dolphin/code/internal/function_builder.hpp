#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dolphin/code/bytecode.hpp"

namespace lapwing::dolphin::internal {

/// Puts one function together: code, constants, and the variables in scope while its text is walked through.
///
/// Every variable has a slot of its own. Which ones closures capture is known only at the end: `finish` then turns the
/// instructions of those into their cell forms.
class FunctionBuilder {
 public:
  FunctionBuilder(FunctionBuilder* enclosing, std::string name) : enclosing_(enclosing) {
    function_.name = std::move(name);
  }

  [[nodiscard]] Function& function() { return function_; }
  [[nodiscard]] FunctionBuilder* enclosing() const { return enclosing_; }

  /// The line that instructions belong to from now on.
  void at_line(std::uint32_t line) { line_ = line; }
  [[nodiscard]] std::uint32_t line() const { return line_; }

  /// Returns the instruction's place, for `patch`.
  int emit(Op op, int a = 0, int b = 0);
  [[nodiscard]] int here() const { return static_cast<int>(function_.code.size()); }
  void patch(int instruction) { patch(instruction, here()); }
  void patch(int instruction, int target) { function_.code[static_cast<std::size_t>(instruction)].a = target; }
  void emit_constant(Value value);
  [[nodiscard]] int name(std::string_view text);

  void open_scope() { scopes_.emplace_back(); }
  void close_scope() { scopes_.pop_back(); }
  /// `type`: empty when none was declared.
  int declare(std::string const& variable, std::string_view type = {});
  /// The declared type of a local variable or one of an enclosing function; empty when there is none.
  [[nodiscard]] std::string_view type_of(std::string const& variable) const;
  /// A slot without a name.
  int hidden() { return new_slot(); }
  [[nodiscard]] std::optional<int> find_local(std::string const& variable) const;
  /// The index among this function's captures of a variable of an enclosing one.
  [[nodiscard]] std::optional<int> capture(std::string const& variable);

  [[nodiscard]] std::shared_ptr<Function const> finish();

 private:
  int new_slot();

  FunctionBuilder* enclosing_;
  Function function_;
  std::vector<std::map<std::string, int>> scopes_{1};
  std::vector<bool> is_captured_;
  std::map<int, std::string> types_;  ///< of slots
  std::map<std::pair<bool, int>, int> capture_index_;
  std::map<std::string, int, std::less<>> name_index_;
  std::uint32_t line_ = 0;
};

}  // namespace lapwing::dolphin::internal
