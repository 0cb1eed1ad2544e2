#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "dolphin/check/flow/rehearsal.hpp"
#include "dolphin/check/inference.hpp"
#include "dolphin/names/resolver.hpp"
#include "dolphin/syntax/ast.hpp"
#include "tasks/platform.hpp"

namespace lapwing::dolphin {

/// What is sure of a task before it runs.
struct TaskShape {
  std::size_t vehicles = 0;  ///< it needs at least so many at once
  bool never_ends = false;   ///< by itself
};

/// Reads task expressions: operators, chains, choices, and variables that hold one task all the time. What it does not
/// understand needs no vehicle and ends, so that it never claims too much.
class TaskShapes {
 public:
  TaskShapes(Resolution const& resolution, Inference& inference, std::span<tasks::BuilderSpec const> builders)
      : resolution_(resolution), inference_(inference), builders_(builders) {}

  [[nodiscard]] TaskShape of(ast::Expr const& task) { return of(task, max_depth); }
  /// Of the parts that run at once, the one that needs the vehicle after the first `others`.
  [[nodiscard]] ast::Expr const& taker(ast::Expr const& task, std::size_t others);
  ast::Expr const& taker(ast::Expr const&& task, std::size_t others) = delete;  ///< it may be the very one
  /// The platform's blocks in it (`mission { ... }`), some dozens at most.
  [[nodiscard]] std::vector<ast::Expr const*> blocks(ast::Expr const& task);
  /// The block with which a task certainly begins, or ends when it has run to its end; null when that is not certain.
  [[nodiscard]] ast::Expr const* beginning(ast::Expr const& task) { return edge(task, true, max_depth); }
  [[nodiscard]] ast::Expr const* ending(ast::Expr const& task) { return edge(task, false, max_depth); }
  /// What a block makes when that can be told before it runs; null otherwise.
  [[nodiscard]] std::shared_ptr<tasks::PlatformTask const> built(ast::Expr const& block);
  /// Each block is built once, however often it is asked for.
  [[nodiscard]] Rehearsal const& rehearsed(ast::Closure const& body, tasks::BuilderSpec const& builder);

 private:
  static constexpr int max_depth = 64;
  static constexpr std::size_t max_blocks = 50;

  TaskShape of(ast::Expr const& task, int depth);
  TaskShape of_call(ast::Call const& call, int depth);
  TaskShape of_binary(ast::Binary const& binary, int depth);
  TaskShape of_chain(ast::Chain const& chain, int depth);
  TaskShape of_variable(Variable const& variable, int depth);
  ast::Expr const* edge(ast::Expr const& task, bool is_begin, int depth);
  [[nodiscard]] tasks::BuilderSpec const* builder_of(ast::Expr const& expr) const;
  void add_blocks(ast::Expr const& task, int depth, std::vector<ast::Expr const*>& out);

  Resolution const& resolution_;
  Inference& inference_;
  std::span<tasks::BuilderSpec const> builders_;
  std::unordered_map<Variable const*, TaskShape> variables_;
  std::unordered_map<ast::Closure const*, Rehearsal> rehearsed_;
};

/// The one value that a variable holds all the time, or null.
[[nodiscard]] ast::Expr const* only_value(Variable const* variable);
/// The name of the instruction that is called, or nothing when it is something of the script.
[[nodiscard]] std::string_view called_instruction(ast::Call const& call, Resolution const& resolution);

}  // namespace lapwing::dolphin
