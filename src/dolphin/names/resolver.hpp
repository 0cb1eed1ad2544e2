#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "dolphin/names/instruction_table.hpp"
#include "dolphin/syntax/ast.hpp"

/// Which variable a name means (language specification 1.6, Scoping; REC-14).
namespace lapwing::dolphin {

enum class VariableKind {
  global,     ///< assigned without a declaration, anywhere
  local,      ///< declared: def, a type, for, catch
  parameter,  ///< of a function or closure, `it` included
};

struct Variable {
  std::string name;
  VariableKind kind = VariableKind::global;
  base::Span defined;                     ///< the first place that gives it a value
  ast::Identifier const* type = nullptr;  ///< as declared; null for def
  std::vector<ast::Expr const*> values;   ///< every expression that is assigned to it
  bool has_other_values = false;    ///< also gets values that are no expression of the script: parameters, loops, steps
  std::size_t first_statement = 0;  ///< statement of the script with the first assignment; 0 when a function assigns it
};

/// What names mean in one script. Points into its tree.
struct Resolution {
  std::deque<Variable> variables;
  std::unordered_map<std::string_view, Variable const*> globals;
  std::unordered_map<std::string_view, std::vector<ast::FunctionDecl const*>> functions;
  /// Names (Expr), keys of `execute` and declared names (Identifier) that mean something other than a global.
  std::unordered_map<void const*, Variable const*> locals;
  std::vector<ast::Identifier const*> redeclared;  ///< declared a second time in the same scope
  InstructionTable instructions;

  /// The variable, or null when the name is defined nowhere.
  [[nodiscard]] Variable const* find(ast::Expr const& name) const;
  [[nodiscard]] Variable const* find(ast::Identifier const& key) const;
};

/// `instructions`: those that the script can give.
[[nodiscard]] Resolution resolve(ast::Program const& program, InstructionTable instructions = {});

}  // namespace lapwing::dolphin
