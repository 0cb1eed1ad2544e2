#pragma once

#include <span>
#include <string_view>

#include "slam/mapper_options.hpp"

namespace lapwing::slam {

/// One number of the mapper's options by its name, for who tries others (`lapwing map --set`,
/// bench/slam/sensitivity.py).
struct Parameter {
  std::string_view name;
  double (*get)(MapperOptions const&);
  void (*set)(MapperOptions&, double);
};

[[nodiscard]] std::span<Parameter const> all_parameters();

/// Whether the mapper can work with that value: more than nothing, within a factor of a thousand of the usual one.
[[nodiscard]] bool is_usable(Parameter const& parameter, double value);

}  // namespace lapwing::slam
