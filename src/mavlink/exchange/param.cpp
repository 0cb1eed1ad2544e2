#include "mavlink/exchange/param.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "mavlink/connection/inbox.hpp"
#include "mavlink/exchange/internal/repeats.hpp"

namespace lapwing::mavlink {

using base::ErrorKind;
using base::fail;

namespace {

struct Range {
  double lowest;
  double highest;
};
template <class T>
constexpr Range range_of{static_cast<double>(std::numeric_limits<T>::lowest()),
                         static_cast<double>(std::numeric_limits<T>::max())};

/// Of the integers that four bytes can carry; nothing for other types.
std::optional<Range> range(MavParamType type) {
  switch (type) {
    case MavParamType::uint8: return range_of<std::uint8_t>;
    case MavParamType::int8: return range_of<std::int8_t>;
    case MavParamType::uint16: return range_of<std::uint16_t>;
    case MavParamType::int16: return range_of<std::int16_t>;
    case MavParamType::uint32: return range_of<std::uint32_t>;
    case MavParamType::int32: return range_of<std::int32_t>;
    default: return std::nullopt;
  }
}

double from_bytes(float wire, MavParamType type) {
  auto const bits = std::bit_cast<std::uint32_t>(wire);
  switch (type) {
    case MavParamType::uint8: return static_cast<std::uint8_t>(bits);
    case MavParamType::int8: return static_cast<std::int8_t>(bits);
    case MavParamType::uint16: return static_cast<std::uint16_t>(bits);
    case MavParamType::int16: return static_cast<std::int16_t>(bits);
    case MavParamType::uint32: return bits;
    case MavParamType::int32: return static_cast<std::int32_t>(bits);
    default: return static_cast<double>(wire);
  }
}

std::unexpected<base::Error> cannot_hold(Parameter const& parameter, std::string const& why) {
  return fail(ErrorKind::invalid_input, fmt::format("{} cannot be {}: {}", parameter.name, parameter.value, why));
}

/// Sends `request` until a value of that name comes, or the vehicle's word that none will. Vehicles also send values
/// unasked, which serve as well.
base::Task<base::Result<Parameter>> ask(Connection& connection, Address target, std::string name, Message request,
                                        ParamOptions options) {
  Inbox answers(connection, target, [name](Message const& message) {
    auto const* value = std::get_if<ParamValue>(&message);
    auto const* error = std::get_if<ParamError>(&message);
    return (value && value->name == name) || (error && error->name == name);
  });
  internal::Repeats repeats(connection, target, options.tries, options.reply_timeout);
  while (!repeats.are_over()) {
    if (auto sent = connection.send(target, request); !sent) co_return std::unexpected(sent.error());
    auto const got = co_await answers.next(connection.loop().now() + repeats.next());
    if (!got) continue;
    if (auto const* value = std::get_if<ParamValue>(&*got)) co_return decode_param(*value, options.encoding);
    auto const error = std::get<ParamError>(*got).error;
    co_return fail(error == MavParamError::does_not_exist ? ErrorKind::not_found : ErrorKind::refused,
                   fmt::format("vehicle {} answered about parameter {}: {}", target.system, name, to_string(error)));
  }
  co_return fail(ErrorKind::timed_out, fmt::format("vehicle {} did not answer about parameter {}", target.system, name),
                 "check the name: ArduPilot is silent about parameters that it does not have");
}

}  // namespace

bool is_integer(MavParamType type) {
  return range(type).has_value();
}

std::string to_string(MavParamType type) {
  switch (type) {
    case MavParamType::uint8: return "uint8";
    case MavParamType::int8: return "int8";
    case MavParamType::uint16: return "uint16";
    case MavParamType::int16: return "int16";
    case MavParamType::uint32: return "uint32";
    case MavParamType::int32: return "int32";
    case MavParamType::uint64: return "uint64";
    case MavParamType::int64: return "int64";
    case MavParamType::real32: return "real32";
    case MavParamType::real64: return "real64";
  }
  return fmt::format("type {}", static_cast<int>(type));
}

std::string value_text(Parameter const& parameter) {
  // A vehicle may call a parameter an integer and send a fraction all the same.
  if (is_integer(parameter.type) && parameter.value == std::trunc(parameter.value))
    return fmt::format("{:.0f}", parameter.value);
  return fmt::format("{}", static_cast<float>(parameter.value));
}

Parameter decode_param(ParamValue const& wire, ParamEncoding encoding) {
  auto const value =
      encoding == ParamEncoding::bytewise ? from_bytes(wire.value, wire.type) : static_cast<double>(wire.value);
  return {.name = wire.name, .value = value, .type = wire.type};
}

base::Result<float> encode_param(Parameter const& parameter, ParamEncoding encoding) {
  auto const value = parameter.value;
  auto const type = parameter.type;
  if (!std::isfinite(value)) return cannot_hold(parameter, "it is not a number");
  if (type == MavParamType::uint64 || type == MavParamType::int64 || type == MavParamType::real64)
    return cannot_hold(parameter, "the protocol cannot carry " + to_string(type));
  auto const integers = range(type);
  if (!integers) {
    if (std::abs(value) > static_cast<double>(std::numeric_limits<float>::max()))
      return cannot_hold(parameter, "it is too large for a float");
    return static_cast<float>(value);
  }
  if (value != std::trunc(value)) return cannot_hold(parameter, "it is an integer (" + to_string(type) + ")");
  if (value < integers->lowest || value > integers->highest)
    return cannot_hold(parameter,
                       fmt::format("{} holds {:.0f} to {:.0f}", to_string(type), integers->lowest, integers->highest));
  if (encoding == ParamEncoding::bytewise)
    return std::bit_cast<float>(static_cast<std::uint32_t>(static_cast<std::int64_t>(value)));
  auto const wire = static_cast<float>(value);
  if (static_cast<double>(wire) != value)
    return cannot_hold(parameter, fmt::format("this vehicle sends integers as floats, which would make {:.0f} of it",
                                              static_cast<double>(wire)));
  return wire;
}

bool same_value(Parameter const& a, Parameter const& b) {
  // Files without types call integers floats, too.
  bool const are_whole = a.value == std::trunc(a.value) && b.value == std::trunc(b.value);
  if (are_whole && (is_integer(a.type) || is_integer(b.type))) return a.value == b.value;
  if (std::isnan(a.value) || std::isnan(b.value)) return std::isnan(a.value) && std::isnan(b.value);
  return static_cast<float>(a.value) == static_cast<float>(b.value);
}

base::Task<base::Result<Parameter>> read_param(Connection& connection, Address target, std::string name,
                                               ParamOptions options) {
  if (name.empty() || name.size() > longest_param_name)
    co_return fail(ErrorKind::invalid_input,
                   fmt::format("'{}' is no parameter: names have 1 to {} characters", name, longest_param_name));
  Message const request = ParamRequestRead{.name = name};
  co_return co_await ask(connection, target, name, request, options);
}

base::Task<base::Result<ParamChange>> set_param(Connection& connection, Address target, std::string name, double value,
                                                ParamOptions options) {
  auto const before = co_await read_param(connection, target, name, options);
  if (!before) co_return std::unexpected(before.error());
  Parameter const wanted{.name = name, .value = value, .type = before->type};
  auto const wire = encode_param(wanted, options.encoding);
  if (!wire) co_return std::unexpected(wire.error());
  if (same_value(*before, wanted)) co_return ParamChange{*before, *before};
  Message const request = ParamSet{.name = name, .value = *wire, .type = wanted.type};
  auto after = co_await ask(connection, target, name, request, options);
  if (!after) co_return std::unexpected(after.error());
  // It may have been sent for another reason just before the vehicle took the new value: ask once more.
  if (!same_value(*after, wanted)) after = co_await read_param(connection, target, name, options);
  if (!after) co_return std::unexpected(after.error());
  if (same_value(*after, wanted)) co_return ParamChange{*before, *after};
  co_return fail(
      ErrorKind::refused,
      fmt::format("vehicle {} stored {} = {}, not {}", target.system, name, value_text(*after), value_text(wanted)),
      "the vehicle limits it, rounds it or does not let it be changed now");
}

}  // namespace lapwing::mavlink
