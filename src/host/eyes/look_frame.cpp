#include "host/eyes/look_frame.hpp"

#include <utility>

#include <fmt/format.h>

namespace lapwing::host {

using base::ErrorKind;
using base::fail;
using nlohmann::json;

std::string to_bytes(LookFrame frame) {
  frame.head["bytes"] = frame.body.size();
  auto text = frame.head.dump(-1, ' ', false, json::error_handler_t::replace);
  text += '\n';
  text += frame.body;
  return text;
}

base::Result<std::optional<LookFrame>> LookFrameReader::next() {
  if (!head_) {
    auto const has_head = read_head();
    if (!has_head) return std::unexpected(has_head.error());
    if (!*has_head) return std::nullopt;
  }
  if (text_.size() < body_bytes_) return std::nullopt;
  LookFrame frame{.head = *std::exchange(head_, std::nullopt), .body = text_.substr(0, body_bytes_)};
  text_.erase(0, body_bytes_);
  return frame;
}

base::Result<bool> LookFrameReader::read_head() {
  auto const end = text_.find('\n');
  if (std::min(end, text_.size()) > most_head_bytes)
    return fail(ErrorKind::invalid_input, fmt::format("a head of more than {} bytes", most_head_bytes));
  if (end == std::string::npos) return false;
  auto head = json::parse(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
  if (!head.is_object()) return fail(ErrorKind::invalid_input, "a head that is no JSON object");
  auto const bytes = head.find("bytes");
  if (bytes != head.end() && !bytes->is_number_unsigned())
    return fail(ErrorKind::invalid_input, "a head whose `bytes` is no number of them");
  auto const count = bytes == head.end() ? 0 : bytes->get<std::uint64_t>();
  if (count > most_body_bytes)
    return fail(ErrorKind::invalid_input, fmt::format("{} bytes are more than {}", count, most_body_bytes));
  body_bytes_ = static_cast<std::size_t>(count);
  head_ = std::move(head);
  text_.erase(0, end + 1);
  return true;
}

std::optional<std::int64_t> count_in(nlohmann::json const& head, std::string_view key) {
  auto const found = head.find(key);
  if (found == head.end() || !found->is_number_integer()) return std::nullopt;
  auto const count = found->get<std::int64_t>();
  return count >= 0 && std::cmp_less_equal(count, most_body_bytes) ? std::optional(count) : std::nullopt;
}

LookFrame refusal(std::string_view message) {
  return {.head = {{"error", message}}, .body = {}};
}

std::optional<std::string> refusal_in(LookFrame const& answer) {
  auto const error = answer.head.find("error");
  if (error == answer.head.end()) return std::nullopt;
  return error->is_string() ? error->get<std::string>() : "it says that something is wrong";
}

}  // namespace lapwing::host
