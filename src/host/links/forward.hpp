#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "route/endpoint.hpp"

namespace lapwing::host {

/// Another program that rides along: it hears the vehicles of one network and speaks to them.
struct Forward {
  std::string network = {};  ///< empty: the one without a name
  route::EndpointOptions endpoint;
};

/// Of the option --forward.
inline constexpr auto forward_help =
    "Let another program ride along, e.g. udpout://127.0.0.1:14551 for QGroundControl, or with the vehicles of a "
    "network north=udpout://127.0.0.1:14552 (may be repeated)";
/// Values of --forward. Errors: invalid_input.
[[nodiscard]] base::Result<std::vector<Forward>> forward_to(std::vector<std::string> const& texts);

}  // namespace lapwing::host
