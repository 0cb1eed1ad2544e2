#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace lapwing::mavlink {

/// A MAVLink system where there may be several networks, each with system ids of its own: "7", and "north/7" in the
/// network north.
struct SystemName {
  std::string network = {};  ///< empty: the network without a name
  std::uint8_t system_id = 0;

  friend auto operator<=>(SystemName const&, SystemName const&) = default;
};

[[nodiscard]] std::string to_string(SystemName const& name);
/// Error: invalid_input. System ids are 1 to 255.
[[nodiscard]] base::Result<SystemName> parse_system_name(std::string_view text);

/// A name that a network may have: letters, digits, - and _, at least one.
[[nodiscard]] bool is_network_name(std::string_view name);

}  // namespace lapwing::mavlink
