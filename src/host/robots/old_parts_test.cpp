#include "host/robots/old_parts.hpp"

#include <gtest/gtest.h>

namespace lapwing::host {
namespace {

TEST(OldParts, NamesALinkAndTheRobot) {
  EXPECT_EQ(parse_old_parts("tcpin://127.0.0.1:5771").value(),
            (OldParts{"robot1", {link::Transport::tcp_in, "127.0.0.1", 5771}}));
  EXPECT_EQ(parse_old_parts("robot2=serial:///dev/ttyUSB1:115200?flow=on").value(),
            (OldParts{"robot2", {link::Transport::serial, "/dev/ttyUSB1", 115200, true}}));
  EXPECT_EQ(parse_old_parts("serial:///dev/ttyUSB1:115200?flow=on").value().robot, "robot1");
  EXPECT_EQ(parse_old_parts("tcpout://10.0.0.7:5771").value().url.host, "10.0.0.7");
}

TEST(OldParts, SaysWhatIsWrong) {
  auto const wrong = [](std::string_view text) { return parse_old_parts(text).error().message; };
  EXPECT_EQ(wrong("tcpin://0.0.0.0:5771"),
            "--old-parts tcpin://0.0.0.0:5771: the lines have no password, so they are taken on this machine alone");
  EXPECT_EQ(wrong("udpin://127.0.0.1:5771"),
            "--old-parts udpin://127.0.0.1:5771: lines need a stream: TCP or a serial line");
  EXPECT_FALSE(parse_old_parts("centre"));
  EXPECT_FALSE(parse_old_parts("robot1="));
}

}  // namespace
}  // namespace lapwing::host
