#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lapwing::sim::building {

/// Red, green, blue, 8 bits each, row by row from the top.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;

  [[nodiscard]] std::uint8_t const* at(int x, int y) const {
    return rgb.data() +
           3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
  friend bool operator==(Picture const&, Picture const&) = default;
};

/// As a PPM file (P6), which every program for pictures reads.
[[nodiscard]] std::string ppm_of(Picture const& picture);

}  // namespace lapwing::sim::building
