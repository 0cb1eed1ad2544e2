#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mavlink/exchange/param.hpp"

/// All parameters of a vehicle: it is asked for its list once, then for every number that got lost on the way.
namespace lapwing::mavlink {

struct ParamList {
  std::vector<Parameter> parameters;    ///< in the vehicle's order
  std::optional<std::uint32_t> hash{};  ///< PX4's _HASH_CHECK of names and values
};

struct ParamListOptions {
  ParamEncoding encoding = ParamEncoding::c_cast;
  std::size_t in_flight = 10;  ///< requests for single numbers; ArduPilot queues 20 at most
  /// Without anything new for so long, the vehicle is given up.
  base::Duration silence_limit = std::chrono::seconds(12);
  /// Asked before each request: false holds them back (and the limit above) while the link is needed for what matters
  /// more. A list that streams already cannot be held: ArduPilot has no word for it. Empty: never.
  std::function<bool()> may_send = {};
};

using ParamProgress = std::function<void(std::size_t done, std::size_t total)>;

/// Waits adapt to the link: a number is asked for again after the round trip as measured, the stream is over when
/// nothing came for several of its own intervals. Errors: timed_out (says how many arrived), those of Connection::send.
base::Task<base::Result<ParamList>> download_params(Connection& connection, Address target,
                                                    ParamListOptions options = {}, ParamProgress progress = {});

/// The name under which PX4 tells the hash of all its parameters.
inline constexpr auto hash_param = "_HASH_CHECK";

}  // namespace lapwing::mavlink
