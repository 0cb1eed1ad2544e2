#include "host/survey/survey_desk.hpp"

#include "host/survey/survey_control.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include "autonomy/operator/map_request.hpp"
#include "autonomy/operator/map_text.hpp"
#include "autonomy/operator/report_text.hpp"
#include "base/log.hpp"
#include "link/pictures/picture_server.hpp"
#include "station/http/http_server.hpp"

namespace lapwing::host {
namespace {

namespace wire = link::operator_link;
using namespace std::chrono_literals;
using ::lapwing::map::LayerKind;

auto const home = geo::Wgs84::from_degrees(43.2585, -79.9201, 100.0);

/// A station's desk, and a drone's end of the operator link on this machine, in real time.
class Desk : public ::testing::Test {
 public:
  void SetUp() override {
    wire::ServeSettings settings{.port = 0};
    settings.server.end.name = "drone";
    drone = wire::serve(loop, std::move(settings), {}).value();
    wire::ConnectSettings reached{.port = drone->port()};
    reached.client.back_off = {.first = 10ms, .most = 50ms};
    desk = SurveyDesk::open(loop, map, base::Logger(hub, "survey"), {{.name = "hawk", .settings = reached}}).value();
    until([&] { return view().is_connected; });
    EXPECT_EQ(heard(), map_request_text(autonomy::MapRequest::as_changes)) << "it asks for changes of the map first";
  }
  template <class Condition>
  void until(Condition condition) {
    auto const deadline = loop.now() + 10s;
    while (!condition() && loop.now() < deadline) loop.run_until_done(next_look());
    EXPECT_TRUE(condition());
  }
  base::Task<> next_look() { co_await loop.sleep(2ms); }
  [[nodiscard]] vehicle::SurveyDroneView view() const { return desk->drones().at(0); }
  void say(std::string text) { ASSERT_EQ(drone->send_to_all({.text = std::move(text)}), 0U); }
  void say_heartbeat(autonomy::Said const& said, std::optional<autonomy::OccupancyMap> const& found = std::nullopt) {
    autonomy::Told told;
    told.flight = autonomy::FlightController{.mode = "GUIDED",
                                             .is_armed = true,
                                             .relative_alt_m = 12.0,
                                             .position = home,
                                             .local = geo::Point3<autonomy::ArmingFrame>(5, 7, 12),
                                             .battery = 0.8};
    say(autonomy::heartbeat_text(said, told, found).value());
  }
  /// What the drone is told next.
  std::string heard() {
    auto* const session = drone->sessions().at(0);
    auto const message = loop.run_until_done(session->receive(10s));
    return message ? message->text : "nothing";
  }

