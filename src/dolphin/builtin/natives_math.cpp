#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "dolphin/builtin/internal/native_lists.hpp"
#include "dolphin/names/row_parameters.hpp"
#include "dolphin/value/equality.hpp"
#include "dolphin/value/operators.hpp"
#include "dolphin/value/text.hpp"

/// java.lang.Math without its prefix.
namespace lapwing::dolphin::internal {
namespace {

std::unexpected<Fault> not_a_number(Value const& value) {
  return fault(fmt::format("expected a number, not {}", kind_name(value)), "IllegalArgumentException");
}

template <double (*function)(double)>
Checked<Value> unary(Runtime& /*runtime*/, Fiber& /*fiber*/, Arguments arguments) {
  if (!arguments[0].is_number()) return not_a_number(arguments[0]);
  return Value::real(function(arguments[0].number()));
}

template <double (*function)(double, double)>
Checked<Value> binary(Runtime& /*runtime*/, Fiber& /*fiber*/, Arguments arguments) {
  for (auto const& argument : arguments) {
    if (!argument.is_number()) return not_a_number(argument);
  }
  return Value::real(function(arguments[0].number(), arguments[1].number()));
}

double to_radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}
double to_degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}
double signum(double x) {
  return x > 0 ? 1.0 : x < 0 ? -1.0 : x;
}

Checked<Value> absolute(Runtime& /*runtime*/, Fiber& /*fiber*/, Arguments arguments) {
  auto const& x = arguments[0];
  if (!x.is_number()) return not_a_number(x);
  if (x.is(ValueKind::real)) return Value::real(std::fabs(x.real()));
  return x.integer() < 0 ? negate(x) : Checked<Value>(x);
}

Checked<Value> rounded(Runtime& /*runtime*/, Fiber& /*fiber*/, Arguments arguments) {
  auto const& x = arguments[0];
  if (!x.is_number()) return not_a_number(x);
  if (x.is(ValueKind::integer)) return x;
  if (!(std::fabs(x.real()) < 9.2e18))
    return fault(fmt::format("{} has no nearest integer", to_text(x)), "ArithmeticException");
  return Value::integer(static_cast<std::int64_t>(std::floor(x.real() + 0.5)));
}

template <bool is_least>
Checked<Value> extreme(Runtime& /*runtime*/, Fiber& /*fiber*/, Arguments arguments) {
  Value best = arguments[0];
  for (auto const& one : arguments.subspan(1)) {
    auto const order = compare(best, one);
    if (!order) return std::unexpected(order.error());
    if (*order == std::partial_ordering::unordered) return Value::real(std::nan(""));
    if ((*order <= 0) != is_least) best = one;
  }
  return best;
}

/// A function of numbers as in java.lang.Math.
InstructionSpec maths(std::string_view name, std::size_t count, std::string_view doc, NativeFunction call) {
  using namespace rows;
  std::vector<ParameterSpec> parameters(count, plain("x", number));
  if (count == 2) parameters[1].name = "y";
  return {.name = name,
          .signatures = {takes(std::move(parameters))},
          .result = number,
          .doc = doc,
          .call = call,
          .is_pure = true};
}

}  // namespace

std::vector<InstructionSpec> maths_words() {
  using namespace rows;
  return {
      maths("abs", 1, "Without its sign.", absolute),
      maths("sqrt", 1, "Square root.", unary<std::sqrt>),
      maths("cbrt", 1, "Cube root.", unary<std::cbrt>),
      maths("sin", 1, "Sine of radians.", unary<std::sin>),
      maths("cos", 1, "Cosine of radians.", unary<std::cos>),
      maths("tan", 1, "Tangent of radians.", unary<std::tan>),
      maths("asin", 1, "Arc sine, radians.", unary<std::asin>),
      maths("acos", 1, "Arc cosine, radians.", unary<std::acos>),
      maths("atan", 1, "Arc tangent, radians.", unary<std::atan>),
      maths("atan2", 2, "The angle of the point (y, x), radians.", binary<std::atan2>),
      maths("exp", 1, "e to the power of x.", unary<std::exp>),
      maths("log", 1, "Natural logarithm.", unary<std::log>),
      maths("log10", 1, "Decimal logarithm.", unary<std::log10>),
      maths("pow", 2, "x to the power of y.", binary<std::pow>),
      maths("hypot", 2, "Length of (x, y).", binary<std::hypot>),
      maths("floor", 1, "Rounded down.", unary<std::floor>),
      maths("ceil", 1, "Rounded up.", unary<std::ceil>),
      maths("round", 1, "Rounded to the nearest integer.", rounded),
      maths("signum", 1, "-1, 0 or 1.", unary<signum>),
      maths("toRadians", 1, "Degrees to radians.", unary<to_radians>),
      maths("toDegrees", 1, "Radians to degrees.", unary<to_degrees>),
      {.name = "min",
       .signatures = {takes_many(plain("x", any))},
       .result = any,
       .doc = "The smallest.",
       .example = "message min(3, 1, 2)",
       .call = extreme<true>,
       .is_pure = true},
      {.name = "max",
       .signatures = {takes_many(plain("x", any))},
       .result = any,
       .doc = "The largest.",
       .example = "message max(3, 1, 2)",
       .call = extreme<false>,
       .is_pure = true},
  };
}

}  // namespace lapwing::dolphin::internal
