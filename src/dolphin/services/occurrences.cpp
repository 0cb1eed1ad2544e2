#include "dolphin/services/occurrences.hpp"

#include <algorithm>
#include <utility>

#include "dolphin/syntax/ast_walk.hpp"

namespace lapwing::dolphin {

namespace {

using base::Span;

template <class Spec>
Spec const* find_by_name(std::span<Spec const> table, std::string_view name) {
  auto const found = std::ranges::find(table, name, &Spec::name);
  return found == table.end() ? nullptr : &*found;
}

class Collector {
 public:
  Collector(Document const& document, Scopes& scopes) : document_(document), scopes_(scopes) {
    for (auto const& variable : document.resolution().variables) {
      if (variable.kind != VariableKind::global && variable.defined.size() > 0)
        declared_.emplace(variable.defined.begin, &variable);
    }
  }

  std::vector<Occurrence> run() {
    scope_ = {0, static_cast<std::uint32_t>(document_.source().text().size())};
    block(document_.program().body);
    std::ranges::stable_sort(out_, {}, [](Occurrence const& one) { return one.span.begin; });
    return std::move(out_);
  }

 private:
  Occurrence& add(Span span, WordKind kind) { return out_.emplace_back(Occurrence{.span = span, .kind = kind}); }

  // ---- names

  void variable(Span span, Variable const* variable) {
    if (!variable) return;
    auto& made = add(span, WordKind::variable);
    made.variable = variable;
    made.is_definition = variable->defined.begin == span.begin && variable->defined.size() > 0;
  }
  void declaration(ast::Identifier const& name, Span scope) {
    auto const found = declared_.find(name.span.begin);
    if (found == declared_.end()) return;
    scopes_.of_locals.emplace(found->second, scope);
    variable(name.span, found->second);
  }
  void type(ast::Identifier const& type) {
    if (auto const* spec = find_by_name(types(), type.text)) add(type.span, WordKind::type).name = spec;
  }
  void name(ast::Expr const& expr) {
    auto const& text = std::get<ast::Name>(expr.node).text;
    if (auto const* found = document_.resolution().find(expr)) return variable(expr.span, found);
    if (auto const* constant = find_by_name(constants(), text)) add(expr.span, WordKind::constant).name = constant;
    if (auto const* type = find_by_name(types(), text)) add(expr.span, WordKind::type).name = type;
  }
  /// A word in quotes; texts with escapes or three quotes are left alone.
  void quoted(ast::Expr const& expr, WordKind kind, bool is_definition) {
    auto const* literal = std::get_if<ast::StringLiteral>(&expr.node);
    if (!literal || literal->value.empty() || expr.span.size() != literal->value.size() + 2) return;
    add({expr.span.begin + 1, expr.span.end - 1}, kind).is_definition = is_definition;
  }

  // ---- statements

  void block(ast::Block const& block) {
    auto const outer = std::exchange(scope_, block.span.size() > 0 ? block.span : scope_);
    if (&block == &document_.program().body) scope_ = outer;
    for (auto const& one : block.statements) statement(*one);
    scope_ = outer;
  }
  void statement(ast::Stmt const& one) {
    std::visit([&](auto const& node) { visit(node, one); }, one.node);
  }

