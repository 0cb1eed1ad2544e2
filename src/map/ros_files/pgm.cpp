#include "map/ros_files/pgm.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

namespace lapwing::map {

namespace {

constexpr std::int64_t most_pixels = 400'000'000;

bool is_space(char letter) {
  return letter == ' ' || (letter >= '\t' && letter <= '\r');
}

/// Takes the next number off the front, over blanks and comments.
std::optional<int> take_number(std::string_view& bytes) {
  while (!bytes.empty() && (is_space(bytes.front()) || bytes.front() == '#')) {
    if (bytes.front() == '#')
      bytes.remove_prefix(std::min(bytes.find('\n'), bytes.size()));
    else
      bytes.remove_prefix(1);
  }
  int number = 0;
  auto const [end, error] = std::from_chars(bytes.data(), bytes.data() + bytes.size(), number);
  if (error != std::errc() || number < 0) return {};
  bytes.remove_prefix(static_cast<std::size_t>(end - bytes.data()));
  return number;
}

std::uint8_t scaled(int value, int greatest) {
  return static_cast<std::uint8_t>((std::min(value, greatest) * 255 + greatest / 2) / greatest);
}

}  // namespace

base::Result<GreyPicture> read_pgm(std::string_view bytes) {
  auto const wrong = [](char const* why) {
    return base::fail(base::ErrorKind::invalid_input, why, "is it a whole PGM file (P5 or P2)?");
  };
  if (!is_pgm(bytes)) return wrong("it does not begin with P5 or P2");
  bool const is_plain = bytes[1] == '2';
  bytes.remove_prefix(2);
  auto const width = take_number(bytes);
  auto const height = take_number(bytes);
  auto const greatest = take_number(bytes);
  if (!width || !height || !greatest) return wrong("its head lacks width, height or greatest value");
  if (*width == 0 || *height == 0 || *greatest == 0 || *greatest > 65535)
    return wrong("its width, height or greatest value makes no picture");
  auto const pixels = std::int64_t{*width} * *height;
  if (pixels > most_pixels) return wrong("it has more than 400 million pixels");
  auto const count = static_cast<std::size_t>(pixels);
  std::size_t const a_pixel = is_plain ? 1 : *greatest > 255 ? 2 : 1;
  // A plain pixel takes a digit and a blank before it at least.
  if (bytes.size() < count * (is_plain ? 2 : a_pixel) + (is_plain ? 0 : 1)) return wrong("it ends before its last row");
  GreyPicture picture{*width, *height, {}};
  picture.values.reserve(count);
  if (!is_plain) bytes.remove_prefix(1);
  for (std::size_t i = 0; i < count; ++i) {
    int value = 0;
    if (is_plain) {
      auto const number = take_number(bytes);
      if (!number) return wrong("it ends before its last row, or a pixel is no number");
      value = *number;
    } else {
      for (std::size_t part = 0; part < a_pixel; ++part)
        value = value * 256 + static_cast<unsigned char>(bytes[i * a_pixel + part]);
    }
    picture.values.push_back(scaled(std::min(value, *greatest), *greatest));
  }
  return picture;
}

}  // namespace lapwing::map
