#include "apps/perceive/perceive_config.hpp"

#include <string>

#include <gtest/gtest.h>

namespace lapwing::apps {
namespace {

struct Read {
  PerceiveConfig config;
  std::string mistakes;
};

Read read(std::string text) {
  base::SourceFile const source("/etc/lapwing/onboard.toml", std::move(text));
  base::Diagnostics diagnostics(source);
  auto config = read_perceive_config(source, diagnostics);
  return {std::move(config), base::render(diagnostics)};
}

TEST(PerceiveConfig, IsReadWhole) {
  auto const [config, mistakes] = read(R"(
[bus]
domain = 7
[decide]
anything = "is read by others"
[camera]
kind = "pattern"
[survey]
name = "p4"
area = [[43.2587, -79.9204], [43.2587, -79.9200], [43.2584, -79.9200]]
fence = [[43.2590, -79.9210], [43.2590, -79.9195], [43.2580, -79.9195], [43.2580, -79.9210]]
ground_m = -1.5
speed_m_s = 4
coverage = 0.98
most_min = 10
lot_lost_s = 60
folder = "found"
pictures_a_s = 2
remembers_min = 15
[stream]
port = 3090
pictures_a_s = 15
most_viewers = 3
token_file = "camera.token"
)");
  EXPECT_EQ(mistakes, "");
  auto const& order = config.perceive.order;
  EXPECT_EQ(config.bus.domain, 7U);
  EXPECT_EQ(order.name, "p4");
  ASSERT_EQ(order.area.size(), 3U);
  EXPECT_NEAR(order.area[0].lat_deg(), 43.2587, 1e-9);
  EXPECT_EQ(order.fence.size(), 4U);
  EXPECT_EQ(order.ground_m, -1.5);
  EXPECT_EQ(order.planner.flight.speed_m_s, 4.0);
  EXPECT_EQ(order.enough_coverage, 0.98);
  EXPECT_EQ(order.most_s, 600.0);
  EXPECT_EQ(order.lot_lost, std::chrono::seconds(60));
  EXPECT_EQ(config.perceive.folder, "/etc/lapwing/found");
  EXPECT_EQ(config.perceive.looks_a_s, 2.0);
  EXPECT_EQ(config.perceive.remembers, std::chrono::minutes(15));
  ASSERT_TRUE(config.perceive.stream);
  EXPECT_EQ(config.perceive.stream->port, 3090);
  EXPECT_EQ(config.perceive.shown_a_s, 15.0);
  EXPECT_EQ(config.perceive.stream->address, "127.0.0.1");
  EXPECT_EQ(config.perceive.stream->most_viewers, 3U);
  EXPECT_EQ(config.stream_token_file.filename(), "camera.token");
  EXPECT_EQ(order.planner.camera.width_px, config.perceive.camera.lens.width_px);
}

TEST(PerceiveConfig, TellsEveryMistakeAtOnce) {
  auto const [config, mistakes] = read(R"(
[camera]
kind = "eye"
[survey]
area = [[143.2587, -79.9204], [43.2587], [43.2584, -79.9200]]
speed_m_s = 90
colour = "blue"
)");
  for (auto const* const words : {"eye", "143.259 is no latitude", "speed_m_s", "colour"})
    EXPECT_NE(mistakes.find(words), std::string::npos) << words << "\n" << mistakes;
}

TEST(PerceiveConfig, WantsACameraAndAnArea) {
  EXPECT_NE(read("").mistakes.find("there is no camera"), std::string::npos);
  EXPECT_NE(read("[camera]\nkind = \"pattern\"\n").mistakes.find("no survey"), std::string::npos);
  EXPECT_NE(read("[camera]\nkind = \"pattern\"\n[survey]\n").mistakes.find("has no area"), std::string::npos);
}

TEST(PerceiveConfig, TriesTheSurvey) {
  auto const [config, mistakes] = read(R"(
[camera]
kind = "pattern"
[survey]
area = [[43.2587, -79.9204], [43.2584, -79.9200], [43.2587, -79.9200], [43.2584, -79.9204]]
)");
  EXPECT_NE(mistakes.find("cross"), std::string::npos) << mistakes;
}

}  // namespace
}  // namespace lapwing::apps
