#pragma once

#include <memory>

#include "link/byte_link.hpp"
#include "mavlink/connection/connection.hpp"

namespace lapwing::mavlink {

/// All links of `connection` as one, for a router beside it: delivers each packet that the connection took for new,
/// from the far end that sent it, and passes packets of others on to those far ends as they are. Takes the connection's
/// forward hook; the connection outlives it.
[[nodiscard]] std::unique_ptr<link::ByteLink> as_link(Connection& connection);

}  // namespace lapwing::mavlink
