#include "apps/onboard/onboard_config.hpp"

#include <string>

#include <gtest/gtest.h>

namespace lapwing::apps {
namespace {

struct Read {
  OnboardConfig config;
  std::string mistakes;
};

Read read(std::string text) {
  base::SourceFile const source("/etc/lapwing/onboard.toml", std::move(text));
  base::Diagnostics diagnostics(source);
  auto config = read_onboard_config(source, diagnostics);
  return {std::move(config), base::render(diagnostics)};
}

TEST(OnboardConfig, WithoutAnythingIsBridgeAndDecideOnLoopback) {
  auto const [config, mistakes] = read("");
  EXPECT_EQ(mistakes, "");
  ASSERT_EQ(config.processes.size(), 2U);
  EXPECT_EQ(config.processes[0].name, "bridge");
  EXPECT_EQ(config.processes[1].name, "decide");
  EXPECT_TRUE(config.bus.is_local);
  EXPECT_EQ(config.decide.desk.address, "127.0.0.1");
  EXPECT_EQ(config.decide.desk.port, 3000);
  EXPECT_TRUE(config.decide.relies_on.empty());
  EXPECT_EQ(config.decide.state_folder, "/etc/lapwing/lapwing-onboard");
}

TEST(OnboardConfig, WithACameraSeesBeforeItDecides) {
  // What is in the tables is the business of lapwing-perceive.
  auto const [config, mistakes] = read("[camera]\nkind = \"simulated\"\n[survey]\nname = \"lot\"\n");
  EXPECT_EQ(mistakes, "");
  EXPECT_TRUE(config.sees);
  ASSERT_EQ(config.processes.size(), 3U);
  EXPECT_EQ(config.processes[1].name, "perceive");
  EXPECT_TRUE(config.processes[1].tells_life);
  auto const named = read("[camera]\n[[process]]\nname = \"bridge\"\n[[process]]\nname = \"perceive\"\n");
  EXPECT_EQ(named.mistakes, "");
  EXPECT_TRUE(named.config.processes[1].tells_life);
  EXPECT_NE(read("[survey]\n").mistakes.find("a survey needs a camera"), std::string::npos);
}

TEST(OnboardConfig, ShowsWhatItSeesOverRtsp) {
  auto const [config, mistakes] = read("[camera]\n[stream]\n[rtsp]\nport = 1\n");
  EXPECT_EQ(mistakes, "");
  EXPECT_TRUE(config.shows);
  ASSERT_EQ(config.processes.size(), 4U);
  EXPECT_EQ(config.processes[1].name, "perceive");
  EXPECT_EQ(config.processes[2].name, "stream") << "who has the pictures is there first";
  EXPECT_TRUE(config.processes[2].tells_life);
  EXPECT_FALSE(read("[camera]\n[stream]\n").config.shows);
  EXPECT_EQ(read("[camera]\n[rtsp]\n[[process]]\nname = \"stream\"\n").mistakes, "");
  EXPECT_NE(read("[camera]\n[[process]]\nname = \"stream\"\n").mistakes.find("no process stream"), std::string::npos);
  EXPECT_NE(read("[rtsp]\n").mistakes.find("there is none"), std::string::npos);
}

TEST(OnboardConfig, IsReadWhole) {
  auto const [config, mistakes] = read(R"(
health_file = "health.json"
[bus]
domain = 7
network = true
[bridge]
link = "serial:///dev/ttyAMA0:921600"
system_id = 3
geoid_m = -36.2
[decide]
state_folder = "/var/lib/lapwing"
link_lost_s = 5
furthest_m = 400
relies_on = ["vision", "planner"]
[operator]
address = "0.0.0.0"
port = 3001
name = "hawk"
mode = "json"
token_file = "operator.token"
certificate = "drone.pem"
key = "drone.key"
client_authority = "operators.pem"
[[process]]
name = "bridge"
[[process]]
name = "perceive"
command = ["/usr/bin/perceive", "--fast"]
tells_life = true
[[process]]
name = "decide"
)");
  EXPECT_EQ(mistakes, "");
  EXPECT_EQ(config.health_file, "/etc/lapwing/health.json");
  EXPECT_EQ(config.bus.domain, 7U);
  EXPECT_FALSE(config.bus.is_local);
  EXPECT_EQ(config.bridge.system_id, 3);
  EXPECT_EQ(config.bridge.geoid_m, -36.2);
  EXPECT_EQ(config.decide.state_folder, "/var/lib/lapwing");
  EXPECT_EQ(config.decide.machine.link_lost, std::chrono::seconds(5));
  EXPECT_EQ(config.decide.desk.server.end.session.link_lost, std::chrono::seconds(5));
  EXPECT_EQ(config.decide.machine.places.furthest_m, 400.0);
  EXPECT_EQ(config.decide.relies_on, (std::vector<std::string>{"vision", "planner"}));
  EXPECT_EQ(config.decide.desk.server.end.mode, link::operator_link::Mode::json);
  EXPECT_EQ(config.decide.desk.server.end.name, "hawk");
  EXPECT_EQ(config.token_file, "/etc/lapwing/operator.token");
  ASSERT_TRUE(config.decide.desk.tls);
  EXPECT_EQ(config.decide.desk.tls->client_authority, "/etc/lapwing/operators.pem");
  ASSERT_EQ(config.processes.size(), 3U);
  EXPECT_EQ(config.processes[1].command, (std::vector<std::string>{"/usr/bin/perceive", "--fast"}));
  EXPECT_TRUE(config.processes[1].tells_life);
}

TEST(OnboardConfig, TellsEveryMistakeAtItsPlace) {
  auto const [config, mistakes] = read(R"(
[bus]
domain = 200
[bridge]
link = "nowhere"
[decide]
relies_on = ["eyes"]
[operator]
mode = "xml"
name = "a name"
token = "secret"
key = "drone.key"
[[process]]
name = "decide"
[[process]]
name = "bridge"
[[process]]
name = "perceive"
[[process]]
command = ["x"]
[[process]]
name = "decide"
command = ["x"]
[typo]
)");
  for (auto const* const words : {"domain", "nowhere", "eyes", "xml", "'a name' is no name", "token_file",
                                  "certificate and its key", "bridge stands behind decide", "no process perceive",
                                  "needs a name", "two processes decide", "takes no command", "typo"})
    EXPECT_NE(mistakes.find(words), std::string::npos) << words << "\n" << mistakes;
}

}  // namespace
}  // namespace lapwing::apps
