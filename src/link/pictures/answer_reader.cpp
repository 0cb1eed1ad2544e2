#include "link/pictures/answer_reader.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "link/pictures/http_head.hpp"

namespace lapwing::link::pictures {

namespace {

std::unexpected<base::Error> no_answer(std::string_view why) {
  return base::fail(base::ErrorKind::invalid_input,
                    fmt::format("what answers at the address of the drone's video is something else: {}", why));
}

}  // namespace

base::Result<std::optional<HttpAnswer>> AnswerReader::take(std::string_view bytes) {
  buffer_.append(bytes);
  if (!answer_) {
    auto const end = buffer_.find(end_of_head);
    // The blank line may have come in part.
    auto const length =
        end != std::string::npos ? end : buffer_.size() - std::min(buffer_.size(), end_of_head.size() - 1);
    if (length > largest_head) return no_answer("its head does not end");
    if (end == std::string::npos) return std::nullopt;
    if (auto const read = read_head(std::string_view(buffer_).substr(0, end)); !read)
      return std::unexpected(read.error());
    buffer_.erase(0, end + end_of_head.size());
  }
  if (buffer_.size() < length_) return std::nullopt;
  auto answer = *std::exchange(answer_, std::nullopt);
  answer.body = buffer_.substr(0, length_);
  return answer;
}

base::Result<> AnswerReader::read_head(std::string_view head) {
  constexpr std::size_t version = 9;  // "HTTP/1.1 "
  constexpr std::size_t digits = 3;
  auto const line = head.substr(0, head.find(end_of_line));
  bool const is_http = line.starts_with("HTTP/1.1 ") || line.starts_with("HTTP/1.0 ");
  auto const status = number_of<int>(is_http ? line.substr(version, digits) : std::string_view());
  constexpr int least = 100;
  constexpr int most = 599;
  if (!status || *status < least || *status > most) return no_answer(fmt::format("'{}'", printable(line)));
  auto const length = number_of<std::size_t>(header(head, "Content-Length"));
  if (!length || *length > largest_body)
    return no_answer(fmt::format("its answer has no length up to {} KiB", largest_body / 1024));
  length_ = *length;
  answer_ = HttpAnswer{.status = *status,
                       .content_type = std::string(header(head, "Content-Type").value_or("")),
                       .location = std::string(header(head, "Location").value_or(""))};
  return {};
}

}  // namespace lapwing::link::pictures
