#include <fmt/format.h>

#include <array>
#include <cmath>

#include "dolphin/builtin/internal/method_rows.hpp"
#include "dolphin/value/operators.hpp"

/// Methods of numbers.
namespace lapwing::dolphin::internal {
namespace {

Checked<Value> integer_of(Value const& number, double rounded) {
  if (number.is(ValueKind::integer)) return number;
  if (!(std::fabs(rounded) < 9.2e18)) return fault(to_text(number) + " is no integer", "ArithmeticException");
  return Value::integer(static_cast<std::int64_t>(rounded));
}

/// `x.round()` is an integer, `x.round(2)` has two decimal places.
MethodResult rounded(Call call, Value const& number) {
  if (!number.is_number()) return std::nullopt;
  if (call.arguments.empty()) return integer_of(number, std::floor(number.number() + 0.5));
  auto const places = call.integer_argument();
  if (!places) return std::unexpected(places.error());
  if (*places < 0 || *places > 15) return fault("round takes 0 to 15 decimal places", "IllegalArgumentException");
  double const scale = std::pow(10.0, static_cast<double>(*places));
  return Value::real(std::floor(number.number() * scale + 0.5) / scale);
}

MethodResult divided(Call call, Value const& number) {
  if (!number.is_number()) return std::nullopt;
  auto const& by = call.arguments[0];
  if (!number.is(ValueKind::integer) || !by.is(ValueKind::integer)) {
    return fault(fmt::format("intdiv divides integers, not {} by {}", kind_name(number), kind_name(by)),
                 "MissingMethodException");
  }
  if (by.integer() == 0) return fault("division by zero", "ArithmeticException");
  if (by.integer() == -1) return negate(number);
  return Value::integer(number.integer() / by.integer());
}

MethodResult absolute(Call /*call*/, Value const& number) {
  if (!number.is_number()) return std::nullopt;
  if (number.is(ValueKind::real)) return Value::real(std::fabs(number.real()));
  return number.integer() < 0 ? negate(number) : Checked<Value>(number);
}

MethodResult is_nan(Call /*call*/, Value const& number) {
  if (!number.is_number()) return std::nullopt;
  return Value::boolean(std::isnan(number.number()));
}

MethodResult is_infinite(Call /*call*/, Value const& number) {
  if (!number.is_number()) return std::nullopt;
  return Value::boolean(std::isinf(number.number()));
}

}  // namespace

MethodResult as_integer(Call /*call*/, Value const& number) {
  if (!number.is_number()) return std::nullopt;
  return integer_of(number, std::trunc(number.number()));
}

MethodResult as_real(Call /*call*/, Value const& number) {
  if (!number.is_number()) return std::nullopt;
  return Value::real(number.number());
}

namespace {

using namespace receivers;

constexpr auto table = std::to_array<MethodSpec>({
    written({number, "times", "closure", any, "Calls the closure with 0 to n - 1.", ""}, R"dolphin(
def times(n, f) {
  for (def i = 0; i < n; i++) { f(i) }
  return null
}
)dolphin"),
    written({number, "upto", "last, closure", any, "Calls the closure with each up to the other.", ""}, R"dolphin(
def upto(first, last, f) {
  for (def i = first; i <= last; i++) { f(i) }
  return null
}
)dolphin"),
    written({number, "step", "end, by, closure", any,
             "Calls the closure with each up to before the other, so far apart.", ""},
            R"dolphin(
def step(first, last, by, f) {
  for (def i = first; by > 0 ? i < last : i > last; i += by) { f(i) }
  return null
}
)dolphin"),
    {number, "isInfinite", "", Kind::boolean, "Whether it is beyond all numbers.", "1.0.isInfinite()", of<is_infinite>},
    {number, "div", "n", any, "The same as /.", "", of<by_operator<ast::BinaryOp::divide>>},
    {number, "mod", "n", any, "The same as %.", "", of<by_operator<ast::BinaryOp::remainder>>},
    {number, "power", "n", any, "The same as **.", "", of<by_operator<ast::BinaryOp::power>>},
    written({number, "downto", "last, closure", any, "Calls the closure with each down to the other.", ""}, R"dolphin(
def downto(first, last, f) {
  for (def i = first; i >= last; i--) { f(i) }
  return null
}
)dolphin"),
    pure({number, "intdiv", "n", Kind::integer, "Divided, without the rest.", "7.intdiv(2)", of<divided>}),
    pure({number, "abs", "", number, "Without its sign.", "(-7).abs()", of<absolute>}),
    pure({number, "round", "places?", number, "Rounded to an integer, or to so many decimal places.", "2.345.round(1)",
          of<rounded>}),
    {number, "intValue", "", Kind::integer, "As an integer.", "2.9.intValue()", of<as_integer>},
    {number, "longValue", "", Kind::integer, "As an integer.", "", of<as_integer>},
    {number, "toLong", "", Kind::integer, "As an integer.", "", of<as_integer>},
    {number, "isNaN", "", Kind::boolean, "Whether it is not a number.", "NaN.isNaN()", of<is_nan>},
    {number, "doubleValue", "", Kind::decimal, "As a decimal.", "", of<as_real>},
});

}  // namespace

std::span<MethodSpec const> number_methods() {
  return table;
}

}  // namespace lapwing::dolphin::internal
