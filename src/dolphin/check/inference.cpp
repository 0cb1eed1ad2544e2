#include "dolphin/check/inference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "dolphin/names/declared_type.hpp"

namespace lapwing::dolphin {

namespace {

Facts join(Facts const& a, Facts const& b) {
  return {a.kinds | b.kinds, a.dimension == b.dimension ? a.dimension : std::nullopt};
}

Facts number_facts(std::optional<Dimension> dimension) {
  return {Kinds::number(), dimension};
}

/// Sums keep a common dimension; a plain number takes that of the other.
Facts sum(Facts const& a, Facts const& b) {
  if (!a.dimension || !b.dimension) return number_facts(std::nullopt);
  if (*a.dimension == Dimension::none) return number_facts(b.dimension);
  if (*b.dimension == Dimension::none || a.dimension == b.dimension) return number_facts(a.dimension);
  return number_facts(std::nullopt);
}

/// A plain number may be a speed: what it makes of a length or a time is not known. Percents change nothing.
Facts product(Facts const& a, Facts const& b, bool divides) {
  if (!a.dimension || !b.dimension) return number_facts(std::nullopt);
  if (*a.dimension == Dimension::none && *b.dimension == Dimension::none) return number_facts(Dimension::none);
  if (*b.dimension == Dimension::ratio) return number_facts(a.dimension);
  if (*a.dimension == Dimension::ratio && !divides) return number_facts(b.dimension);
  return number_facts(std::nullopt);
}

bool is_exactly(Facts const& facts, Kind kind) {
  return facts.kinds == Kinds(kind);
}

std::optional<double> as_number(std::optional<tasks::Argument> const& value) {
  if (!value) return std::nullopt;
  if (auto const* whole = std::get_if<std::int64_t>(&*value)) return static_cast<double>(*whole);
  if (auto const* decimal = std::get_if<double>(&*value)) return *decimal;
  return std::nullopt;
}

/// Computes constants; looks at a limited number of nodes.
class Evaluator {
 public:
  using Value = std::optional<tasks::Argument>;
  explicit Evaluator(Resolution const& resolution) : resolution_(resolution) {}

  Value value(ast::Expr const& expr) {
    if (--budget_ < 0) return std::nullopt;
    return std::visit([&](auto const& node) { return of(node, expr); }, expr.node);
  }

 private:
  Value of(ast::BoolLiteral const& n, ast::Expr const&) { return n.value; }
  Value of(ast::IntegerLiteral const& n, ast::Expr const&) { return n.value; }
  Value of(ast::DecimalLiteral const& n, ast::Expr const&) { return n.value; }
  Value of(ast::StringLiteral const& n, ast::Expr const&) { return n.value; }
  Value of(ast::Name const& n, ast::Expr const& expr) {
    auto const* variable = resolution_.find(expr);
    if (!variable && n.text == "NaN") return std::numeric_limits<double>::quiet_NaN();
    if (!variable && n.text == "PI") return std::numbers::pi;
    if (!variable || variable->has_other_values || variable->values.size() != 1) return std::nullopt;
    auto known = value(*variable->values.front());
    bool const may_grow = known && std::holds_alternative<tasks::List>(*known);  // by `list << item`
    return may_grow ? std::nullopt : known;
  }
  Value of(ast::Unary const& n, ast::Expr const&) {
    auto operand = value(*n.operand);
    if (n.op == ast::UnaryOp::plus) return operand;
    if (n.op != ast::UnaryOp::minus || !operand) return std::nullopt;
    if (auto const* whole = std::get_if<std::int64_t>(&*operand)) {
      return *whole == std::numeric_limits<std::int64_t>::min() ? Value() : Value(-*whole);
    }
    auto const number = as_number(operand);
    return number ? Value(-*number) : Value();
  }
  Value of(ast::Binary const& n, ast::Expr const&) {
    if (n.op == ast::BinaryOp::bit_xor) return disc(*n.left, *n.right);
    auto const left = as_number(value(*n.left));
    auto const right = left ? as_number(value(*n.right)) : std::nullopt;
    if (!right) return std::nullopt;
    switch (n.op) {
      case ast::BinaryOp::add: return *left + *right;
      case ast::BinaryOp::subtract: return *left - *right;
      case ast::BinaryOp::multiply: return *left * *right;
      case ast::BinaryOp::divide: return *right == 0.0 ? Value() : Value(*left / *right);
      default: return std::nullopt;
    }
  }
  Value of(ast::Member const& n, ast::Expr const&) {
    if (auto const* type = std::get_if<ast::Name>(&n.object->node); type && n.name.text == "NaN") {
      return std::numeric_limits<double>::quiet_NaN();
    }
    auto const* unit = find_unit(n.name.text);
    auto const number = unit ? as_number(value(*n.object)) : std::nullopt;
    return number ? Value(*number * unit->factor) : Value();
  }
  Value of(ast::ListLiteral const& n, ast::Expr const&) {
    tasks::List list;
    for (auto const& item : n.items) {
      auto const known = value(*item);
      auto const plain = known ? tasks::item_of(*known) : std::nullopt;
      if (!plain) return std::nullopt;
      list.push_back(*plain);
    }
    return list;
  }
  Value of(ast::Call const& n, ast::Expr const&) {
    auto const* callee = std::get_if<ast::Name>(&n.callee->node);
    if (!callee || resolution_.functions.contains(callee->text)) return std::nullopt;
    if (callee->text == "area" && n.arguments.size() == 2) return disc(*n.arguments[0].value, *n.arguments[1].value);
    if (callee->text == "location") return location(n);
    return std::nullopt;
  }
  Value disc(ast::Expr const& center, ast::Expr const& radius) {
    auto const place = value(center);
    auto const* at = place ? std::get_if<geo::Wgs84>(&*place) : nullptr;
    auto const radius_m = at ? as_number(value(radius)) : std::nullopt;
    if (!radius_m) return std::nullopt;
    return geo::Area(geo::Disc{*at, *radius_m});
  }
  Value location(ast::Call const& n) {
    if (n.arguments.size() < 2 || n.arguments.size() > 3) return std::nullopt;
    auto const lat = as_number(value(*n.arguments[0].value));
    auto const lon = as_number(value(*n.arguments[1].value));
    auto const height = n.arguments.size() == 3 ? as_number(value(*n.arguments[2].value)) : 0.0;
    if (!lat || !lon || !height) return std::nullopt;
    return geo::Wgs84::from_degrees(*lat, *lon, *height);
  }
  template <class Other>
  Value of(Other const&, ast::Expr const&) {
    return std::nullopt;
  }

