#include "dolphin/check/flow/vehicle_flow.hpp"

#include <algorithm>
#include <utility>

#include "dolphin/check/flow/internal/execute_check.hpp"
#include "dolphin/check/flow/internal/flow_changes.hpp"
#include "dolphin/check/flow/internal/vehicle_facts.hpp"
#include "dolphin/syntax/ast_walk.hpp"

namespace lapwing::dolphin {

namespace {

class VehicleFlow {
 public:
  VehicleFlow(ast::Program const& program, Resolution const& resolution, Inference& inference, TaskShapes& tasks,
              base::Diagnostics& diagnostics)
      : program_(program),
        resolution_(resolution),
        inference_(inference),
        tasks_(tasks),
        diagnostics_(diagnostics),
        deferred_(deferred_changes(program, resolution)) {}

  void run() {
    if (deferred_.picks) state_.note_pick(std::nullopt);
    block(program_.body);
    in_function_ = true;
    for (auto const& statement : program_.body.statements) {
      auto const* function = std::get_if<ast::FunctionDecl>(&statement->node);
      if (!function) continue;
      state_ = {};
      state_.note_pick(std::nullopt);
      is_dead_ = false;
      block(function->body);
    }
  }

 private:
  using Set = std::optional<VehicleSet>;

  // ---- statements

  void block(ast::Block const& block) {
    for (auto const& statement : block.statements) {
      if (is_dead_) return;
      std::visit([&](auto const& node) { follow(node); }, statement->node);
    }
  }

  void follow(ast::ExprStmt const& n) {
    (void)value(*n.expr);
    auto const* call = std::get_if<ast::Call>(&n.expr->node);
    is_dead_ = call && called_instruction(*call, resolution_) == "halt";
  }
  void follow(ast::Assign const& n) {
    auto const set = value(*n.value);
    assign(n, *n.target, set);
    for (auto const& target : n.more) assign(n, *target, set);
  }
  void assign(ast::Assign const& n, ast::Expr const& target, Set const& set) {
    if (!std::holds_alternative<ast::Name>(target.node)) return (void)value(target);
    auto const* variable = resolution_.find(target);
    if (set && !n.op && !n.unpacks && is_followed(variable)) return state_.assign(variable, *set);
    state_.forget(variable);
  }
  void follow(ast::VarDecl const& n) {
    auto set = n.value ? value(*n.value) : Set();
    for (auto const& name : n.names) {
      auto const* variable = resolution_.find(name);
      if (set && !n.unpacks && is_followed(variable)) {
        state_.assign(variable, *set);
      } else {
        state_.forget(variable);
      }
    }
  }
  void follow(ast::If const& n) {
    (void)value(*n.condition);
    FlowChanges changes;
    bool const then_goes_on = branch(n.then, changes);
    bool const else_goes_on = !n.otherwise || branch(*n.otherwise, changes);
    unsettle(changes);
    is_dead_ = !then_goes_on && !else_goes_on;
  }
  void follow(ast::While const& n) {
    FlowChanges changes;
    changes.add(*n.condition, resolution_);
    loop(n.body, std::move(changes), n.condition.get());
  }
  void follow(ast::For const& n) {
    if (n.init) std::visit([&](auto const& node) { follow(node); }, n.init->node);
    FlowChanges changes;
    if (n.condition) changes.add(*n.condition, resolution_);
    if (n.update) changes.add(*n.update, resolution_);
    loop(n.body, std::move(changes), n.condition.get());
  }
  void follow(ast::ForIn const& n) {
    (void)value(*n.iterable);
    FlowChanges changes;
    changes.assigned.insert(resolution_.find(n.variable));
    loop(n.body, std::move(changes), nullptr);
  }
  void follow(ast::Switch const& n) {
    (void)value(*n.subject);
    FlowChanges changes;
    for (auto const& one : n.cases) changes.add(one.body, resolution_);
    unsettle(changes);  // a case may fall through to the next
    for (auto const& one : n.cases) apart(one.body);
  }
  void follow(ast::Try const& n) {
    FlowChanges changes;
    changes.add(n.body, resolution_);
    auto const outer = std::exchange(in_try_, in_try_ || !n.catches.empty());
    apart(n.body);
    in_try_ = outer;
    unsettle(changes);
    for (auto const& one : n.catches) {
      apart(one.body);
      changes.add(one.body, resolution_);
    }
    unsettle(changes);
    if (n.finally) block(*n.finally);
  }
  void follow(ast::Return const& n) { leave(n.value.get()); }
  void follow(ast::Throw const& n) { leave(n.value.get()); }
  void follow(ast::Break const&) { is_dead_ = true; }
  void follow(ast::Continue const&) { is_dead_ = true; }
  void follow(ast::Assert const& n) { (void)value(*n.condition); }
  void follow(ast::FunctionDecl const&) {}
  void follow(ast::Import const&) {}

