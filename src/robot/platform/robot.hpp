#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/async/loop.hpp"
#include "base/async/scope.hpp"
#include "base/log.hpp"
#include "robot/mapping/pose_check.hpp"
#include "robot/mapping/wheel_spin.hpp"
#include "robot/planner/follower.hpp"
#include "robot/planner/home_charge.hpp"
#include "robot/platform/body.hpp"
#include "robot/platform/robot_health.hpp"
#include "robot/platform/thoughts.hpp"
#include "robot/views/tag_place.hpp"
#include "robot/views/viewpoint.hpp"
#include "robot/words/drive_task.hpp"
#include "tasks/platform.hpp"
#include "vehicle/connection_timeout.hpp"
#include "vehicle/registry.hpp"

namespace lapwing::robot {

/// A robot as it is set up.
struct RobotSpec {
  std::string id = "robot1";
  std::string name = "robot 1";
  std::string site = {};
  std::string floor = {};
  /// Where it starts in its site, as somebody who has put it there says.
  geo::Pose<geo::SiteFrame> start = {};
  std::vector<std::string> payload = {"Laser"};
  MappingOptions mapping = {};
  PlannerOptions planning = {};  ///< its limits are those of the body
  /// Awaited before mapping and planning work: has the module hang for as long, in tests and exercises. Empty: none.
  std::function<base::Task<>(Module)> hold_up = {};
};

/// How sure a robot is of where it is, against the part of its map around it: standard deviations, of the place along
/// the axes of its ellipse.
struct PoseSpread {
  double major_m = 0.0;
  double minor_m = 0.0;
  double axis_rad = 0.0;  ///< of the major axis, counterclockwise from the site's x axis
  double yaw_rad = 0.0;
};

/// One drive, and what became of it.
struct DriveRecord {
  enum class Outcome { running, done, failed, stopped };
  std::string name = {};
  int steps = 0;
  Outcome outcome = Outcome::running;
  std::string error = {};
  std::string remark = {};  ///< what it is done without
  std::string progress = {};
  bool robot_failed = false;
};
[[nodiscard]] std::string_view to_string(DriveRecord::Outcome outcome);

/// One robot: keeps its map and its plans going from what its body says, steers it, and shows it in the registry.
///
/// It drives only for a drive; everything heavy is worked out beside the loop. It stands when its scans or readings
/// cease to come. Thread-bound.
class Robot {
 public:
  /// What `driveTo 'room 221'` asks for the place; in the site's frame.
  using FindPlace = std::function<base::Result<geo::Point<geo::SiteFrame>>(std::string const& name)>;
  /// Called when the grid has changed, twice a second at most.
  using OnMap = std::function<void(map::OccupancyGrid const& grid, std::vector<map::TileKey> const& changed)>;
  /// Called when walls have changed, every few seconds at most; in the map's frame.
  using OnWalls = std::function<void(WallBook::Changes const& changes)>;
  /// What its eyes want to look at once more before an exploration is over, as TagFinder says it. All empty: it has
  /// none.
  struct SecondLooks {
    std::function<base::Task<std::optional<Viewpoint>>(WallChoice which)> next;
    std::function<base::Task<bool>(WallChoice which)> is_any_left;
    std::function<bool()> has_looked;
    std::function<std::size_t()> unread;
  };
  struct Surroundings {
    base::Loop& loop;
    vehicle::Registry& registry;
    FindPlace find_place;
    /// Takes a picture of what is ahead and puts it on the map; gives what is to be said of that.
    std::function<base::Task<base::Result<std::string>>()> photograph;
    std::function<std::optional<geo::Point<geo::SiteFrame>>(geo::Wgs84)> on_site;
    std::function<std::optional<geo::Wgs84>(geo::Point<geo::SiteFrame>)> on_globe;
    OnMap on_map;
    OnWalls on_walls;
    /// Called when the map has moved, with where that is now which was somewhere before.
    std::function<void(MapMove const&)> on_moved;
    /// What is wrong with the way to the operators, of watch/codes.hpp; nothing where there is none to be watched.
    std::function<std::optional<std::uint16_t>()> communication;
    /// What is wrong with its eyes, likewise; nothing where it has none, and while they do not answer.
    std::function<std::optional<std::uint16_t>()> points_of_interest;
    SecondLooks second_looks;
    /// Who is about something on the same floor now, beside it; empty: it is alone.
    std::function<std::vector<Companion>()> companions;
    /// Who is on the same floor, about something or not, on its own map; empty: it is alone.
    std::function<std::vector<OtherRobot>()> others;
    /// Whether what it maps is kept on the disk; empty: nobody keeps it.
    std::function<bool()> is_map_kept;
    base::Logger log;
  };
  Robot(RobotSpec spec, std::unique_ptr<Body> body, Surroundings surroundings);
  Robot(Robot const&) = delete;
  Robot& operator=(Robot const&) = delete;

