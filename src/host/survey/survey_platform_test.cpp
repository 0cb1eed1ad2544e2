#include "host/survey/survey_platform.hpp"

#include <deque>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "autonomy/operator/map_request.hpp"
#include "autonomy/operator/report_text.hpp"
#include "base/async/scope.hpp"

namespace lapwing::host {
namespace {

namespace wire = link::operator_link;
using namespace std::chrono_literals;
using autonomy::LotTask;
using autonomy::State;
using tasks::RunState;

auto const home = geo::Wgs84::from_degrees(43.2585, -79.9201, 100.0);
vehicle::VehicleId const hawk{"drone1"};

/// A drone that does at once what it is told, at the far end of the operator link.
class ObedientDrone {
 public:
  ObedientDrone(base::Loop& loop) : loop_(loop), scope_(loop) {
    wire::ServeSettings settings{.port = 0};
    settings.server.end.name = "drone";
    server_ = wire::serve(loop, std::move(settings), {}).value();
    scope_.spawn(obey());
    scope_.spawn(beat());
  }
  [[nodiscard]] std::uint16_t port() const { return server_->port(); }

  void be(State state) {
    said.state = state;
    say_heartbeat();
  }
  void say(std::string text) { (void)server_->send_to_all({.text = std::move(text)}); }
  void say_survey(std::string_view begun, double coverage, bool is_over) {
    say(fmt::format(R"({{"Type":"Slots","Features":{{"type":"FeatureCollection","features":[],)"
                    R"("survey":{{"begun":"{}","coverage":{},"is_over":{}}}}}}})",
                    begun, coverage, is_over));
  }

  autonomy::Said said;
  autonomy::FlightController flight{.mode = "GUIDED",
                                    .relative_alt_m = 0.0,
                                    .position = home,
                                    .local = geo::Point3<autonomy::ArmingFrame>(5, 7, 0),
                                    .battery = 0.8};
  std::deque<std::string> heard;  ///< types of commands
  nlohmann::json last;
  bool explores_to_the_end = true;
  bool knows_the_lot = true;
  int refusals = 0;      ///< of being armed, that are still to come
  int vain_armings = 0;  ///< that the flight controller does not take; they come first

 private:
  base::Task<> obey() {
    while (server_->sessions().empty()) co_await loop_.sleep(2ms);
    for (;;) {
      auto receiving = server_->sessions().front()->receive(1h);
      auto const message = co_await receiving;
      if (message) obey(message->text);
    }
  }
  void obey(std::string const& text) {
    if (autonomy::parse_map_request(text)) return;  // this drone has no map
    last = nlohmann::json::parse(text);
    auto const type = last["Type"].get<std::string>();
    heard.push_back(type);
    if (type == "Arm" && vain_armings > 0) {
      --vain_armings;
      be(State::arm);
      say(autonomy::error_log_text("arming was given up: the flight controller did not arm: see its messages"));
      be(State::idle);
    } else if (type == "Arm" && refusals > 0) {
      --refusals;
      say(autonomy::error_log_text("Arm is refused: the pre-arm checks fail"));
    } else if (type == "Arm") {
      flight.is_armed = true;
      be(State::arm);
    } else if (type == "Takeoff") {
      be(State::takeoff);
      be(State::hover);
    } else if (type == "Autonomous Explore") {
      be(State::autonomous_explore);
      say_survey("2026-11-24T10:00:00Z", 0.5, false);
      if (explores_to_the_end) say_survey("2026-11-24T10:00:00Z", 0.99, true);
    } else if (type == "Land" || type == "Disarm") {
      flight.is_armed = false;
      be(State::land);
      be(State::idle);
    } else if (type.ends_with("Move")) {
      be(type == "Compulsive Move" ? State::compulsive_move : State::autonomous_move);
      scope_.spawn(arrive());
    }
  }
  /// Not at once, so that the move is seen.
  base::Task<> arrive() {
    geo::Point3<autonomy::ArmingFrame> const to(last["X"].get<double>(), last["Y"].get<double>(), 10.0);
    co_await loop_.sleep(30ms);
    if (knows_the_lot) flight.local = to;
    be(knows_the_lot ? State::hover : State::desired_location_error);
  }
  base::Task<> beat() {
    for (;; co_await loop_.sleep(20ms)) say_heartbeat();
  }
  void say_heartbeat() {
    autonomy::Told told;
    told.flight = flight;
    // Each one counts: a state that is over at once must be heard of as well.
    say(autonomy::heartbeat_text(said, told).value());
  }

