#include "video/files/file_bytes.hpp"

#include <fstream>
#include <iterator>
#include <span>

#include <fmt/format.h>

#include "vision/image/image.hpp"

namespace lapwing::video {

base::Result<std::string> bytes_of(std::filesystem::path const& file, std::size_t most) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    return base::fail(base::ErrorKind::not_found, fmt::format("there is no file {}", file.string()));
  auto const size = std::filesystem::file_size(file, error);
  if (!error && size > most)
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("{} has {} bytes, {} at most are read", file.string(), size, most));
  std::ifstream in(file, std::ios::binary);
  std::string bytes(error ? 0 : size, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (error || !in || static_cast<std::size_t>(in.gcount()) != bytes.size())
    return base::fail(base::ErrorKind::io, fmt::format("{} cannot be read", file.string()));
  return bytes;
}

base::Result<cv::Mat> picture_of(std::filesystem::path const& file) {
  auto const bytes = bytes_of(file, vision::max_picture_bytes);
  if (!bytes) return std::unexpected(bytes.error());
  auto image = vision::decode_image(std::as_bytes(std::span(*bytes)));
  if (!image)
    return base::fail(image.error().kind, fmt::format("{}: {}", file.string(), image.error().message),
                      image.error().hint);
  return image->stored;
}

}  // namespace lapwing::video