  base::LogHub hub;
  base::Loop loop;
  ::lapwing::map::LiveMap map{[this] { return loop.utc_now(); }};
  std::unique_ptr<wire::Server> drone;
  std::unique_ptr<SurveyDesk> desk;
};

TEST_F(Desk, ShowsWhatTheDroneTells) {
  EXPECT_EQ(view().state, "");
  say_heartbeat({.state = autonomy::State::hover, .user_error = autonomy::UserError::no_lot_detected});
  until([&] { return view().state == "Hover"; });
  EXPECT_EQ(view().name, "hawk");
  EXPECT_EQ(view().mode, "GUIDED");
  EXPECT_TRUE(view().is_armed);
  EXPECT_EQ(view().height_m, 12.0);
  EXPECT_EQ(view().battery, 0.8);
  EXPECT_EQ(view().user_error, to_string(autonomy::UserError::no_lot_detected));
  say(autonomy::error_log_text("Takeoff is refused: it is not armed yet"));
  until([&] { return !view().words.empty(); });
  EXPECT_EQ(view().words.back().text, "Takeoff is refused: it is not armed yet");
  say("{\"Type\":\"Poem\"}");
  until([&] { return view().words.size() == 2; });
  EXPECT_EQ(view().words.back().text, "a drone's message of the unknown type 'Poem'");
}

TEST_F(Desk, HandsCommandsOnAndNothingElse) {
  ASSERT_TRUE(desk->command("hawk", R"({"Type":"Autonomous Explore"})"));
  EXPECT_EQ(heard(), R"({"Type":"Autonomous Explore"})");
  EXPECT_EQ(desk->command("dove", R"({"Type":"Arm"})").error().kind, base::ErrorKind::not_found);
  EXPECT_EQ(desk->command("hawk", R"({"Type":"Sing"})").error().kind, base::ErrorKind::invalid_input);
  drone.reset();
  until([&] { return !view().is_connected; });
  auto const refused = desk->command("hawk", R"({"Type":"Land"})");
  EXPECT_EQ(refused.error().kind, base::ErrorKind::refused);
  EXPECT_EQ(refused.error().message, "hawk is not connected");
  EXPECT_TRUE(desk->command("hawk", R"({"Type":"Kill"})")) << "that waits for a moment";
}

TEST_F(Desk, LetsTheNewestWordOfWhereToFlyOvertakeOthersButNotHeights) {
  ASSERT_TRUE(desk->command("hawk", R"({"Type":"Configure","Min":8,"Des":9,"Max":10})"));
  ASSERT_TRUE(desk->command("hawk", R"({"Type":"Autonomous Explore"})"));
  ASSERT_TRUE(desk->command("hawk", R"({"Type":"Land"})"));
  EXPECT_EQ(heard(), R"({"Type":"Configure","Min":8,"Des":9,"Max":10})");
  EXPECT_EQ(heard(), R"({"Type":"Land"})");
}

TEST_F(Desk, StopsTheDroneInAnEmergencyUntilItSaysThatItStands) {
  SurveyControl control(loop, *desk, vehicle::StopAction::hold, base::Logger(hub, "survey"));
  say_heartbeat({.state = autonomy::State::autonomous_explore});
  until([&] { return view().state == "AutonomousExplore"; });
  control.emergency_stop(std::nullopt, "operator 2");
  EXPECT_EQ(heard(), R"({"Type":"Compulsive Move","X":5,"Y":7})");
  EXPECT_FALSE(control.emergency().vehicles.at(0).is_confirmed);
  auto const refused = desk->command("hawk", R"({"Type":"Autonomous Explore"})");
  EXPECT_EQ(refused.error().message, "the emergency stop of operator 2 is latched");
  EXPECT_TRUE(desk->command("hawk", R"({"Type":"Land"})"));
  EXPECT_EQ(heard(), R"({"Type":"Land"})");
  say_heartbeat({.state = autonomy::State::hover});
  until([&] { return control.emergency().vehicles.at(0).is_confirmed; });
  EXPECT_EQ(control.emergency().vehicles.at(0).detail, "hovers");
  control.release_emergency_stop("operator 2");
  EXPECT_TRUE(desk->command("hawk", R"({"Type":"Autonomous Explore"})"));
}

TEST_F(Desk, PutsTheOccupancyMapWhereTheDroneIs) {
  autonomy::OccupancyMap found{
      .columns = 2, .rows = 2, .resolution_m = 0.5, .origin = {-1, 2}, .cells = {-1, 0, 100, 50}};
  say_heartbeat({}, found);
  until([&] { return !map.grids().empty(); });
  auto const& [key, record] = *map.grids().begin();
  EXPECT_EQ(key.site, "default");
  EXPECT_EQ(key.name, "hawk parking");
  // The drone is in the site's middle, 5 m east and 7 m north of where it was armed.
  EXPECT_NEAR(record.grid.site_from_grid().origin().x(), -6.0, 1e-6);
  EXPECT_NEAR(record.grid.site_from_grid().origin().y(), -5.0, 1e-6);
  EXPECT_FALSE(record.grid.at({0, 0}).is_seen());
  EXPECT_NEAR(record.grid.at({1, 0}).probability(), 0.02, 0.002);
  EXPECT_NEAR(record.grid.at({0, 1}).probability(), 0.98, 0.002);
  EXPECT_NEAR(record.grid.at({1, 1}).probability(), 0.5, 0.002);
  found.cells = {0, 0, -1, 50};
  say_heartbeat({}, found);
  until([&] { return record.grid.at({0, 0}).is_seen(); });
  EXPECT_FALSE(record.grid.at({0, 1}).is_seen()) << "what the drone does not know any more";
}

TEST_F(Desk, FollowsTheMapByItsChangesAndAsksAgainWhenItHasMissedSome) {
  autonomy::OccupancyMap const first{
      .columns = 2, .rows = 2, .resolution_m = 0.5, .origin = {-1, 2}, .cells = {-1, 0, 100, 50}};
  auto second = first;
  second.cells = {0, 0, -1, 50};
  auto third = second;
  third.cells[2] = 100;
  say(autonomy::map_text(first, 1).value());
  say_heartbeat({});  // only now it is known where the map lies
  until([&] { return !map.grids().empty(); });
  auto const& record = map.grids().begin()->second;
  EXPECT_FALSE(record.grid.at({0, 0}).is_seen());
  EXPECT_NEAR(record.grid.at({0, 1}).probability(), 0.98, 0.002);
  say(autonomy::map_changes_text(first, 1, second, 2));
  until([&] { return record.grid.at({0, 0}).is_seen(); });
  EXPECT_FALSE(record.grid.at({0, 1}).is_seen());

  say(autonomy::map_changes_text(third, 3, first, 4));
  EXPECT_EQ(heard(), map_request_text(autonomy::MapRequest::as_changes));
  say(autonomy::map_text(third, 4).value());
  until([&] { return record.grid.at({0, 1}).is_seen(); });
}

TEST_F(Desk, PutsSlotsOnTheMapAndCountsThem) {
  say_heartbeat({});
  until([&] { return map.site("default") != nullptr; });
  auto const slot = [](int number, std::string_view state) {
    double const west = -79.92 + number * 1e-4;
    return fmt::format(
        R"({{"type":"Feature","id":"{}","properties":{{"state":"{}","taken_probability":0.5}},"geometry":{{"type":"Polygon",)"
        R"("coordinates":[[[{},43.25],[{},43.25],[{},43.2501],[{},43.2501],[{},43.25]]]}}}})",
        number, state, west, west + 3e-5, west + 3e-5, west, west);
  };
  say(fmt::format(R"({{"Type":"Slots","Features":{{"type":"FeatureCollection","features":[{},{},{}]}}}})",
                  slot(1, "free"), slot(2, "taken"), slot(3, "taken")));
  until([&] { return view().slots.has_value(); });
  EXPECT_EQ(view().slots->free, 1U);
  EXPECT_EQ(view().slots->taken, 2U);
  ASSERT_NE(map.find(LayerKind::slots, "hawk 2"), nullptr);
  EXPECT_EQ(map.find(LayerKind::slots, "hawk 2")->feature.account.writer, "hawk");
  say(fmt::format(R"({{"Type":"Slots","Features":{{"type":"FeatureCollection","features":[{},{}]}}}})", slot(1, "free"),
                  slot(3, "taken")));
  until([&] { return view().slots->taken == 1; });
  say(R"({"Type":"Slots","Features":{"type":"Nonsense"}})");
  until([&] { return !view().words.empty(); });
  EXPECT_TRUE(view().words.back().text.starts_with("the map does not take it: ")) << view().words.back().text;
}

TEST_F(Desk, ShowsTheCameraWhileItIsAskedFor) {
  auto const camera = link::pictures::PictureServer::open(loop, {.port = 0}).value();
  wire::ConnectSettings const reached{.port = drone->port()};
  SurveyLink const told{.name = "dove", .settings = reached, .camera = link::pictures::Source{.port = camera->port()}};
  auto const seat = SurveyDesk::open(loop, map, base::Logger(hub, "survey"), {told}).value();
  using link::pictures::View;
  EXPECT_FALSE(camera->is_watched(View::raw));
  auto const taken = loop.utc_now();
  base::Scope scope(loop);
  auto const offering = [&]() -> base::Task<> {
    while (!camera->is_watched(View::raw)) co_await loop.sleep(2ms);
    camera->offer(View::raw, {.jpeg = std::make_shared<std::string const>("jpeg"), .taken = taken});
  };
  scope.spawn(offering());
  auto const picture = loop.run_until_done(seat->picture("dove", vehicle::PictureView::raw, 0));
  ASSERT_TRUE(picture) << picture.error().message;
  EXPECT_EQ(*picture->jpeg, "jpeg");
  EXPECT_EQ(picture->number, 1U);
  EXPECT_LT(std::chrono::abs(picture->taken - taken), 1ms);
  EXPECT_FALSE(camera->is_watched(View::annotated));
  auto const none = loop.run_until_done(seat->picture("dove", vehicle::PictureView::raw, picture->number));
  ASSERT_FALSE(none);
  EXPECT_TRUE(none.error().message.starts_with("NoImage")) << none.error().message;
  until([&] { return !camera->is_watched(View::raw); });
  EXPECT_EQ(loop.run_until_done(seat->picture("crow", vehicle::PictureView::raw, 0)).error().kind,
            base::ErrorKind::not_found);
}

/// What a drone answers to whoever offers himself, and what it was told.
class Whep {
 public:
  Whep(base::Loop& loop, base::LogHub& hub)
      : server(station::HttpServer::open(loop, {.port = 0, .token = "swordfish"}, base::Logger(hub, "whep")).value()) {
    station::Router router;
    router.add("POST", "/api/v1/whep/raw", [this](station::HttpRequest const& request) -> station::Reply {
      offered.push_back(request.body);
      return answer;
    });
    router.add("DELETE", "/api/v1/whep/sessions/5eed", [this](station::HttpRequest const&) -> station::Reply {
      ++ended;
      return station::HttpResponse{.body = "{}"};
    });
    server->set_router(std::move(router));
  }

