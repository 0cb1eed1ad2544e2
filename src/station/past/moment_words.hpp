#pragma once

#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "station/http/http.hpp"
#include "station/past/past_grids.hpp"

namespace lapwing::station {

/// A time of an address, in milliseconds since 1970, UTC. Error, invalid_input: it is missing, or none.
[[nodiscard]] base::Result<base::UtcTime> time_parameter(HttpRequest const& request, std::string_view name);
/// Downwards.
[[nodiscard]] std::int64_t milliseconds_of(base::UtcTime time);
[[nodiscard]] HttpResponse no_history();
/// What was, stays: it may be kept, but for the last seconds, of which there may be more to come.
[[nodiscard]] HttpResponse picture_of_the_past(HttpRequest const& request, PastGrids::Picture picture, bool is_settled);

}  // namespace lapwing::station
