// JPEG that is to be shown: any bytes either are refused with a reason or become a picture within the limits.
#include <cstdint>
#include <string_view>

#include "../require.hpp"
#include "video/rtsp/jpeg.hpp"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using lapwing::fuzz::require;
  using lapwing::video::most_pixels_a_side;
  auto const picture = lapwing::video::read_jpeg({reinterpret_cast<char const*>(data), size});
  if (!picture) {
    require(!picture.error().message.empty());
    return 0;
  }
  require(picture->width > 0 && picture->width <= most_pixels_a_side);
  require(picture->height > 0 && picture->height <= most_pixels_a_side);
  require(picture->bytes->size() == 4UL * static_cast<unsigned>(picture->width * picture->height));
  return 0;
}
