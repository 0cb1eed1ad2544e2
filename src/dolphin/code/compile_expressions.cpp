#include <algorithm>
#include <limits>
#include <numbers>
#include <variant>

#include "dolphin/code/internal/compilation.hpp"
#include "dolphin/names/signatures.hpp"
#include "dolphin/value/objects.hpp"

namespace lapwing::dolphin::internal {
namespace {

std::optional<double> number_constant(std::string_view name) {
  if (name == "NaN") return std::numeric_limits<double>::quiet_NaN();
  if (name == "PI") return std::numbers::pi;
  if (name == "E") return std::numbers::e;
  return std::nullopt;
}

bool is_comparison(ast::BinaryOp op) {
  using enum ast::BinaryOp;
  switch (op) {
    case less:
    case less_equal:
    case greater:
    case greater_equal:
    case in:
    case equal:
    case not_equal:
    case compare: return true;
    default: return false;
  }
}

}  // namespace

bool is_type_name(std::string_view name) {
  return std::ranges::find(types(), name, &NameSpec::name) != types().end();
}

int Compilation::global(std::string const& name) {
  auto const [place, is_new] = globals_.try_emplace(name, static_cast<int>(program_.globals.size()));
  if (is_new) program_.globals.push_back(name);
  return place->second;
}

bool Compilation::is_variable(std::string const& name) {
  return function_->find_local(name) || function_->capture(name) || globals_.contains(name);
}

void Compilation::load(std::string const& name) {
  if (auto const local = function_->find_local(name)) {
    function_->emit(Op::load_local, *local);
  } else if (auto const captured = function_->capture(name)) {
    function_->emit(Op::load_captured, *captured);
  } else {
    function_->emit(Op::load_global, global(name));
  }
}

void Compilation::store(std::string const& name) {
  if (auto const local = function_->find_local(name)) {
    function_->emit(Op::store_local, *local);
  } else if (auto const captured = function_->capture(name)) {
    function_->emit(Op::store_captured, *captured);
  } else {
    function_->emit(Op::store_global, global(name));
  }
}

void Compilation::text(std::string const& text) {
  function_->emit_constant(Value(program_.texts.make<Text>(text)));
}

void Compilation::name(std::string const& name, base::Span /*span*/) {
  if (is_variable(name)) return load(name);
  if (auto const constant = number_constant(name)) return function_->emit_constant(Value::real(*constant));
  if (is_type_name(name)) {
    function_->emit_constant(Value(program_.texts.make<TypeValue>(TypeName{name})));
    return;
  }
  load(name);
}

void Compilation::expression(ast::Expr const& expr) {
  auto const outer_line = function_->line();
  function_->at_line(diagnostics_.source().line(expr.span.begin));
  expression_node(expr);
  function_->at_line(outer_line);
}

void Compilation::expression_node(ast::Expr const& expr) {
  struct Visitor {
    Compilation& self;
    base::Span span;
    FunctionBuilder& f;

    void operator()(ast::ErrorExpr const&) const { f.emit(Op::null); }
    void operator()(ast::NullLiteral const&) const { f.emit(Op::null); }
    void operator()(ast::BoolLiteral const& node) const { f.emit(Op::boolean, node.value ? 1 : 0); }
    void operator()(ast::IntegerLiteral const& node) const { f.emit_constant(Value::integer(node.value)); }
    void operator()(ast::DecimalLiteral const& node) const { f.emit_constant(Value::real(node.value)); }
    void operator()(ast::StringLiteral const& node) const { self.text(node.value); }
    void operator()(ast::GString const& node) const { self.gstring(node); }
    void operator()(ast::PatternLiteral const& node) const {
      auto expression = RegularExpression::make(node.text);
      if (!expression)
        return self.diagnostics_.report(code("invalid-pattern"), span, "this is no pattern: " + expression.error());
      f.emit_constant(Value(self.program_.texts.make<PatternValue>(*std::move(expression))));
    }
    void operator()(ast::Name const& node) const { self.name(node.text, span); }
    void operator()(ast::ListLiteral const& node) const {
      for (auto const& item : node.items) self.expression(*item);
      f.emit(Op::make_list, static_cast<int>(node.items.size()));
    }
    void operator()(ast::MapLiteral const& node) const { self.map_literal(node); }
    void operator()(ast::Range const& node) const {
      self.expression(*node.first);
      self.expression(*node.last);
      f.emit(Op::make_range, node.inclusive ? 1 : 0);
    }
    void operator()(ast::Unary const& node) const {
      self.expression(*node.operand);
      switch (node.op) {
        case ast::UnaryOp::logical_not: f.emit(Op::logical_not); break;
        case ast::UnaryOp::minus: f.emit(Op::negate); break;
        case ast::UnaryOp::plus: f.emit(Op::plus); break;
        case ast::UnaryOp::complement: f.emit(Op::complement); break;
      }
    }
    void operator()(ast::Step const& node) const { self.step(node); }
    void operator()(ast::Binary const& node) const { self.binary(node); }
    void operator()(ast::Cast const& node) const {
      self.expression(*node.operand);
      f.emit(Op::cast, f.name(node.type.text));
    }
    void operator()(ast::InstanceOf const& node) const {
      self.expression(*node.operand);
      f.emit(Op::instance_of, f.name(node.type.text));
    }
    void operator()(ast::Ternary const& node) const { self.ternary(node); }
    void operator()(ast::Member const& node) const { self.member(node); }
    void operator()(ast::Index const& node) const {
      auto const* plan = std::get_if<ast::Name>(&node.object->node);
      bool const is_plan = plan && plan->text == "imcPlan" && !self.is_variable(plan->text);
      if (!is_plan) self.expression(*node.object);
      self.expression(*node.index);
      if (is_plan) return self.native_call("task", 1, span);
      f.emit(Op::get_index);
    }
    void operator()(ast::Call const& node) const { self.call(node, span); }
    void operator()(ast::New const& node) const {
      int const count = self.arguments(node.arguments);
      f.emit(Op::construct, f.name(node.type.text), count);
    }
    void operator()(ast::Closure const& node) const { self.closure(node); }
    void operator()(ast::Chain const& node) const { self.chain(node, span); }
  };
  std::visit(Visitor{*this, expr.span, *function_}, expr.node);
}

void Compilation::gstring(ast::GString const& node) {
  for (auto const& piece : node.pieces) {
    if (auto const* plain = std::get_if<std::string>(&piece)) text(*plain);
    if (auto const* part = std::get_if<ast::ExprPtr>(&piece)) expression(**part);
  }
  function_->emit(Op::concatenate, static_cast<int>(node.pieces.size()));
}

void Compilation::map_literal(ast::MapLiteral const& node) {
  for (auto const& entry : node.entries) {
    expression(*entry.key);
    expression(*entry.value);
  }
  function_->emit(Op::make_map, static_cast<int>(node.entries.size()));
}

void Compilation::binary(ast::Binary const& node) {
  auto& f = *function_;
  expression(*node.left);
  switch (node.op) {
    case ast::BinaryOp::logical_and:
    case ast::BinaryOp::logical_or: {
      f.emit(Op::truth);
      f.emit(Op::duplicate);
      int const end = f.emit(node.op == ast::BinaryOp::logical_and ? Op::jump_if_false : Op::jump_if_true);
      f.emit(Op::pop);
      expression(*node.right);
      f.emit(Op::truth);
      return f.patch(end);
    }
    case ast::BinaryOp::elvis: {
      f.emit(Op::duplicate);
      int const end = f.emit(Op::jump_if_true);
      f.emit(Op::pop);
      expression(*node.right);
      return f.patch(end);
    }
    default: break;
  }
  expression(*node.right);
  f.at_line(diagnostics_.source().line(node.op_span.begin));
  f.emit(is_comparison(node.op) ? Op::compare : Op::binary, static_cast<int>(node.op));
}

void Compilation::ternary(ast::Ternary const& node) {
  expression(*node.condition);
  int const otherwise = function_->emit(Op::jump_if_false);
  expression(*node.if_true);
  int const end = function_->emit(Op::jump);
  function_->patch(otherwise);
  expression(*node.if_false);
  function_->patch(end);
}

void Compilation::step(ast::Step const& node) {
  auto& f = *function_;
  int const old = f.hidden();
  int const fresh = f.hidden();
  auto const add = [&] {
    f.emit(Op::duplicate);
    f.emit(Op::store_local, old);
    f.emit_constant(Value::integer(node.by));
    f.emit(Op::binary, static_cast<int>(ast::BinaryOp::add));
    f.emit(Op::store_local, fresh);
    f.emit(Op::load_local, fresh);
  };
  if (auto const* name = std::get_if<ast::Name>(&node.target->node)) {
    load(name->text);
    add();
    store(name->text);
  } else if (auto const* member = std::get_if<ast::Member>(&node.target->node)) {
    int const member_name = f.name(member->name.text);
    expression(*member->object);
    f.emit(Op::duplicate);
    f.emit(Op::get_member, member_name);
    add();
    f.emit(Op::set_member, member_name);
  } else if (auto const* index = std::get_if<ast::Index>(&node.target->node)) {
    int const at = f.hidden();
    expression(*index->object);
    f.emit(Op::duplicate);
    expression(*index->index);
    f.emit(Op::duplicate);
    f.emit(Op::store_local, at);
    f.emit(Op::get_index);
    f.emit(Op::store_local, old);
    f.emit(Op::load_local, at);
    f.emit(Op::load_local, old);
    add();
    f.emit(Op::set_index);
  } else {
    diagnostics_.report(code("not-assignable"), node.target->span, "this cannot be assigned to");
  }
  f.emit(Op::load_local, node.prefix ? fresh : old);
}

/// `list*.name`, `list*.name()`: the list of what `push_value` makes of each element on the stack; null of null.
void Compilation::each_element(ast::Expr const& object, std::function<void()> const& push_value) {
  auto& f = *function_;
  int const result = f.hidden();
  int const value = f.hidden();
  expression(object);
  int const items = f.hidden();
  f.hidden();  // the index, next to it
  f.emit(Op::start_iteration, items);
  f.emit(Op::make_list, 0);
  f.emit(Op::store_local, result);
  int const begin = f.here();
  int const next = f.emit(Op::next_item, 0, items);
  int const nothing = f.emit(Op::jump_if_null);
  push_value();
  f.patch(nothing);
  f.emit(Op::store_local, value);
  f.emit(Op::load_local, result);
  f.emit(Op::load_local, value);
  f.emit(Op::binary, static_cast<int>(ast::BinaryOp::shift_left));
  f.emit(Op::pop);
  f.emit(Op::jump_back, begin);
  f.patch(next);
  f.emit(Op::load_local, result);
}

void Compilation::member(ast::Member const& node) {
  if (node.is_spread) {
    return each_element(*node.object, [&] { function_->emit(Op::get_member, function_->name(node.name.text)); });
  }
  expression(*node.object);
  int const nothing = node.safe ? function_->emit(Op::jump_if_null) : -1;
  function_->emit(Op::get_member, function_->name(node.name.text));
  if (nothing >= 0) function_->patch(nothing);
}

void Compilation::closure(ast::Closure const& node) {
  auto const code = function("", node.parameters, !node.has_arrow, node.body, function_);
  function_->function().closures.push_back(code);
  function_->emit(Op::make_closure, static_cast<int>(function_->function().closures.size()) - 1);
}

std::shared_ptr<Function const> Compilation::function(std::string name, std::vector<ast::Parameter> const& parameters,
                                                      bool has_it, ast::Block const& its_body,
                                                      FunctionBuilder* enclosing) {
  FunctionBuilder f(enclosing, std::move(name));
  auto* const outer = std::exchange(function_, &f);
  auto const outer_surroundings = std::exchange(surroundings_, {});
  auto const outer_blocks = enclosing ? blocks_ : std::exchange(blocks_, {});
  f.at_line(diagnostics_.source().line(its_body.span.begin));
  f.function().is_library = is_library_;
  for (auto const& parameter : parameters) {
    f.declare(parameter.name.text, parameter.type ? std::string_view(parameter.type->text) : std::string_view());
  }
  if (has_it) f.declare("it");
  f.function().parameters = f.function().locals;
  f.function().required = has_it ? 0 : static_cast<int>(parameters.size());
  f.function().spreads_lists = f.function().parameters > 1;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (!parameters[i].fallback) {
      f.emit(Op::adopt_parameter, static_cast<int>(i));
      continue;
    }
    f.function().required = std::min(f.function().required, static_cast<int>(i));
    int const passed = f.emit(Op::jump_if_passed, 0, static_cast<int>(i));
    expression(*parameters[i].fallback);
    f.emit(Op::declare_local, static_cast<int>(i));
    int const ready = f.emit(Op::jump);
    f.patch(passed);
    f.emit(Op::adopt_parameter, static_cast<int>(i));
    f.patch(ready);
  }
  if (has_it) f.emit(Op::adopt_parameter, 0);
  for (auto const& parameter : parameters) {
    if (!parameter.type || !is_checked_type(parameter.type->text)) continue;
    load(parameter.name.text);
    hold(parameter.type->text, parameter.name.text, Holder::parameter);
    store(parameter.name.text);
  }
  body(its_body);
  function_ = outer;
  surroundings_ = outer_surroundings;
  blocks_ = outer_blocks;
  return f.finish();
}

}  // namespace lapwing::dolphin::internal
