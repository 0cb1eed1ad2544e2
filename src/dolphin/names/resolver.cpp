#include "dolphin/names/resolver.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "dolphin/syntax/ast_walk.hpp"

namespace lapwing::dolphin {

namespace {

class Resolver {
 public:
  explicit Resolver(ast::Program const& program) : program_(program) {}

  Resolution run() {
    scopes_.emplace_back();
    for (statement_ = 0; statement_ < program_.body.statements.size(); ++statement_)
      walk(*program_.body.statements[statement_]);
    for (auto const name : changed_globals_) {
      if (auto const found = globals_.find(name); found != globals_.end()) found->second->has_other_values = true;
    }
    return std::move(out_);
  }

 private:
  using Scope = std::unordered_map<std::string_view, Variable*>;

  /// Names declared until it ends are local to it.
  class Inside {
   public:
    explicit Inside(Resolver& resolver) : resolver_(resolver) { resolver_.scopes_.emplace_back(); }
    Inside(Inside const&) = delete;
    Inside& operator=(Inside const&) = delete;
    ~Inside() { resolver_.scopes_.pop_back(); }

   private:
    Resolver& resolver_;
  };

  Variable* local(std::string_view name) const {
    for (auto scope = scopes_.size(); scope-- > first_visible_;) {
      if (auto const found = scopes_[scope].find(name); found != scopes_[scope].end()) return found->second;
    }
    return nullptr;
  }

  Variable& declare(ast::Identifier const& name, VariableKind kind) {
    auto& made = out_.variables.emplace_back();
    made.name = name.text;
    made.kind = kind;
    made.defined = name.span;
    out_.locals.emplace(&name, &made);
    if (!scopes_.back().insert_or_assign(made.name, &made).second) out_.redeclared.push_back(&name);
    return made;
  }

  Variable& global(std::string const& name, base::Span place) {
    if (auto const found = globals_.find(name); found != globals_.end()) return *found->second;
    auto& made = out_.variables.emplace_back();
    made.name = name;
    made.defined = place;
    made.first_statement = in_function_ ? 0 : statement_;
    globals_.emplace(made.name, &made);
    out_.globals.emplace(made.name, &made);
    return made;
  }

  void use(void const* where, std::string_view name) {
    if (auto const* found = local(name)) out_.locals.emplace(where, found);
  }

  void walk(ast::Block const& block) {
    Inside const inside(*this);
    for (auto const& statement : block.statements) walk(*statement);
  }
  void walk(ast::ExprPtr const& expr) {
    if (expr) walk(*expr);
  }
  void walk_children(auto const& node) {
    ast::for_each_child(node, [&](auto const& child) { walk(child); });
  }

  // ---- statements

  void walk(ast::Stmt const& statement) {
    std::visit([this](auto const& node) { visit(node); }, statement.node);
  }
  void visit(ast::ExprStmt const& n) { walk(n.expr); }
  void visit(ast::Return const& n) { walk(n.value); }
  void visit(ast::Throw const& n) { walk(n.value); }
  void visit(ast::Break const&) {}
  void visit(ast::Continue const&) {}
  void visit(ast::Import const&) {}
  void visit(ast::Assert const& n) {
    walk(n.condition);
    walk(n.message);
  }
  void visit(ast::Assign const& n) {
    walk(n.value);
    assign(n, *n.target);
    for (auto const& target : n.more) assign(n, *target);
  }
  void assign(ast::Assign const& n, ast::Expr const& target) {
    auto const* name = std::get_if<ast::Name>(&target.node);
    if (!name || n.op) walk(target);
    if (!name) return;
    auto* variable = local(name->text);
    if (!variable && !n.op) variable = &global(name->text, target.span);
    if (!variable) changed_globals_.push_back(name->text);
    if (!variable) return;
    if (variable->kind != VariableKind::global) out_.locals.emplace(&target, variable);
    if (n.op || n.unpacks) {
      variable->has_other_values = true;
    } else {
      variable->values.push_back(n.value.get());
    }
    if (in_function_) variable->first_statement = 0;
  }
  void visit(ast::VarDecl const& n) {
    walk(n.value);
    for (auto const& name : n.names) {
      auto& variable = declare(name, VariableKind::local);
      variable.type = n.type ? &*n.type : nullptr;
      variable.has_other_values = n.unpacks || !n.value || n.type;
      if (n.value && !n.unpacks) variable.values.push_back(n.value.get());
    }
  }
  void visit(ast::FunctionDecl const& n) {
    out_.functions[n.name.text].push_back(&n);
    auto const visible = std::exchange(first_visible_, scopes_.size());
    auto const outer = std::exchange(in_function_, true);
    {
      Inside const inside(*this);
      declare_parameters(n.parameters);
      walk(n.body);
    }
    in_function_ = outer;
    first_visible_ = visible;
  }
  void visit(ast::If const& n) {
    walk(n.condition);
    walk(n.then);
    if (n.otherwise) walk(*n.otherwise);
  }
  void visit(ast::While const& n) {
    if (n.body_first) walk(n.body);
    walk(n.condition);
    if (!n.body_first) walk(n.body);
  }
  void visit(ast::For const& n) {
    Inside const inside(*this);
    if (n.init) walk(*n.init);
    walk(n.condition);
    if (n.update) walk(*n.update);
    walk(n.body);
  }
  void visit(ast::ForIn const& n) {
    walk(n.iterable);
    Inside const inside(*this);
    declare(n.variable, VariableKind::local).has_other_values = true;
    walk(n.body);
  }
  void visit(ast::Switch const& n) {
    walk(n.subject);
    for (auto const& one : n.cases) {
      walk(one.value);
      walk(one.body);
    }
  }
  void visit(ast::Try const& n) {
    walk(n.body);
    for (auto const& one : n.catches) {
      Inside const inside(*this);
      declare(one.name, VariableKind::local).has_other_values = true;
      walk(one.body);
    }
    if (n.finally) walk(*n.finally);
  }

