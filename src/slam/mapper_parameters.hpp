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

}  // namespace lapwing::slam
