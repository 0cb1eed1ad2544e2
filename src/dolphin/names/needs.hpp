#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/text/source.hpp"
#include "dolphin/syntax/ast.hpp"
#include "geo/position.hpp"

namespace lapwing::dolphin {

/// One `pick` of a script.
struct VehicleNeed {
  std::string type;  ///< "UAV"; empty: any
  int count = 1;
  std::vector<std::string> payload;
  base::Span span;  ///< of the pick
};

/// What a script asks of the world that it is to run in, as far as its text tells: literals, units, sums, and variables
/// that are given a value once. A pick that is repeated or never reached still counts once.
struct Needs {
  std::vector<VehicleNeed> vehicles;
  std::vector<base::Span> unclear;  ///< picks of particular vehicles, or of a type or count known only at run time
  std::optional<geo::Wgs84> home;   ///< the first home of a mission; else the first location in the text
};

[[nodiscard]] Needs needs_of(ast::Program const& program);

}  // namespace lapwing::dolphin
