#include "video/rtsp/jpeg.hpp"

#include <turbojpeg.h>

#include <algorithm>

#include <fmt/format.h>

namespace lapwing::video {

namespace {

base::Result<RawPicture> failed(tjhandle reader) {
  return base::fail(base::ErrorKind::invalid_input, fmt::format("a picture is no JPEG: {}", tjGetErrorStr2(reader)));
}

}  // namespace

base::Result<RawPicture> read_jpeg(std::string_view jpeg) {
  std::unique_ptr<void, decltype(&tjDestroy)> const reader(tjInitDecompress(), &tjDestroy);
  auto const* const bytes = reinterpret_cast<unsigned char const*>(jpeg.data());
  RawPicture picture;
  int subsampling = 0;
  int colours = 0;
  if (tjDecompressHeader3(reader.get(), bytes, jpeg.size(), &picture.width, &picture.height, &subsampling, &colours) !=
      0)
    return failed(reader.get());
  if (std::max(picture.width, picture.height) > most_pixels_a_side)
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("a picture of {} by {} pixels: at most {} a side are shown", picture.width,
                                  picture.height, most_pixels_a_side));
  auto pixels = std::make_shared<std::string>(4UL * static_cast<unsigned>(picture.width * picture.height), '\0');
  // What misses its end is told as a warning, which fails, too: half a picture is not shown.
  if (tjDecompress2(reader.get(), bytes, jpeg.size(), reinterpret_cast<unsigned char*>(pixels->data()), picture.width,
                    0, picture.height, TJPF_BGRX, 0) != 0)
    return failed(reader.get());
  picture.bytes = std::move(pixels);
  return picture;
}

}  // namespace lapwing::video