  Resolution const& resolution_;
  int budget_ = 200;
};

}  // namespace

UnitSpec const* find_unit(std::string_view name) {
  auto const found = std::ranges::find(units(), name, &UnitSpec::name);
  return found == units().end() ? nullptr : &*found;
}

std::optional<tasks::Argument> Inference::constant(ast::Expr const& expr) const {
  return Evaluator(resolution_).value(expr);
}

Facts Inference::facts(Variable const& variable, int depth) {
  if (variable.type && is_checked_type(variable.type->text)) return {kinds_held(variable.type->text), {}};
  if (variable.has_other_values || variable.values.empty() || depth <= 0) return {};
  if (auto const known = known_.find(&variable); known != known_.end()) return known->second;
  known_.emplace(&variable, Facts{});  // a variable whose value depends on itself
  auto out = facts(*variable.values.front(), depth - 1);
  for (auto const* value : variable.values) out = join(out, facts(*value, depth - 1));
  known_[&variable] = out;
  return out;
}

struct Inference::Visitor {
  Inference& self;
  ast::Expr const& expr;
  int depth;

  Facts operator()(ast::NullLiteral const&) const { return {Kind::other, {}}; }
  Facts operator()(ast::BoolLiteral const&) const { return {Kind::boolean, {}}; }
  Facts operator()(ast::IntegerLiteral const&) const { return {Kind::integer, Dimension::none}; }
  Facts operator()(ast::DecimalLiteral const&) const { return {Kind::decimal, Dimension::none}; }
  Facts operator()(ast::StringLiteral const&) const { return {Kind::text, {}}; }
  Facts operator()(ast::GString const&) const { return {Kind::text, {}}; }
  Facts operator()(ast::ListLiteral const&) const { return {Kind::list, {}}; }
  Facts operator()(ast::MapLiteral const&) const { return {Kind::map, {}}; }
  Facts operator()(ast::Range const&) const { return {Kind::other, {}}; }
  Facts operator()(ast::Closure const&) const { return {Kind::closure, {}}; }
  Facts operator()(ast::PatternLiteral const&) const { return {Kind::other, {}}; }
  Facts operator()(ast::Cast const& n) const {
    if (!is_checked_type(n.type.text)) return {};
    return {kinds_held(n.type.text) | Kind::other, {}};  // null stays null
  }
  Facts operator()(ast::InstanceOf const&) const { return {Kind::boolean, {}}; }
  Facts operator()(ast::Name const&) const { return self.facts_of_name(expr, depth); }
  Facts operator()(ast::Unary const& n) const {
    if (n.op == ast::UnaryOp::logical_not) return {Kind::boolean, {}};
    auto const operand = self.facts(*n.operand, depth - 1);
    if (n.op != ast::UnaryOp::complement) return operand;
    return {operand.kinds == Kinds(Kind::integer) ? operand.kinds : Kinds(Kind::integer) | Kind::other, {}};
  }
  Facts operator()(ast::Binary const& n) const { return self.facts_of_binary(n, depth); }
  Facts operator()(ast::Ternary const& n) const {
    return join(self.facts(*n.if_true, depth - 1), self.facts(*n.if_false, depth - 1));
  }
  Facts operator()(ast::Member const& n) const { return self.facts_of_member(n, depth); }
  Facts operator()(ast::Index const& n) const {
    return is_exactly(self.facts(*n.object, depth - 1), Kind::task) ? Facts{Kind::task, {}} : Facts{};
  }
  Facts operator()(ast::Call const& n) const { return self.facts_of_call(n, depth); }
  Facts operator()(ast::Chain const& n) const {
    return n.kind == ast::ChainKind::when ? Facts{Kinds::none(), {}} : Facts{Kind::task, {}};
  }
  template <class Other>
  Facts operator()(Other const&) const {
    return {};
  }
};

Facts Inference::facts(ast::Expr const& expr, int depth) {
  if (depth <= 0) return {};
  return std::visit(Visitor{*this, expr, depth}, expr.node);
}

Facts Inference::facts_of_name(ast::Expr const& expr, int depth) {
  if (auto const* variable = resolution_.find(expr)) return facts(*variable, depth);
  auto const& name = std::get<ast::Name>(expr.node).text;
  bool const is_constant = std::ranges::find(constants(), name, &NameSpec::name) != constants().end();
  return is_constant ? number_facts(std::nullopt) : Facts{};
}

namespace {

Facts facts_of_arithmetic(ast::BinaryOp op, Facts const& left, Facts const& right) {
  using enum ast::BinaryOp;
  if (!left.is_number() || !right.is_number()) return {};
  switch (op) {
    case add:
    case subtract: return sum(left, right);
    case multiply: return product(left, right, false);
    case divide: return product(left, right, true);
    default: return number_facts(std::nullopt);
  }
}

/// Of operators that put tasks, vehicles or truths together, or an area around a position.
Facts facts_of_union(ast::BinaryOp op, Facts const& left, Facts const& right) {
  using enum ast::BinaryOp;
  bool const is_task = is_exactly(left, Kind::task);
  if (op == shift_right) return is_task && right.kinds.meets(Kind::task) ? left : Facts{};
  if (is_exactly(left, Kind::boolean) && is_exactly(right, Kind::boolean)) return left;
  if (op == bit_xor) return is_exactly(left, Kind::position) ? Facts{Kind::area, {}} : Facts{};
  return is_task || is_exactly(left, Kind::vehicles) ? left : Facts{};
}

}  // namespace

Facts Inference::facts_of_binary(ast::Binary const& binary, int depth) {
  using enum ast::BinaryOp;
  auto const left = facts(*binary.left, depth - 1);
  auto const right = facts(*binary.right, depth - 1);
  switch (binary.op) {
    case less:
    case less_equal:
    case greater:
    case greater_equal:
    case equal:
    case not_equal:
    case in:
    case match:
    case logical_and:
    case logical_or: return {Kind::boolean, {}};
    case find: return {Kind::list, {}};
    case compare: return {Kind::integer, Dimension::none};
    case elvis: return join(left, right);
    case add:
    case subtract:
      if (is_exactly(left, Kind::text)) return {Kind::text, {}};
      if (is_exactly(left, Kind::vehicles) && is_exactly(right, Kind::vehicles)) return left;
      return facts_of_arithmetic(binary.op, left, right);
    case divide:
      if (is_exactly(left, Kind::task)) return right.kinds.meets(Kind::closure) ? left : Facts{};
      return facts_of_arithmetic(binary.op, left, right);
    case multiply:
    case power:
    case remainder: return facts_of_arithmetic(binary.op, left, right);
    case bit_xor:
    case bit_or:
    case bit_and:
    case shift_right: return facts_of_union(binary.op, left, right);
    case shift_left: return {};
  }
  return {};
}

Facts Inference::facts_of_member(ast::Member const& member, int depth) {
  if (member.is_spread) return {Kind::list, {}};
  auto const object = facts(*member.object, depth - 1);
  if (object.is_number()) {
    if (auto const* unit = find_unit(member.name.text)) return number_facts(unit->dimension);
    return {};
  }
  if (object.kinds.is_any() || object.kinds.meets(Kind::map)) return {};
  for (auto const& method : methods()) {
    if (method.is_property && method.name == member.name.text && object.kinds.within(method.receiver))
      return {method.result, {}};
  }
  return {};
}

Facts Inference::facts_of_call(ast::Call const& call, int depth) {
  auto const* name = std::get_if<ast::Name>(&call.callee->node);
  if (!name) {
    auto const* member = std::get_if<ast::Member>(&call.callee->node);
    if (member && member->is_spread) return {Kind::list, {}};
    auto const object = member ? facts(*member->object, depth - 1) : Facts{};
    if (object.kinds.is_any()) return {};
    for (auto const& method : methods()) {
      bool const fits = !method.is_property && method.name == member->name.text && object.kinds.within(method.receiver);
      if (fits && !method.receiver.is_any()) return {method.result, {}};
    }
    return {};
  }
  if (resolution_.functions.contains(name->text)) return {};
  if (std::ranges::find(builders_, name->text, &tasks::BuilderSpec::name) != builders_.end()) return {Kind::task, {}};
  auto const* instruction = resolution_.instructions.find(name->text);
  if (!instruction || resolution_.locals.contains(call.callee.get())) return {};
  if (instruction->result.is_none()) return {Kind::other, {}};
  auto const dimension =
      instruction->dimension == Dimension::none ? std::nullopt : std::optional(instruction->dimension);
  return {instruction->result, dimension};
}

}  // namespace lapwing::dolphin
