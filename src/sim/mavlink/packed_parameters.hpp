#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/model/parameter_table.hpp"

namespace lapwing::sim {

/// Which parameters ArduPilot's file `@PARAM/param.pck` is to hold.
struct PackedSelection {
  std::size_t start = 0;
  std::size_t count = 0;  ///< 0: all that follow
  bool with_defaults = false;
};

/// Reads "@PARAM/param.pck" with what may follow it: "?start=10&count=5&withdefaults=1". Nothing for other files.
[[nodiscard]] std::optional<PackedSelection> packed_parameters_named(std::string_view path);

/// The file's content. No value crosses a multiple of `read_size`, so that a part that is read again is never half of
/// an old and half of a new value; zeros before an entry make room for that.
[[nodiscard]] std::vector<std::uint8_t> pack(ParameterTable const& parameters, PackedSelection const& selection,
                                             std::size_t read_size);

}  // namespace lapwing::sim
