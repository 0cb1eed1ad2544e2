#pragma once

#include <string>

#include "base/log.hpp"

namespace lapwing::apps {

/// The content of models/cars.onnx. Empty when it is not there, which is said: vehicles are looked for by their
/// contrast then.
[[nodiscard]] std::string car_network(base::Logger const& log);

}  // namespace lapwing::apps
