#pragma once

#include <optional>

#include "base/config.hpp"
#include "geo/position.hpp"

namespace lapwing::geo {

/// How a file says where on Earth its frame lies.
inline constexpr auto anchor_form = "anchor = [latitude, longitude, altitude], in degrees and metres";

/// The `anchor` of a configuration file. Nothing: it is not there, or no place on Earth, which is reported.
[[nodiscard]] std::optional<Wgs84> read_anchor(base::ConfigReader& reader);

}  // namespace lapwing::geo