  void leave(ast::Expr const* result) {
    if (result) (void)value(*result);
    is_dead_ = true;
  }

  /// Follows one of several ways and forgets what happened on it; whether the way comes to its end.
  bool apart(ast::Block const& way) {
    auto const before = state_.mark();
    block(way);
    state_.undo(before);
    return !std::exchange(is_dead_, false);
  }
  /// A way that comes to its end adds what it may have changed.
  bool branch(ast::Block const& way, FlowChanges& changes) {
    bool const goes_on = apart(way);
    if (goes_on) changes.add(way, resolution_);
    return goes_on;
  }

  /// Each turn may find what an earlier one left; so may the code behind the loop.
  void loop(ast::Block const& body, FlowChanges changes, ast::Expr const* condition) {
    changes.add(body, resolution_);
    unsettle(changes);
    auto const before = state_.mark();
    if (condition) (void)value(*condition);
    block(body);
    state_.undo(before);
    is_dead_ = false;
  }

  /// Makes unknown what that code may have changed.
  void unsettle(FlowChanges const& changes) {
    for (auto const& [name, place] : changes.released) {
      auto const* variable = resolution_.find(*name);
      if (!changes.assigned.contains(variable)) release(variable, place, Released::maybe);
    }
    for (auto const* variable : changes.assigned) state_.forget(variable);
    if (changes.picks || (changes.calls && deferred_.picks)) state_.note_pick(std::nullopt);
  }

  // ---- expressions

  /// Does what the expression does; the vehicles it gives, when they are known.
  Set value(ast::Expr const& expr) {
    if (std::holds_alternative<ast::Name>(expr.node)) {
      auto const* variable = resolution_.find(expr);
      auto const* known = is_followed(variable) ? state_.find(variable) : nullptr;
      return known ? Set(*known) : Set();
    }
    if (std::holds_alternative<ast::Closure>(expr.node)) return std::nullopt;
    if (auto const* call = std::get_if<ast::Call>(&expr.node)) return value_of_call(*call, expr.span);
    if (auto const* binary = std::get_if<ast::Binary>(&expr.node)) return value_of_binary(*binary);
    if (auto const* ternary = std::get_if<ast::Ternary>(&expr.node)) {
      (void)value(*ternary->condition);
      perhaps(*ternary->if_true);
      perhaps(*ternary->if_false);
      return std::nullopt;
    }
    ast::for_each_child(expr.node, [this](auto const& child) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(child)>, ast::Expr>) (void)value(child);
    });
    return std::nullopt;
  }

  /// Code that may be passed over.
  void perhaps(ast::Expr const& expr) {
    FlowChanges changes;
    changes.add(expr, resolution_);
    unsettle(changes);
  }

  Set value_of_binary(ast::Binary const& binary) {
    using enum ast::BinaryOp;
    auto left = value(*binary.left);
    if (binary.op == logical_and || binary.op == logical_or || binary.op == elvis) {
      perhaps(*binary.right);
      return std::nullopt;
    }
    auto const right = value(*binary.right);
    if (!left) return std::nullopt;
    bool const is_filter = binary.op == bit_or && std::holds_alternative<ast::Closure>(binary.right->node);
    bool const keeps_part = binary.op == subtract || binary.op == bit_and || is_filter;
    if (binary.op == add) return right ? united(*left, *right) : Set();
    left->is_part = true;
    return keeps_part ? std::move(left) : Set();
  }