  [[nodiscard]] RobotSpec const& spec() const { return spec_; }
  [[nodiscard]] vehicle::VehicleId id() const { return {spec_.id}; }
  [[nodiscard]] vehicle::VehicleState const& state() const { return *around_.registry.find(id()); }
  /// It has said how its laser looks, and is heard.
  [[nodiscard]] bool is_connected() const;
  [[nodiscard]] bool has_been_heard() const { return last_reading_.has_value(); }
  base::Duration connection_timeout = vehicle::default_connection_timeout;

  /// Carries the steps out one after the other; what it did before ends as stopped.
  [[nodiscard]] std::shared_ptr<DriveRecord const> start(std::string name, std::vector<Step> steps);
  /// Ends what it does; it stands. `is_failure`: somebody else took it, or it cannot go on.
  void end_drive(std::string const& reason, bool is_failure);
  /// It stands, whatever its modules say, until it is restarted.
  void kill(std::string const& reason);
  /// The operator's, after a kill. Error (refused): which of its modules is not well yet.
  base::Result<> restart();

  [[nodiscard]] bool is_driving() const { return record_ && record_->outcome == DriveRecord::Outcome::running; }
  [[nodiscard]] bool stands() const;
  /// As its body shows.
  [[nodiscard]] bool is_killed() const { return last_reading_ && last_reading_->is_killed; }
  /// It was killed, here or at its body.
  [[nodiscard]] bool needs_restart() const { return health_.watch().is_killed() || is_killed(); }
  /// What a module says of itself that is no part of this program.
  void hear_module(Module module, ModuleReport const& said) { health_.heard(module, said); }
  /// How its modules do.
  [[nodiscard]] ModuleWatch const& watch() const { return health_.watch(); }
  [[nodiscard]] std::vector<std::shared_ptr<DriveRecord const>> const& drives() const { return drives_; }
  [[nodiscard]] std::optional<Survey> const& survey() const { return survey_; }
  [[nodiscard]] std::optional<Located> const& here() const { return here_; }
  /// On its own map, at this moment; nothing before it has a place.
  [[nodiscard]] std::optional<slam::Pose2> pose() const;
  [[nodiscard]] double radius_m() const { return body_->limits().radius_m; }
  /// Nothing before it has a place.
  [[nodiscard]] std::optional<PoseSpread> spread() const;
  /// What those on the same floor may know of it, in the frame of its own map; nothing unless it is about something.
  [[nodiscard]] std::optional<Companion> as_companion() const;
  /// The way that it follows now, in the site's frame; empty: none.
  [[nodiscard]] std::vector<geo::Point<geo::SiteFrame>> way() const;
  [[nodiscard]] slam::LoopCounts const& loops() const { return loops_; }
  /// Notified when a drive ends, a reading comes in which it stands, or it is heard first.
  [[nodiscard]] base::Notifier& changed() { return changed_; }
  /// As its laser sees it at this moment.
  [[nodiscard]] ClearWay clear_way() const;
  /// In the site's frame.
  [[nodiscard]] geo::Point<geo::SiteFrame> on_site(Place const& place) const { return site_from_map_ * place; }
  [[nodiscard]] Place on_map(geo::Point<geo::SiteFrame> const& point) const { return map_from_site_ * point; }

