#include "vision/image/image.hpp"

#include <vector>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

#include "base/assert.hpp"
#include "vision/image/internal/picture_header.hpp"

namespace lapwing::vision {

namespace {

using base::ErrorKind;
using base::fail;

/// An upright picture is the stored one, transposed if `swaps`, then mirrored as said.
struct Turn {
  bool swaps;
  bool mirrors_x;
  bool mirrors_y;
};

Turn turn_of(Orientation orientation) {
  switch (orientation) {
    case Orientation::upright: return {false, false, false};
    case Orientation::mirrored: return {false, true, false};
    case Orientation::rotated_180: return {false, true, true};
    case Orientation::mirrored_180: return {false, false, true};
    case Orientation::mirrored_270: return {true, false, false};
    case Orientation::rotated_90: return {true, true, false};
    case Orientation::mirrored_90: return {true, true, true};
    case Orientation::rotated_270: return {true, false, true};
  }
  return {false, false, false};
}

/// OpenCV throws what a decoder says; to whoever gave the file it is one thing.
cv::Mat decoded(std::span<std::byte const> bytes) {
  try {
    cv::Mat const view(
        1, static_cast<int>(bytes.size()), CV_8U,
        const_cast<std::byte*>(bytes.data()));  // NOLINT(cppcoreguidelines-pro-type-const-cast): only read
    return cv::imdecode(view, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (cv::Exception const&) {
    return {};
  }
}

}  // namespace

cv::Mat Image::upright() const {
  auto const turn = turn_of(orientation);
  cv::Mat out = stored;
  if (turn.swaps) out = out.t();
  if (turn.mirrors_x || turn.mirrors_y) {
    cv::Mat flipped;
    int const both = -1;
    cv::flip(out, flipped, turn.mirrors_x && turn.mirrors_y ? both : (turn.mirrors_x ? 1 : 0));
    out = std::move(flipped);
  }
  return out;
}

Box Image::to_stored(Box const& of_upright) const {
  auto const turn = turn_of(orientation);
  double const width = turn.swaps ? stored.rows : stored.cols;
  double const height = turn.swaps ? stored.cols : stored.rows;
  Box box = of_upright;
  if (turn.mirrors_x) box.x = width - box.x - box.width;
  if (turn.mirrors_y) box.y = height - box.y - box.height;
  if (turn.swaps) box = {.x = box.y, .y = box.x, .width = box.height, .height = box.width};
  return box;
}

base::Result<Image> decode_image(std::span<std::byte const> bytes) {
  if (bytes.size() > max_picture_bytes)
    return fail(ErrorKind::invalid_input, fmt::format("{} MB is too large for a picture", bytes.size() >> 20U),
                fmt::format("files of up to {} MB are read", max_picture_bytes >> 20U));
  auto const header = internal::read_header(bytes);
  if (!header) return std::unexpected(header.error());
  if (std::uint64_t{header->width} * header->height > max_pixels)
    return fail(ErrorKind::invalid_input,
                fmt::format("{} by {} pixels are too many for a picture", header->width, header->height),
                fmt::format("pictures of up to {} megapixels are read", max_pixels / 1'000'000));
  Image image{.stored = decoded(bytes), .orientation = header->orientation};
  if (image.stored.empty() || image.stored.type() != CV_8UC3)
    return fail(ErrorKind::invalid_input, "the picture cannot be decoded", "the file is damaged or cut off");
  return image;
}

std::string encode_jpeg(cv::Mat const& pixels) {
  LAPWING_ASSERT(!pixels.empty() && pixels.depth() == CV_8U);
  std::vector<unsigned char> bytes;
  constexpr int quality = 90;
  cv::imencode(".jpg", pixels, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
  return {bytes.begin(), bytes.end()};
}

}  // namespace lapwing::vision