  Set value_of_call(ast::Call const& call, base::Span span) {
    auto const instruction = called_instruction(call, resolution_);
    if (instruction.empty()) (void)value(*call.callee);
    std::vector<Set> arguments;
    for (auto const& argument : call.arguments) arguments.push_back(value(*argument.value));
    if (instruction == "pick") return picked(call);
    if (instruction == "release" && arguments.size() == 1) {
      auto const& what = *call.arguments[0].value;
      if (std::holds_alternative<ast::Name>(what.node)) release(resolution_.find(what), span, Released::yes);
    } else if (instruction == "execute" && !in_try_) {
      check_execute({resolution_, tasks_, state_, diagnostics_}, call);
    }
    bool const runs_code = instruction.empty() || instruction == "execute";
    if (runs_code && deferred_.picks) state_.note_pick(std::nullopt);
    return std::nullopt;
  }

  void release(Variable const* variable, base::Span place, Released is) {
    if (!variable || !is_followed(variable)) return;
    if (!state_.find(variable)) state_.assign(variable, {{state_.add({place, {}, {}, {}})}, {}});
    auto const& set = *state_.find(variable);
    if (set.is_part) return;  // which of them is not known
    for (auto const pick : set.picks) state_.release(pick, is, place);
  }

  /// Variables of which every change is seen here.
  [[nodiscard]] bool is_followed(Variable const* variable) const {
    if (!variable || deferred_.assigned.contains(variable)) return false;
    return !in_function_ || variable->kind != VariableKind::global;
  }

  // ---- pick

  Set picked(ast::Call const& call) {
    auto const* body = call.arguments.size() == 1 ? std::get_if<ast::Closure>(&call.arguments[0].value->node) : nullptr;
    if (!body) {
      state_.note_pick(std::nullopt);
      return std::nullopt;
    }
    Pick made{call.callee->span, 1, {}, {}};
    for (auto const& statement : body->body.statements) {
      auto const* expr = std::get_if<ast::ExprStmt>(&statement->node);
      auto const* field = expr ? std::get_if<ast::Call>(&expr->expr->node) : nullptr;
      if (!field || !read_field(*field, made)) {
        made.count.reset();  // other code may set any field
        made.type.clear();
      }
    }
    state_.note_pick(made.count);
    auto const count = made.count;
    return VehicleSet{{state_.add(std::move(made))}, count};
  }

  bool read_field(ast::Call const& field, Pick& out) {
    auto const* name = std::get_if<ast::Name>(&field.callee->node);
    if (!name) return false;
    auto const constant = field.arguments.size() == 1 ? inference_.constant(*field.arguments[0].value) : std::nullopt;
    if (name->text == "count") {
      auto const* count = constant ? std::get_if<std::int64_t>(&*constant) : nullptr;
      out.count = count && *count > 0 ? std::optional(static_cast<std::size_t>(*count)) : std::nullopt;
    } else if (name->text == "type") {
      auto const* type = constant ? std::get_if<std::string>(&*constant) : nullptr;
      out.type = type ? *type : "";
    } else if (name->text == "payload") {
      for (auto const& argument : field.arguments) {
        auto const value = inference_.constant(*argument.value);
        if (value && std::holds_alternative<std::string>(*value)) out.payload.push_back(std::get<std::string>(*value));
      }
    }
    return name->text == "count" || name->text == "type" || name->text == "payload" || name->text == "id" ||
           name->text == "region" || name->text == "timeout";
  }

  ast::Program const& program_;
  Resolution const& resolution_;
  Inference& inference_;
  TaskShapes& tasks_;
  base::Diagnostics& diagnostics_;
  DeferredChanges deferred_;
  VehicleState state_;
  bool in_function_ = false;
  bool in_try_ = false;
  bool is_dead_ = false;  ///< nothing comes here
};

}  // namespace

void check_vehicle_flow(ast::Program const& program, Resolution const& resolution, Inference& inference,
                        TaskShapes& tasks, base::Diagnostics& diagnostics) {
  VehicleFlow(program, resolution, inference, tasks, diagnostics).run();
}

}  // namespace lapwing::dolphin