  // ---- expressions

  void walk(ast::Expr const& expr) {
    if (auto const* name = std::get_if<ast::Name>(&expr.node)) return use(&expr, name->text);
    if (auto const* closure = std::get_if<ast::Closure>(&expr.node)) return walk_closure(*closure);
    if (auto const* call = std::get_if<ast::Call>(&expr.node)) note_keys(*call);
    if (auto const* step = std::get_if<ast::Step>(&expr.node)) note_step(*step);
    walk_children(expr.node);
  }

  void note_keys(ast::Call const& call) {
    for (auto const& argument : call.arguments) {
      if (argument.name) use(&*argument.name, argument.name->text);
    }
  }

  void note_step(ast::Step const& step) {
    auto const* name = std::get_if<ast::Name>(&step.target->node);
    auto* variable = name ? local(name->text) : nullptr;
    if (variable) variable->has_other_values = true;
    if (!variable && name) changed_globals_.push_back(name->text);
  }

  void walk_closure(ast::Closure const& closure) {
    Inside const inside(*this);
    if (!closure.has_arrow) {
      auto& it = out_.variables.emplace_back();
      it.name = "it";
      it.kind = VariableKind::parameter;
      it.has_other_values = true;
      scopes_.back().emplace(it.name, &it);
    }
    declare_parameters(closure.parameters);
    walk(closure.body);
  }

  void declare_parameters(std::vector<ast::Parameter> const& parameters) {
    for (auto const& parameter : parameters) {
      walk(parameter.fallback);
      auto& variable = declare(parameter.name, VariableKind::parameter);
      variable.has_other_values = true;
      variable.type = parameter.type ? &*parameter.type : nullptr;
    }
  }

  ast::Program const& program_;
  Resolution out_;
  std::unordered_map<std::string_view, Variable*> globals_;
  std::vector<Scope> scopes_;
  std::size_t first_visible_ = 0;                  ///< scopes below belong to code that a function does not see
  std::vector<std::string_view> changed_globals_;  ///< by += or ++, perhaps before they are known
  bool in_function_ = false;
  std::size_t statement_ = 0;
};

}  // namespace

Variable const* Resolution::find(ast::Expr const& name) const {
  if (auto const found = locals.find(&name); found != locals.end()) return found->second;
  auto const found = globals.find(std::get<ast::Name>(name.node).text);
  return found == globals.end() ? nullptr : found->second;
}

Variable const* Resolution::find(ast::Identifier const& key) const {
  if (auto const found = locals.find(&key); found != locals.end()) return found->second;
  auto const found = globals.find(key.text);
  return found == globals.end() ? nullptr : found->second;
}

Resolution resolve(ast::Program const& program, InstructionTable instructions) {
  auto resolution = Resolver(program).run();
  resolution.instructions = std::move(instructions);
  return resolution;
}

}  // namespace lapwing::dolphin
