#include "robot/ros/ros_picture.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <fmt/format.h>

namespace lapwing::robot::ros {

using base::ErrorKind;
using base::fail;

namespace {

constexpr std::uint64_t most_pixels = 40'000'000;
constexpr std::size_t channels = 3;

/// Where the bytes of a pixel have red, green and blue, and how many bytes it has.
struct Encoding {
  std::string_view name;
  std::size_t bytes;
  std::array<std::size_t, channels> rgb;
};
constexpr auto encodings = std::to_array<Encoding>({{"rgb8", 3, {0, 1, 2}},
                                                    {"bgr8", 3, {2, 1, 0}},
                                                    {"rgba8", 4, {0, 1, 2}},
                                                    {"bgra8", 4, {2, 1, 0}},
                                                    {"mono8", 1, {0, 0, 0}}});

}  // namespace

base::Result<RosPicture> picture_of(bus::Image const& image) {
  auto const encoding = std::ranges::find(encodings, image.encoding, &Encoding::name);
  if (encoding == encodings.end())
    return fail(ErrorKind::invalid_input, fmt::format("pictures come as '{:.20}'", image.encoding),
                "rgb8, bgr8, rgba8, bgra8 and mono8 are read, and sensor_msgs/msg/CompressedImage");
  std::uint64_t const width = image.width;
  std::uint64_t const height = image.height;
  if (width == 0 || height == 0 || width * height > most_pixels)
    return fail(ErrorKind::invalid_input, fmt::format("a picture of {} times {} pixels", width, height));
  if (image.step < width * encoding->bytes || image.data.size() < image.step * (height - 1) + width * encoding->bytes)
    return fail(ErrorKind::invalid_input, fmt::format("{} bytes are no {} times {} pixels of {}", image.data.size(),
                                                      width, height, image.encoding));
  RosPicture picture{.bytes = {}, .width = static_cast<int>(width), .height = static_cast<int>(height)};
  picture.bytes.reserve(width * height * channels);
  for (std::uint64_t row = 0; row < height; ++row) {
    auto const* pixel = image.data.data() + row * image.step;
    for (std::uint64_t column = 0; column < width; ++column, pixel += encoding->bytes)
      for (auto const at : encoding->rgb) picture.bytes += static_cast<char>(pixel[at]);
  }
  return picture;
}

base::Result<RosPicture> picture_of(bus::CompressedImage const& image) {
  if (image.data.empty()) return fail(ErrorKind::invalid_input, "an empty picture");
  return RosPicture{.bytes = {image.data.begin(), image.data.end()}, .width = 0, .height = 0};
}

}  // namespace lapwing::robot::ros
