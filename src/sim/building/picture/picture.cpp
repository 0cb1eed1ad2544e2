#include "sim/building/picture/picture.hpp"

#include <fmt/format.h>

namespace lapwing::sim::building {

std::string ppm_of(Picture const& picture) {
  auto text = fmt::format("P6\n{} {}\n255\n", picture.width, picture.height);
  text.append(picture.rgb.begin(), picture.rgb.end());
  return text;
}

}  // namespace lapwing::sim::building
