#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bus/messages/common.hpp"

/// sensor_msgs: pictures.
namespace lapwing::bus {

struct Image {
  Header header = {};  ///< the moment that the light fell in
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::string encoding = {};      ///< "rgb8", "bgr8", "mono8", ...
  std::uint8_t is_bigendian = 0;  ///< of pixels of more than a byte
  std::uint32_t step = 0;         ///< bytes from row to row
  std::vector<std::uint8_t> data = {};
  friend bool operator==(Image const&, Image const&) = default;
};
template <>
struct Description<Image> {
  static constexpr std::string_view name = "sensor_msgs/msg/Image";
  static constexpr auto fields = std::tuple{Field{"header", &Image::header},
                                            Field{"height", &Image::height},
                                            Field{"width", &Image::width},
                                            Field{"encoding", &Image::encoding},
                                            Field{"is_bigendian", &Image::is_bigendian},
                                            Field{"step", &Image::step},
                                            Field{"data", &Image::data}};
};

struct CompressedImage {
  Header header = {};
  std::string format = {};  ///< "jpeg", "png", "rgb8; jpeg compressed bgr8"
  std::vector<std::uint8_t> data = {};
  friend bool operator==(CompressedImage const&, CompressedImage const&) = default;
};
template <>
struct Description<CompressedImage> {
  static constexpr std::string_view name = "sensor_msgs/msg/CompressedImage";
  static constexpr auto fields =
      std::tuple{Field{"header", &CompressedImage::header}, Field{"format", &CompressedImage::format},
                 Field{"data", &CompressedImage::data}};
};

}  // namespace lapwing::bus
