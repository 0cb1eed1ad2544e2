#include "link/operator_link/wire/json_objects.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/text/printable.hpp"

namespace lapwing::link::operator_link {

namespace {

/// Deeper than any message; a bound for what a stranger can make this remember.
constexpr std::size_t most_brackets = 64;
/// What is shown of something that is wrong.
constexpr std::size_t shown = 40;

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

}  // namespace

std::optional<JsonObjects::Item> JsonObjects::next() {
  if (items_.empty()) return std::nullopt;
  auto item = std::move(items_.front());
  items_.pop_front();
  return item;
}

void JsonObjects::feed(Bytes bytes) {
  for (auto const byte : bytes) {
    auto const c = static_cast<char>(byte);
    if (brackets_.empty())
      between(c);
    else if (in_text_)
      within_text(c);
    else
      within(c);
  }
}

void JsonObjects::between(char c) {
  if (c == '{') return begin();
  if (is_blank(c)) {
    in_garbage_ = in_garbage_ && c != '\n';
    return;
  }
  if (!std::exchange(in_garbage_, true))
    items_.push_back(std::unexpected(fmt::format("'{}' where an object must begin", base::printable({&c, 1}))));
}

void JsonObjects::within_text(char c) {
  if (c == '\n' || c == '\r') {
    give_up("a line ends within a text");
    in_garbage_ = false;  // it has ended with the line
    return;
  }
  keep(c);
  if (is_escaped_) {
    is_escaped_ = false;
  } else if (c == '\\') {
    is_escaped_ = true;
  } else if (c == '"') {
    in_text_ = false;
    before_ = c;
  }
}

void JsonObjects::within(char c) {
  if (c == '{' && !may_open_object()) {
    give_up("an object begins where none can stand, so the one before was cut off");
    return begin();
  }
  if (c == '{' || c == '[') return open(c);
  if (c == '}' || c == ']') return close(c);
  keep(c);
  in_text_ = c == '"';
  if (!is_blank(c)) before_ = c;
}

bool JsonObjects::may_open_object() const {
  return brackets_.back() == '{' ? before_ == ':' : before_ == '[' || before_ == ',';
}

void JsonObjects::open(char c) {
  if (brackets_.size() == most_brackets) return give_up(fmt::format("more than {} brackets are open", most_brackets));
  keep(c);
  brackets_.push_back(c);
  before_ = c;
}

void JsonObjects::close(char c) {
  keep(c);
  if ((brackets_.back() == '{') != (c == '}')) return give_up("a bracket does not match");
  brackets_.pop_back();
  before_ = c;
  if (brackets_.empty()) finish();
}

void JsonObjects::begin() {
  object_ = "{";
  brackets_ = "{";
  before_ = '{';
  in_text_ = is_escaped_ = is_too_long_ = in_garbage_ = false;
}

void JsonObjects::keep(char c) {
  if (is_too_long_) return;
  if (object_.size() < longest_) {
    object_.push_back(c);
    return;
  }
  is_too_long_ = true;
  items_.push_back(std::unexpected(fmt::format("an object of more than {} bytes, which begins with {}", longest_,
                                               base::printable(object_.substr(0, shown)))));
  object_ = {};
}

void JsonObjects::finish() {
  if (!is_too_long_) items_.push_back(std::move(object_));
  object_ = {};
}

void JsonObjects::give_up(std::string why) {
  if (!is_too_long_)
    items_.push_back(std::unexpected(fmt::format("{}: {}", why, base::printable(object_.substr(0, shown)))));
  object_ = {};
  brackets_.clear();
  in_text_ = false;
  in_garbage_ = true;  // the rest of the line belongs to it
}

}  // namespace lapwing::link::operator_link
