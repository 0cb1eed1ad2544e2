#include "base/text/edit.hpp"

#include <algorithm>

namespace lapwing::base {

std::string applied(std::string_view text, std::span<Edit const> edits, Span within) {
  std::string out;
  auto const end = std::min<std::size_t>(within.end, text.size());
  auto at = std::min<std::size_t>(within.begin, end);
  for (auto const& edit : edits) {
    if (edit.span.begin < at || edit.span.end > end) continue;
    out.append(text.substr(at, edit.span.begin - at)).append(edit.replacement);
    at = edit.span.end;
  }
  return out.append(text.substr(at, end - at));
}

std::string applied(std::string_view text, std::span<Edit const> edits) {
  return applied(text, edits, {0, static_cast<std::uint32_t>(text.size())});
}

}  // namespace lapwing::base
