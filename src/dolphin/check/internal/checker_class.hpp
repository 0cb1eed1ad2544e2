#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "base/text/diagnostic.hpp"
#include "dolphin/check/inference.hpp"
#include "dolphin/check/internal/task_shape.hpp"
#include "dolphin/names/resolver.hpp"
#include "dolphin/names/signatures.hpp"
#include "dolphin/syntax/ast.hpp"
#include "dolphin/syntax/codes.hpp"

namespace lapwing::dolphin {

/// The words that a block adds while its closure is checked.
struct BlockContext {
  BlockKind kind = BlockKind::none;
  std::string_view name;
  std::span<InstructionSpec const> words;
};

/// A platform's block word with its commands in the language's own form.
struct Builder {
  tasks::BuilderSpec const* spec;
  std::vector<InstructionSpec> words;
};

/// One pass over a tree.
class Checker {
 public:
  /// `vocabulary` outlives it.
  Checker(ast::Program const& program, tasks::Vocabulary const& vocabulary, base::Diagnostics& diagnostics);
  void run();

 private:
  /// What `return`, `break` and the value of the last statement mean where the pass is.
  struct Place {
    bool in_closure = false;  ///< code that runs later than where it stands
    bool in_loop = false;
    bool in_switch = false;
    bool in_task = false;         ///< code that running tasks call: actions, guards, handlers
    bool can_be_stopped = false;  ///< part of a task that a guard or time limit ends
  };

  // ---- statements (checker.cpp)
  void block(ast::Block const& block, bool is_value);
  void statement(ast::Stmt const& statement, bool is_value);
  void check(ast::ExprStmt const& n, ast::Stmt const& statement, bool is_value);
  void check(ast::Assign const& n, ast::Stmt const& statement, bool is_value);
  void check(ast::VarDecl const& n, ast::Stmt const& statement, bool is_value);
  void check(ast::FunctionDecl const& n, ast::Stmt const& statement, bool is_value);
  void check(ast::If const& n, ast::Stmt const& statement, bool is_value);
  void check(ast::While const& n, ast::Stmt const& statement, bool is_value);
  void check(ast::For const& n, ast::Stmt const& statement, bool is_value);
  void check(ast::ForIn const& n, ast::Stmt const& statement, bool is_value);
  void check(ast::Switch const& n, ast::Stmt const& statement, bool is_value);
  void check(ast::Try const& n, ast::Stmt const& statement, bool is_value);
  void check(ast::Throw const& n, ast::Stmt const& statement, bool is_value);
  void check(ast::Return const& n, ast::Stmt const& statement, bool is_value);
  void check(ast::Break const& n, ast::Stmt const& statement, bool is_value);
  void check(ast::Continue const& n, ast::Stmt const& statement, bool is_value);
  void check(ast::Assert const& n, ast::Stmt const& statement, bool is_value);
  void check(ast::Import const& n, ast::Stmt const& statement, bool is_value);
  void loop_body(ast::Block const& body);
  void spinning(ast::Expr const* condition, ast::Block const& body, ast::Stmt const& statement);
  void assigned(ast::Assign const& n, ast::Expr const& target);
  void assigned_field(ast::Expr const& target);
  void function_overloads();
  [[nodiscard]] std::string_view ends_with(ast::Stmt const& statement);
  [[nodiscard]] std::string_view ends_with(ast::Call const& call);

  // ---- expressions (checker_expressions.cpp)
  void expression(ast::ExprPtr const& expr);
  void expression(ast::Expr const& expr);
  void name(ast::Expr const& expr);
  void undefined_name(std::string const& name, base::Span span);
  bool used_too_early(ast::Expr const& expr, Variable const& variable);
  void closure(ast::Closure const& closure, std::optional<BlockContext> context);
  void pattern(ast::PatternLiteral const& literal, base::Span span);
  void index(ast::Expr const& expr);
  void map(ast::MapLiteral const& map);
  void chain(ast::Expr const& expr);
  void otherwise(ast::Chain const& chain);

  // ---- operators (checker_operators.cpp)
  void operation(ast::Binary const& binary);
  void operands(ast::Binary const& binary);
  void dimensions(ast::Binary const& binary);
  bool missing_parentheses(ast::Expr const& expr, ast::Binary const& binary);
  void battery_comparison(ast::Binary const& binary);
  [[nodiscard]] std::string of_one_vehicle(ast::Expr const& expr);

