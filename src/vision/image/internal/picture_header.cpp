#include "vision/image/internal/picture_header.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

namespace lapwing::vision::internal {

namespace {

using base::ErrorKind;
using base::fail;
using Bytes = std::span<std::byte const>;

std::uint32_t byte_at(Bytes bytes, std::size_t at) {
  return at < bytes.size() ? std::to_integer<std::uint32_t>(bytes[at]) : 0;
}

/// Numbers of `length` bytes; what lies beyond the end counts as 0.
std::uint32_t big_endian(Bytes bytes, std::size_t at, std::size_t length) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < length; ++k) value = (value << 8U) | byte_at(bytes, at + k);
  return value;
}

std::uint32_t little_endian(Bytes bytes, std::size_t at, std::size_t length) {
  std::uint32_t value = 0;
  for (std::size_t k = length; k-- > 0;) value = (value << 8U) | byte_at(bytes, at + k);
  return value;
}

bool says(Bytes bytes, std::size_t at, std::string_view text) {
  if (bytes.size() < at + text.size()) return false;
  return std::equal(text.begin(), text.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
                    [](char c, std::byte b) { return static_cast<std::byte>(c) == b; });
}

/// Of the TIFF directory that a JPEG's APP1 segment holds; upright when it says nothing that makes sense.
Orientation orientation_of_exif(Bytes segment) {
  if (!says(segment, 0, std::string_view("Exif\0\0", 6))) return Orientation::upright;
  auto const tiff = segment.subspan(6);
  bool const is_little = says(tiff, 0, "II");
  auto const number = [&](std::size_t at, std::size_t length) {
    return is_little ? little_endian(tiff, at, length) : big_endian(tiff, at, length);
  };
  constexpr std::size_t entry_bytes = 12;
  constexpr std::uint32_t orientation_tag = 0x0112;
  std::size_t const directory = number(4, 4);
  std::size_t const entries = number(directory, 2);
  for (std::size_t k = 0; k < entries; ++k) {
    std::size_t const entry = directory + 2 + k * entry_bytes;
    if (entry + entry_bytes > tiff.size()) break;
    if (number(entry, 2) != orientation_tag) continue;
    auto const value = number(entry + 8, 2);
    return value >= 1 && value <= 8 ? static_cast<Orientation>(value) : Orientation::upright;
  }
  return Orientation::upright;
}

/// From the start of a JPEG's coded data on, FF D9 is the end and nothing else: within the data FF is followed by 00.
bool has_end(Bytes coded) {
  constexpr std::array end{std::byte{0xFF}, std::byte{0xD9}};
  return !std::ranges::search(coded, end).empty();
}

base::Result<PictureHeader> read_jpeg(Bytes bytes) {
  PictureHeader header;
  std::size_t at = 2;
  while (at + 4 <= bytes.size()) {
    if (byte_at(bytes, at) != 0xFF) break;
    auto const marker = byte_at(bytes, at + 1);
    if (marker == 0xFF) {  // filling
      ++at;
      continue;
    }
    if (marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8)) {  // these stand alone
      at += 2;
      continue;
    }
    std::size_t const length = big_endian(bytes, at + 2, 2);
    if (length < 2 || at + 2 + length > bytes.size()) break;
    auto const segment = bytes.subspan(at + 4, length - 2);
    bool const is_frame = marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (is_frame) {
      header.height = big_endian(segment, 1, 2);
      header.width = big_endian(segment, 3, 2);
    } else if (marker == 0xE1 && header.orientation == Orientation::upright) {
      header.orientation = orientation_of_exif(segment);
    } else if (marker == 0xDA) {
      if (has_end(bytes.subspan(at))) return header;
      break;
    }
    at += 2 + length;
  }
  return fail(ErrorKind::invalid_input, "the JPEG picture ends before its end", "copy it again; the file is cut off");
}

base::Result<PictureHeader> read_webp(Bytes bytes) {
  constexpr std::uint32_t lossy_size = 0x3FFF;
  if (says(bytes, 12, "VP8X"))
    return PictureHeader{.width = little_endian(bytes, 24, 3) + 1, .height = little_endian(bytes, 27, 3) + 1};
  if (says(bytes, 12, "VP8L")) {
    auto const both = little_endian(bytes, 21, 4);
    return PictureHeader{.width = (both & lossy_size) + 1, .height = ((both >> 14U) & lossy_size) + 1};
  }
  return PictureHeader{.width = little_endian(bytes, 26, 2) & lossy_size,
                       .height = little_endian(bytes, 28, 2) & lossy_size};
}

base::Result<PictureHeader> read_any(Bytes bytes) {
  if (bytes.empty()) return fail(ErrorKind::invalid_input, "the file is empty");
  if (says(bytes, 0, "\xFF\xD8\xFF")) return read_jpeg(bytes);
  if (says(bytes, 0, "\x89PNG\r\n\x1A\n") && says(bytes, 12, "IHDR"))
    return PictureHeader{.width = big_endian(bytes, 16, 4), .height = big_endian(bytes, 20, 4)};
  if (says(bytes, 0, "RIFF") && says(bytes, 8, "WEBP")) return read_webp(bytes);
  return fail(ErrorKind::invalid_input, "not a picture that can be read", "give a JPEG, PNG or WebP file");
}

}  // namespace

base::Result<PictureHeader> read_header(Bytes bytes) {
  auto header = read_any(bytes);
  if (header && (header->width == 0 || header->height == 0))
    return fail(ErrorKind::invalid_input, "the picture has no size", "the file is damaged");
  return header;
}

}  // namespace lapwing::vision::internal
