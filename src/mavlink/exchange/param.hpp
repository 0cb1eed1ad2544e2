#pragma once

#include <string>

#include "mavlink/connection/connection.hpp"

/// The parameter protocol (https://mavlink.io/en/services/parameter.html), one parameter at a time; param_list.hpp has
/// all of them.
namespace lapwing::mavlink {

/// How a vehicle puts integers into the four bytes of a value, which are a float's: as the float that is nearest
/// (ArduPilot; exact to 24 bits), or their own bytes (PX4). AutopilotVersion::capabilities tells.
enum class ParamEncoding { c_cast, bytewise };

/// One parameter. A double holds every value that the protocol can carry (integers of up to 32 bits, floats) exactly.
struct Parameter {
  std::string name{};
  double value = 0.0;
  MavParamType type = MavParamType::real32;
  friend bool operator==(Parameter const&, Parameter const&) = default;
};

inline constexpr std::size_t longest_param_name = 16;

[[nodiscard]] bool is_integer(MavParamType type);
/// "int32", "real32".
[[nodiscard]] std::string to_string(MavParamType type);
/// The value as people and files write it: integers without a point, floats with as few digits as tell them apart.
[[nodiscard]] std::string value_text(Parameter const& parameter);

[[nodiscard]] Parameter decode_param(ParamValue const& wire, ParamEncoding encoding);
/// The bytes that carry the value. Errors (invalid_input): a fraction or a number beyond the type's range, an integer
/// of more than 24 bits that a float would change, no finite number, a 64-bit type: what is stored would be another
/// value.
[[nodiscard]] base::Result<float> encode_param(Parameter const& parameter, ParamEncoding encoding);
/// Whether the vehicle can hold both as one: floats are compared as floats.
[[nodiscard]] bool same_value(Parameter const& a, Parameter const& b);

struct ParamOptions {
  ParamEncoding encoding = ParamEncoding::c_cast;
  /// As CommandOptions have them. A name that ArduPilot does not have costs 5 s; a link that loses 30 %, and whose
  /// round trip is unknown, one read in 200.
  int tries = 8;
  base::Duration reply_timeout = std::chrono::milliseconds(600);
};

/// Asks the vehicle. Errors: not_found (the vehicle says that it has no such parameter), timed_out also for such a
/// name, since ArduPilot then stays silent, those of Connection::send.
base::Task<base::Result<Parameter>> read_param(Connection& connection, Address target, std::string name,
                                               ParamOptions options = {});

/// What a set came to.
struct ParamChange {
  Parameter before;
  Parameter after;
};

/// Asks what is there and of which type, sets it unless it is that already, and makes sure that the vehicle stored it.
/// Errors: those of `read_param`; invalid_input (the type cannot hold the value); refused when the vehicle said so or
/// stored another value (limits, rounding: names both).
base::Task<base::Result<ParamChange>> set_param(Connection& connection, Address target, std::string name, double value,
                                                ParamOptions options = {});

}  // namespace lapwing::mavlink
