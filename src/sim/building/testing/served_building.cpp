#include "sim/building/testing/served_building.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

#include <fmt/format.h>

#include "base/async/pool.hpp"
#include "base/async/scope.hpp"
#include "sim/building/building_run.hpp"

namespace lapwing::sim::building::testing {

namespace {

using namespace std::chrono_literals;

double constexpr rad_per_deg = std::numbers::pi / 180.0;

/// Standard input without waiting for it.
class Words {
 public:
  /// The next whole line; nothing while there is none.
  std::optional<std::string> next() {
    read_on();
    auto const end = rest_.find('\n');
    if (end == std::string::npos) return std::nullopt;
    auto line = rest_.substr(0, end);
    rest_.erase(0, end + 1);
    return line;
  }
  [[nodiscard]] bool has_ended() const { return has_ended_; }

 private:
  void read_on() {
    pollfd ready{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
    std::array<char, 4096> piece{};
    while (!has_ended_ && ::poll(&ready, 1, 0) > 0) {
      auto const count = ::read(STDIN_FILENO, piece.data(), piece.size());
      has_ended_ = count <= 0;
      if (count > 0) rest_.append(piece.data(), static_cast<std::size_t>(count));
    }
  }

  std::string rest_;
  bool has_ended_ = false;
};

/// False for what is no such line.
bool mend(Building& building, std::string const& what) {
  auto& robot = building.robot(0);
  if (what == "all") {
    robot.mend_all();
    return true;
  }
  for (auto const& fault : std::vector(robot.faults()))
    if (to_string(fault.kind) == what) robot.mend(fault.kind);
  return true;
}

std::string ppm(Shot const& shot) {
  return ppm_of(develop(shot));
}

/// Beside the loop: the board's time must not wait for a picture.
base::Task<> shoot(base::Loop& loop, Building& building, std::size_t camera, std::string file) {
  auto shot = building.shoot(0, building.robot(0).settings().side_cameras[camera]);
  if (!shot) co_return;
  auto const bytes = co_await loop.on_pool(&ppm, *std::move(shot));
  std::ofstream(file, std::ios::binary) << bytes;
  fmt::print(R"({{"shot": "{}"}})"
             "\n",
             file);
  (void)std::fflush(stdout);
}

bool obey(base::Scope& scope, base::Loop& loop, Building& building, std::string const& line) {
  std::istringstream words(line);
  std::string verb;
  std::string what;
  words >> verb;
  auto& robot = building.robot(0);
  if (verb == "restart") {
    robot.restart_board();
    return true;
  }
  if (verb == "fault" && words >> what) {
    auto const fault = parse_fault(what);
    if (fault) robot.set(*fault);
    return fault.has_value();
  }
  if (verb == "mend" && words >> what) return mend(building, what);
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_deg = 0.0;
  std::size_t person = 0;
  std::size_t camera = 0;
  if (verb == "shoot" && words >> camera >> what && camera < robot.settings().side_cameras.size()) {
    scope.spawn(shoot(loop, building, camera, what));
    return true;
  }
  if (verb == "person" && words >> person >> x_m >> y_m && person < building.people().all().size()) {
    building.people().put(person, {{x_m, y_m}, 0.0});
    return true;
  }
  if (verb == "carry" && words >> x_m >> y_m >> yaw_deg) {
    robot.body().put({{x_m, y_m}, yaw_deg * rad_per_deg});
    return true;
  }
  return false;
}

void tell(Building& building) {
  auto const& robot = building.robot(0);
  auto const pose = robot.body().pose();
  auto const [left, right] = robot.voltages();
  fmt::print(R"({{"time_s": {:.2f}, "x_m": {:.3f}, "y_m": {:.3f}, "yaw_deg": {:.1f}, "speed_m_s": {:.3f}, )"
             R"("voltages": [{:.3f}, {:.3f}], "collisions": {}}})"
             "\n",
             building.time_s(), pose.position.x(), pose.position.y(), pose.yaw_rad / rad_per_deg,
             robot.body().speed_m_s(), left, right, building.collisions().size());
  (void)std::fflush(stdout);
}

base::Task<> live(base::Loop& loop, Building& building) {
  Words words;
  base::Scope scope(loop);
  while (!words.has_ended()) {
    while (auto const line = words.next())
      if (!obey(scope, loop, building, *line)) fmt::print(stderr, "no such thing can be done: {}\n", *line);
    tell(building);
    co_await loop.sleep(100ms);
  }
}

}  // namespace

int serve(Building& building, link::Url const& url) {
  base::Loop loop;
  BuildingRun run(loop, building);
  if (auto const served = run.serve(0, url); !served) {
    fmt::print(stderr, "{}; {}\n", served.error().message, served.error().hint);
    return 2;
  }
  loop.run_until_done(live(loop, building));
  return 0;
}

}  // namespace lapwing::sim::building::testing
