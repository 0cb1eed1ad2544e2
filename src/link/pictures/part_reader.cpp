#include "link/pictures/part_reader.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "link/pictures/http_head.hpp"

namespace lapwing::link::pictures {

base::Result<std::optional<Picture>> PartReader::take(std::string_view bytes) {
  std::optional<Picture> newest;
  if (awaits_ == Awaits::nothing) return newest;
  buffer_.append(bytes);
  for (;;) {
    auto const stepped = step(newest);
    if (!stepped) {
      awaits_ = Awaits::nothing;
      buffer_.clear();
      return std::unexpected(stepped.error());
    }
    if (!*stepped) return newest;
  }
}

base::Result<bool> PartReader::step(std::optional<Picture>& newest) {
  if (awaits_ == Awaits::picture) {
    if (buffer_.size() < length_) return false;
    newest = Picture{.jpeg = std::make_shared<std::string const>(buffer_, 0, length_), .taken = taken_};
    buffer_.erase(0, length_);
    awaits_ = Awaits::part;
    return true;
  }
  auto const end = buffer_.find(end_of_head);
  // The blank line may have come in part.
  auto const length =
      end != std::string::npos ? end : buffer_.size() - std::min(buffer_.size(), end_of_head.size() - 1);
  if (length > largest_head)
    return base::fail(base::ErrorKind::invalid_input,
                      "what answers at the camera's address sends no stream of pictures");
  if (end == std::string::npos) return false;
  auto const head = std::string_view(buffer_).substr(0, end);
  auto const read = awaits_ == Awaits::answer ? read_answer(head) : read_part(head);
  if (!read) return std::unexpected(read.error());
  buffer_.erase(0, end + end_of_head.size());
  return true;
}

base::Result<> PartReader::read_answer(std::string_view head) {
  auto const status = head.substr(0, head.find(end_of_line));
  if (!status.starts_with("HTTP/1.1 200") && !status.starts_with("HTTP/1.0 200"))
    return base::fail(base::ErrorKind::refused, fmt::format("the camera's address answers '{}'", printable(status)));
  if (!header(head, "Content-Type").value_or("").starts_with("multipart/x-mixed-replace"))
    return base::fail(base::ErrorKind::invalid_input, "what answers at the camera's address is no stream of pictures");
  awaits_ = Awaits::part;
  return {};
}

base::Result<> PartReader::read_part(std::string_view head) {
  auto const length = number_of<std::size_t>(header(head, "Content-Length"));
  auto const taken_s = number_of<double>(header(head, "X-Timestamp"));
  constexpr double year_2100_s = 4.1e9;
  bool const is_dated = taken_s && *taken_s >= 0.0 && *taken_s < year_2100_s;
  if (!length || *length == 0 || *length > largest_picture || !is_dated)
    return base::fail(
        base::ErrorKind::invalid_input,
        fmt::format("a picture of the stream has no length up to {} MiB, or no time", largest_picture / 1024 / 1024));
  length_ = *length;
  // In whole microseconds: nanoseconds since 1970 are more than a double holds.
  taken_ = base::UtcTime(std::chrono::round<std::chrono::microseconds>(std::chrono::duration<double>(*taken_s)));
  awaits_ = Awaits::picture;
  return {};
}

}  // namespace lapwing::link::pictures
