#pragma once

#include <compare>
#include <string>

#include "base/time.hpp"

namespace lapwing::station {

/// A time in a run of a station that is kept.
struct Moment {
  std::string session;
  base::UtcTime at;
  friend auto operator<=>(Moment const&, Moment const&) = default;
};

}  // namespace lapwing::station
