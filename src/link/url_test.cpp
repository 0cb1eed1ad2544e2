#include "link/url.hpp"

#include <gtest/gtest.h>

namespace lapwing::link {
namespace {

TEST(Url, ReadsEveryKindAndPrintsItAgain) {
  for (auto const* text : {"udpin://0.0.0.0:14550", "udpout://127.0.0.1:14550", "udpbcast://192.168.1.255:14550",
                           "tcpout://drone.local:5760", "tcpin://0.0.0.0:5760", "serial:///dev/ttyUSB0:57600"}) {
    auto const url = parse_url(text);
    ASSERT_TRUE(url) << text;
    EXPECT_EQ(to_string(*url), text);
  }
  EXPECT_EQ(*parse_url("serial:///dev/ttyACM0:115200"), (Url{Transport::serial, "/dev/ttyACM0", 115200}));
}

TEST(Url, ReadsWhatOtherToolsWrite) {
  struct Written {
    char const* theirs;
    char const* ours;
  };
  Written const cases[] = {
      {"udp:0.0.0.0:14550", "udpin://0.0.0.0:14550"},
      {"udpin:127.0.0.1:14550", "udpin://127.0.0.1:14550"},
      {"udpout:10.0.0.7:14550", "udpout://10.0.0.7:14550"},
      {"tcp:127.0.0.1:5760", "tcpout://127.0.0.1:5760"},
      {"tcpin:0.0.0.0:5760", "tcpin://0.0.0.0:5760"},
      {"/dev/ttyACM0,115200", "serial:///dev/ttyACM0:115200"},
      {"/dev/ttyUSB0", "serial:///dev/ttyUSB0:57600"},
      {"udp://:14540", "udpin://0.0.0.0:14540"},
      {"tcp://drone.local:5760", "tcpout://drone.local:5760"},
      {"udpbcast:10.0.0.255:14550", "udpbcast://10.0.0.255:14550"},
  };
  for (auto const& [theirs, ours] : cases) {
    auto const url = parse_url(theirs);
    ASSERT_TRUE(url) << theirs << ": " << url.error().message;
    EXPECT_EQ(to_string(*url), ours);
  }
}

struct Wrong {
  char const* text;
  char const* message;
  char const* hint;
};

TEST(Url, SaysWhatIsWrongAndShowsARightOne) {
  Wrong const cases[] = {
      {"udpin://0.0.0.0", "the port is missing", "udpin://0.0.0.0:14550"},
      {"udpin://:14550", "the address is missing", "udpin://0.0.0.0:14550"},
      {"udpout://1.2.3.4:x", "'x' is no port", "udpout://127.0.0.1:14550"},
      {"udpout://1.2.3.4:0", "1 to 65535", "udpout://"},
      {"udpbcast://10.0.0.255:0", "1 to 65535", "udpbcast://192.168.1.255:14550"},
      {"tcpin://0.0.0.0:70000", "1 to 65535", "tcpin://0.0.0.0:5760"},
      {"tcpout://host:-1", "'-1' is no port", "tcpout://"},
      {"serial:///dev/ttyUSB0", "baud rate is missing", "serial:///dev/ttyUSB0:57600"},
      {"serial://:57600", "device is missing", "serial:///dev/ttyUSB0:57600"},
      {"serial:///dev/ttyUSB0:fast", "'fast' is no baud rate", "serial:///dev/ttyUSB0:57600"},
      {"udp://10.0.0.7:14540", "'udp' is no kind of link", "udpin://0.0.0.0:14550 to listen"},
      {"/dev/ttyUSB0,fast", "'fast' is no baud rate", "serial:///dev/ttyUSB0:57600"},
      {"http://x:80", "'http' is no kind of link", "udpin://"},
      {"14550", "no '://'", "udpin://"},
      {"", "no '://'", "udpin://"},
  };
  for (auto const& wrong : cases) {
    auto const url = parse_url(wrong.text);
    ASSERT_FALSE(url) << wrong.text;
    EXPECT_EQ(url.error().kind, base::ErrorKind::invalid_input);
    EXPECT_NE(url.error().message.find(wrong.message), std::string::npos) << url.error().message;
    EXPECT_NE(url.error().hint.find(wrong.hint), std::string::npos) << url.error().hint;
  }
}

TEST(Url, TakesPortZeroWhereItListens) {
  EXPECT_TRUE(parse_url("udpin://127.0.0.1:0"));
  EXPECT_TRUE(parse_url("tcpin://127.0.0.1:0"));
}

TEST(Url, TakesFlowControlOfASerialLine) {
  auto const url = parse_url("serial:///dev/serial/by-id/usb-FTDI_Radio-if00:57600?flow=on");
  ASSERT_TRUE(url);
  EXPECT_EQ(*url, (Url{Transport::serial, "/dev/serial/by-id/usb-FTDI_Radio-if00", 57600, true}));
  EXPECT_EQ(to_string(*url), "serial:///dev/serial/by-id/usb-FTDI_Radio-if00:57600?flow=on");
  EXPECT_FALSE(parse_url("udpin://0.0.0.0:14550?flow=on"));
  EXPECT_FALSE(parse_url("serial:///dev/ttyUSB0:57600?flow=maybe"));
}

}  // namespace
}  // namespace lapwing::link