  template <class Node>
  void visit(Node const&, ast::Stmt const& one) {
    ast::for_each_child(one.node, child_);
  }
  void visit(ast::VarDecl const& n, ast::Stmt const&) {
    if (n.type) type(*n.type);
    for (auto const& name : n.names) declaration(name, scope_);
    expression(n.value);
  }
  void visit(ast::FunctionDecl const& n, ast::Stmt const& one) {
    auto const found = document_.resolution().functions.find(n.name.text);
    auto& made = add(n.name.span, WordKind::function);
    made.functions = &found->second;
    made.is_definition = true;
    scopes_.functions.push_back(one.span);
    auto const blocks = std::exchange(blocks_, {});
    parameters(n.parameters, one.span);
    block(n.body);
    blocks_ = blocks;
  }
  void visit(ast::If const& n, ast::Stmt const&) {
    expression(n.condition);
    block(n.then);
    if (n.otherwise) block(*n.otherwise);
  }
  void visit(ast::While const& n, ast::Stmt const&) {
    if (!n.body_first) expression(n.condition);
    block(n.body);
    if (n.body_first) expression(n.condition);
  }
  void visit(ast::For const& n, ast::Stmt const& one) {
    auto const outer = std::exchange(scope_, one.span);
    if (n.init) statement(*n.init);
    expression(n.condition);
    if (n.update) statement(*n.update);
    block(n.body);
    scope_ = outer;
  }
  void visit(ast::ForIn const& n, ast::Stmt const& one) {
    declaration(n.variable, one.span);
    expression(n.iterable);
    block(n.body);
  }
  void visit(ast::Switch const& n, ast::Stmt const& one) {
    expression(n.subject);
    auto const outer = std::exchange(scope_, one.span);
    for (auto const& branch : n.cases) {
      expression(branch.value);
      block(branch.body);
    }
    scope_ = outer;
  }
  void visit(ast::Try const& n, ast::Stmt const&) {
    block(n.body);
    for (auto const& one : n.catches) {
      for (auto const& caught : one.types) type(caught);
      declaration(one.name, cover(one.name.span, one.body.span));
      block(one.body);
    }
    if (n.finally) block(*n.finally);
  }

  // ---- expressions

  void expression(ast::ExprPtr const& expr) {
    if (expr) expression(*expr);
  }
  void expression(ast::Expr const& expr) {
    if (auto const* call = std::get_if<ast::Call>(&expr.node)) return this->call(*call);
    if (auto const* chain = std::get_if<ast::Chain>(&expr.node)) return this->chain(*chain);
    if (auto const* closure = std::get_if<ast::Closure>(&expr.node)) return this->closure(*closure, expr.span, nullptr);
    if (std::holds_alternative<ast::Name>(expr.node)) return name(expr);
    if (auto const* member = std::get_if<ast::Member>(&expr.node)) this->member(*member, false);
    if (auto const* cast = std::get_if<ast::Cast>(&expr.node)) type(cast->type);
    if (auto const* test = std::get_if<ast::InstanceOf>(&expr.node)) type(test->type);
    if (auto const* made = std::get_if<ast::New>(&expr.node)) type(made->type);
    ast::for_each_child(expr.node, child_);
  }

  void closure(ast::Closure const& closure, Span span, BlockWords const* words) {
    if (!closure.has_arrow) scopes_.implicit_parameters.push_back(span);
    if (words) blocks_.push_back(words);
    parameters(closure.parameters, span);
    block(closure.body);
    if (words) blocks_.pop_back();
  }
  void parameters(std::vector<ast::Parameter> const& parameters, Span scope) {
    for (auto const& parameter : parameters) {
      if (parameter.type) type(*parameter.type);
      declaration(parameter.name, scope);
      expression(parameter.fallback);
    }
  }

  void chain(ast::Chain const& n) {
    auto const words = chain_words();
    auto const is_head = [&](ChainSpec const& one) {
      return one.kind == n.kind && (one.name == "otherwise") == n.is_otherwise;
    };
    add(n.head_span, WordKind::chain).chain = &*std::ranges::find_if(words, is_head);
    expression(n.subject);
    auto const* handler = n.body ? std::get_if<ast::Closure>(&n.body->node) : nullptr;
    if (n.kind == ast::ChainKind::watch && handler) {
      return closure(*handler, n.body->span, document_.vocabulary().block("onError"));
    }
    expression(n.body);
  }

  void member(ast::Member const& n, bool is_call) {
    auto const facts = document_.facts(*n.object);
    auto const* unit = is_call || !facts.kinds.meets(Kinds::number()) ? nullptr : find_by_name(units(), n.name.text);
    if (unit && (facts.is_number() || facts.kinds.is_any())) {
      add(n.name.span, WordKind::unit).unit = unit;
      return;
    }
    auto const fits = [&](MethodSpec const& one) { return one.name == n.name.text && one.receiver.meets(facts.kinds); };
    auto const found = std::ranges::find_if(methods(), fits);
    if (found == methods().end()) return;
    auto& made = add(n.name.span, WordKind::member);
    made.method = &*found;
    made.is_call = is_call;
  }

