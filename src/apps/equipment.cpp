#include "apps/equipment.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

namespace lapwing::apps {

base::Result<> add_payload(std::string const& text, Equipment& equipment) {
  auto const equals = text.find('=');
  int system_id = 0;
  auto const [end, error] = std::from_chars(text.data(), text.data() + std::min(equals, text.size()), system_id);
  bool const is_id = error == std::errc() && equals != std::string::npos && end == text.data() + equals;
  if (!is_id || system_id < 1 || system_id > 255 || equals + 1 == text.size()) {
    return base::fail(base::ErrorKind::invalid_input, fmt::format("'{}' is no payload of a vehicle", text),
                      "write ID=NAME,NAME with the vehicle's system id, for example --payload 3=Sidescan,Multibeam");
  }
  auto& names = equipment[system_id];
  for (auto at = equals + 1; at <= text.size();) {
    auto const comma = std::min(text.find(',', at), text.size());
    if (comma > at) names.push_back(text.substr(at, comma - at));
    at = comma + 1;
  }
  return {};
}

}  // namespace lapwing::apps
