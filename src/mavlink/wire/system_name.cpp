#include "mavlink/wire/system_name.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

#include <fmt/format.h>

namespace lapwing::mavlink {

std::string to_string(SystemName const& name) {
  return name.network.empty() ? std::to_string(name.system_id) : fmt::format("{}/{}", name.network, name.system_id);
}

base::Result<SystemName> parse_system_name(std::string_view text) {
  auto const slash = text.find('/');
  auto const network = slash == std::string_view::npos ? std::string_view() : text.substr(0, slash);
  auto const digits = slash == std::string_view::npos ? text : text.substr(slash + 1);
  SystemName name{.network = std::string(network)};
  auto const [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), name.system_id);
  bool const is_id = error == std::errc() && end == digits.data() + digits.size() && name.system_id > 0;
  if (is_id && (slash == std::string_view::npos || is_network_name(network))) return name;
  return base::fail(base::ErrorKind::invalid_input, fmt::format("'{}' names no vehicle", text),
                    "write its system id, 1 to 255, or NETWORK/ID where its link belongs to a network: north/7");
}

bool is_network_name(std::string_view name) {
  auto const is_plain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_'; };
  return !name.empty() && std::ranges::all_of(name, is_plain);
}

}  // namespace lapwing::mavlink
