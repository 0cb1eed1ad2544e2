#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/time.hpp"

namespace lapwing::base {

/// RFC 3339 in UTC with as many decimals as it takes, at least milliseconds: "2026-11-21T10:12:52.123Z".
[[nodiscard]] std::string utc_text(UtcTime time);
/// The same to the millisecond, as messages to people and programs have it.
[[nodiscard]] std::string to_iso8601(UtcTime time);
/// Of RFC 3339, with any offset ("2026-11-21T11:12:52+01:00"); decimals beyond nanoseconds are cut. Nothing for what is
/// no such time, or lies outside of 1678 to 2262, which `UtcTime` cannot hold.
[[nodiscard]] std::optional<UtcTime> utc_from_text(std::string_view text);

}  // namespace lapwing::base
