#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "dolphin/check/fixes.hpp"
#include "dolphin/check/internal/checker_class.hpp"

/// What the checker knows of operators (language specification 2) and of the values that they join.
namespace lapwing::dolphin {

namespace {

using enum ast::BinaryOp;

constexpr auto any = Kinds::any();
constexpr auto number = Kinds::number();
constexpr auto whole = Kinds(Kind::integer);
constexpr auto text = Kinds(Kind::text);
constexpr auto vehicles = Kinds(Kind::vehicles);
constexpr auto task = Kinds(Kind::task);

/// What an operator takes on either side; what may be anything else is left to the run.
struct Operation {
  ast::BinaryOp op;
  Kinds left;
  Kinds right;
};

constexpr auto operations = std::to_array<Operation>({
    {add, number, number},
    {add, text, any},
    {add, any, text},
    {add, Kind::list, any},
    {add, vehicles, vehicles},
    {add, Kind::map, Kind::map},
    {add, Kind::position, Kind::displacement},
    {subtract, number, number},
    {subtract, text, any},
    {subtract, Kind::list, any},
    {subtract, vehicles, vehicles},
    {subtract, Kind::map, Kind::map},
    {multiply, number, number},
    {multiply, text, whole},
    {multiply, Kind::list, whole},
    {divide, number, number},
    {divide, task, Kind::closure},
    {remainder, number, number},
    {power, number, number},
    {shift_right, whole, whole},
    {shift_right, task, task},
    {shift_left, whole, whole},
    {shift_left, Kind::list, any},
    {shift_left, Kind::map, Kind::map},
    {bit_and, whole, whole},
    {bit_and, vehicles, vehicles},
    {bit_and, Kind::boolean, Kind::boolean},
    {bit_xor, whole, whole},
    {bit_xor, Kind::position, number},
    {bit_xor, Kind::boolean, Kind::boolean},
    {bit_or, whole, whole},
    {bit_or, task, task},
    {bit_or, vehicles, Kind::closure},
    {bit_or, Kind::boolean, Kind::boolean},
});

bool is_order(ast::BinaryOp op) {
  return (op >= less && op <= greater_equal) || op == compare;
}
bool is_equality(ast::BinaryOp op) {
  return op == equal || op == not_equal;
}

/// Kinds that `<` and its like order among themselves. A single vehicle counts as vehicles.
constexpr auto ordered = std::to_array<Kinds>({number, text, Kind::boolean, vehicles});

bool can_meet(ast::BinaryOp op, Kinds left, Kinds right) {
  if ((op == logical_and || op == logical_or) && left == task && right == task) return false;
  if (op == find || op == match) return left.meets(text | Kinds(Kind::other)) && right.meets(text | Kinds(Kind::other));
  if (left.is_none() || right.is_none() || left.meets(Kind::other) || right.meets(Kind::other)) return true;
  auto const fits = [&](Operation const& one) {
    return one.op == op && left.meets(one.left) && right.meets(one.right);
  };
  auto const orders = [&](Kinds kind) { return left.meets(kind) && right.meets(kind); };
  if (is_order(op)) return std::ranges::any_of(ordered, orders);
  if (is_equality(op)) return left.meets(right) || (left.meets(number) && right.meets(number));
  bool const is_for_all = op == in || op == logical_and || op == logical_or || op == elvis;
  return is_for_all || std::ranges::any_of(operations, fits);
}

/// What belongs on the right of the operator, in words; empty where there is no better word than its kinds.
std::string_view wanted(ast::BinaryOp op, Kinds left) {
  if (left == task && op == divide) return "a task is ended by a closure: task / { condition }";
  if (left == task && op == shift_right) return "a task is followed by a task";
  if (left == task && op == bit_or) return "a task runs beside a task";
  if (left == vehicles && op == bit_or) return "vehicles are filtered by a closure: vehicles | { condition }";
  if (left == vehicles && op == add) return "vehicles are joined with vehicles";
  if (left == vehicles && (op == subtract || op == bit_and)) return "vehicles are compared with vehicles";
  if (left == Kinds(Kind::position) && op == bit_xor) return "an area is a position ^ a radius in metres";
  return {};
}

}  // namespace

/// `task / { condition }`: the guard can stop the task.
void Checker::operation(ast::Binary const& binary) {
  bool const is_guarded = binary.op == divide && std::holds_alternative<ast::Closure>(binary.right->node);
  auto const outer = place_;
  place_.can_be_stopped = place_.can_be_stopped || is_guarded;
  expression(binary.left);
  place_.can_be_stopped = outer.can_be_stopped;
  place_.in_task = place_.in_task || is_guarded;
  expression(binary.right);
  place_ = outer;
  dimensions(binary);
  battery_comparison(binary);
  operands(binary);
  endless_sequence(binary);
  landed_sequence(binary);
}

/// `lon -8.64`: a subtraction from something that is not a variable.
bool Checker::missing_parentheses(ast::Expr const& expr, ast::Binary const& binary) {
  if (binary.op != subtract && binary.op != add) return false;
  auto const* callee = std::get_if<ast::Name>(&binary.left->node);
  if (!callee || resolution_.find(*binary.left) || !is_callable(callee->text)) return false;
  auto const sign = binary.op == subtract ? "-" : "+";
  auto const argument = diagnostics_.source().text({binary.right->span.begin, expr.span.end});
  diagnostics_.report(code("missing-parentheses"), expr.span,
                      fmt::format("this calculates with {}, which is an instruction", callee->text),
                      {fmt::format("write {} ({}{})", callee->text, sign, argument),
                       argument_in_parentheses(diagnostics_.source(), binary.left->span, expr.span)});
  return true;
}

/// Operators on values whose kinds are known.
void Checker::operands(ast::Binary const& binary) {
  auto const left = inference_.facts(*binary.left).kinds;
  auto const right = inference_.facts(*binary.right).kinds;
  if (can_meet(binary.op, left, right)) return;
  auto hint = of_one_vehicle(*binary.left);
  if (hint.empty()) hint = of_one_vehicle(*binary.right);
  if (is_equality(binary.op)) {
    diagnostics_.report(code("never-equal"), binary.op_span,
                        fmt::format("{} never equals {}", describe(left), describe(right)), std::move(hint));
  } else if (auto const words = wanted(binary.op, left); !words.empty()) {
    diagnostics_.report(code("operand-type"), binary.right->span, fmt::format("{}, not {}", words, describe(right)));
  } else if (is_order(binary.op)) {
    diagnostics_.report(code("operand-type"), binary.op_span,
                        fmt::format("{} cannot be compared with {}", describe(left), describe(right)), std::move(hint));
  } else {
    if (left == task && right == task) hint = "write >> for one after the other, | for both at once";
    diagnostics_.report(code("operand-type"), binary.op_span,
                        fmt::format("{} has no operator {} with {}", describe(left),
                                    diagnostics_.source().text(binary.op_span), describe(right)),
                        std::move(hint));
  }
}

/// `v.battery` of a set of vehicles is a list: what to write for one of them; empty for all other expressions.
std::string Checker::of_one_vehicle(ast::Expr const& expr) {
  auto const* member = std::get_if<ast::Member>(&expr.node);
  if (!member || inference_.facts(*member->object).kinds != vehicles) return {};
  return fmt::format("this lists all; of the first vehicle write {}[0].{}",
                     diagnostics_.source().text(member->object->span), member->name.text);
}

void Checker::dimensions(ast::Binary const& binary) {
  bool const compares = is_order(binary.op) || is_equality(binary.op);
  if (binary.op != add && binary.op != subtract && !compares) return;
  auto const left = inference_.facts(*binary.left).dimension;
  auto const right = inference_.facts(*binary.right).dimension;
  if (!left || !right || *left == Dimension::none || *right == Dimension::none || left == right) return;
  if (compares) {
    diagnostics_.report(code("compared-dimensions"), binary.op_span,
                        fmt::format("this compares {} with {}", noun(*left), noun(*right)));
  } else {
    diagnostics_.report(
        code("mixed-dimensions"), binary.op_span,
        fmt::format("{} and {} have no {}", noun(*left), noun(*right), binary.op == add ? "sum" : "difference"));
  }
}

/// A battery's charge runs from 0 to 1: `battery(v) < 30` is always true.
void Checker::battery_comparison(ast::Binary const& binary) {
  if (binary.op < less || binary.op > greater_equal) return;
  auto const is_battery = [&](ast::Expr const& expr) {
    if (auto const* member = std::get_if<ast::Member>(&expr.node)) return member->name.text == "battery";
    auto const* called = std::get_if<ast::Call>(&expr.node);
    auto const* callee = called ? std::get_if<ast::Name>(&called->callee->node) : nullptr;
    return callee && callee->text == "battery" && !resolution_.functions.contains(callee->text);
  };
  auto const& limit = is_battery(*binary.left) ? binary.right : binary.left;
  if (!is_battery(*binary.left) && !is_battery(*binary.right)) return;
  auto const value = inference_.constant(*limit);
  double known = 0.0;
  if (value && std::holds_alternative<double>(*value)) known = std::get<double>(*value);
  if (value && std::holds_alternative<std::int64_t>(*value))
    known = static_cast<double>(std::get<std::int64_t>(*value));
  if (known > 1.0) {
    diagnostics_.report(code("battery-ratio"), limit->span, "battery gives 0 to 1",
                        with_unit(diagnostics_.source(), *limit, "percent"));
  }
}

}  // namespace lapwing::dolphin
