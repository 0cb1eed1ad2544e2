#include "perceive/health.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace lapwing::perceive {
namespace {

using namespace std::chrono_literals;
using bus::DiagnosticStatus;

constexpr base::TimePoint begin{};

SightRecord good() {
  return {.film = {.is_open = true, .pictures = 40},
          .began = begin,
          .good_at = begin + 10s,
          .took_s = 0.1,
          .looks_a_s = 4.0};
}

/// What is said then.
DiagnosticStatus said(SightRecord const& record, base::TimePoint now) {
  auto const told = vision_health(record, now);
  EXPECT_TRUE(told);
  return told.value_or(DiagnosticStatus{.level = DiagnosticStatus::stale});
}

std::string value_of(DiagnosticStatus const& status, std::string const& key) {
  auto const found = std::ranges::find(status.values, key, &bus::KeyValue::key);
  return found == status.values.end() ? "none" : found->value;
}

TEST(VisionHealth, IsWellWithPicturesAndTellsItsFigures) {
  auto const told = said(good(), begin + 10s);
  EXPECT_EQ(told.level, DiagnosticStatus::ok);
  EXPECT_EQ(told.message, "");
  EXPECT_EQ(value_of(told, "looks_a_second"), "4.00");
  EXPECT_EQ(value_of(told, "look_ms"), "100");
}

TEST(VisionHealth, WarnsOfWhatPassesAndFailsWithWhatStays) {
  auto gone = good();
  gone.film.is_open = false;
  gone.film.fault = "the camera is gone";
  EXPECT_EQ(said(gone, begin + 11s).level, DiagnosticStatus::warn);
  auto const later = said(gone, begin + 13s);
  EXPECT_EQ(later.level, DiagnosticStatus::error);
  EXPECT_EQ(later.message, "the camera is gone");

  auto black = good();
  black.picture_fault = "it is black: is the lens covered?";
  EXPECT_EQ(said(black, begin + 11s).level, DiagnosticStatus::warn);
  EXPECT_EQ(said(black, begin + 13s).level, DiagnosticStatus::error);
  EXPECT_NE(said(black, begin + 13s).message.find("black"), std::string::npos);

  EXPECT_EQ(said(good(), begin + 13s).message, "no picture comes");
  auto slow = good();
  slow.took_s = 1.4;
  EXPECT_EQ(said(slow, begin + 10s).level, DiagnosticStatus::warn);
}

TEST(VisionHealth, IsNotSaidBeforeItIsKnown) {
  SightRecord fresh{.film = {.is_open = true}, .began = begin + 10s};
  EXPECT_FALSE(vision_health(fresh, begin + 11s)) << "it would be taken for well, and the drone would take off";
  EXPECT_EQ(said(fresh, begin + 13s).level, DiagnosticStatus::error);
  EXPECT_EQ(said(fresh, begin + 13s).message, "no picture comes");
  fresh.place_fault = "it is not known where the drone is";
  EXPECT_FALSE(vision_health(fresh, begin + 11s));
  EXPECT_EQ(said(fresh, begin + 13s).message, "it is not known where the drone is");
  fresh.place_fault.clear();
  fresh.good_at = begin + 11s;
  EXPECT_EQ(said(fresh, begin + 11s).level, DiagnosticStatus::ok);
}

TEST(MapperHealth, NeedsAPose) {
  ThoughtRecord record{.has_home = true};
  EXPECT_EQ(mapper_health(record).level, DiagnosticStatus::error);
  record.pose_age = 3s;
  EXPECT_EQ(mapper_health(record).message, "no pose for 3.0 s");
  record.pose_age = 100ms;
  EXPECT_EQ(mapper_health(record).level, DiagnosticStatus::ok);
  record.has_home = false;
  EXPECT_EQ(mapper_health(record).level, DiagnosticStatus::warn);
  record.figures.coverage = 0.5;
  EXPECT_EQ(value_of(mapper_health(record), "coverage"), "0.500");
}

TEST(PlannerHealth, SaysWhyThereIsNoSurvey) {
  EXPECT_EQ(planner_health({}).level, DiagnosticStatus::ok);
  auto const told = planner_health({.fault = "the area to be mapped is none"});
  EXPECT_EQ(told.level, DiagnosticStatus::error);
  EXPECT_EQ(told.message, "the area to be mapped is none");
}

}  // namespace
}  // namespace lapwing::perceive
