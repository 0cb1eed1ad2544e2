#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/time.hpp"
#include "geo/camera/ground_view.hpp"

namespace lapwing::video {

/// More is refused before it is read.
inline constexpr std::size_t most_table_bytes = std::size_t{16} << 20;
inline constexpr std::size_t most_pictures = 100'000;
inline constexpr std::string_view pose_columns = "file,time,east_m,north_m,up_m,yaw_deg,tilt_deg,roll_deg";

/// A picture of a folder: when it was taken and, where somebody wrote that down, from where.
struct ListedPicture {
  std::string file;  ///< a name within the folder
  base::UtcTime at;
  std::optional<geo::CameraPlace> site_from_camera = {};
};

/// Of poses.csv (docs/reference/car-park-worlds.md): `pose_columns` as the first line, and a line for each picture, of
/// which the last six may be left empty. Errors (invalid_input) name the line.
[[nodiscard]] base::Result<std::vector<ListedPicture>> pictures_of_table(std::string_view text);

}  // namespace lapwing::video
