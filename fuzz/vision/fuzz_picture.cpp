// Pictures: any bytes either are refused with a reason or become a picture within the limits, whose boxes stay in it
// when they are turned.
#include <cstdint>
#include <span>

#include "../require.hpp"
#include "vision/doors/classic.hpp"
#include "vision/image/image.hpp"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using lapwing::fuzz::require;
  auto const image = lapwing::vision::decode_image(std::as_bytes(std::span(data, size)));
  if (!image) {
    require(!image.error().message.empty());
    return 0;
  }
  auto const upright = image->upright();
  require(!upright.empty() && upright.total() == image->stored.total() &&
          upright.total() <= lapwing::vision::max_pixels);
  for (auto const& door : lapwing::vision::doors_by_colour(upright)) {
    auto const box = image->to_stored(door.box);
    constexpr double rounding = 1e-6;
    require(box.x >= -rounding && box.y >= -rounding && box.x + box.width <= image->stored.cols + rounding &&
            box.y + box.height <= image->stored.rows + rounding);
  }
  return 0;
}
