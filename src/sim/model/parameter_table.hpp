#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "mavlink/codec/enums.hpp"
#include "sim/model/kind.hpp"

namespace lapwing::sim {

/// One parameter of the autopilot. Names, types and units are its own (centimetres where ArduPilot has centimetres).
struct Parameter {
  std::string name;
  float value = 0.0F;
  mavlink::MavParamType type = mavlink::MavParamType::real32;
  float standard = 0.0F;  ///< what it is unless somebody sets it
};

/// PX4 puts the four bytes of a whole number where the message has a float ("bytewise" encoding), and back.
[[nodiscard]] float bytewise(Parameter const& parameter);
[[nodiscard]] float from_bytewise(float on_the_wire, mavlink::MavParamType type);

/// What a parameter is to be instead of its default.
struct ParameterSetting {
  std::string name;
  float value = 0.0F;
};

/// Reads "SR0_POSITION=10". Errors: invalid_input. Whether there is such a parameter depends on the vehicle.
[[nodiscard]] base::Result<ParameterSetting> parse_parameter(std::string_view text);

/// The autopilot's parameter table: those of ArduPilot's or PX4's that matter to a ground station or to this
/// simulation.
class ParameterTable {
 public:
  ParameterTable(Kind const& kind, int system_id);

  [[nodiscard]] std::vector<Parameter> const& all() const { return table_; }
  [[nodiscard]] std::optional<std::size_t> index_of(std::string_view name) const;
  /// The value, or `otherwise` when this family has no such parameter.
  [[nodiscard]] double value(std::string_view name, double otherwise = 0.0) const;
  /// False when there is no such parameter.
  bool set(std::string_view name, float value);
  /// PX4's checksum of all names and values, which it sends as the parameter _HASH_CHECK.
  [[nodiscard]] std::uint32_t hash() const;
  /// Grows with every change.
  [[nodiscard]] unsigned revision() const { return revision_; }

 private:
  std::vector<Parameter> table_;  // in alphabetical order
  unsigned revision_ = 1;
};

}  // namespace lapwing::sim
