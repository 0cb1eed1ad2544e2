#pragma once

#include <array>
#include <string_view>

#include "base/error.hpp"
#include "plan/plan_file.hpp"

namespace lapwing::plan::internal {

/// One item as files hold it, in MAVLink's own units; NaN where a file says nothing.
struct FileItem {
  double command = 0.0;
  double frame = 0.0;
  std::array<double, 7> params{};  ///< 5 to 7: latitude and longitude in degrees, height in metres
  bool autocontinue = true;
};

/// The one place where units and frames of files become ours. The error's message lacks the place in the file.
[[nodiscard]] base::Result<mavlink::MissionItem> to_item(FileItem const& item);
/// Errors when it is no place on earth.
[[nodiscard]] base::Result<geo::Wgs84> to_place(double lat_deg, double lon_deg, double alt_m);

/// "lat 95 is beyond 90 degrees" -> "a.plan: mission.items[3]: lat 95 is beyond 90 degrees".
[[nodiscard]] std::unexpected<base::Error> wrong(std::string_view where, std::string_view what,
                                                 std::string_view hint = {});

[[nodiscard]] base::Result<PlanFile> read_qgc_plan(std::string_view file, std::string_view text);
[[nodiscard]] base::Result<PlanFile> read_way_points(std::string_view file, std::string_view text);

}  // namespace lapwing::plan::internal