  // ---- calls

  void call(ast::Call const& n) {
    BlockWords const* block = nullptr;
    auto named = NamedArguments::none;
    if (auto const* callee = std::get_if<ast::Name>(&n.callee->node)) {
      auto const first = out_.size();
      this->callee(*n.callee, callee->text);
      if (out_.size() > first) {
        auto& made = out_.back();
        made.is_call = true;
        if (made.instruction && made.kind == WordKind::instruction) named = made.instruction->named;
        if (made.kind == WordKind::instruction || made.kind == WordKind::builder)
          block = document_.vocabulary().block(callee->text);
        quoted_arguments(n, made.kind, callee->text);
      }
    } else if (auto const* member = std::get_if<ast::Member>(&n.callee->node)) {
      this->member(*member, true);
      expression(member->object);
    } else {
      expression(n.callee);
    }
    for (auto const& argument : n.arguments) this->argument(argument, named, block);
  }

  /// In the order in which the checker looks (REC-36: words of blocks first).
  void callee(ast::Expr const& expr, std::string const& text) {
    for (auto words = blocks_.rbegin(); words != blocks_.rend(); ++words) {
      auto const* found = find_by_name((*words)->words, text);
      if (!found) continue;
      auto& made = add(expr.span, WordKind::command);
      made.instruction = found;
      made.block = *words;
      return;
    }
    auto const& resolution = document_.resolution();
    if (resolution.locals.contains(&expr)) return variable(expr.span, resolution.find(expr));
    if (auto const found = resolution.functions.find(text); found != resolution.functions.end()) {
      add(expr.span, WordKind::function).functions = &found->second;
    } else if (auto const* instruction = resolution.instructions.find(text)) {
      add(expr.span, WordKind::instruction).instruction = instruction;
    } else if (document_.vocabulary().builder(text)) {
      add(expr.span, WordKind::builder).block = document_.vocabulary().block(text);
    } else {
      variable(expr.span, resolution.find(expr));
    }
  }

  void quoted_arguments(ast::Call const& n, WordKind kind, std::string_view callee) {
    if (n.arguments.empty() || n.arguments[0].name) return;
    auto const& first = *n.arguments[0].value;
    if (kind == WordKind::command && callee == "name") quoted(first, WordKind::plan, true);
    if (kind != WordKind::instruction) return;
    if (callee == "task" || callee == "imcPlan") quoted(first, WordKind::plan, false);
    if (callee == "poll") quoted(first, WordKind::signal, false);
  }

  void argument(ast::Argument const& argument, NamedArguments named, BlockWords const* block) {
    if (argument.name) {
      auto span = argument.name->span;
      bool const in_quotes = span.size() == argument.name->text.size() + 2;
      if (in_quotes) span = {span.begin + 1, span.end - 1};
      bool const is_plain = span.size() == argument.name->text.size();
      if (is_plain && named == NamedArguments::vehicles) variable(span, document_.resolution().find(*argument.name));
      if (is_plain && named == NamedArguments::values) add(span, WordKind::signal);
    }
    auto const* body = argument.value ? std::get_if<ast::Closure>(&argument.value->node) : nullptr;
    if (body && block) return closure(*body, argument.value->span, block);
    expression(argument.value);
  }

  struct Child {
    Collector& self;
    void operator()(ast::Stmt const& one) const { self.statement(one); }
    void operator()(ast::Expr const& one) const { self.expression(one); }
  };

  Document const& document_;
  Scopes& scopes_;
  std::unordered_map<std::uint32_t, Variable const*> declared_;
  std::vector<Occurrence> out_;
  std::vector<BlockWords const*> blocks_;
  Span scope_;
  Child child_{*this};
};

}  // namespace

std::vector<Occurrence> find_occurrences(Document const& document, Scopes& scopes) {
  return Collector(document, scopes).run();
}

}  // namespace lapwing::dolphin
