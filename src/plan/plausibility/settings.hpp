#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "base/error.hpp"
#include "plan/plausibility/finding.hpp"

namespace lapwing::plan::plausibility {

/// From where on something is implausible. Nothing where the vehicle's family decides.
struct Limits {
  /// GPS and maps disagree by some metres: less than this is no move of home at all.
  double gps_error_m = 5.0;
  /// A field's length: who stands further from the script's home stands on another field.
  double home_moved_m = 100.0;
  /// Of a mission's places from the vehicle and from each other. A slip in the first decimal of a latitude is 11.1 km.
  std::optional<double> distance_m;
  /// Of a place that an operator sends a vehicle to by hand.
  std::optional<double> go_to_m;
  /// A map, a GPS and a barometer differ by 10 m and more; ellipsoid and sea level mostly by more than this.
  double home_height_m = 20.0;
  /// Lower take-offs stay in the grass.
  double low_take_off_m = 2.0;
  /// Above home; the limit of most countries for flights without a permission.
  double ceiling_m = 120.0;
  /// Above home: nobody means this by mistake of a few metres.
  double highest_m = 500.0;
  /// Between two vehicles that stand: GPS lands within 2 m.
  double pad_m = 3.0;
  /// How long a full battery lasts, where the vehicle does not tell.
  std::optional<double> endurance_s;
};

/// Limits, and the rules that somebody has allowed with a reason.
struct Settings {
  Limits limits = {};
  std::map<Rule, std::string> allowed = {};

  /// The same with what one command allows.
  [[nodiscard]] Settings with(std::map<Rule, std::string> const& more) const;
};

/// One limit as settings name it.
struct LimitName {
  std::string_view name;
  std::string_view doc;
  double least = 0.0;
  double most = 0.0;
};
[[nodiscard]] std::span<LimitName const> limit_names();

/// Error: invalid_input for a name that there is not (with what may have been meant) or an empty reason.
[[nodiscard]] base::Result<std::pair<Rule, std::string>> allowance(std::string_view rule, std::string_view reason);
/// Error: invalid_input for a name that there is not, or a value that cannot be.
[[nodiscard]] base::Result<> set_limit(Limits& limits, std::string_view name, double value);

/// `RULE=REASON` and `NAME=VALUE` as the command line has them. Error: invalid_input.
[[nodiscard]] base::Result<> add_allowance(Settings& settings, std::string_view text);
[[nodiscard]] base::Result<> add_limit(Settings& settings, std::string_view text);

/// Every finding of an allowed rule gets its reason.
[[nodiscard]] Findings marked(Findings findings, Settings const& settings);

}  // namespace lapwing::plan::plausibility
