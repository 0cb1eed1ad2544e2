#include "link/pictures/http_head.hpp"

#include <algorithm>
#include <cctype>

namespace lapwing::link::pictures {

namespace {

bool is_same_name(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

}  // namespace

std::optional<std::string_view> header(std::string_view head, std::string_view name) {
  while (!head.empty()) {
    auto const line = head.substr(0, head.find(end_of_line));
    head.remove_prefix(std::min(head.size(), line.size() + end_of_line.size()));
    auto const colon = line.find(':');
    if (colon == std::string_view::npos || !is_same_name(line.substr(0, colon), name)) continue;
    auto const value = line.substr(colon + 1);
    return value.substr(std::min(value.size(), value.find_first_not_of(' ')));
  }
  return std::nullopt;
}

std::string printable(std::string_view text) {
  constexpr std::size_t enough = 80;
  std::string shown(text.substr(0, enough));
  std::ranges::replace_if(shown, [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
  return shown;
}

}  // namespace lapwing::link::pictures
