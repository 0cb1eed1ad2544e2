#include "onboard/decide/survey_processes.hpp"

#include <functional>

#include <gtest/gtest.h>

#include "bus/messages/survey_names.hpp"
#include "bus/testing/own_domain.hpp"

namespace lapwing::onboard {
namespace {

TEST(SeenExtent, LiesAroundTheCellsThatAreKnown) {
  autonomy::OccupancyMap const map{.columns = 4,
                                   .rows = 3,
                                   .resolution_m = 0.5,
                                   .origin = {10, -2},
                                   .cells = {-1, -1, -1, -1,  //
                                             -1, 0, 100, -1,  //
                                             -1, -1, 50, -1}};
  auto const box = seen_extent(map);
  ASSERT_TRUE(box);
  EXPECT_EQ(box->least, (geo::Point<autonomy::ArmingFrame>(10.5, -1.5)));
  EXPECT_EQ(box->most, (geo::Point<autonomy::ArmingFrame>(11.5, -0.5)));
}

TEST(SeenExtent, IsNothingWhereNothingWasSeen) {
  EXPECT_FALSE(seen_extent({}));
  EXPECT_FALSE(seen_extent({.columns = 2, .rows = 1, .resolution_m = 1, .cells = {-1, -1}}));
}

struct SurveyProcessesOnTheBus : testing::Test {
  /// Until it holds; false when it does not within ten seconds.
  bool comes_true(std::function<bool()> const& holds) {
    using namespace std::chrono_literals;
    return loop.run_until_done([](base::Loop& on, std::function<bool()> wanted) -> base::Task<bool> {
      auto const deadline = on.now() + 10s;
      while (!wanted() && on.now() < deadline) co_await on.sleep(5ms);
      co_return wanted();
    }(loop, holds));
  }

  base::Loop loop;
  /// Tests that run side by side do not hear each other.
  std::unique_ptr<bus::Bus> bus = bus::Bus::open(loop, {.domain = bus::testing::own_domain()}).value();
  FlightHeard flight;
  std::unique_ptr<SurveyProcesses> processes = SurveyProcesses::open(loop, *bus, flight, {}).value();
};

TEST_F(SurveyProcessesOnTheBus, AreToldTheHoverHeightsInForceHoweverLateTheyCome) {
  processes->hear(autonomy::HoverHeights{.min_m = 8, .desired_m = 11, .max_m = 15});
  std::optional<bus::Float64MultiArray> heard;
  auto const reading = bus::Subscription<bus::Float64MultiArray>::open(
      *bus, bus::survey::names::hover_heights, bus::Profile::latched, [&](auto const& heights) { heard = heights; });
  ASSERT_TRUE(reading);
  ASSERT_TRUE(comes_true([&] { return heard.has_value(); }));
  EXPECT_EQ(heard->data, (std::vector<double>{8, 11, 15}));
}

TEST_F(SurveyProcessesOnTheBus, AreToldHowLongTheDroneMayFlyOnceThatIsKnown) {
  using namespace std::chrono_literals;
  std::vector<double> heard;
  auto const reading =
      bus::Subscription<bus::Float64>::open(*bus, bus::survey::names::flying_time_left, bus::Profile::standard,
                                            [&](auto const& seconds) { heard.push_back(seconds.data); });
  ASSERT_TRUE(reading);
  // Not latched: until the reader is met nobody hears it.
  ASSERT_TRUE(comes_true([&] {
    processes->hear(autonomy::Said{});
    processes->hear(autonomy::Said{.flying_time_left = 90500ms});
    return !heard.empty();
  }));
  EXPECT_EQ(heard.front(), 90.5);
}

TEST_F(SurveyProcessesOnTheBus, SpeakToTheOperatorInPrintableWords) {
  auto writing =
      bus::Publisher<bus::String>::open(*bus, bus::survey::names::survey_report, bus::Profile::standard).value();
  ASSERT_TRUE(comes_true([&] { return writing.readers() == 1; }));
  writing.publish({"the survey is over:\nall is seen"});
  std::vector<std::string> reports;
  ASSERT_TRUE(comes_true([&] {
    if (reports.empty()) reports = processes->take_reports();
    return !reports.empty();
  }));
  EXPECT_EQ(reports, std::vector<std::string>{"the survey is over:?all is seen"});
  EXPECT_TRUE(processes->take_reports().empty());
}

}  // namespace
}  // namespace lapwing::onboard
