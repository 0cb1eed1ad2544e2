#include "vehicle/aspects/positioning.hpp"

#include <array>
#include <cstddef>

namespace lapwing::vehicle {

std::string_view gps_fix_name(int fix) {
  static constexpr std::array<std::string_view, 9> names{"no GPS",    "no fix",    "2D",     "3D", "DGPS",
                                                         "RTK float", "RTK fixed", "static", "PPP"};
  auto const index = static_cast<std::size_t>(fix);
  return index < names.size() ? names[index] : "unknown";
}

}  // namespace lapwing::vehicle
