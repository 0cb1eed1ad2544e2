#include "vision/image/internal/picture_header.hpp"

#include <algorithm>
#include <array>

#include "vision/image/internal/exif.hpp"
#include "vision/image/internal/jpeg_segments.hpp"

namespace lapwing::vision::internal {

namespace {

using base::ErrorKind;
using base::fail;

/// Upright when the segment says nothing that makes sense.
Orientation orientation_of(Bytes app1) {
  constexpr std::uint32_t orientation_tag = 0x0112;
  auto const exif = Exif::of_segment(app1);
  if (!exif) return Orientation::upright;
  auto const value = exif->value(exif->directory(), orientation_tag);
  return value && *value >= 1 && *value <= 8 ? static_cast<Orientation>(*value) : Orientation::upright;
}

/// From the start of a JPEG's coded data on, FF D9 is the end and nothing else: within the data FF is followed by 00.
bool has_end(Bytes coded) {
  constexpr std::array end{std::byte{0xFF}, std::byte{0xD9}};
  return !std::ranges::search(coded, end).empty();
}

base::Result<PictureHeader> read_jpeg(Bytes bytes) {
  PictureHeader header;
  for (auto const& [marker, body] : jpeg_segments(bytes)) {
    bool const is_frame = marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (is_frame) {
      header.height = big_endian(body, 1, 2);
      header.width = big_endian(body, 3, 2);
    } else if (marker == jpeg_app1 && header.orientation == Orientation::upright) {
      header.orientation = orientation_of(body);
    } else if (marker == jpeg_coded_data && has_end(body)) {
      return header;
    }
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