 private:
  void take(Reading const& reading);
  void take(slam::Scan const& scan);
  void steer();
  void show_reading(Reading const& reading, bool is_first);
  void write_map(MapResult& result);
  void tell_of_moves(std::vector<MapShift> const& shifts);
  void write_walls(WallBook::Changes const& changes);
  [[nodiscard]] base::Task<MapResult> map_scans();
  [[nodiscard]] base::Task<PlanResult> plan(MapResult map);
  [[nodiscard]] std::uint16_t mapping_code() const;
  void use(PlanResult result);
  void give(Errand errand);
  void begin_to_think();
  base::Task<> keep_thinking();
  base::Task<> keep_aligning();
  base::Task<> watch_link();
  base::Task<> carry_out(std::shared_ptr<DriveRecord> record, std::vector<Step> steps);
  /// Gives what is to be said of a step that is done.
  [[nodiscard]] base::Task<base::Result<std::string>> carry_out(Step step);
  [[nodiscard]] base::Task<base::Result<std::string>> explore(std::string strategy);
  /// Drives before what its eyes could not read, and stands there until they have looked: `any_m` of way for any wall,
  /// `likely_m` for those on which most likely a sign is.
  base::Task<> look_again(double any_m, double likely_m);
  /// What is to be said of those that no camera looked at; empty: nothing.
  [[nodiscard]] base::Task<std::string> walls_left() const;
  enum class Reach {
    any,
    keeps_way_home,  ///< it may end with the plan still under way, when its battery takes it home and little farther
  };
  /// How the errand that was given last ends.
  [[nodiscard]] base::Task<base::Result<std::string>> see_through(Reach reach = Reach::any);
  [[nodiscard]] bool is_under_way() const;
  [[nodiscard]] std::string turned_home() const;
  void conclude(DriveRecord& record, DriveRecord::Outcome outcome, std::string error);
  [[nodiscard]] slam::Pose2 pose_now(slam::Pose2 const& odometry) const;

  RobotSpec spec_;
  std::unique_ptr<Body> body_;
  Surroundings around_;
  geo::Transform<geo::SiteFrame, map::GridFrame> site_from_map_;
  geo::Transform<map::GridFrame, geo::SiteFrame> map_from_site_;
  Follower follower_{Limits{}};
  RobotHealth health_;
  PoseCheck pose_check_;
  bool is_pose_lost_ = false;
  WheelSpin wheel_spin_;
  std::uint16_t planner_code_ = 0;
  std::optional<base::TimePoint> left_out_at_;  ///< when a scan was that could not be kept up with

  std::optional<Reading> last_reading_;
  std::deque<slam::Scan> scans_;  ///< that have not been thought of
  std::optional<base::TimePoint> scanned_at_;
  Room room_;
  double driven_m_ = 0.0;
  HomeCharge home_charge_{Limits{}.speed_m_s};
  Motion asked_;
  std::optional<base::TimePoint> moved_at_;  ///< when it was last asked to move

  std::unique_ptr<Thoughts> thoughts_;  ///< null until the first scan, and while they are worked on
  bool has_thoughts_ = false;
  std::unique_ptr<slam::JointAlignment> alignment_;  ///< that is to be done
  bool is_aligning_ = false;
  bool aligns_soon_ = false;          ///< as an exploration has ended
  std::vector<slam::Pose2> aligned_;  ///< and the map has not taken in
  std::optional<NewErrand> next_errand_;
  std::uint64_t last_errand_ = 0;   ///< that was given
  std::uint64_t known_errand_ = 0;  ///< that the planner has
  Errand errand_;                   ///< the last one
  Plan plan_;                       ///< of that
  std::optional<Located> here_;
  slam::Pose2 odometry_here_;
  std::optional<Survey> survey_;
  base::TimePoint surveyed_at_{};
  base::TimePoint walls_at_{};  ///< when they were looked for
  base::TimePoint met_at_{};    ///< when companions were asked for
  slam::LoopCounts loops_;
  std::optional<map::OccupancyGrid> grid_;
  std::set<map::TileKey> unwritten_;
  base::TimePoint written_at_{};

  std::shared_ptr<DriveRecord> record_;
  std::vector<std::shared_ptr<DriveRecord const>> drives_;
  base::Notifier scanned_;
  base::Notifier planned_;
  base::Notifier aligning_;
  base::Notifier changed_;
  base::Task<> drive_;  // behind what it waits for
  base::Scope scope_;
};

}  // namespace lapwing::robot
