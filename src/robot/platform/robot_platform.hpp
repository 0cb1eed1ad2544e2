#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/async/scope.hpp"
#include "base/log.hpp"
#include "map/live/live_map.hpp"
#include "robot/platform/robot.hpp"
#include "robot/poi/tag_finder.hpp"
#include "tasks/platform.hpp"
#include "vehicle/authority.hpp"

namespace lapwing::robot {

/// Robots as a platform of the mission language: `drive { ... }` blocks. Their maps go to the live map as grids, one a
/// robot, and their poses to the registry.
///
/// Thread-bound; outlives the runs that it started.
class RobotPlatform final : public tasks::Platform {
 public:
  struct Surroundings {
    base::Loop& loop;
    vehicle::Registry& registry;
    vehicle::Authority& authority;
    map::LiveMap& live_map;
  };
  /// All of `around` outlives the platform.
  RobotPlatform(Surroundings around, base::Logger log);
  RobotPlatform(RobotPlatform const&) = delete;
  RobotPlatform& operator=(RobotPlatform const&) = delete;

  /// Error: invalid_input for an id that another robot has, or a site or floor that the map does not have.
  [[nodiscard]] base::Result<Robot*> add(RobotSpec spec, std::unique_ptr<Body> body);
  [[nodiscard]] std::vector<std::unique_ptr<Robot>> const& robots() const { return robots_; }
  /// What one of them sees with from now on: name tags on its way become points of interest on the map, and it takes
  /// pictures when it is told to. What the eyes need outlives the platform.
  void open_eyes(Robot const& robot, Eyes eyes);
  /// What it has found; null for one without eyes.
  [[nodiscard]] TagFinder const* tags_of(vehicle::VehicleId const& id) const;
  /// Null for an id that is not one of theirs.
  [[nodiscard]] Robot* robot(vehicle::VehicleId const& id) const;

  [[nodiscard]] tasks::Vocabulary const& vocabulary() const override { return vocabulary_; }
  /// It has no plans: error not_found.
  [[nodiscard]] base::Result<std::shared_ptr<tasks::PlatformTask const>> named_task(
      std::string_view name) const override;
  [[nodiscard]] std::vector<tasks::VehicleInfo> vehicles() const override;
  [[nodiscard]] std::optional<tasks::VehicleInfo> find(vehicle::VehicleId const& id) const override;
  [[nodiscard]] base::Notifier& vehicles_changed() override { return vehicles_changed_; }
  void set_connection_timeout(vehicle::VehicleId const& id, base::Duration timeout) override;
  /// Drives are what it does.
  [[nodiscard]] std::optional<std::string> unsuited(tasks::PlatformTask const& task,
                                                    tasks::VehicleInfo const& vehicle) const override;
  [[nodiscard]] std::unique_ptr<tasks::TaskRun> start(std::shared_ptr<tasks::PlatformTask const> task,
                                                      vehicle::VehicleId const& id) override;
  /// Until each stands, or is lost.
  [[nodiscard]] base::Task<void> settle() override;
  /// The names of those that it waits for.
  [[nodiscard]] std::vector<std::string> unsettled() const;
  /// How the way to the operators is, for the robots' communication module: gives what is wrong with it, of
  /// watch/codes.hpp. Without this nobody says anything of it. An outage of it stops nothing.
  void set_communication(std::function<std::uint16_t()> code) { communication_ = std::move(code); }
  /// Whether what goes onto the map is kept on the disk, for the robots' mapping. Without this nobody asks.
  void set_map_keeping(std::function<bool()> is_kept) { is_map_kept_ = std::move(is_kept); }
  /// Of all robots; `settle` waits until they stand.
  void end_drives(std::string const& reason);

 private:
  [[nodiscard]] tasks::VehicleInfo info_of(Robot const& robot) const;
  [[nodiscard]] base::Result<geo::Point<geo::SiteFrame>> find_place(RobotSpec const& spec,
                                                                    std::string const& name) const;
  void write(RobotSpec const& spec, map::OccupancyGrid const& grid, std::vector<map::TileKey> const& changed);
  void write_walls(RobotSpec const& spec, WallBook::Changes const& changes);
  /// Of a robot that maps anew, so that what it found another time does not lie among what it finds now.
  void forget_walls(RobotSpec const& spec);
  [[nodiscard]] base::Task<base::Result<std::string>> photograph(vehicle::VehicleId id);
  void move_what_it_saw(vehicle::VehicleId const& id, MapMove const& moved);
  /// Another robot on a floor, and where the frame of its map lies in that of the map of whom it is beside.
  struct Beside {
    Robot const* robot = nullptr;
    slam::Pose2 origin = {};
  };
  [[nodiscard]] std::vector<Beside> beside(RobotSpec const& spec) const;
  [[nodiscard]] std::vector<Companion> companions_of(RobotSpec const& spec) const;
  [[nodiscard]] std::vector<OtherRobot> others_of(RobotSpec const& spec) const;
  [[nodiscard]] Robot::SecondLooks second_looks_of(vehicle::VehicleId const& id);
  [[nodiscard]] std::optional<std::uint16_t> trouble_of_eyes(vehicle::VehicleId const& id) const;
  base::Task<> pass_on(Robot& robot);
  base::Task<> pass_on_membership();

  Surroundings around_;
  base::Logger log_;
  tasks::Vocabulary vocabulary_;
  std::function<std::uint16_t()> communication_;
  std::function<bool()> is_map_kept_;
  base::Notifier vehicles_changed_;
  base::Notifier settled_;
  struct Sight {
    Eyes eyes;
    std::unique_ptr<TagFinder> tags;
    std::vector<std::string> photographs;  ///< on the map
  };
  std::map<vehicle::VehicleId, Sight> sights_;
  std::vector<std::unique_ptr<Robot>> robots_;
  base::Scope scope_;
};

}  // namespace lapwing::robot
