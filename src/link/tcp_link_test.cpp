#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <ctime>
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

TEST(TcpLink, LetsTheLongestSilentClientGoForANewOne) {
  base::Loop loop(base::Loop::Pace{.speedup = 5.0});
  Talker in(loop, opened(loop, "tcpin://127.0.0.1:0"));
  auto const url = "tcpout" + in.link().name().substr(5);
  std::deque<Talker> clients;
  auto const connect = [&] {
    clients.emplace_back(loop, opened(loop, url));
    ASSERT_TRUE(loop.run_until_done(until_standing(loop, clients.back().link(), true)));
  };
  connect();
  for (int i = 1; i < 256; ++i) connect();
  EXPECT_TRUE(clients[0].say("I am here"));
  ASSERT_TRUE(loop.run_until_done(in.hears("I am here")));
  EXPECT_EQ(in.link().standing_peers().size(), 256u);
  connect();
  EXPECT_TRUE(clients.back().say("so am I"));
  ASSERT_TRUE(loop.run_until_done(in.hears("so am I")));
  EXPECT_EQ(in.link().standing_peers().size(), 256u);
  ASSERT_TRUE(loop.run_until_done(until_standing(loop, clients[1].link(), false))) << "it had said nothing";
  EXPECT_FALSE(clients[0].link().standing_peers().empty());
}

TEST(TcpLink, DoesNotSpinWhereNoDescriptorIsLeft) {
#ifdef LAPWING_SANITIZED
  GTEST_SKIP() << "the sanitizer needs a descriptor to look at an object's type";
#endif
  base::Loop loop;
  Talker in(loop, opened(loop, "tcpin://127.0.0.1:0"));
  Talker out(loop, opened(loop, "tcpout" + in.link().name().substr(5)));
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &before), 0);
  int const next = dup(0);  // the lowest that is free
  ::close(next);
  rlimit const none{static_cast<rlim_t>(next) + 1, before.rlim_max};  // one for the client's end, none for the server's
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &none), 0);
  EXPECT_TRUE(loop.run_until_done(until_standing(loop, out.link(), true))) << "the kernel has taken it";
  auto const began = std::clock();
  loop.run_until_done(pass(loop, 500ms));
  double const busy_s = static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
  EXPECT_TRUE(in.link().standing_peers().empty());
  EXPECT_NE(in.link().last_error(), "");
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &before), 0);
  EXPECT_LT(busy_s, 0.1);
  EXPECT_TRUE(loop.run_until_done(until_standing(loop, in.link(), true)));
  EXPECT_EQ(in.link().last_error(), "");
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
