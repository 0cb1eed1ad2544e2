#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <deque>
#include <string>

#include <gtest/gtest.h>

#include "link/testing/talker.hpp"

namespace lapwing::link {
namespace {

using namespace testing;

TEST(TcpLink, CarriesBytesBothWaysAndNamesItsClients) {
  base::Loop loop;
  Talker in(loop, opened(loop, "tcpin://127.0.0.1:0"));
  Talker out(loop, opened(loop, "tcpout://127.0.0.1:" + std::to_string(port_of(in.link()))));
  EXPECT_FALSE(out.say("too early"));
  ASSERT_TRUE(loop.run_until_done(until_standing(loop, out.link(), true)));
  EXPECT_TRUE(out.say("hello"));
  ASSERT_TRUE(loop.run_until_done(in.hears("hello")));
  EXPECT_EQ(in.link().peer_name(in.from()).rfind("127.0.0.1:", 0), 0u);
  EXPECT_TRUE(in.answer("good day"));
  EXPECT_TRUE(loop.run_until_done(out.hears("good day")));
  EXPECT_EQ(in.link().standing_peers().size(), 1u);
}

TEST(TcpLink, ComesBackAfterTheServerDid) {
  base::Loop loop(base::Loop::Pace{.speedup = 20.0});
  auto in = std::make_unique<Talker>(loop, opened(loop, "tcpin://127.0.0.1:0"));
  auto const url = in->link().name();
  Talker out(loop, opened(loop, "tcpout" + url.substr(5)));
  ASSERT_TRUE(loop.run_until_done(until_standing(loop, out.link(), true)));
  in.reset();
  ASSERT_TRUE(loop.run_until_done(until_standing(loop, out.link(), false)));
  EXPECT_EQ(out.link().state(), LinkState::opening);
  EXPECT_NE(out.link().last_error(), "");
  in = std::make_unique<Talker>(loop, opened(loop, url));
  ASSERT_TRUE(loop.run_until_done(until_standing(loop, out.link(), true)));
  EXPECT_TRUE(out.say("back"));
  EXPECT_TRUE(loop.run_until_done(in->hears("back")));
}

TEST(TcpLink, ForgetsAClientThatLeft) {
  base::Loop loop;
  Talker in(loop, opened(loop, "tcpin://127.0.0.1:0"));
  auto out = std::make_unique<Talker>(loop, opened(loop, "tcpout" + in.link().name().substr(5)));
  ASSERT_TRUE(loop.run_until_done(until_standing(loop, in.link(), true)));
  auto const peer = in.link().standing_peers().front();
  out.reset();
  ASSERT_TRUE(loop.run_until_done(until_standing(loop, in.link(), false)));
  EXPECT_FALSE(in.say("anybody there?", peer));
}

template <class T>
std::optional<T> option_of(int descriptor, int level, int option) {
  T value{};
  socklen_t size = sizeof(value);
  if (getsockopt(descriptor, level, option, &value, &size) != 0) return std::nullopt;
  return value;
}

/// The descriptors of this process that are connected TCP sockets.
std::vector<int> tcp_connections() {
  std::vector<int> found;
  for (int descriptor = 0; descriptor < 1024; ++descriptor) {
    auto const info = option_of<tcp_info>(descriptor, IPPROTO_TCP, TCP_INFO);
    if (info && info->tcpi_state == TCP_ESTABLISHED) found.push_back(descriptor);
  }
  return found;
}

TEST(TcpLink, GivesAFarEndUpThatIsSilentForSeconds) {
  base::Loop loop;
  Talker in(loop, opened(loop, "tcpin://127.0.0.1:0"));
  Talker out(loop, opened(loop, "tcpout" + in.link().name().substr(5)));
  ASSERT_TRUE(loop.run_until_done(until_standing(loop, out.link(), true)));
  ASSERT_TRUE(loop.run_until_done(until_standing(loop, in.link(), true)));
  auto const both = tcp_connections();
  EXPECT_EQ(both.size(), 2u);
  for (int const one : both) {
    EXPECT_EQ(option_of<int>(one, IPPROTO_TCP, TCP_USER_TIMEOUT), 5000) << "with something on its way";
    EXPECT_EQ(option_of<int>(one, SOL_SOCKET, SO_KEEPALIVE), 1) << "with nothing on its way";
    EXPECT_EQ(option_of<int>(one, IPPROTO_TCP, TCP_KEEPIDLE), 5);
    EXPECT_EQ(option_of<int>(one, IPPROTO_TCP, TCP_KEEPINTVL), 2);
    EXPECT_EQ(option_of<int>(one, IPPROTO_TCP, TCP_KEEPCNT), 2);
  }
}

TEST(TcpLink, ConnectsToAHostByItsName) {
  base::Loop loop;
  Talker in(loop, opened(loop, "tcpin://127.0.0.1:0"));
  Talker out(loop, opened(loop, "tcpout://localhost:" + std::to_string(port_of(in.link()))));
  ASSERT_TRUE(loop.run_until_done(until_standing(loop, out.link(), true)));
}

TEST(TcpLink, SpeaksIpv6WhereThereIsOne) {
  base::Loop loop;
  auto listening = open(loop, parse_url("tcpin://[::1]:0").value());
  if (!listening) GTEST_SKIP() << listening.error().message;
  Talker in(loop, std::move(*listening));
  Talker out(loop, opened(loop, "tcpout" + in.link().name().substr(5)));
  ASSERT_TRUE(loop.run_until_done(until_standing(loop, out.link(), true)));
  EXPECT_TRUE(out.say("hello"));
  EXPECT_TRUE(loop.run_until_done(in.hears("hello")));
}

TEST(TcpLink, NamesThePortThatIsTaken) {
  base::Loop loop;
  auto const first = opened(loop, "tcpin://127.0.0.1:0");
  auto const taken = open(loop, parse_url(first->name()).value());
  ASSERT_FALSE(taken);
  EXPECT_NE(taken.error().message.find("is already in use"), std::string::npos);
}

}  // namespace
}  // namespace lapwing::link
