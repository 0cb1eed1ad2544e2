#include "base/text/utc_text.hpp"

#include <fmt/chrono.h>

namespace lapwing::base {

std::string to_iso8601(UtcTime time) {
  auto const millis = std::chrono::floor<std::chrono::milliseconds>(time);
  auto const seconds = std::chrono::floor<std::chrono::seconds>(millis);
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(std::chrono::system_clock::to_time_t(seconds)),
                     (millis - seconds).count());
}

}  // namespace lapwing::base
