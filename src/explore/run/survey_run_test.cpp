// Whole surveys of simulated car parks: each ends by itself, never leaves the fence, and tells what is so.
#include "explore/run/survey_run.hpp"

#include <gtest/gtest.h>

namespace lapwing::explore {
namespace {

SurveyRunSettings usual_run() {
  constexpr double across_rad = 1.08;
  SurveyRunSettings settings;
  settings.survey.camera = geo::pinhole(1280, 720, across_rad);
  settings.keeps_track = true;
  return settings;
}

void expect_within_fence(CarPark const& park, SurveyReport const& report) {
  ASSERT_FALSE(report.track.empty());
  for (auto const& place : report.track) {
    EXPECT_TRUE(geo::contains(park.fence(), map::SitePoint(place.x(), place.y()))) << place.x() << ' ' << place.y();
    EXPECT_LE(place.z(), 20.0 + 1e-9);
    EXPECT_GE(place.z(), 7.0 - 1e-9);
  }
}

struct SurveyRunTest : ::testing::TestWithParam<std::uint64_t> {};

/// Of the seeds 2, 6 have a building in the middle, 1, 4 a corner cut out.
TEST_P(SurveyRunTest, EndsByItselfWithinTheFenceWithTheLotKnown) {
  CarPark const park(GetParam());
  auto const report = fly_survey(park, usual_run()).value();
  EXPECT_EQ(report.ending, "nothing more to learn");
  EXPECT_GE(report.coverage, 0.98);
  EXPECT_GE(report.slots_found, 0.93);
  EXPECT_GE(report.occupancy_right, 0.97);
  EXPECT_LT(report.off_m, 0.22) << "each place of the camera is off by 0.3 m east and 0.3 m north";
  EXPECT_LT(report.took_s, 600.0);
  expect_within_fence(park, report);
}

INSTANTIATE_TEST_SUITE_P(Parks, SurveyRunTest, ::testing::Values(1, 2, 3, 4, 6));

TEST(SurveyRun, APlaceOffByASlotHalvesNoSlotAndDoublesNone) {
  DetectorFaults faults;
  faults.camera_off_m = 1.0;
  CarPark const park(4, faults);
  auto const report = fly_survey(park, usual_run()).value();
  EXPECT_EQ(report.ending, "nothing more to learn");
  EXPECT_GE(report.slots_found, 0.9);
  EXPECT_GE(report.occupancy_right, 0.95);
  EXPECT_LE(report.wrong_slots, park.slots().size() / 20);
}

TEST(SurveyRun, TheSameSeedGivesTheSameRun) {
  CarPark const park(5);
  auto const one = fly_survey(park, usual_run()).value();
  auto const two = fly_survey(park, usual_run()).value();
  EXPECT_EQ(one.took_s, two.took_s);
  EXPECT_EQ(one.flown_m, two.flown_m);
  EXPECT_EQ(one.information, two.information);
  EXPECT_EQ(one.track, two.track);
}

TEST(SurveyRun, LittleEnergyEndsItInTimeToFlyHome) {
  CarPark const park(3);
  auto settings = usual_run();
  settings.flying_s = 60.0;
  auto const report = fly_survey(park, settings).value();
  EXPECT_EQ(report.ending, "energy");
  auto const& last = report.track.back();
  double const home_s =
      seconds_to_fly(geo::distance_m(map::SitePoint(last.x(), last.y()), park.home()), settings.survey.flight);
  EXPECT_LE(report.took_s + home_s, 60.0 + 1.0);
}

TEST(SurveyRun, WhoKeepsWatchingDoesSoUntilEnergyEndsIt) {
  CarPark const park(2);
  auto settings = usual_run();
  settings.survey.keeps_watching = true;
  settings.flying_s = 240.0;
  auto const report = fly_survey(park, settings).value();
  EXPECT_EQ(report.ending, "energy");
  EXPECT_GT(report.took_s, 190.0);
  expect_within_fence(park, report);
}

TEST(SurveyRun, ADetectorThatErrsMoreCostsTimeAndStaysHonest) {
  CarPark const park(3, {.wrong_share = 0.06});
  auto const report = fly_survey(park, usual_run()).value();
  EXPECT_EQ(report.ending, "nothing more to learn");
  EXPECT_GE(report.occupancy_right, 0.95);
}

TEST(SurveyRun, TheLawnMowerFliesTheSameCarParkWithinTheFence) {
  for (std::uint64_t const seed : {1U, 2U, 3U}) {
    CarPark const park(seed);
    auto const report = fly_lawn_mower(park, usual_run(), {.height_m = 20.0, .sidelap = 0.3}).value();
    EXPECT_EQ(report.ending, "legs flown");
    EXPECT_GE(report.coverage, 0.98);
    expect_within_fence(park, report);
  }
}

}  // namespace
}  // namespace lapwing::explore
