#include "route/config.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "route/test_packets.hpp"

namespace lapwing::route {
namespace {

struct Read {
  explicit Read(std::string text) : source("router.toml", std::move(text)), diagnostics(source) {
    config = read_router_config(source, diagnostics);
    complaints = base::render(diagnostics);
  }
  base::SourceFile source;
  base::Diagnostics diagnostics;
  RouterConfig config;
  std::string complaints;
};

TEST(RouterConfig, ReadsEverySetting) {
  Read const read(R"(
metrics_port = 9470
drop_duplicates = false

[[endpoint]]
name = "vehicles"
url = "udpin://0.0.0.0:14550"
between_members = true
[endpoint.in]
block_messages = ["ATTITUDE", "70000"]
allow_systems = [1, 2]

[[endpoint]]
name = "radio"
url = "/dev/ttyUSB0,57600"
bytes_per_s = 4000
messages_per_s = 50.5
[endpoint.telemetry]
messages_per_s = 20
[endpoint.out]
block_components = [100]

[[endpoint]]
url = "udpout://127.0.0.1:14560"
sniffer = true
coalesce = false

[[endpoint]]
url = "tcpin://127.0.0.1:5760"
read_only = true
)");
  EXPECT_EQ(read.complaints, "");
  EXPECT_EQ(read.config.metrics_port, 9470);
  EXPECT_FALSE(read.config.options.drops_duplicates);
  ASSERT_EQ(read.config.endpoints.size(), 4u);
  auto const& vehicles = read.config.endpoints[0];
  EXPECT_EQ(vehicles.name, "vehicles");
  EXPECT_EQ(link::to_string(vehicles.url), "udpin://0.0.0.0:14550");
  EXPECT_TRUE(vehicles.between_members);
  EXPECT_FALSE(vehicles.limits.any());
  EXPECT_FALSE(vehicles.in.passes(packet("ATTITUDE").view()));
  EXPECT_FALSE(vehicles.in.passes(unknown_packet(70'000).view()));
  EXPECT_TRUE(vehicles.in.passes(packet("HEARTBEAT").view()));
  EXPECT_FALSE(vehicles.in.passes(packet("HEARTBEAT", {.source = {3, 1}}).view()));
  EXPECT_TRUE(vehicles.out.passes(packet("ATTITUDE").view()));
  auto const& radio = read.config.endpoints[1];
  EXPECT_EQ(link::to_string(radio.url), "serial:///dev/ttyUSB0:57600");
  EXPECT_EQ(radio.limits.all.bytes_per_s, 4000.0);
  EXPECT_EQ(radio.limits.all.messages_per_s, 50.5);
  EXPECT_EQ(radio.limits.by_class[static_cast<std::size_t>(MessageClass::telemetry)].messages_per_s, 20.0);
  EXPECT_FALSE(radio.out.passes(packet("HEARTBEAT", {.source = {1, 100}}).view()));
  EXPECT_TRUE(read.config.endpoints[2].is_sniffer);
  EXPECT_FALSE(read.config.endpoints[2].coalesces);
  EXPECT_TRUE(read.config.endpoints[3].is_read_only);
}

TEST(RouterConfig, HasDefaults) {
  Read const read("");
  EXPECT_EQ(read.complaints, "");
  EXPECT_TRUE(read.config.endpoints.empty());
  EXPECT_FALSE(read.config.metrics_port);
  EXPECT_TRUE(read.config.options.drops_duplicates);
}

struct Mistake {
  char const* text;
  char const* complaint;
  char const* hint;
};

TEST(RouterConfig, ShowsEveryMistakeWithItsPlaceAndARemedy) {
  Mistake const mistakes[] = {
      {"[[endpoint]]\nurl = 'udpin://0.0.0.0'", "router.toml:2:7: error: link 'udpin://0.0.0.0': the port is missing",
       "udpin://0.0.0.0:14550"},
      {"[[endpoint]]\nname = 'a'", "router.toml:1:1: error: an endpoint needs a url",
       "url = \"udpin://0.0.0.0:14550\""},
      {"[[endpoint]]\nurl = 7", "router.toml:2:7: error: url must be text, not a whole number", ""},
      {"[endpoint]\nurl = 'udpin://0.0.0.0:1'", "endpoint must be written as [[endpoint]], not a table", ""},
      {"[[endpoint]]\nurl = 'udpin://0.0.0.0:1'\nsnifer = true", "router.toml:3:1: error: there is no setting snifer",
       "did you mean sniffer?"},
      {"[[endpoint]]\nurl = 'udpin://0.0.0.0:1'\n[endpoint.in]\nblock_messages = ['ATTITUD']",
       "router.toml:4:19: error: there is no message ATTITUD", "did you mean ATTITUDE?"},
      {"[[endpoint]]\nurl = 'udpin://0.0.0.0:1'\n[endpoint.out]\nallow_messages = ['99999999']",
       "there is no message 99999999", "or a number such as"},
      {"[[endpoint]]\nurl = 'udpin://0.0.0.0:1'\n[endpoint.out]\nallow_systems = [256]",
       "every element of allow_systems must be a whole number from 0 to 255", ""},
      {"[[endpoint]]\nurl = 'udpin://0.0.0.0:1'\nbytes_per_s = 0", "bytes_per_s must be from 0.1", ""},
      {"[[endpoint]]\nurl = 'udpin://0.0.0.0:1'\n[endpoint.commands]\nbytes_per_s = 9", "there is no setting commands",
       "did you mean command?"},
      {"[[endpoint]]\nname = 'a'\nurl = 'udpin://0.0.0.0:1'\n[[endpoint]]\nname = 'a'\nurl = 'udpin://0.0.0.0:2'",
       "two endpoints are called a", "tell them apart"},
      {"metrics_port = 70000", "metrics_port must be from 0 to 65535", ""},
      {"endpoints = 1", "there is no setting endpoints", "did you mean endpoint?"},
      {"[[endpoint", "not-toml", ""},
  };
  for (auto const& [text, complaint, hint] : mistakes) {
    Read const read(text);
    EXPECT_NE(read.complaints.find(complaint), std::string::npos) << text << "\n" << read.complaints;
    EXPECT_NE(read.complaints.find(hint), std::string::npos) << text << "\n" << read.complaints;
  }
}

TEST(LimitSerialLine, TakesTheLinesOwnSpeedWhereNobodySaidAnother) {
  EndpointOptions serial{.url = {link::Transport::serial, "/dev/ttyUSB0", 57600}};
  limit_serial_line(serial);
  EXPECT_NEAR(serial.limits.all.bytes_per_s, 5472.0, 0.5);
  serial.limits.all.bytes_per_s = 1000.0;
  limit_serial_line(serial);
  EXPECT_EQ(serial.limits.all.bytes_per_s, 1000.0);
  EndpointOptions udp{.url = {link::Transport::udp_in, "0.0.0.0", 14550}};
  limit_serial_line(udp);
  EXPECT_TRUE(std::isinf(udp.limits.all.bytes_per_s));
}

}  // namespace
}  // namespace lapwing::route
