#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bus/messages/common.hpp"

/// nav_msgs, as far as robots and their maps need it.
namespace lapwing::bus {

struct MapMetaData {
  Time map_load_time = {};
  float resolution = 0.0F;  ///< metres a cell
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  Pose origin = {};  ///< of the corner of cell (0, 0)
  friend bool operator==(MapMetaData const&, MapMetaData const&) = default;
};
template <>
struct Description<MapMetaData> {
  static constexpr std::string_view name = "nav_msgs/msg/MapMetaData";
  static constexpr auto fields =
      std::tuple{Field{"map_load_time", &MapMetaData::map_load_time}, Field{"resolution", &MapMetaData::resolution},
                 Field{"width", &MapMetaData::width}, Field{"height", &MapMetaData::height},
                 Field{"origin", &MapMetaData::origin}};
};

/// Cells row by row from the origin: 0 free to 100 taken, -1 unknown.
struct OccupancyGrid {
  Header header = {};
  MapMetaData info = {};
  std::vector<std::int8_t> data = {};
  friend bool operator==(OccupancyGrid const&, OccupancyGrid const&) = default;
};
template <>
struct Description<OccupancyGrid> {
  static constexpr std::string_view name = "nav_msgs/msg/OccupancyGrid";
  static constexpr auto fields = std::tuple{Field{"header", &OccupancyGrid::header},
                                            Field{"info", &OccupancyGrid::info}, Field{"data", &OccupancyGrid::data}};
};

/// The pose of `child_frame_id` in the header's frame, which drifts; the twist in the child's own.
struct Odometry {
  Header header = {};
  std::string child_frame_id = {};
  PoseWithCovariance pose = {};
  TwistWithCovariance twist = {};
  friend bool operator==(Odometry const&, Odometry const&) = default;
};
template <>
struct Description<Odometry> {
  static constexpr std::string_view name = "nav_msgs/msg/Odometry";
  static constexpr auto fields =
      std::tuple{Field{"header", &Odometry::header}, Field{"child_frame_id", &Odometry::child_frame_id},
                 Field{"pose", &Odometry::pose}, Field{"twist", &Odometry::twist}};
};

struct Path {
  Header header = {};
  std::vector<PoseStamped> poses = {};
  friend bool operator==(Path const&, Path const&) = default;
};
template <>
struct Description<Path> {
  static constexpr std::string_view name = "nav_msgs/msg/Path";
  static constexpr auto fields = std::tuple{Field{"header", &Path::header}, Field{"poses", &Path::poses}};
};

}  // namespace lapwing::bus
