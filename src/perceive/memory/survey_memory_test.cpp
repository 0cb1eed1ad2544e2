#include "perceive/memory/survey_memory.hpp"

#include <gtest/gtest.h>

#include "perceive/memory/kept_sights.hpp"

namespace lapwing::perceive {
namespace {

using namespace std::chrono_literals;

auto const anchor = geo::Wgs84::from_degrees(43.2585, -79.9201, 100.0);
auto const begun = base::UtcTime(std::chrono::hours(24 * 365 * 55));

geo::Site site_at(geo::Wgs84 const& place) {
  return geo::Site::make("lot", place).value();
}

explore::Corners slot_at(double x) {
  return {{{x, 0.0}, {x + 2.5, 0.0}, {x + 2.5, 5.0}, {x, 5.0}}};
}

explore::LotSight sight_from(double x, base::UtcTime at) {
  explore::LotSight sight{.vehicle = "drone",
                          .at = at,
                          .view = {.lens = geo::pinhole(640, 480, 1.0),
                                   .site_from_camera = geo::camera_at({x, 2.0, 10.0}, 0.3, 0.1),
                                   .ground_up_m = 0.5}};
  sight.slots.push_back({.outline = slot_at(x), .surety = 0.9, .taken_chance = 0.25});
  sight.slots.push_back({.outline = slot_at(x + 2.5), .surety = 0.7});
  sight.cars.push_back({.outline = slot_at(x), .chance = 0.8});
  return sight;
}

SurveyMemory some_memory() {
  SurveyMemory memory{
      .at = begun + 90s, .lives = 3, .begun = begun, .explores = true, .ending = "time", .pictures = 17};
  map::Slot content{.outline = {{{{1, 0}, {3.5, 0}, {3.5, 5}, {1, 5}}}},
                    .state = map::SlotState::free,
                    .taken_probability = 0.125,
                    .seen_at = begun + 40s,
                    .seen_by = "drone"};
  memory.slots.push_back(
      {.id = "slot-4", .site = "lot", .account = {.writer = "drone", .at = begun + 41s}, .content = content});
  return memory;
}

std::string some_text() {
  KeptSights kept;
  kept.add(sight_from(1.0, begun + 40s), true);
  kept.add(sight_from(9.0, begun + 42s), true);
  return memory_text(some_memory(), site_at(anchor), kept.lines());
}

std::string fault_of(std::string_view text, geo::Wgs84 const& place = anchor) {
  auto const memory = read_memory(text, site_at(place));
  return memory ? std::string() : memory.error().message;
}

TEST(SurveyMemory, IsReadAsItWasWritten) {
  auto const memory = read_memory(some_text(), site_at(anchor)).value();
  auto const written = some_memory();
  EXPECT_EQ(memory.at, written.at);
  EXPECT_EQ(memory.lives, 3);
  EXPECT_EQ(memory.begun, written.begun);
  EXPECT_TRUE(memory.explores);
  EXPECT_EQ(memory.ending, "time");
  EXPECT_EQ(memory.pictures, 17U);
  ASSERT_EQ(memory.slots.size(), 1U);
  EXPECT_EQ(memory.slots[0].id, "slot-4");
  EXPECT_EQ(memory.slots[0].account, written.slots[0].account);
  auto const& slot = std::get<map::Slot>(memory.slots[0].content);
  EXPECT_EQ(slot.state, map::SlotState::free);
  EXPECT_EQ(slot.taken_probability, 0.125);
  EXPECT_EQ(slot.seen_at, begun + 40s);

  ASSERT_EQ(memory.sights.size(), 2U);
  auto const expected = sight_from(9.0, begun + 42s);
  auto const& sight = memory.sights[1];
  EXPECT_EQ(sight.vehicle, "drone");
  EXPECT_EQ(sight.at, expected.at);
  EXPECT_EQ(sight.view.ground_up_m, 0.5);
  EXPECT_EQ(sight.view.lens.width_px, 640);
  EXPECT_NEAR(geo::distance_m(sight.view.site_from_camera.origin(), expected.view.site_from_camera.origin()), 0, 1e-3);
  EXPECT_NEAR(sight.view.site_from_camera.rotation().angularDistance(expected.view.site_from_camera.rotation()), 0,
              1e-5);
  ASSERT_EQ(sight.slots.size(), 2U);
  EXPECT_EQ(sight.slots[0].taken_chance, 0.25);
  EXPECT_FALSE(sight.slots[1].taken_chance);
  EXPECT_EQ(sight.slots[1].surety, 0.7);
  EXPECT_NEAR(sight.slots[0].outline[2].x(), 11.5, 1e-3);
  ASSERT_EQ(sight.cars.size(), 1U);
  EXPECT_EQ(sight.cars[0].chance, 0.8);
}

TEST(SurveyMemory, LiesWhereItLayWhenTheOriginOfTheFlightControllerIsAnother) {
  auto const there = site_at(anchor);
  auto const elsewhere = geo::displaced(anchor, {.north = 30.0, .east = -40.0, .down = -2.0});
  auto const here = site_at(elsewhere);
  auto const memory = read_memory(some_text(), here).value();
  auto const place_of = [](geo::Site const& site, map::SitePoint const& point) {
    return site.place_of(geo::Point3<geo::SiteFrame>(point.x(), point.y(), 0.0));
  };
  auto const was = place_of(there, sight_from(9.0, begun).slots[0].outline[0]);
  EXPECT_LT(geo::surface_distance_m(place_of(here, memory.sights[1].slots[0].outline[0]), was), 0.01);
  auto const& ring = std::get<map::Slot>(memory.slots[0].content).outline.rings[0];
  EXPECT_LT(geo::surface_distance_m(place_of(here, ring[0]), place_of(there, {1.0, 0.0})), 0.01);
  auto const& view = memory.sights[1].view;
  EXPECT_NEAR(view.height_m(), 9.5, 1e-3) << "over the ground it is as high as it was";
  EXPECT_NEAR(view.ground_up_m, -1.5, 0.01);
}

TEST(SurveyMemory, OfElsewhereIsNone) {
  EXPECT_NE(fault_of(some_text(), geo::Wgs84::from_degrees(43.3585, -79.9201, 100.0)).find("from here"),
            std::string::npos);
}

TEST(SurveyMemory, IsRefusedWhereverItIsCutOff) {
  auto const text = some_text();
  for (std::size_t length = 0; length < text.size(); ++length)
    ASSERT_NE(fault_of(text.substr(0, length)), "") << length;
}

TEST(SurveyMemory, IsRefusedWhicheverByteWasChanged) {
  auto const text = some_text();
  for (std::size_t i = 0; i < text.size(); ++i) {
    auto changed = text;
    changed[i] = static_cast<char>(changed[i] ^ 1);
    ASSERT_NE(fault_of(changed), "") << i;
  }
}

/// With a checksum that is right.
std::string changed(std::string_view from, std::string_view to) {
  auto text = some_text();
  auto const at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  text.erase(text.rfind("{\"crc32\""));
  return with_checksum(std::move(text));
}

TEST(SurveyMemory, OfALaterVersionIsNamedSo) {
  EXPECT_NE(fault_of(changed("\"version\":1", "\"version\":2")).find("version 2"), std::string::npos);
}

TEST(SurveyMemory, OfAnotherProgramIsNone) {
  EXPECT_NE(fault_of(changed("lapwing survey", "lapwing sonata")).find("no survey"), std::string::npos);
  EXPECT_NE(fault_of(with_checksum("")), "");
  EXPECT_NE(fault_of(with_checksum("[]\n{}\n")), "");
}

TEST(SurveyMemory, IsRefusedWithWhatMakesNoSense) {
  EXPECT_NE(fault_of(changed("\"lives\":3", "\"lives\":-3")), "");
  EXPECT_NE(fault_of(changed("\"lat_deg\":43.2585", "\"lat_deg\":143.2585")), "");
  EXPECT_NE(fault_of(changed("\"taken_probability\":0.125", "\"taken_probability\":7")), "");
  EXPECT_NE(fault_of(changed("\"lens\":[640,", "\"lens\":[0,")), "");
  EXPECT_NE(fault_of(changed("\"vehicle\":\"drone\"", "\"vehicle\":5")), "");
  EXPECT_NE(fault_of(changed(",0.9,0.25]", ",1.9,0.25]")), "");
  EXPECT_NE(fault_of(changed(",0.9,0.25]", ",0.9,0.25,1]")), "");
}

TEST(KeptSights, AreThoseThatShowNewGroundAndOneAMinuteFromEachPlace) {
  KeptSights kept;
  EXPECT_TRUE(kept.add(sight_from(0.0, begun), true));
  EXPECT_TRUE(kept.add(sight_from(0.5, begun + 1s), true));
  EXPECT_FALSE(kept.add(sight_from(1.0, begun + 2s), false));
  EXPECT_TRUE(kept.add(sight_from(5.0, begun + 3s), false));
  EXPECT_FALSE(kept.add(sight_from(5.0, begun + 50s), false));
  EXPECT_TRUE(kept.add(sight_from(5.0, begun + 64s), false));
  EXPECT_EQ(kept.size(), 4U);
  kept.forget_before(begun + 2s);
  EXPECT_EQ(kept.size(), 2U);
}

TEST(KeptSights, LetTheOldestGoWhenThereAreTooMany) {
  KeptSights kept;
  for (int i = 0; i < 1000 + static_cast<int>(KeptSights::most); ++i) kept.add(sight_from(0.0, begun + i * 1s), true);
  EXPECT_EQ(kept.size(), KeptSights::most);
  auto const text = memory_text(some_memory(), site_at(anchor), kept.lines());
  auto const memory = read_memory(text, site_at(anchor)).value();
  EXPECT_EQ(memory.sights.front().at, begun + 1000s);
}

}  // namespace
}  // namespace lapwing::perceive
