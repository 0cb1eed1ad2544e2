#include "lsp/message_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>
#include <utility>

namespace lapwing::lsp {

namespace {

constexpr std::string_view header_name = "Content-Length:";

bool is_content_length(std::string_view name) {
  constexpr std::string_view wanted = "content-length";
  auto const same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
  return std::ranges::equal(name, wanted, same);
}

std::string_view trimmed(std::string_view text) {
  auto const begin = std::min(text.find_first_not_of(" \t"), text.size());
  text.remove_prefix(begin);
  return text.substr(0, text.find_last_not_of(" \t") + 1);
}

}  // namespace

std::optional<MessageReader::Message> MessageReader::next() {
  while (true) {
    compact();
    auto const skipped = std::min(to_skip_, pending_.size() - at_);
    at_ += skipped;
    to_skip_ -= skipped;
    if (to_skip_ > 0) return std::nullopt;
    if (in_body_) return take_body();
    auto const line = take_line();
    if (!line) return std::nullopt;
    if (!line->empty()) {
      read_header(*line);
      continue;
    }
    if (!length_ && mistake_.empty()) mistake_ = "a message without Content-Length";
    if (length_ && *length_ > max_size_) {
      mistake_ = fmt::format("a message of {} bytes; at most {} are read", *length_, max_size_);
      to_skip_ = *std::exchange(length_, std::nullopt);
    }
    in_body_ = length_.has_value();
    auto mistake = std::exchange(mistake_, {});
    if (!in_body_) return Message{{}, std::move(mistake)};
  }
}

/// What is no header and never ends is read over, up to where the next header may have begun.
std::optional<std::string_view> MessageReader::take_line() {
  auto const rest = std::string_view(pending_).substr(at_);
  if (auto const end = rest.find('\n'); end != std::string_view::npos) {
    at_ += end + 1;
    auto const line = rest.substr(0, end);
    return line.ends_with('\r') ? line.substr(0, end - 1) : line;
  }
  if (rest.size() > max_header_line) {
    auto const found = rest.rfind(header_name);
    bool const begins_header = found != std::string_view::npos && found > 0;
    at_ += begins_header ? found : rest.size() - header_name.size();
    mistake_ = "something that is no message";
  }
  return std::nullopt;
}

/// A line may begin with the rest of a message whose length was wrong.
void MessageReader::read_header(std::string_view line) {
  if (auto const found = line.rfind(header_name); found != std::string_view::npos) line.remove_prefix(found);
  auto const colon = line.find(':');
  if (colon == std::string_view::npos) mistake_ = "a header line without a colon";
  if (colon == std::string_view::npos || !is_content_length(line.substr(0, colon))) return;
  auto const value = trimmed(line.substr(colon + 1));
  std::size_t length = 0;
  auto const [end, failure] = std::from_chars(value.data(), value.data() + value.size(), length);
  if (failure == std::errc{} && end == value.data() + value.size()) {
    length_ = length;
  } else {
    length_.reset();
    mistake_ = "a Content-Length that is no number";
  }
}

std::optional<MessageReader::Message> MessageReader::take_body() {
  if (pending_.size() - at_ < *length_) return std::nullopt;
  Message out{pending_.substr(at_, *length_), {}};
  at_ += *length_;
  length_.reset();
  in_body_ = false;
  return out;
}

void MessageReader::compact() {
  if (at_ == pending_.size() || at_ > pending_.size() / 2) pending_.erase(0, std::exchange(at_, 0));
}

std::string with_header(std::string_view body) {
  return fmt::format("Content-Length: {}\r\n\r\n{}", body.size(), body);
}

}  // namespace lapwing::lsp
