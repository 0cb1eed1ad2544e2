#include "base/assert.hpp"

#include <cstdio>
#include <cstdlib>

namespace lapwing::base::internal {

namespace {

/// From the folder of the sources on: the rest is the place on the machine that built it.
std::string_view in_sources(std::string_view file) {
  auto const at = file.rfind("src/");
  return at == std::string_view::npos ? file : file.substr(at);
}

/// The first of the names, up to a comma outside of brackets and texts, which is taken off.
std::string_view take_name(std::string_view& names) {
  int depth = 0;
  bool is_quoted = false;
  std::size_t end = 0;
  for (; end < names.size(); ++end) {
    char const c = names[end];
    if (c == '"') is_quoted = !is_quoted;
    if (is_quoted) continue;
    if (c == '(' || c == '[' || c == '{') ++depth;
    if (c == ')' || c == ']' || c == '}') --depth;
    if (c == ',' && depth == 0) break;
  }
  auto const name = names.substr(0, end);
  names.remove_prefix(std::min(names.size(), end + 1));
  while (names.starts_with(' ')) names.remove_prefix(1);
  return name;
}

}  // namespace

void assertion_failed(Assertion assertion, std::string const& values) {
  auto text = std::string("lapwing: broken contract: ") + assertion.condition;
  std::string_view names = assertion.names;
  std::string_view rest = values;
  for (char const* separator = " ["; !rest.empty(); separator = ", ") {
    auto const end = rest.find('\n');
    text.append(separator).append(take_name(names)).append(" = ").append(rest.substr(0, end));
    rest.remove_prefix(end + 1);
  }
  if (!values.empty()) text += ']';
  text.append(" at ").append(in_sources(assertion.file)).append(":").append(std::to_string(assertion.line));
  text += "\nlapwing: this is a mistake in Lapwing: please report it with this line\n";
  // In one piece, and past every buffer: nothing runs after it.
  std::fflush(nullptr);
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::abort();
}

}  // namespace lapwing::base::internal