  // ---- calls (checker_calls.cpp)
  void call(ast::Expr const& expr);
  void instruction_call(ast::Call const& call, base::Span span, InstructionSpec const& spec);
  void function_call(ast::Call const& call, base::Span span, std::vector<ast::FunctionDecl const*> const& functions);
  [[nodiscard]] bool is_closure(ast::Call const& call, Variable const& variable);
  void closure_call(ast::Call const& call, base::Span span, Variable const& variable);
  void builder_call(ast::Call const& call, base::Span span, Builder const& builder);
  void undefined_call(ast::Call const& call, base::Span span);
  void value_call(ast::Call const& call);
  void arguments(ast::Call const& call, std::optional<BlockContext> context);
  void duplicate_keys(ast::Call const& call);
  void vehicle_keys(ast::Call const& call, InstructionSpec const& spec);
  void connection_timeout(ast::Expr const& value);
  void signatures(ast::Call const& call, base::Span span, InstructionSpec const& spec);
  [[nodiscard]] std::optional<std::size_t> mismatch(ast::Call const& call, SignatureSpec const& signature);
  void report_mismatch(ast::Call const& call, InstructionSpec const& spec, SignatureSpec const& signature,
                       std::size_t position);
  void areas(ast::Call const& call, InstructionSpec const& spec);
  [[nodiscard]] std::optional<std::size_t> wrong_item(ast::Expr const& value, ParameterSpec const& parameter);
  void report_item(ast::Expr const& item, std::size_t number, InstructionSpec const& spec,
                   ParameterSpec const& parameter);
  void rehearse(ast::Closure const& body, Builder const& builder, base::Span span);

  // ---- behind a point (checks/methods.cpp)
  void member(ast::Expr const& expr);
  void unit(ast::Member const& n);
  void method_call(ast::Call const& call);
  void unknown_method(ast::Member const& callee, Kinds kinds, bool is_property);
  [[nodiscard]] bool is_function_of_type(ast::Member const& callee);
  [[nodiscard]] bool may_be_key(std::string const& name);

  // ---- types, signals, statements that do nothing (checks/statements.cpp)
  void unused_value(ast::Expr const& expr);
  void duplicate_cases(ast::Switch const& n);
  void type_name(ast::Identifier const& type);
  void caught_type(ast::Identifier const& type);
  void declared_type(ast::Identifier const& type);
  void declared_value(ast::Identifier const& name, std::string_view type, ast::Expr const& value);
  void declared_arguments(ast::Call const& call, ast::FunctionDecl const& function);
  void hidden_instructions();
  void note_signals(ast::Call const& call, std::string_view instruction);
  void unposted_signals();

  // ---- tasks (checker_tasks.cpp)
  void empty_choice(ast::Call const& call, InstructionSpec const& spec);
  void consuming_guard(ast::Expr const& guard);
  void single_vehicle(ast::Call const& call, InstructionSpec const& spec);
  [[nodiscard]] std::size_t least_vehicles(ast::Expr const& set, int depth);
  void values(ast::Call const& call, InstructionSpec const& spec);
  void vehicle_type(ast::Call const& call);
  void value(ast::Expr const& expr, base::DiagnosticKind const& kind, double least, double most, std::string_view what);
  void endless_sequence(ast::Binary const& binary);
  void landed_sequence(ast::Binary const& binary);
  void landed_executes(ast::Block const& block);
  void landed(ast::Expr const& before, ast::Expr const& after);
  [[nodiscard]] ast::Argument const* execution_on_one(ast::Stmt const& statement);
  void unused_tasks();

  // ---- names (checker_expressions.cpp)
  [[nodiscard]] InstructionSpec const* block_word(std::string_view name) const;
  [[nodiscard]] Builder const* find_builder(std::string_view name) const;
  [[nodiscard]] bool is_callable(std::string_view name) const;
  [[nodiscard]] bool may_be_defined_in_unread(std::string_view name) const;
  [[nodiscard]] base::Hint suggestion(std::string_view name, base::Span span) const;
  /// "stands inside mission { ... }" for a word that is known only there.
  [[nodiscard]] std::string block_of(std::string_view name) const;
  [[nodiscard]] std::string hint_in_mission(std::string_view name) const;

  ast::Program const& program_;
  base::Diagnostics& diagnostics_;
  Resolution resolution_;
  Inference inference_;
  std::vector<Builder> builders_;
  std::vector<BlockContext> contexts_;
  std::unordered_set<std::string> unread_names_;
  std::optional<std::unordered_set<std::string>> map_keys_;    ///< made when it is needed first
  std::optional<std::unordered_set<std::string>> made_types_;  ///< behind `new`; made when it is needed first
  /// A signal that is consumed or polled.
  struct Awaited {
    std::string name;
    base::Span span;
    bool is_taken;
  };
  std::vector<Awaited> awaited_;
  std::set<std::string, std::less<>> posted_;
  bool posts_unknown_ = false;
  std::unordered_set<std::string> reported_;  ///< undefined names, each once
  std::unordered_set<std::string_view> locals_;
  std::unordered_set<Variable const*> read_;
  bool names_plans_ = false;  ///< task('name'): a mission may be executed by its name
  TaskShapes tasks_;
  Place place_;
  std::size_t top_statement_ = 0;
  Variable const* defining_ = nullptr;  ///< the global that the value being checked is the first one of
};

}  // namespace lapwing::dolphin
