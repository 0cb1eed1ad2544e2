#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/text/diagnostic.hpp"
#include "dolphin/code/bytecode.hpp"
#include "dolphin/code/internal/function_builder.hpp"
#include "dolphin/names/declared_type.hpp"
#include "dolphin/syntax/ast.hpp"
#include "dolphin/syntax/codes.hpp"
#include "tasks/vocabulary.hpp"

namespace lapwing::dolphin::internal {

/// The builder blocks of the language itself, beside the platform's.
struct BlockWords {
  std::string_view name;
  std::vector<std::string_view> commands;
};
[[nodiscard]] std::span<BlockWords const> built_in_blocks();
/// `Math`, `Float` ...: names that stand for types unless the script has a variable of that name.
[[nodiscard]] bool is_type_name(std::string_view name);

/// One walk over a tree. Functions are compiled as they are met; `function_` is the one being put together.
class Compilation {
 public:
  /// `vocabulary` outlives it.
  Compilation(Program& program, tasks::Vocabulary const& vocabulary, base::Diagnostics& diagnostics)
      : program_(program), vocabulary_(vocabulary), diagnostics_(diagnostics) {}

  /// Declares the functions of `tree`, then compiles them and its other statements, whose function is returned.
  [[nodiscard]] std::shared_ptr<Function const> script(ast::Program const& tree, bool is_library);
  /// The value of one expression.
  [[nodiscard]] std::shared_ptr<Function const> answer(ast::Expr const& expr);

 private:
  static constexpr int nowhere = -1;

  struct Loop {
    std::vector<int> breaks;
    std::vector<int> continues;
    std::size_t finallies = 0;  ///< round the loop
    bool is_switch = false;
  };
  struct Finally {
    int local = 0;
    std::vector<int> calls;
  };
  /// One of the functions that share a name.
  struct Overload {
    ast::FunctionDecl const* declaration;
    int index;  ///< in the program
  };
  /// What belongs to one function but not to what it becomes.
  struct Surroundings {
    std::vector<Loop> loops;
    std::vector<Finally> finallies;
  };

  // statements
  void declare_functions(ast::Block const& block);
  [[nodiscard]] int index_of(ast::FunctionDecl const& declaration) const;
  /// The function of that name that takes so many arguments, else the first of that name; nothing when there is none.
  [[nodiscard]] std::optional<int> function_for(std::string const& name, std::size_t arguments) const;
  /// `sink`: the local that gets the value of its last statement.
  void block(ast::Block const& block, int sink = nowhere);
  void value_statement(ast::Stmt const& stmt, int sink);
  /// Returns the value of the block's last statement from the function.
  void body(ast::Block const& block);
  void last_statement(ast::Stmt const& stmt);
  void statement(ast::Stmt const& stmt);
  void assign(ast::Assign const& assign, bool keeps_value);
  void assign_several(ast::Assign const& assign, bool keeps_value);
  void assign_to(ast::Expr const& target, std::optional<ast::BinaryOp> op, bool keeps_value,
                 std::function<void()> const& push_value);
  void hold(std::string_view type, std::string const& variable, Holder holder);
  void declare_variables(ast::VarDecl const& decl);
  void if_statement(ast::If const& node, int sink = nowhere);
  void do_loop(ast::While const& node);
  void while_loop(ast::While const& node);
  void for_loop(ast::For const& node);
  void for_in_loop(ast::ForIn const& node);
  void switch_statement(ast::Switch const& node, int sink = nowhere);
  void try_statement(ast::Try const& node, int sink = nowhere);
  void catches(ast::Try const& node, int begin, int end, int sink);
  void leave(bool is_break, base::Span span);
  void return_statement(ast::Return const& node);
  void assert_statement(ast::Assert const& node);
  void close_loop();
  void run_finallies(std::size_t down_to);

  // expressions
  void expression(ast::Expr const& expr);
  void expression_node(ast::Expr const& expr);
  void name(std::string const& name, base::Span span);
  void text(std::string const& text);
  void gstring(ast::GString const& node);
  void binary(ast::Binary const& node);
  void ternary(ast::Ternary const& node);
  void step(ast::Step const& node);
  void member(ast::Member const& node);
  void each_element(ast::Expr const& object, std::function<void()> const& push_value);
  void map_literal(ast::MapLiteral const& node);
  void closure(ast::Closure const& node);
  std::shared_ptr<Function const> function(std::string name, std::vector<ast::Parameter> const& parameters, bool has_it,
                                           ast::Block const& body, FunctionBuilder* enclosing);
  void load(std::string const& name);
  void store(std::string const& name);
  [[nodiscard]] int global(std::string const& name);

  // calls
  void call(ast::Call const& node, base::Span span);
  void named_call(std::string const& name, ast::Call const& node, base::Span span);
  bool block_command(std::string const& name, ast::Call const& node);
  bool block_call(std::string const& name, ast::Call const& node);
  void method_call(ast::Member const& callee, ast::Call const& node);
  void keyed_call(std::string const& native, ast::Call const& node);
  void native_call(std::string_view name, int arguments, base::Span span);
  void vehicle_instruction(tasks::VehicleInstruction const& instruction, ast::Call const& node, base::Span span);
  void check_count(std::string_view name, ArgumentCount takes, int count, base::Span span);
  /// Pushes them, named ones gathered into a map that comes first; returns how many values that makes.
  int arguments(std::vector<ast::Argument> const& arguments);
  void named_arguments(std::vector<ast::Argument> const& arguments);
  void displacement_argument(ast::Closure const& node);
  void built(std::string_view block, ast::Closure const& node);
  void chain(ast::Chain const& node, base::Span span);
  [[nodiscard]] bool is_variable(std::string const& name);
  [[nodiscard]] bool has_command(std::string_view block, std::string_view command) const;
  [[nodiscard]] bool is_platform_block(std::string_view name) const;

  Program& program_;
  tasks::Vocabulary const& vocabulary_;
  base::Diagnostics& diagnostics_;
  std::unordered_map<std::string, int>* functions_ = nullptr;  ///< of the program, script's or prelude's
  std::map<std::string, std::vector<Overload>> overloads_;
  std::map<std::string, int> globals_;
  FunctionBuilder* function_ = nullptr;
  Surroundings surroundings_;
  std::vector<std::string> blocks_;  ///< the builder blocks that the text stands in, outermost first
  bool is_library_ = false;
};

}  // namespace lapwing::dolphin::internal
