#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "mavlink/exchange/param.hpp"

/// Parameter files of other ground stations.
namespace lapwing::parameters {

using mavlink::Parameter;

struct ParameterFile {
  std::vector<Parameter> parameters;    ///< of the autopilot, in the file's order; each name once
  bool has_types = false;               ///< QGroundControl's does; else every type is real32
  std::size_t of_other_components = 0;  ///< left out: cameras, gimbals
};

/// Files have at most so many; larger ones are refused.
inline constexpr std::size_t max_file_parameters = 20'000;

/// Reads QGroundControl's file (`.params`: vehicle id, component id, name, value, type, separated by tabs) or Mission
/// Planner's and MAVProxy's (`.param`, `.parm`: NAME,VALUE or NAME VALUE); `#` begins a comment. `file` is the name for
/// messages. Errors are invalid_input and say where: "a.params:7: ...".
[[nodiscard]] base::Result<ParameterFile> read_parameter_file(std::string_view file, std::string_view text);

/// What QGroundControl writes above the values.
struct FileHeader {
  std::uint8_t system_id = 1;
  std::string stack = {};    ///< "ArduPilot"
  std::string vehicle = {};  ///< "copter"
  std::string version = {};  ///< "4.6.0"
};
/// QGroundControl's file. Values read back exactly.
[[nodiscard]] std::string qgroundcontrol_text(std::span<Parameter const> parameters, FileHeader const& header);
/// Mission Planner's file: without types.
[[nodiscard]] std::string mission_planner_text(std::span<Parameter const> parameters);

}  // namespace lapwing::parameters
