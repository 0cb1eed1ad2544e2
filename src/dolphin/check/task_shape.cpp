#include "dolphin/check/internal/task_shape.hpp"

#include <algorithm>
#include <string_view>

#include "dolphin/syntax/ast_walk.hpp"

namespace lapwing::dolphin {

namespace {

constexpr std::size_t many = 1'000'000;  ///< sums stop here: names for names for names can double without end

TaskShape one_after_another(TaskShape a, TaskShape b) {
  return {std::max(a.vehicles, b.vehicles), a.never_ends || b.never_ends};
}
TaskShape at_once(TaskShape a, TaskShape b) {
  return {std::min(a.vehicles + b.vehicles, many), a.never_ends || b.never_ends};
}
TaskShape ended_from_outside(TaskShape a) {
  return {a.vehicles, false};
}

/// The branches of oneOf, choose and allOf.
std::vector<ast::Chain const*> branches(ast::Call const& call) {
  std::vector<ast::Chain const*> out;
  auto const* body = call.arguments.empty() ? nullptr : std::get_if<ast::Closure>(&call.arguments.back().value->node);
  if (!body) return out;
  for (auto const& statement : body->body.statements) {
    auto const* expr = std::get_if<ast::ExprStmt>(&statement->node);
    auto const* chain = expr ? std::get_if<ast::Chain>(&expr->expr->node) : nullptr;
    if (chain && chain->kind == ast::ChainKind::when) out.push_back(chain);
  }
  return out;
}

bool moves_nothing(ast::Expr const& task, Resolution const& resolution) {
  auto const* call = std::get_if<ast::Call>(&task.node);
  auto const instruction = call ? called_instruction(*call, resolution) : std::string_view();
  return instruction == "action" || instruction == "condition" || instruction == "idle";
}

bool is_choice(std::string_view instruction) {
  return instruction == "oneOf" || instruction == "choose" || instruction == "allOf";
}

}  // namespace

ast::Expr const* only_value(Variable const* variable) {
  bool const has_one = variable && !variable->has_other_values && variable->values.size() == 1;
  return has_one ? variable->values.front() : nullptr;
}

std::string_view called_instruction(ast::Call const& call, Resolution const& resolution) {
  auto const* name = std::get_if<ast::Name>(&call.callee->node);
  if (!name || resolution.locals.contains(call.callee.get()) || resolution.functions.contains(name->text)) return {};
  return resolution.instructions.find(name->text) ? std::string_view(name->text) : std::string_view();
}

TaskShape TaskShapes::of(ast::Expr const& task, int depth) {
  if (depth <= 0) return {};
  if (std::holds_alternative<ast::Name>(task.node)) {
    auto const* variable = resolution_.find(task);
    return only_value(variable) ? of_variable(*variable, depth) : TaskShape();
  }
  if (auto const* call = std::get_if<ast::Call>(&task.node)) {
    if (!builder_of(task)) return of_call(*call, depth);
    auto const block = built(task);
    return {1, block && block->never_ends()};
  }
  if (auto const* binary = std::get_if<ast::Binary>(&task.node)) return of_binary(*binary, depth);
  if (auto const* chain = std::get_if<ast::Chain>(&task.node)) return of_chain(*chain, depth);
  if (auto const* index = std::get_if<ast::Index>(&task.node)) return of(*index->object, depth - 1);
  return {};
}

TaskShape TaskShapes::of_variable(Variable const& variable, int depth) {
  if (auto const known = variables_.find(&variable); known != variables_.end()) return known->second;
  variables_.emplace(&variable, TaskShape());  // a variable whose value depends on itself
  auto const out = of(*variable.values.front(), depth - 1);
  variables_[&variable] = out;
  return out;
}

TaskShape TaskShapes::of_call(ast::Call const& call, int depth) {
  auto const instruction = called_instruction(call, resolution_);
  if (instruction == "task" || instruction == "imcPlan") return {1, false};
  if (instruction == "idle") return {0, call.arguments.empty()};
  if (!is_choice(instruction)) return {};
  TaskShape out;
  for (auto const* branch : branches(call))
    out.vehicles = std::max(out.vehicles, of(*branch->body, depth - 1).vehicles);
  return out;
}

TaskShape TaskShapes::of_binary(ast::Binary const& binary, int depth) {
  auto const left = of(*binary.left, depth - 1);
  switch (binary.op) {
    case ast::BinaryOp::shift_right: return one_after_another(left, of(*binary.right, depth - 1));
    case ast::BinaryOp::bit_or: return at_once(left, of(*binary.right, depth - 1));
    case ast::BinaryOp::divide: return ended_from_outside(left);
    default: return {};
  }
}

TaskShape TaskShapes::of_chain(ast::Chain const& chain, int depth) {
  switch (chain.kind) {
    case ast::ChainKind::wait_for:
    case ast::ChainKind::when: return of(*chain.body, depth - 1);
    case ast::ChainKind::until:
    case ast::ChainKind::during: return ended_from_outside(of(*chain.body, depth - 1));
    case ast::ChainKind::watch: return of(*chain.subject, depth - 1);
  }
  return {};
}

ast::Expr const& TaskShapes::taker(ast::Expr const& task, std::size_t others) {
  auto const* chain = std::get_if<ast::Chain>(&task.node);
  if (chain) return taker(chain->kind == ast::ChainKind::watch ? *chain->subject : *chain->body, others);
  auto const* binary = std::get_if<ast::Binary>(&task.node);
  if (!binary) return task;
  if (binary->op == ast::BinaryOp::bit_or) {
    auto const left = of(*binary->left).vehicles;
    return left > others ? taker(*binary->left, others) : taker(*binary->right, others - left);
  }
  if (binary->op == ast::BinaryOp::divide) return taker(*binary->left, others);
  if (binary->op != ast::BinaryOp::shift_right) return task;
  return taker(of(*binary->left).vehicles > others ? *binary->left : *binary->right, others);
}

// ---- blocks of the platform ---------------------------------------------------------------------

tasks::BuilderSpec const* TaskShapes::builder_of(ast::Expr const& expr) const {
  auto const* call = std::get_if<ast::Call>(&expr.node);
  auto const* name = call ? std::get_if<ast::Name>(&call->callee->node) : nullptr;
  bool const is_own = name && (resolution_.locals.contains(call->callee.get()) ||
                               resolution_.functions.contains(name->text) || resolution_.instructions.find(name->text));
  if (!name || is_own) return nullptr;
  auto const found = std::ranges::find(builders_, name->text, &tasks::BuilderSpec::name);
  return found == builders_.end() ? nullptr : &*found;
}

std::vector<ast::Expr const*> TaskShapes::blocks(ast::Expr const& task) {
  std::vector<ast::Expr const*> out;
  add_blocks(task, max_depth, out);
  return out;
}

void TaskShapes::add_blocks(ast::Expr const& task, int depth, std::vector<ast::Expr const*>& out) {
  if (depth <= 0 || out.size() >= max_blocks) return;
  if (builder_of(task)) {
    if (std::ranges::find(out, &task) == out.end()) out.push_back(&task);
    return;
  }
  if (std::holds_alternative<ast::Name>(task.node)) {
    if (auto const* value = only_value(resolution_.find(task))) add_blocks(*value, depth - 1, out);
    return;
  }
  if (auto const* call = std::get_if<ast::Call>(&task.node)) {
    if (!is_choice(called_instruction(*call, resolution_))) return;
    for (auto const* branch : branches(*call)) add_blocks(*branch->body, depth - 1, out);
  } else if (auto const* binary = std::get_if<ast::Binary>(&task.node)) {
    add_blocks(*binary->left, depth - 1, out);
    if (binary->op != ast::BinaryOp::divide) add_blocks(*binary->right, depth - 1, out);
  } else if (auto const* chain = std::get_if<ast::Chain>(&task.node)) {
    add_blocks(chain->kind == ast::ChainKind::watch ? *chain->subject : *chain->body, depth - 1, out);
  } else if (auto const* index = std::get_if<ast::Index>(&task.node)) {
    add_blocks(*index->object, depth - 1, out);
  }
}

ast::Expr const* TaskShapes::edge(ast::Expr const& task, bool is_begin, int depth) {
  if (depth <= 0) return nullptr;
  if (builder_of(task)) return &task;
  if (std::holds_alternative<ast::Name>(task.node)) {
    auto const* value = only_value(resolution_.find(task));
    return value ? edge(*value, is_begin, depth - 1) : nullptr;
  }
  if (auto const* index = std::get_if<ast::Index>(&task.node)) return edge(*index->object, is_begin, depth - 1);
  if (auto const* chain = std::get_if<ast::Chain>(&task.node)) {
    bool const runs_whole = chain->kind == ast::ChainKind::wait_for;
    return runs_whole ? edge(*chain->body, is_begin, depth - 1) : nullptr;
  }
  auto const* binary = std::get_if<ast::Binary>(&task.node);
  if (!binary) return nullptr;
  if (binary->op == ast::BinaryOp::divide) return is_begin ? edge(*binary->left, true, depth - 1) : nullptr;
  if (binary->op != ast::BinaryOp::shift_right) return nullptr;
  auto const& near = is_begin ? *binary->left : *binary->right;
  auto const& far = is_begin ? *binary->right : *binary->left;
  return edge(moves_nothing(near, resolution_) ? far : near, is_begin, depth - 1);
}

std::shared_ptr<tasks::PlatformTask const> TaskShapes::built(ast::Expr const& block) {
  auto const* builder = builder_of(block);
  auto const& call = std::get<ast::Call>(block.node);
  auto const* body = call.arguments.size() == 1 ? std::get_if<ast::Closure>(&call.arguments[0].value->node) : nullptr;
  return builder && builder->begin && body ? rehearsed(*body, *builder).task : nullptr;
}

Rehearsal const& TaskShapes::rehearsed(ast::Closure const& body, tasks::BuilderSpec const& builder) {
  auto const known = rehearsed_.find(&body);
  return known != rehearsed_.end() ? known->second
                                   : rehearsed_.emplace(&body, rehearsal(body, builder, inference_)).first->second;
}

}  // namespace lapwing::dolphin
