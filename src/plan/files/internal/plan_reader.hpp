#pragma once

#include <array>
#include <string_view>

#include "base/error.hpp"
#include "plan/files/plan_file.hpp"

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
/// The other way. Degrees are rounded to 1e-9, so that what files say is what was read.
[[nodiscard]] FileItem from_item(mavlink::MissionItem const& item);
/// Whether parameters 5 to 7 are a place.
[[nodiscard]] bool is_placed(mavlink::MissionItem const& item);
/// Errors when it is no place on earth.
[[nodiscard]] base::Result<geo::Wgs84> to_place(double lat_deg, double lon_deg, double alt_m);
/// From a centimetre, which the 32 bits of an item still tell from nothing.
[[nodiscard]] bool is_radius(double radius_m);
/// To 1e-9 degrees, a tenth of a millimetre.
[[nodiscard]] double file_degrees(double degrees);
/// A number as files have it; the whole of `word`.
[[nodiscard]] std::optional<double> number_in(std::string_view word);

/// A place without a height of its own stands at the height that the user named, above home.
[[nodiscard]] base::Result<FileItem> way_point_at(double lat_deg, double lon_deg, std::optional<double> alt_m,
                                                  mavlink::MavFrame frame, PlanReadOptions const& options);

/// "lat 95 is beyond 90 degrees" -> "a.plan: mission.items[3]: lat 95 is beyond 90 degrees".
[[nodiscard]] std::unexpected<base::Error> wrong(std::string_view where, std::string_view what,
                                                 std::string_view hint = {});

/// Corners and zones so far, for the limits; `where` is for the message.
struct FenceBudget {
  std::size_t zones = 0;
  std::size_t corners = 0;
  base::Result<> take_zone(std::string_view where);
  base::Result<> take_corners(std::string_view where, std::size_t count);
};

[[nodiscard]] base::Result<PlanFile> read_json_plan(std::string_view file, std::string_view text,
                                                    PlanReadOptions const& options);
[[nodiscard]] base::Result<PlanFile> read_way_points(std::string_view file, std::string_view text);
[[nodiscard]] base::Result<PlanFile> read_kml(std::string_view file, std::string_view text,
                                              PlanReadOptions const& options);
/// The KML in a KMZ.
[[nodiscard]] base::Result<std::string> unzip_kml(std::string_view file, std::string_view bytes);

[[nodiscard]] std::string write_qgc_plan(Plan const& plan);
[[nodiscard]] std::string write_way_points(Plan const& plan);
[[nodiscard]] std::string write_geojson(Plan const& plan);
[[nodiscard]] std::string write_kml(Plan const& plan);
[[nodiscard]] base::Result<std::string> zip_kml(std::string_view kml);

}  // namespace lapwing::plan::internal