  std::vector<std::string> offered;
  int ended = 0;
  station::HttpResponse answer{.status = 201,
                               .content_type = "application/sdp",
                               .body = "v=0 of the drone",
                               .headers = {{"Location", "/api/v1/whep/sessions/5eed"}}};
  std::unique_ptr<station::HttpServer> server;
};

TEST_F(Desk, HandsAViewersOfferToTheDroneAndEndsItsSession) {
  Whep whep(loop, hub);
  SurveyLink told{.name = "dove", .settings = {.port = drone->port()}, .camera_token = "swordfish"};
  told.webrtc = link::pictures::Source{.port = static_cast<std::uint16_t>(whep.server->port())};
  auto const seat = SurveyDesk::open(loop, map, base::Logger(hub, "survey"), {told}).value();
  auto const ask = [&] { return loop.run_until_done(seat->video("dove", vehicle::PictureView::raw, "v=0")); };
  auto const video = ask();
  ASSERT_TRUE(video) << video.error().message;
  EXPECT_EQ(video->answer, "v=0 of the drone");
  EXPECT_EQ(video->session, "5eed");
  EXPECT_EQ(whep.offered, std::vector<std::string>{"v=0"});
  auto const over = loop.run_until_done(seat->end_video("dove", "5eed"));
  EXPECT_TRUE(over) << over.error().message;
  EXPECT_EQ(whep.ended, 1);
  for (auto const* const strange : {"", "../sessions/5eed", "5eed HTTP/1.1"})
    EXPECT_EQ(loop.run_until_done(seat->end_video("dove", strange)).error().kind, base::ErrorKind::not_found);

  whep.answer = station::problem(503, "as many look at the camera as it allows");
  auto const full = ask();
  ASSERT_FALSE(full);
  EXPECT_EQ(full.error().kind, base::ErrorKind::refused);
  EXPECT_NE(full.error().message.find("as many look"), std::string::npos) << full.error().message;
  for (auto const& strange :
       {station::HttpResponse{.body = "{}"}, station::HttpResponse{.status = 201, .content_type = "application/sdp"},
        station::HttpResponse{.status = 201,
                              .content_type = "application/sdp",
                              .headers = {{"Location", "/api/v1/whep/sessions/../x"}}}}) {
    whep.answer = strange;
    EXPECT_EQ(ask().error().kind, base::ErrorKind::lost);
  }
}

TEST_F(Desk, TellsThatADroneHasNoVideo) {
  auto const nobody = loop.run_until_done(desk->video("hawk", vehicle::PictureView::raw, "v=0"));
  ASSERT_FALSE(nobody);
  EXPECT_EQ(nobody.error().kind, base::ErrorKind::lost);
  EXPECT_TRUE(nobody.error().message.starts_with("FailedToSend")) << nobody.error().message;
  EXPECT_EQ(loop.run_until_done(desk->video("crow", vehicle::PictureView::raw, "v=0")).error().kind,
            base::ErrorKind::not_found);
}

TEST(CameraOf, IsBesideTheOperatorLinkUnlessItIsTold) {
  SurveyLink link{.settings = parse_survey("drone.local:3001").value()};
  EXPECT_EQ(camera_of(link).host, "drone.local");
  EXPECT_EQ(camera_of(link).port, 3081);
  EXPECT_EQ(video_of(link).port, 3181) << "never the picture's port of the drone beside it";
  link.camera = link::pictures::Source{.host = "10.0.0.7", .port = 8000};
  EXPECT_EQ(camera_of(link).host, "10.0.0.7");
}

TEST(ParseSurvey, TakesAHostWithOrWithoutAPort) {
  EXPECT_EQ(parse_survey("127.0.0.1")->port, 3000);
  EXPECT_EQ(parse_survey("drone.local:3001")->host, "drone.local");
  EXPECT_EQ(parse_survey("drone.local:3001")->port, 3001);
  for (auto const* const text : {"", ":3000", "a:", "a:x", "a:70000", "a:0", "tcp://a:3000"})
    EXPECT_FALSE(parse_survey(text)) << text;
}

TEST_F(Desk, RefusesTwoOfOneName) {
  wire::ConnectSettings const reached{.port = drone->port()};
  auto const opened = SurveyDesk::open(loop, map, base::Logger(hub, "survey"), {{"a", reached}, {"a", reached}});
  EXPECT_EQ(opened.error().message, "two survey drones are called a");
}

}  // namespace
}  // namespace lapwing::host
