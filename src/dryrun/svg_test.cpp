#include "dryrun/svg.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>

#include <gtest/gtest.h>

#include "dryrun/internal/drawing.hpp"
#include "dryrun/recorder.hpp"
#include "missions/mission_task.hpp"

namespace lapwing::dryrun {
namespace {

using namespace internal;
using namespace std::chrono_literals;

TEST(Drawing, EscapesForeignText) {
  EXPECT_EQ(escaped("a<b>&c"), "a&lt;b&gt;&amp;c");
  EXPECT_EQ(escaped("zoë ▁"), "zoë ▁");
  EXPECT_EQ(escaped(std::string_view("a\0b\x1b[1m", 7)), "a b [1m");
  EXPECT_EQ(escaped("\xff\xc3"), "\uFFFD\uFFFD");
  EXPECT_EQ(escaped("\xed\xa0\x80"), "\uFFFD\uFFFD\uFFFD");  // half of a surrogate pair
  EXPECT_EQ(escaped("\xef\xbf\xbf"), "\uFFFD");              // no character of XML
}

TEST(Drawing, WritesValuesIntoItsMarkup) {
  Drawing drawing;
  drawing.add("<a b=\"{}\" c=\"{}\" d=\"{}\" e=\"{}\">{}</a>", 1.26, Point{-0.01, 2}, Line{{1, 2}, {3, 4.5}},
              std::vector<Line>{{{1, 2}, {3, 4}}, {{5, 6}}}, "<&>");
  EXPECT_EQ(drawing.take(), "<a b=\"1.3\" c=\"0 2\" d=\"M1 2L3 4.5\" e=\"M1 2L3 4ZM5 6Z\">&lt;&amp;&gt;</a>\n");
}

TEST(Drawing, CutsTextsToTheirRoom) {
  EXPECT_EQ(fitted("short", 10.0, 100.0), "short");
  auto const cut = fitted("a rather long naïve name", 10.0, 60.0);
  EXPECT_TRUE(cut.ends_with("…"));
  EXPECT_LE(text_width(cut, 10.0), 60.0);
  EXPECT_EQ(fitted("anything", 10.0, 3.0), "");
}

TEST(Drawing, SimplifiesLinesWithinTheTolerance) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> step(-3.0, 3.0);
  for (int round = 0; round < 50; ++round) {
    Line line{{0, 0}};
    for (int i = 0; i < 200; ++i) line.push_back({line.back().x + step(random), line.back().y + step(random)});
    auto const fewer = simplified(line, 2.0);
    EXPECT_LT(fewer.size(), line.size());
    EXPECT_EQ(fewer.front().x, line.front().x);
    EXPECT_EQ(fewer.back().y, line.back().y);
    for (auto const& point : line) {
      double nearest = 1e9;
      for (std::size_t i = 1; i < fewer.size(); ++i) {
        double const x = fewer[i].x - fewer[i - 1].x;
        double const y = fewer[i].y - fewer[i - 1].y;
        double const along = std::clamp(
            ((point.x - fewer[i - 1].x) * x + (point.y - fewer[i - 1].y) * y) / std::max(1e-12, x * x + y * y), 0.0,
            1.0);
        nearest =
            std::min(nearest, std::hypot(point.x - fewer[i - 1].x - along * x, point.y - fewer[i - 1].y - along * y));
      }
      EXPECT_LE(nearest, 2.0 + 1e-9);
    }
  }
}

TEST(Labels, DoNotOverlapAndStayInside) {
  Labels labels({{0, 0}, 200, 100});
  std::vector<Box> placed;
  int refused = 0;
  for (int i = 0; i < 40; ++i) {
    Drawing drawing;
    refused += labels.write(drawing, {100, 50}, "label", 10.0, 2.0, "") ? 0 : 1;
    auto const text = drawing.take();
    Point at;
    if (std::sscanf(text.c_str(), "<text x=\"%lf\" y=\"%lf\"", &at.x, &at.y) == 2)
      placed.push_back({{at.x, at.y - 8.0}, text_width("label", 10.0), 10.0});
  }
  EXPECT_EQ(refused + static_cast<int>(placed.size()), 40);
  EXPECT_GT(refused, 0);
  ASSERT_GT(placed.size(), 3U);
  for (std::size_t i = 0; i < placed.size(); ++i)
    for (std::size_t k = i + 1; k < placed.size(); ++k) EXPECT_FALSE(placed[i].meets(placed[k]));
  Drawing drawing;
  EXPECT_FALSE(labels.write(drawing, {199, 99}, "far too long for the corner it is in, whichever side", 10.0, 2.0, ""));
}

mavlink::MissionItem waypoint(geo::Wgs84 place) {
  mavlink::MissionItem item;
  item.command = mavlink::MavCmd::nav_waypoint;
  item.place = {.lat_rad = place.lat_rad, .lon_rad = place.lon_rad, .z_m = place.alt_m};
  return item;
}

/// A copter on a square and a rover on a line that meets it, with a fence that the copter leaves.
FlightRecord sample_record() {
  auto const home = geo::Wgs84::from_degrees(41.0, -8.0, 90.0);
  std::vector<VehicleRecord> crew(2);
  crew[0].id = "1";
  crew[0].name = "copter 1";
  crew[1].id = "2";
  crew[1].name = "rover 2";
  crew[1].family = vehicle::Family::rover;
  Recorder recorder(crew, {});
  plan::Mission mission{.name = "Square <1>", .home = home, .items = {}};
  for (auto const& corner : {geo::Ned{0, 0, -20}, {100, 0, -20}, {100, 100, -20}, {0, 100, -20}, {0, 0, -20}})
    mission.items.push_back(waypoint(geo::displaced(home, corner)));
  for (int i = 0; i <= 400; ++i) {
    double const way = i % 400;
    double const north = way < 100 ? way : way < 200 ? 100 : way < 300 ? 300 - way : 0;
    double const east = way < 100 ? 0 : way < 200 ? way - 100 : way < 300 ? 100 : 400 - way;
    Sample const copter{.place_m = {north, east, i == 0 || i == 400 ? 0.0 : -20.0},
                        .mode = "AUTO",
                        .remaining = 1.0 - i * 1e-3,
                        .used_mah = i * 5.0,
                        .voltage_v = 12.0,
                        .in_the_air = i != 0 && i != 400};
    Sample const rover{.place_m = {50, -30 + i * 0.5, 0},
                       .mode = "AUTO",
                       .remaining = 1.0 - i * 1e-4,
                       .used_mah = i * 0.5,
                       .voltage_v = 12.4,
                       .moves = true};
    recorder.sample(i * 200ms, std::vector{copter, rover});
  }
  auto const task = std::make_shared<missions::MissionTask const>(std::move(mission));
  auto const note = [&](base::Duration time, tasks::TaskEvent::Kind kind, char const* name, char const* id) {
    recorder.note({.time = base::TimePoint(time),
                   .kind = kind,
                   .task = name,
                   .vehicle = vehicle::VehicleId{id},
                   .detail = {},
                   .subject = task});
  };
  note(1s, tasks::TaskEvent::Kind::start, "Square <1>", "1");
  note(60s, tasks::TaskEvent::Kind::stop, "Square <1>", "1");
  note(2s, tasks::TaskEvent::Kind::start, "Line", "2");
  note(70s, tasks::TaskEvent::Kind::error, "Line", "2");
  recorder.say(30s, "Program message: half-way & on\n");
  auto record = recorder.finish(80s);
  record.script = "sample.dolphin";
  record.outcome = "done";
  record.home = home;
  return record;
}

plan::Fence sample_fence() {
  return {{{.name = "field",
            .kind = plan::Zone::Kind::inclusion,
            .polygons = {{{{{-20, -40}, {-20, 180}, {80, 180}, {80, -40}}}}},
            .lowest_m = {},
            .highest_m = 60.0},
           {.name = "mast",
            .kind = plan::Zone::Kind::exclusion,
            .polygons = {{{{{40, 120}, {40, 140}, {60, 140}, {60, 120}}}}},
            .lowest_m = {},
            .highest_m = {}}}};
}

std::string drawn(FlightRecord const& record, plan::Fence const& fence) {
  return to_svg(record, analyse(record, fence), fence);
}

TEST(Svg, DrawsTheGoldenPicture) {
  auto const path = std::string(LAPWING_SOURCE_DIR) + "/tests/golden/plan/sample.svg";
  auto const svg = drawn(sample_record(), sample_fence());
  if (std::getenv("LAPWING_REFRESH_GOLDEN")) std::ofstream(path) << svg;
  std::ifstream file(path);
  std::string const golden(std::istreambuf_iterator<char>(file), {});
  EXPECT_EQ(svg, golden) << "look at it, and refresh it with LAPWING_REFRESH_GOLDEN=1 when it is meant";
}

TEST(Svg, IsClosedEverywhere) {
  auto const svg = drawn(sample_record(), sample_fence());
  auto const count = [&](std::string const& words) {
    std::size_t found = 0;
    for (auto at = svg.find(words); at != std::string::npos; at = svg.find(words, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("<g ") + count("<g>"), count("</g>"));
  EXPECT_EQ(count("<svg "), count("</svg>"));
  EXPECT_EQ(count("<text "), count("</text>"));
  EXPECT_EQ(count("<title>"), count("</title>"));
  EXPECT_EQ(count("Square <1>"), 0U);
  EXPECT_EQ(count("nan"), 0U);
  EXPECT_EQ(count("inf"), 0U);
}

TEST(Svg, OfNothingIsAPictureToo) {
  FlightRecord record;
  record.script = "empty";
  record.outcome = "done";
  auto const svg = drawn(record, {});
  EXPECT_TRUE(svg.starts_with("<svg "));
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(Svg, StaysReadableWithManyVehicles) {
  FlightRecord record;
  record.duration = 100s;
  for (int i = 0; i < 200; ++i) {
    VehicleRecord vehicle;
    vehicle.name = "copter " + std::to_string(i);
    vehicle.track = {{0s, {0.0, 1.0 * i, 0.0}}, {100s, {50.0, 2.0 * i, -20.0}}};
    vehicle.charge.resize(2);
    record.vehicles.push_back(std::move(vehicle));
  }
  auto const svg = drawn(record, {});
  EXPECT_NE(svg.find("and 140 more vehicles"), std::string::npos);
  EXPECT_LT(svg.size(), 300'000U);
}

}  // namespace
}  // namespace lapwing::dryrun
