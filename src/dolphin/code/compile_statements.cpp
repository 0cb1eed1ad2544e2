#include <algorithm>
#include <variant>

#include "dolphin/code/internal/compilation.hpp"
#include "dolphin/names/declared_type.hpp"
#include "dolphin/value/objects.hpp"

namespace lapwing::dolphin::internal {
void Compilation::declare_functions(ast::Block const& block) {
  for (auto const& stmt : block.statements) {
    auto const* decl = std::get_if<ast::FunctionDecl>(&stmt->node);
    if (!decl) continue;
    auto const index = static_cast<int>(program_.functions.size());
    functions_->try_emplace(decl->name.text, index);
    overloads_[decl->name.text].push_back({decl, index});
    program_.functions.emplace_back();
  }
}

int Compilation::index_of(ast::FunctionDecl const& declaration) const {
  auto const found = overloads_.find(declaration.name.text);
  if (found == overloads_.end()) return -1;
  auto const overload = std::ranges::find(found->second, &declaration, &Overload::declaration);
  return overload == found->second.end() ? -1 : overload->index;
}

std::optional<int> Compilation::function_for(std::string const& name, std::size_t arguments) const {
  auto const found = overloads_.find(name);
  if (found == overloads_.end()) return std::nullopt;
  auto const takes = [&](Overload const& overload) {
    auto const& parameters = overload.declaration->parameters;
    auto const has_no_default = [](ast::Parameter const& parameter) { return !parameter.fallback; };
    auto const required = std::ranges::count_if(parameters, has_no_default);
    return arguments >= static_cast<std::size_t>(required) && arguments <= parameters.size();
  };
  auto const fitting = std::ranges::find_if(found->second, takes);
  return fitting == found->second.end() ? found->second.front().index : fitting->index;
}

void Compilation::block(ast::Block const& block, int sink) {
  auto const& statements = block.statements;
  // `case 1: 'one'; break` has the value that stands before the break.
  bool const breaks = statements.size() > 1 && std::holds_alternative<ast::Break>(statements.back()->node);
  auto const last = statements.size() - (breaks ? 1 : 0);
  function_->open_scope();
  for (std::size_t i = 0; i < statements.size(); ++i) {
    if (sink != nowhere && i + 1 == last) {
      value_statement(*statements[i], sink);
    } else {
      statement(*statements[i]);
    }
  }
  function_->close_scope();
}

/// A statement whose value goes into a local: the last one of a block that gives a value.
void Compilation::value_statement(ast::Stmt const& stmt, int sink) {
  function_->at_line(diagnostics_.source().line(stmt.span.begin));
  if (auto const* node = std::get_if<ast::ExprStmt>(&stmt.node)) {
    expression(*node->expr);
    function_->emit(Op::store_local, sink);
  } else if (auto const* assignment = std::get_if<ast::Assign>(&stmt.node)) {
    assign(*assignment, true);
    function_->emit(Op::store_local, sink);
  } else if (auto const* choice = std::get_if<ast::If>(&stmt.node)) {
    if_statement(*choice, sink);
  } else if (auto const* cases = std::get_if<ast::Switch>(&stmt.node)) {
    switch_statement(*cases, sink);
  } else if (auto const* guarded = std::get_if<ast::Try>(&stmt.node)) {
    try_statement(*guarded, sink);
  } else {
    statement(stmt);
  }
}

void Compilation::body(ast::Block const& block) {
  function_->open_scope();
  for (std::size_t i = 0; i + 1 < block.statements.size(); ++i) statement(*block.statements[i]);
  if (!block.statements.empty()) last_statement(*block.statements.back());
  if (block.statements.empty()) {
    function_->emit(Op::null);
    function_->emit(Op::return_value);
  }
  function_->close_scope();
}

void Compilation::last_statement(ast::Stmt const& stmt) {
  function_->at_line(diagnostics_.source().line(stmt.span.begin));
  if (auto const* node = std::get_if<ast::ExprStmt>(&stmt.node)) {
    expression(*node->expr);
  } else if (auto const* assignment = std::get_if<ast::Assign>(&stmt.node)) {
    assign(*assignment, true);
  } else if (auto const* choice = std::get_if<ast::If>(&stmt.node)) {
    expression(*choice->condition);
    int const otherwise = function_->emit(Op::jump_if_false);
    body(choice->then);
    function_->patch(otherwise);
    if (choice->otherwise) return body(*choice->otherwise);
    function_->emit(Op::null);
  } else {
    int const sink = function_->hidden();
    function_->emit(Op::null);
    function_->emit(Op::store_local, sink);
    value_statement(stmt, sink);
    function_->emit(Op::load_local, sink);
  }
  function_->emit(Op::return_value);
}

void Compilation::statement(ast::Stmt const& stmt) {
  function_->at_line(diagnostics_.source().line(stmt.span.begin));
  struct Visitor {
    Compilation& self;
    base::Span span;
    void operator()(ast::ExprStmt const& node) const {
      self.expression(*node.expr);
      self.function_->emit(Op::pop);
    }
    void operator()(ast::Assign const& node) const { self.assign(node, false); }
    void operator()(ast::VarDecl const& node) const { self.declare_variables(node); }
    void operator()(ast::FunctionDecl const& node) const {
      int const index = self.index_of(node);
      if (index < 0 || self.function_->enclosing()) {
        return self.diagnostics_.report(code("nested-function"), node.name.span,
                                        "functions are declared at the top level of a script",
                                        "use a closure: def " + node.name.text + " = { ... }");
      }
      // Functions see global variables only, so there is no enclosing function.
      self.program_.functions[static_cast<std::size_t>(index)] =
          self.function(node.name.text, node.parameters, false, node.body, nullptr);
    }
    void operator()(ast::If const& node) const { self.if_statement(node); }
    void operator()(ast::While const& node) const { self.while_loop(node); }
    void operator()(ast::For const& node) const { self.for_loop(node); }
    void operator()(ast::ForIn const& node) const { self.for_in_loop(node); }
    void operator()(ast::Switch const& node) const { self.switch_statement(node); }
    void operator()(ast::Try const& node) const { self.try_statement(node); }
    void operator()(ast::Throw const& node) const {
      self.expression(*node.value);
      self.function_->emit(Op::throw_value);
    }
    void operator()(ast::Return const& node) const { self.return_statement(node); }
    void operator()(ast::Break const&) const { self.leave(true, span); }
    void operator()(ast::Continue const&) const { self.leave(false, span); }
    void operator()(ast::Assert const& node) const { self.assert_statement(node); }
    void operator()(ast::Import const&) const {}
  };
  std::visit(Visitor{*this, stmt.span}, stmt.node);
}

/// Turns the value on the stack into what a variable of that type holds.
void Compilation::hold(std::string_view type, std::string const& variable, Holder holder) {
  if (type.empty() || !is_checked_type(type)) return;
  auto const declaration = std::string(type) + " " + variable;
  function_->emit(Op::hold, function_->name(declaration), holder == Holder::parameter ? 1 : 0);
}

/// `a = b = value` and `(a, b) = list`: the value first, once, then each target from right to left.
void Compilation::assign_several(ast::Assign const& assign, bool keeps_value) {
  auto& f = *function_;
  int const value = f.hidden();
  expression(*assign.value);
  f.emit(Op::store_local, value);
  for (auto i = assign.more.size() + 1; i-- > 0;) {
    auto const& target = i == 0 ? *assign.target : *assign.more[i - 1];
    assign_to(target, std::nullopt, false, [&] {
      f.emit(Op::load_local, value);
      if (!assign.unpacks) return;
      f.emit_constant(Value::integer(static_cast<std::int64_t>(i)));
      f.emit(Op::get_index);
    });
  }
  if (keeps_value) f.emit(Op::load_local, value);
}

void Compilation::assign(ast::Assign const& assign, bool keeps_value) {
  if (!assign.more.empty()) return assign_several(assign, keeps_value);
  assign_to(*assign.target, assign.op, keeps_value, [&] { expression(*assign.value); });
}

void Compilation::assign_to(ast::Expr const& target, std::optional<ast::BinaryOp> op, bool keeps_value,
                            std::function<void()> const& push_value) {
  auto& f = *function_;
  auto const value = [&](auto const& load_old) {
    if (op) load_old();
    push_value();
    if (op) f.emit(Op::binary, static_cast<int>(*op));
  };
  if (auto const* name = std::get_if<ast::Name>(&target.node)) {
    value([&] { load(name->text); });
    hold(f.type_of(name->text), name->text, Holder::variable);
    if (keeps_value) f.emit(Op::duplicate);
    return store(name->text);
  }
  int const object = f.hidden();
  int const result = f.hidden();
  if (auto const* member = std::get_if<ast::Member>(&target.node)) {
    expression(*member->object);
    f.emit(Op::store_local, object);
    int const member_name = f.name(member->name.text);
    value([&] {
      f.emit(Op::load_local, object);
      f.emit(Op::get_member, member_name);
    });
    f.emit(Op::store_local, result);
    f.emit(Op::load_local, object);
    f.emit(Op::load_local, result);
    f.emit(Op::set_member, member_name);
  } else if (auto const* index = std::get_if<ast::Index>(&target.node)) {
    int const at = f.hidden();
    expression(*index->object);
    f.emit(Op::store_local, object);
    expression(*index->index);
    f.emit(Op::store_local, at);
    auto const load_place = [&] {
      f.emit(Op::load_local, object);
      f.emit(Op::load_local, at);
    };
    value([&] {
      load_place();
      f.emit(Op::get_index);
    });
    f.emit(Op::store_local, result);
    load_place();
    f.emit(Op::load_local, result);
    f.emit(Op::set_index);
  } else {
    diagnostics_.report(code("not-assignable"), target.span, "this cannot be assigned to");
  }
  if (keeps_value) f.emit(Op::load_local, result);
}

void Compilation::declare_variables(ast::VarDecl const& decl) {
  auto& f = *function_;
  auto const type = decl.type ? std::string_view(decl.type->text) : std::string_view();
  if (!decl.unpacks) {
    for (std::size_t i = 0; i < decl.names.size(); ++i) {
      auto const& variable = decl.names[i].text;
      bool const has_value = i == 0 && decl.value;
      if (has_value) expression(*decl.value);
      if (has_value) hold(type, variable, Holder::variable);
      if (!has_value) f.emit_constant(value_at_first(type));
      f.emit(Op::declare_local, f.declare(variable, type));
    }
    return;
  }
  expression(*decl.value);
  int const list = f.hidden();
  f.emit(Op::store_local, list);
  for (std::size_t i = 0; i < decl.names.size(); ++i) {
    f.emit(Op::load_local, list);
    f.emit_constant(Value::integer(static_cast<std::int64_t>(i)));
    f.emit(Op::get_index);
    f.emit(Op::declare_local, f.declare(decl.names[i].text));
  }
}

void Compilation::if_statement(ast::If const& node, int sink) {
  expression(*node.condition);
  int const otherwise = function_->emit(Op::jump_if_false);
  block(node.then, sink);
  if (!node.otherwise) return function_->patch(otherwise);
  int const end = function_->emit(Op::jump);
  function_->patch(otherwise);
  block(*node.otherwise, sink);
  function_->patch(end);
}

void Compilation::close_loop() {
  for (int const jump : surroundings_.loops.back().breaks) function_->patch(jump);
  surroundings_.loops.pop_back();
}

void Compilation::do_loop(ast::While const& node) {
  int const begin = function_->here();
  surroundings_.loops.push_back({.breaks = {}, .continues = {}, .finallies = surroundings_.finallies.size()});
  block(node.body);
  for (int const jump : surroundings_.loops.back().continues) function_->patch(jump);
  expression(*node.condition);
  surroundings_.loops.back().breaks.push_back(function_->emit(Op::jump_if_false));
  function_->emit(Op::jump_back, begin);
  close_loop();
}

void Compilation::while_loop(ast::While const& node) {
  if (node.body_first) return do_loop(node);
  int const begin = function_->here();
  expression(*node.condition);
  int const end = function_->emit(Op::jump_if_false);
  surroundings_.loops.push_back({.breaks = {end}, .continues = {}, .finallies = surroundings_.finallies.size()});
  block(node.body);
  for (int const jump : surroundings_.loops.back().continues) function_->patch(jump);
  function_->emit(Op::jump_back, begin);
  close_loop();
}

void Compilation::for_loop(ast::For const& node) {
  function_->open_scope();
  if (node.init) statement(*node.init);
  int const begin = function_->here();
  surroundings_.loops.push_back({.breaks = {}, .continues = {}, .finallies = surroundings_.finallies.size()});
  if (node.condition) {
    expression(*node.condition);
    surroundings_.loops.back().breaks.push_back(function_->emit(Op::jump_if_false));
  }
  block(node.body);
  for (int const jump : surroundings_.loops.back().continues) function_->patch(jump);
  if (node.update) statement(*node.update);
  function_->emit(Op::jump_back, begin);
  close_loop();
  function_->close_scope();
}

void Compilation::for_in_loop(ast::ForIn const& node) {
  auto& f = *function_;
  expression(*node.iterable);
  int const items = f.hidden();
  f.hidden();  // the index, next to it
  f.emit(Op::start_iteration, items);
  f.open_scope();
  int const begin = f.here();
  int const next = f.emit(Op::next_item, 0, items);
  surroundings_.loops.push_back({.breaks = {next}, .continues = {}, .finallies = surroundings_.finallies.size()});
  f.emit(Op::declare_local, f.declare(node.variable.text));
  block(node.body);
  for (int const jump : surroundings_.loops.back().continues) f.patch(jump);
  f.emit(Op::jump_back, begin);
  close_loop();
  f.close_scope();
}

void Compilation::switch_statement(ast::Switch const& node, int sink) {
  auto& f = *function_;
  int const subject = f.hidden();
  expression(*node.subject);
  f.emit(Op::store_local, subject);
  surroundings_.loops.push_back(
      {.breaks = {}, .continues = {}, .finallies = surroundings_.finallies.size(), .is_switch = true});
  std::vector<int> entries(node.cases.size(), -1);
  for (std::size_t i = 0; i < node.cases.size(); ++i) {
    if (!node.cases[i].value) continue;
    f.emit(Op::load_local, subject);
    expression(*node.cases[i].value);
    f.emit(Op::compare, matches_case);
    entries[i] = f.emit(Op::jump_if_true);
  }
  int const no_case = f.emit(Op::jump);
  bool has_default = false;
  for (std::size_t i = 0; i < node.cases.size(); ++i) {
    if (entries[i] < 0) has_default = true;
    f.patch(entries[i] < 0 ? no_case : entries[i]);
    block(node.cases[i].body, sink);
  }
  if (!has_default) f.patch(no_case);
  close_loop();
}

void Compilation::try_statement(ast::Try const& node, int sink) {
  auto& f = *function_;
  if (node.finally) surroundings_.finallies.push_back({.local = f.hidden(), .calls = {}});
  int const begin = f.here();
  block(node.body, sink);
  int const end = f.here();
  if (!node.catches.empty()) catches(node, begin, end, sink);
  if (!node.finally) return;
  int const protected_end = f.here();
  auto finally = std::move(surroundings_.finallies.back());
  surroundings_.finallies.pop_back();
  finally.calls.push_back(f.emit(Op::call_finally, 0, finally.local));
  int const over = f.emit(Op::jump);
  int const target = f.here();
  for (int const call : finally.calls) f.patch(call, target);
  f.function().handlers.push_back({begin, protected_end, target, finally.local});
  block(*node.finally);
  f.emit(Op::end_finally, 0, finally.local);
  f.patch(over);
}

void Compilation::catches(ast::Try const& node, int begin, int end, int sink) {
  auto& f = *function_;
  std::vector<int> ends{f.emit(Op::jump)};
  f.function().handlers.push_back({begin, end, f.here(), -1});
  int const caught = f.hidden();
  f.emit(Op::store_local, caught);
  for (auto const& clause : node.catches) {
    std::vector<int> matches;
    for (auto const& type : clause.types) {
      f.emit(Op::load_local, caught);
      f.emit(Op::instance_of, f.name(type.text));
      matches.push_back(f.emit(Op::jump_if_true));
    }
    int const skip = clause.types.empty() ? -1 : f.emit(Op::jump);
    for (int const jump : matches) f.patch(jump);
    f.open_scope();
    f.emit(Op::load_local, caught);
    f.emit(Op::declare_local, f.declare(clause.name.text));
    block(clause.body, sink);
    f.close_scope();
    ends.push_back(f.emit(Op::jump));
    if (skip >= 0) f.patch(skip);
  }
  f.emit(Op::load_local, caught);
  f.emit(Op::throw_value);
  for (int const jump : ends) f.patch(jump);
}

void Compilation::run_finallies(std::size_t down_to) {
  auto& finallies = surroundings_.finallies;
  for (std::size_t i = finallies.size(); i > down_to; --i) {
    finallies[i - 1].calls.push_back(function_->emit(Op::call_finally, 0, finallies[i - 1].local));
  }
}

void Compilation::leave(bool is_break, base::Span span) {
  auto& loops = surroundings_.loops;
  for (std::size_t i = loops.size(); i > 0; --i) {
    auto& loop = loops[i - 1];
    if (!is_break && loop.is_switch) continue;
    run_finallies(loop.finallies);
    int const jump = function_->emit(Op::jump);
    (is_break ? loop.breaks : loop.continues).push_back(jump);
    return;
  }
  diagnostics_.report(code("misplaced-break"), span,
                      is_break ? "break outside a loop or switch" : "continue outside a loop");
}

void Compilation::return_statement(ast::Return const& node) {
  auto& f = *function_;
  if (node.value) expression(*node.value);
  if (!node.value) f.emit(Op::null);
  if (!surroundings_.finallies.empty()) {
    int const result = f.hidden();
    f.emit(Op::store_local, result);
    run_finallies(0);
    f.emit(Op::load_local, result);
  }
  f.emit(Op::return_value);
}

void Compilation::assert_statement(ast::Assert const& node) {
  auto& f = *function_;
  expression(*node.condition);
  int const fine = f.emit(Op::jump_if_true);
  if (node.message) expression(*node.message);
  if (!node.message) text(std::string(diagnostics_.source().text(node.condition->span)));
  f.emit(Op::construct, f.name("AssertionError"), 1);
  f.emit(Op::throw_value);
  f.patch(fine);
}

}  // namespace lapwing::dolphin::internal
