// Every exchange of the ground with a vehicle over links of every badness, in virtual time: each completes and the
// vehicle is as it should be, or it fails with a reason; none is left half done, none hangs.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "mavlink/connection/inbox.hpp"
#include "mavlink/exchange/command.hpp"
#include "mavlink/exchange/mission_transfer.hpp"
#include "mavlink/exchange/param.hpp"
#include "mavlink/wire/modes.hpp"
#include "sim/testing/ground.hpp"

namespace lapwing::sim {
namespace {

using namespace std::chrono_literals;
using namespace mavlink;
using base::Result;
using base::Task;

constexpr Address vehicle_address{1, 1};
constexpr TransferOptions transfer{.tries = 12};
constexpr CommandOptions patient{.tries = 12, .ack_timeout = 1500ms, .expiry = 30s};
constexpr ParamOptions insistent{.tries = 12, .reply_timeout = 1500ms};
constexpr std::size_t item_count = 12;

MissionItem item_at(geo::Wgs84 home, std::size_t seq, MissionType type) {
  ItemMaker const make{home};
  auto const north = 10.0 * static_cast<double>(seq);
  auto const command = type == MissionType::fence   ? MavCmd::nav_fence_circle_inclusion
                       : type == MissionType::rally ? MavCmd::nav_rally_point
                                                    : MavCmd::nav_waypoint;
  auto item = make.at(command, {north, 5.0, -20.0}, {type == MissionType::fence ? 500.0F : 0.0F});
  item.type = type;
  item.seq = static_cast<std::uint16_t>(seq);
  return item;
}

std::vector<MissionItem> items_of(TestGround& ground, MissionType type) {
  std::vector<MissionItem> items;
  for (std::size_t i = 0; i < item_count; ++i) items.push_back(item_at(ground.world.options().home, i, type));
  return items;
}

bool is_px4(TestGround& ground) {
  return ground.vehicle().options().kind.is_px4();
}

/// As the wire numbers it: PX4's missions have no home.
MissionPlan held(TestGround& ground, MissionType type) {
  auto const& plans = ground.vehicle().plans();
  if (type == MissionType::fence) return plans.fence;
  if (type == MissionType::rally) return plans.rally;
  auto mission = plans.mission;
  if (is_px4(ground) && !mission.empty()) mission.erase(mission.begin());
  return mission;
}

/// Puts a mission into the vehicle past the link.
void give_mission(TestGround& ground) {
  auto items = items_of(ground, MissionType::mission);
  if (is_px4(ground)) items.insert(items.begin(), MissionItem{});
  ground.vehicle().plans().mission = items;
}

/// All of them and nothing else, each in its place. Item 0 of a mission is the vehicle's own home.
bool is_whole(MissionPlan const& plan, std::vector<MissionItem> const& wanted) {
  if (plan.size() != wanted.size()) return false;
  for (std::size_t i = 1; i < plan.size(); ++i) {
    bool const same = plan[i].command == wanted[i].command &&
                      std::abs(plan[i].place.lat_rad - wanted[i].place.lat_rad) < 1e-8 &&
                      std::abs(plan[i].place.z_m - wanted[i].place.z_m) < 0.02;
    if (!same) return false;
  }
  return true;
}

// ---- the exchanges: another one is two functions here and a line in the table below

Task<Result<>> connect(TestGround& ground) {
  auto const heard = co_await await_message<Heartbeat>(ground.gcs, {1, 0}, [](Heartbeat const&) { return true; }, 60s);
  if (!heard) co_return std::unexpected(heard.error());
  co_return Result<>{};
}
bool always(TestGround&) {
  return true;
}

Task<Result<>> command(TestGround& ground) {
  bool const px4 = is_px4(ground);
  auto const mode = set_mode(px4 ? MavAutopilot::px4 : MavAutopilot::ardupilotmega, px4 ? px4_mode(4, 5) : 4);
  co_return co_await run_command(ground.gcs, vehicle_address, mode, patient);
}
bool is_mode_changed(TestGround& ground) {
  return ground.pilot().mode().behaviour == (is_px4(ground) ? Behaviour::return_home : Behaviour::guided);
}

Task<Result<>> command_int(TestGround& ground) {
  auto const home = set_home(geo::displaced(ground.world.options().home, {100, 0, 0}));
  co_return co_await run_command(ground.gcs, vehicle_address, home, patient);
}
bool is_home_moved(TestGround& ground) {
  return std::abs(ground.pilot().home()->north - 100.0) < 0.1;
}

/// As the fleet does it: what counts is what the vehicle holds. A vehicle whose last acknowledgement was lost answers
/// the repeated last item with an error.
template <MissionType type>
Task<Result<>> upload(TestGround& ground) {
  auto items = items_of(ground, type);
  auto uploaded = co_await upload_mission(ground.gcs, vehicle_address, std::move(items), type, transfer);
  if (uploaded) co_return uploaded;
  auto const got = co_await download_mission(ground.gcs, vehicle_address, type, transfer);
  if (got && is_whole(got->items, items_of(ground, type))) co_return Result<>{};
  co_return uploaded;
}
template <MissionType type>
bool holds_all(TestGround& ground) {
  return is_whole(held(ground, type), items_of(ground, type));
}

Task<Result<>> download(TestGround& ground) {
  give_mission(ground);
  auto const got = co_await download_mission(ground.gcs, vehicle_address, MissionType::mission, transfer);
  if (!got) co_return std::unexpected(got.error());
  EXPECT_TRUE(is_whole(got->items, items_of(ground, MissionType::mission))) << "half a mission was taken for the whole";
  co_return Result<>{};
}

Task<Result<>> clear(TestGround& ground) {
  give_mission(ground);
  co_return co_await clear_mission(ground.gcs, vehicle_address, MissionType::mission, transfer);
}
bool is_empty(TestGround& ground) {
  return ground.vehicle().mission().empty();
}

/// The height of the return.
std::string parameter_of(TestGround& ground) {
  return is_px4(ground) ? "RTL_RETURN_ALT" : "RTL_ALT";
}
ParamOptions with_types(TestGround& ground) {
  auto options = insistent;
  options.encoding = is_px4(ground) ? ParamEncoding::bytewise : ParamEncoding::c_cast;
  return options;
}
Task<Result<>> read_parameter(TestGround& ground) {
  auto const value = co_await read_param(ground.gcs, vehicle_address, parameter_of(ground), with_types(ground));
  if (!value) co_return std::unexpected(value.error());
  EXPECT_EQ(value->value, is_px4(ground) ? 60.0 : 1500.0);
  co_return Result<>{};
}
Task<Result<>> set_parameter(TestGround& ground) {
  auto const changed =
      co_await set_param(ground.gcs, vehicle_address, parameter_of(ground), 2500.0, with_types(ground));
  if (!changed) co_return std::unexpected(changed.error());
  co_return Result<>{};
}
bool is_parameter_set(TestGround& ground) {
  return ground.vehicle().parameters().value(parameter_of(ground)) == 2500.0;
}

struct Exchange {
  std::string_view name;
  Task<Result<>> (*run)(TestGround&);
  bool (*holds)(TestGround&);  ///< whether a success is one: asked of the vehicle itself
};
constexpr std::array exchanges{
    Exchange{"connect", connect, always},
    Exchange{"command", command, is_mode_changed},
    Exchange{"command with a place", command_int, is_home_moved},
    Exchange{"mission up", upload<MissionType::mission>, holds_all<MissionType::mission>},
    Exchange{"fence up", upload<MissionType::fence>, holds_all<MissionType::fence>},
    Exchange{"rally points up", upload<MissionType::rally>, holds_all<MissionType::rally>},
    Exchange{"mission down", download, always},
    Exchange{"clear", clear, is_empty},
    Exchange{"parameter read", read_parameter, always},
    Exchange{"parameter set", set_parameter, is_parameter_set},
};

// ---- the links

struct Badness {
  double loss = 0.0;
  base::Duration delay{};
  bool duplicates = false;
  bool reorders = false;
};

std::string name_of(Badness const& link) {
  auto const ms = std::chrono::duration_cast<std::chrono::milliseconds>(link.delay).count();
  return std::to_string(static_cast<int>(100 * link.loss)) + " % lost, " + std::to_string(ms) + " ms late" +
         (link.duplicates ? ", doubled" : "") + (link.reorders ? ", out of order" : "");
}

WorldOptions over(Badness const& link) {
  WorldOptions options;
  options.impairment = {.loss = link.loss,
                        .duplication = link.duplicates ? 0.2 : 0.0,
                        .delay = link.delay,
                        .jitter = link.reorders ? base::Duration(300ms) : base::Duration{}};
  options.seed = 7;
  return options;
}

/// What a link does that vehicles are really flown over: there nothing may fail.
bool is_bearable(Badness const& link) {
  return link.loss <= 0.3 && link.delay <= 200ms;
}

/// Whether it completed.
bool try_out(Exchange const& exchange, std::string_view vehicle, Badness const& link) {
  SCOPED_TRACE(std::string(vehicle) + ": " + std::string(exchange.name) + ", " + name_of(link));
  TestGround ground(vehicle, over(link));
  EXPECT_TRUE(ground.run_until([&] { return ground.last<Heartbeat>().has_value(); }, 2min));
  ground.boot();
  auto const began = ground.loop.now();
  auto const result = ground.loop.run_until_done(exchange.run(ground));
  EXPECT_LT(ground.loop.now() - began, 5min) << "an end is in sight";
  if (result) {
    EXPECT_TRUE(exchange.holds(ground)) << "said to be done, and is not";
    return true;
  }
  EXPECT_FALSE(is_bearable(link)) << result.error().message;
  EXPECT_FALSE(result.error().message.empty());
  auto const kind = result.error().kind;
  EXPECT_TRUE(kind == base::ErrorKind::timed_out || kind == base::ErrorKind::refused) << result.error().message;
  return false;
}

class LossyLink : public ::testing::TestWithParam<double> {};

TEST_P(LossyLink, LetsEveryExchangeCompleteOrFailWithAReason) {
  int completed = 0;
  int tried = 0;
  for (auto const& exchange : exchanges)
    for (auto const* vehicle : {"copter", "px4"})
      for (auto const delay : {0ms, 200ms, 1000ms})
        for (bool const duplicates : {false, true})
          for (bool const reorders : {false, true}) {
            completed += try_out(exchange, vehicle, {GetParam(), delay, duplicates, reorders}) ? 1 : 0;
            ++tried;
          }
  RecordProperty("completed", completed);
  EXPECT_GT(completed, tried * 3 / 4) << "patience that only ends in giving up is of no use";
}

INSTANTIATE_TEST_SUITE_P(Matrix, LossyLink, testing::Values(0.0, 0.1, 0.3, 0.5),
                         [](auto const& loss) { return "Loses" + std::to_string(static_cast<int>(100 * loss.param)); });

}  // namespace
}  // namespace lapwing::sim
