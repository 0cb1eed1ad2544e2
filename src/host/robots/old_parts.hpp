#pragma once

#include <string>
#include <string_view>

#include "base/error.hpp"
#include "link/url.hpp"

namespace lapwing::host {

/// Where old parts are that speak the seed's lines, and with which robot: `tcpin://127.0.0.1:5771`,
/// `robot2=serial:///dev/ttyUSB1:115200`.
struct OldParts {
  std::string robot = "robot1";
  link::Url url;
  friend bool operator==(OldParts const&, OldParts const&) = default;
};

/// What `--old-parts` says. Errors, invalid_input, with an example: no such link; datagrams, since a line could be cut;
/// a port that other machines reach, since whoever comes there could start the robot and the lines have no password.
[[nodiscard]] base::Result<OldParts> parse_old_parts(std::string_view text);
inline constexpr auto old_parts_help =
    "Where old parts are that speak the seed's lines, for robot1 or another (may be repeated): "
    "[ROBOT=]tcpin://127.0.0.1:PORT, [ROBOT=]tcpout://HOST:PORT or [ROBOT=]serial:///dev/ttyUSB1:115200";

}  // namespace lapwing::host
