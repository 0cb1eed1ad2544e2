#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "dolphin/builtin/internal/native_lists.hpp"
#include "dolphin/value/equality.hpp"
#include "dolphin/value/operators.hpp"
#include "dolphin/value/text.hpp"

/// java.lang.Math without its prefix.
namespace lapwing::dolphin::internal {
namespace {

using Arguments = Native::Arguments;

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
  auto const order = compare(arguments[0], arguments[1]);
  if (!order) return std::unexpected(order.error());
  if (*order == std::partial_ordering::unordered) return Value::real(std::nan(""));
  return (*order <= 0) == is_least ? arguments[0] : arguments[1];
}

}  // namespace

std::span<Native const> math_natives() {
  static constexpr auto pure = [](std::string_view name, int count, auto function) {
    return Native{.name = name, .least = count, .most = count, .call = function, .is_pure = true};
  };
  static std::array const table = {
      pure("abs", 1, absolute),
      pure("round", 1, rounded),
      pure("min", 2, extreme<true>),
      pure("max", 2, extreme<false>),
      pure("sqrt", 1, unary<std::sqrt>),
      pure("cbrt", 1, unary<std::cbrt>),
      pure("sin", 1, unary<std::sin>),
      pure("cos", 1, unary<std::cos>),
      pure("tan", 1, unary<std::tan>),
      pure("asin", 1, unary<std::asin>),
      pure("acos", 1, unary<std::acos>),
      pure("atan", 1, unary<std::atan>),
      pure("exp", 1, unary<std::exp>),
      pure("log", 1, unary<std::log>),
      pure("log10", 1, unary<std::log10>),
      pure("floor", 1, unary<std::floor>),
      pure("ceil", 1, unary<std::ceil>),
      pure("toRadians", 1, unary<to_radians>),
      pure("toDegrees", 1, unary<to_degrees>),
      pure("signum", 1, unary<signum>),
      pure("atan2", 2, binary<std::atan2>),
      pure("pow", 2, binary<std::pow>),
      pure("hypot", 2, binary<std::hypot>),
  };
  return table;
}

}  // namespace lapwing::dolphin::internal
