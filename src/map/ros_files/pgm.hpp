#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace lapwing::map {

/// A grey picture, row by row from the top, 0 black and 255 white whatever range the file has.
struct GreyPicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> values;
};

/// Portable grey maps as netpbm has them (pgm(5)): binary `P5` and plain `P2`, comments, any greatest value up to
/// 65535. Error: invalid_input for anything else, for one that ends too early, and for more than 400 million pixels.
[[nodiscard]] base::Result<GreyPicture> read_pgm(std::string_view bytes);

[[nodiscard]] inline bool is_pgm(std::string_view bytes) {
  return bytes.starts_with("P5") || bytes.starts_with("P2");
}

}  // namespace lapwing::map
