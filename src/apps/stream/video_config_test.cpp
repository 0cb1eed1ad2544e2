#include "apps/stream/video_config.hpp"

#include <string>

#include <gtest/gtest.h>

namespace lapwing::apps {
namespace {

struct Read {
  VideoConfig config;
  std::string mistakes;
};

Read read(std::string text) {
  base::SourceFile const source("/etc/lapwing/onboard.toml", std::move(text));
  base::Diagnostics diagnostics(source);
  auto config = read_video_config(source, diagnostics);
  return {std::move(config), base::render(diagnostics)};
}

TEST(VideoConfig, IsReadWhole) {
  auto const [config, mistakes] = read(R"(
[camera]
kind = "is read by others"
[stream]
address = "0.0.0.0"
port = 3090
token_file = "camera.token"
pictures_a_s = 12.2
[rtsp]
address = "0.0.0.0"
port = 9554
most_viewers = 3
kbit_a_s = 500
[webrtc]
address = "0.0.0.0"
port = 3091
most_viewers = 2
kbit_a_s = 700
)");
  EXPECT_EQ(mistakes, "");
  EXPECT_EQ(config.rtsp->address, "0.0.0.0");
  EXPECT_EQ(config.rtsp->port, 9554);
  EXPECT_EQ(config.rtsp->most_viewers, 3U);
  EXPECT_EQ(config.rtsp->kbit_a_s, 500U);
  EXPECT_EQ(config.rtsp->pictures_a_s, 12.2);
  EXPECT_EQ(config.webrtc->settings.address, "0.0.0.0");
  EXPECT_EQ(config.webrtc->port, 3091);
  EXPECT_EQ(config.webrtc->settings.most_viewers, 2U);
  EXPECT_EQ(config.webrtc->settings.kbit_a_s, 700U);
  EXPECT_EQ(config.webrtc->settings.pictures_a_s, 12.2);
  EXPECT_EQ(config.pictures.host, "127.0.0.1") << "on the same machine";
  EXPECT_EQ(config.pictures.port, 3090);
  EXPECT_EQ(config.token_file, "/etc/lapwing/camera.token");
}

TEST(VideoConfig, NeedsPictures) {
  EXPECT_EQ(read("[stream]\n[rtsp]\n").mistakes, "");
  EXPECT_NE(read("[rtsp]\n").mistakes.find("no pictures to be handed on"), std::string::npos);
  EXPECT_NE(read("[stream]\n").mistakes.find("nothing is to be served"), std::string::npos);
  EXPECT_NE(read("[stream]\nport = 0\n[rtsp]\n").mistakes.find("no port"), std::string::npos);
  EXPECT_NE(read("[stream]\n[rtsp]\ntoken_file = \"x\"\n").mistakes.find("[stream] token_file"), std::string::npos);
  EXPECT_NE(read("[stream]\n[webrtc]\ntoken_file = \"x\"\n").mistakes.find("[stream] token_file"), std::string::npos);
  EXPECT_NE(read("[stream]\n[rtsp]\nkbit_a_s = 1\n").mistakes.find("kbit_a_s"), std::string::npos);
}

TEST(VideoConfig, MayBeForBrowsersAlone) {
  auto const [config, mistakes] = read("[stream]\n[webrtc]\n");
  EXPECT_EQ(mistakes, "");
  EXPECT_FALSE(config.rtsp);
  ASSERT_TRUE(config.webrtc);
  EXPECT_EQ(config.webrtc->port, 3180);
  EXPECT_EQ(config.webrtc->settings.address, "127.0.0.1");
}

TEST(VideoConfig, WantsATokenWhereOtherMachinesReachIt) {
  EXPECT_NE(read("[stream]\n[rtsp]\naddress = \"0.0.0.0\"\n").mistakes.find("whoever is on the network"),
            std::string::npos);
  EXPECT_NE(read("[stream]\n[webrtc]\naddress = \"192.0.2.1\"\n").mistakes.find("[webrtc] address"), std::string::npos);
  EXPECT_EQ(read("[stream]\ntoken_file = \"t\"\n[webrtc]\naddress = \"192.0.2.1\"\n").mistakes, "");
  EXPECT_EQ(read("[stream]\ntoken_file = \"t\"\n[rtsp]\naddress = \"0.0.0.0\"\n").mistakes, "");
  EXPECT_EQ(read("[stream]\n[rtsp]\naddress = \"127.0.0.2\"\n").mistakes, "");
}

}  // namespace
}  // namespace lapwing::apps