  base::Loop& loop_;
  std::unique_ptr<wire::Server> server_;
  base::Scope scope_;
};

class Lot : public ::testing::Test {
 public:
  void SetUp() override {
    wire::ConnectSettings reached{.port = drone.port()};
    reached.client.back_off = {.first = 10ms, .most = 50ms};
    platform.open(
        SurveyDesk::open(loop, map, base::Logger(hub, "survey"), {{.name = hawk.text, .settings = reached}}).value());
    until([&] { return !platform.vehicles().empty(); });
  }
  template <class Condition>
  void until(Condition condition) {
    auto const deadline = loop.now() + 10s;
    while (!condition() && loop.now() < deadline) loop.run_until_done(next_look());
    EXPECT_TRUE(condition());
  }
  base::Task<> next_look() { co_await loop.sleep(2ms); }
  std::unique_ptr<tasks::TaskRun> begin(std::vector<autonomy::Step> steps) {
    return platform.start(std::make_shared<LotTask const>("lot", std::move(steps)), hawk);
  }
  /// To its end.
  std::unique_ptr<tasks::TaskRun> fly(std::vector<autonomy::Step> steps) {
    auto run = begin(std::move(steps));
    until([&] { return run->state() != RunState::in_progress; });
    return run;
  }

  base::LogHub hub;
  base::Loop loop;
  ::lapwing::map::LiveMap map{[this] { return loop.utc_now(); }};
  ObedientDrone drone{loop};
  SurveyPlatform platform{loop, base::Logger(hub, "survey")};
};

TEST_F(Lot, IsFlownFromTheGroundToTheGround) {
  auto const run = fly({autonomy::ExploreStep{}, autonomy::ComeHomeStep{}});
  EXPECT_EQ(run->state(), RunState::done) << run->error();
  std::deque<std::string> const wanted{"Arm", "Takeoff", "Autonomous Explore", "Land"};
  EXPECT_EQ(drone.heard, wanted);
  auto const info = platform.find(hawk).value();
  EXPECT_EQ(info.type, "UAV");
  EXPECT_EQ(info.coverage, 0.99);
  EXPECT_EQ(info.battery, 0.8);
}

TEST_F(Lot, IsExploredAnewWhateverWasToldOfTheSurveyBefore) {
  ASSERT_EQ(fly({autonomy::ExploreStep{}})->state(), RunState::done);
  drone.be(State::hover);
  until([&] { return platform.desk()->heartbeat(hawk.text)->state == "Hover"; });
  drone.explores_to_the_end = false;
  auto const run = begin({autonomy::ExploreStep{}});
  until([&] { return drone.heard.back() == "Autonomous Explore" && drone.heard.size() == 4; });
  // The drone tells the same beginning: nothing has begun anew, and what is over is another survey.
  EXPECT_EQ(run->state(), RunState::in_progress);
  drone.say_survey("2026-11-24T11:00:00Z", 0.99, true);
  until([&] { return run->state() == RunState::done; });
}

TEST_F(Lot, WaitsForADroneThatIsNotReadyYet) {
  drone.refusals = 1;
  drone.vain_armings = 1;
  EXPECT_EQ(fly({autonomy::WaitStep{0.01}})->state(), RunState::done);
  std::deque<std::string> const wanted{"Arm", "Arm", "Arm", "Takeoff"};
  EXPECT_EQ(drone.heard, wanted);
}

TEST_F(Lot, MovesToPlacesInTheDronesOwnFrame) {
  auto const site = geo::Site::make("here", home).value();
  auto const to = site.place_of(geo::Point3<geo::SiteFrame>(20.0, -10.0, 0.0));
  auto const run = fly({autonomy::MoveStep{to}});
  EXPECT_EQ(run->state(), RunState::done) << run->error();
  EXPECT_EQ(drone.last["Type"], "Autonomous Move");
  EXPECT_NEAR(drone.last["X"].get<double>(), 25.0, 0.01);
  EXPECT_NEAR(drone.last["Y"].get<double>(), -3.0, 0.01);
}

TEST_F(Lot, FailsWhereAPlaceIsNotInIt) {
  drone.knows_the_lot = false;
  auto const run = fly({autonomy::MoveStep{geo::Wgs84::from_degrees(43.259, -79.92)}});
  EXPECT_EQ(run->state(), RunState::failed);
  EXPECT_FALSE(run->vehicle_failed());
  EXPECT_TRUE(run->error().starts_with("drone1: its map does not have the place in the lot")) << run->error();
}

TEST_F(Lot, IsOverWhenTheDroneComesHomeByItself) {
  drone.explores_to_the_end = false;
  auto const run = begin({autonomy::ExploreStep{}, autonomy::ComeHomeStep{}});
  until([&] { return run->progress().starts_with("explore, 50 % seen"); });
  drone.say(autonomy::error_log_text("the battery is low"));
  drone.be(State::land);
  until([&] { return run->state() == RunState::failed; });
  EXPECT_TRUE(run->vehicle_failed());
  EXPECT_EQ(run->error(), "drone1 is in Land now: the battery is low");
}

TEST_F(Lot, IsLeftToAnOperatorWhoCommandsTheDrone) {
  drone.explores_to_the_end = false;
  auto const run = begin({autonomy::ExploreStep{}});
  until([&] { return !drone.heard.empty() && drone.heard.back() == "Autonomous Explore"; });
  ASSERT_TRUE(platform.desk()->command(hawk.text, R"({"Type":"Land"})"));
  EXPECT_EQ(run->state(), RunState::failed);
  EXPECT_EQ(run->error(), "an operator took drone1 over");
  until([&] { return drone.heard.back() == "Land"; });
}

TEST_F(Lot, IsStoppedWhereTheDroneIs) {
  drone.explores_to_the_end = false;
  auto const run = begin({autonomy::ExploreStep{}});
  until([&] { return run->progress().starts_with("explore, 50 % seen"); });
  run->stop();
  EXPECT_EQ(run->state(), RunState::failed);
  loop.run_until_done(platform.settle());
  EXPECT_EQ(drone.last["Type"], "Compulsive Move");
  EXPECT_EQ(drone.last["X"], 5.0);
  EXPECT_EQ(drone.last["Y"], 7.0);
  EXPECT_EQ(platform.desk()->heartbeat(hawk.text)->state, "Hover");
}

TEST_F(Lot, IsNotStoppedByWhoBeginsAnotherInTheSameTurn) {
  drone.explores_to_the_end = false;
  auto const run = begin({autonomy::ExploreStep{}});
  until([&] { return run->progress().starts_with("explore, 50 % seen"); });
  run->stop();
  auto const next = fly({autonomy::ComeHomeStep{}});
  EXPECT_EQ(next->state(), RunState::done) << next->error();
  std::deque<std::string> const wanted{"Arm", "Takeoff", "Autonomous Explore", "Land"};
  EXPECT_EQ(drone.heard, wanted);
}

TEST_F(Lot, SuitsSurveyDronesAlone) {
  class Mission final : public tasks::PlatformTask {
   public:
    [[nodiscard]] std::string name() const override { return "M"; }
    [[nodiscard]] std::optional<std::string> unsuited(tasks::VehicleInfo const&) const override { return {}; }
    [[nodiscard]] std::optional<geo::Wgs84> reference_position() const override { return {}; }
  };
  auto const mission = std::make_shared<Mission const>();
  EXPECT_EQ(platform.unsuited(*mission, platform.vehicles().front()),
            "M is no lot, and a survey drone flies no other tasks");
  EXPECT_EQ(platform.start(mission, hawk)->state(), RunState::failed);
  EXPECT_EQ(platform.start(mission, {"nobody"})->error(), "no survey drone nobody");
}

TEST(SurveyPlatform, HasItsWordsAndNoVehiclesWithoutDrones) {
  base::LogHub hub;
  base::Loop loop;
  SurveyPlatform platform(loop, base::Logger(hub, "survey"));
  EXPECT_EQ(platform.vocabulary().builders.front().name, "lot");
  EXPECT_TRUE(platform.vehicles().empty());
  EXPECT_FALSE(platform.find(hawk));
  loop.run_until_done(platform.settle());
}

}  // namespace
}  // namespace lapwing::host
