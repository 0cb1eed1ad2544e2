#include "host/links/equipment.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace lapwing::host {

base::Result<> add_payload(std::string const& text, Equipment& equipment) {
  auto const equals = text.find('=');
  auto const vehicle = mavlink::parse_system_name(text.substr(0, equals));
  if (!vehicle || equals == std::string::npos || equals + 1 == text.size()) {
    return base::fail(
        base::ErrorKind::invalid_input, fmt::format("'{}' is no payload of a vehicle", text),
        "write ID=NAME,NAME with the vehicle's system id, for example --payload 3=Sidescan,Multibeam; in a network "
        "north/3=Sidescan");
  }
  auto& names = equipment[*vehicle];
  for (auto at = equals + 1; at <= text.size();) {
    auto const comma = std::min(text.find(',', at), text.size());
    if (comma > at) names.push_back(text.substr(at, comma - at));
    at = comma + 1;
  }
  return {};
}

}  // namespace lapwing::host
