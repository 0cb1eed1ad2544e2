#include <fcntl.h>
#include <net/if.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "link/impaired_link.hpp"
#include "link/pipe_link.hpp"
#include "link/testing/talker.hpp"

namespace lapwing::link {
namespace {

using namespace testing;

TEST(UdpLink, CarriesDatagramsBothWaysFromOneSocket) {
  base::Loop loop;
  Talker in(loop, opened(loop, "udpin://127.0.0.1:0"));
  auto const url = "udpout://127.0.0.1:" + std::to_string(port_of(in.link()));
  Talker first(loop, opened(loop, url));
  Talker second(loop, opened(loop, url));
  EXPECT_TRUE(in.link().standing_peers().empty());

  EXPECT_TRUE(first.say("one"));
  ASSERT_TRUE(loop.run_until_done(in.hears("one")));
  auto const first_peer = in.from();
  EXPECT_TRUE(second.say("two"));
  ASSERT_TRUE(loop.run_until_done(in.hears("two")));
  EXPECT_NE(in.from(), first_peer);
  EXPECT_EQ(in.link().peer_name(first_peer).rfind("127.0.0.1:", 0), 0u);

  EXPECT_TRUE(in.say("to the first", first_peer));
  EXPECT_TRUE(loop.run_until_done(first.hears("to the first"))) << "a connected socket only hears the listening one";
  EXPECT_EQ(second.heard(), "");
  EXPECT_EQ(in.link().counters().chunks_received, 2u);
  EXPECT_EQ(in.link().counters().bytes_received, 6u);
}

TEST(UdpLink, GoesOnWhenNobodyListensYet) {
  base::Loop loop;
  auto placeholder = opened(loop, "udpin://127.0.0.1:0");
  auto const port = std::to_string(port_of(*placeholder));
  placeholder.reset();
  Talker out(loop, opened(loop, "udpout://127.0.0.1:" + port));
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(out.say("into the void"));
  Talker in(loop, opened(loop, "udpin://127.0.0.1:" + port));
  EXPECT_TRUE(out.say("hello"));
  EXPECT_TRUE(loop.run_until_done(in.hears("hello")));
}

TEST(UdpLink, KeepsWhatIsQueuedTogetherUntilItIsFlushed) {
  base::Loop loop;
  auto const in = opened(loop, "udpin://127.0.0.1:0");
  auto const out = opened(loop, "udpout://127.0.0.1:" + std::to_string(port_of(*in)));
  auto const there = out->standing_peers().front();
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(out->send(there, bytes(std::to_string(i) + " "), Urgency::batched));
  EXPECT_EQ(out->counters().chunks_sent, 64u) << "a batch goes out when it is full";
  out->flush();
  EXPECT_EQ(out->counters().chunks_sent, 100u);

  std::string heard;
  std::string expected;
  std::vector<int> batches{0};
  base::Notifier arrived(loop);
  in->on_drained([&] {
    batches.push_back(0);
    arrived.notify_all();
  });
  in->start([&](Peer, Bytes data) {
    heard += std::string(data.begin(), data.end());
    ++batches.back();
  });
  for (int i = 0; i < 100; ++i) expected += std::to_string(i) + " ";
  EXPECT_TRUE(loop.run_until_done(arrived.wait_for([&] { return heard.size() >= expected.size(); }, 5s)));
  EXPECT_EQ(heard, expected) << "in the order in which they were queued";
  EXPECT_EQ(batches, (std::vector{64, 36, 0}));
}

TEST(UdpLink, SendsAfterWhatWasQueuedBefore) {
  base::Loop loop;
  Talker in(loop, opened(loop, "udpin://127.0.0.1:0"));
  auto const out = opened(loop, "udpout://127.0.0.1:" + std::to_string(port_of(in.link())));
  auto const there = out->standing_peers().front();
  EXPECT_TRUE(out->send(there, bytes("first "), Urgency::batched));
  EXPECT_TRUE(out->send(there, bytes("second")));
  EXPECT_TRUE(loop.run_until_done(in.hears("first second")));
}

TEST(UdpLink, CountsWhatTheOperatingSystemRefuses) {
  base::Loop loop;
  Talker in(loop, opened(loop, "udpin://127.0.0.1:0"));
  auto const out = opened(loop, "udpout://127.0.0.1:" + std::to_string(port_of(in.link())));
  auto const there = out->standing_peers().front();
  std::vector<std::uint8_t> const too_long(70'000);
  EXPECT_TRUE(out->send(there, bytes("before "), Urgency::batched));
  EXPECT_TRUE(out->send(there, too_long, Urgency::batched));
  EXPECT_TRUE(out->send(there, bytes("after"), Urgency::batched));
  out->flush();
  EXPECT_EQ(out->counters().chunks_sent, 2u);
  EXPECT_EQ(out->counters().send_failures, 1u);
  EXPECT_NE(out->last_error(), "");
  EXPECT_TRUE(loop.run_until_done(in.hears("before after")));
  EXPECT_FALSE(out->send(there, too_long));
}

TEST(UdpLink, CountsWhatTheKernelThrewAway) {
  base::Loop loop;
  auto const in = opened(loop, "udpin://127.0.0.1:0");
  auto const out = opened(loop, "udpout://127.0.0.1:" + std::to_string(port_of(*in)));
  auto const there = out->standing_peers().front();
  EXPECT_EQ(in->counters().overruns, 0u);
  std::vector<std::uint8_t> const large(60'000);
  int constexpr sent = 1000;  // 60 MB: more than any buffer that was asked for
  for (int i = 0; i < sent; ++i) out->send(there, large);
  auto const lost = in->counters().overruns;
  EXPECT_GT(lost, 0u);

  base::Notifier arrived(loop);
  in->on_drained([&] { arrived.notify_all(); });
  in->start([](Peer, Bytes) {});
  EXPECT_TRUE(loop.run_until_done(
      arrived.wait_for([&] { return in->counters().chunks_received + lost == out->counters().chunks_sent; }, 5s)))
      << "every datagram is either received or counted as lost";
}

TEST(UdpLink, CallsToEverybodyUntilOneAnswers) {
  base::Loop loop;
  Talker listener(loop, opened(loop, "udpin://0.0.0.0:0"));
  Talker caller(loop, opened(loop, "udpbcast://127.255.255.255:" + std::to_string(port_of(listener.link()))));
  auto const everybody = caller.link().standing_peers().front();
  EXPECT_TRUE(caller.say("anybody there?"));
  ASSERT_TRUE(loop.run_until_done(listener.hears("anybody there?")));
  EXPECT_TRUE(listener.answer("here"));
  ASSERT_TRUE(loop.run_until_done(caller.hears("here")));
  auto const there = caller.link().standing_peers();
  ASSERT_EQ(there.size(), 1u);
  EXPECT_NE(there.front(), everybody);
  EXPECT_EQ(caller.link().peer_name(there.front()), "127.0.0.1:" + std::to_string(port_of(listener.link())));
  EXPECT_TRUE(caller.say("good"));
  EXPECT_TRUE(loop.run_until_done(listener.hears("good")));
}

TEST(UdpLink, FindsAHostByItsName) {
  base::Loop loop;
  Talker in(loop, opened(loop, "udpin://127.0.0.1:0"));
  Talker out(loop, opened(loop, "udpout://localhost:" + std::to_string(port_of(in.link()))));
  ASSERT_TRUE(loop.run_until_done(until_standing(loop, out.link(), true)));
  EXPECT_EQ(out.link().state(), LinkState::open);
  EXPECT_TRUE(out.say("hello"));
  ASSERT_TRUE(loop.run_until_done(in.hears("hello")));
  EXPECT_TRUE(in.answer("good day"));
  EXPECT_TRUE(loop.run_until_done(out.hears("good day")));
}

base::Task<void> until_it_says_why(base::Loop& loop, ByteLink& link) {
  for (int i = 0; i < 500 && link.last_error().empty(); ++i) co_await loop.sleep(10ms);
}

TEST(UdpLink, KeepsLookingForAHostThatIsNotKnownYet) {
  base::Loop loop;
  auto const name = std::string(64, 'x');  // longer than a name can be: no server has to be asked
  Talker out(loop, opened(loop, "udpout://" + name + ":14550"));
  EXPECT_FALSE(out.say("hello", Peer{}));
  EXPECT_EQ(out.link().counters().send_failures, 1u);
  loop.run_until_done(until_it_says_why(loop, out.link()));
  EXPECT_EQ(out.link().last_error(), "cannot find host '" + name + "'");
  EXPECT_EQ(out.link().state(), LinkState::opening);
}

/// Exit codes of the child below.
enum class Netless { works = 0, opens_not, says_not_why, reaches_not, cannot_try };

/// In a network of its own, where at first not even loopback is up: a companion computer that has just been switched
/// on.
Netless open_before_there_is_a_network() {
  if (unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) return Netless::cannot_try;
  base::Loop loop(base::Loop::Pace{.speedup = 20.0});
  auto link = open(loop, parse_url("udpout://127.0.0.1:14550").value());
  if (!link) return Netless::opens_not;
  Talker out(loop, std::move(*link));
  loop.run_until_done(until_it_says_why(loop, out.link()));
  if (out.link().last_error() != "127.0.0.1:14550: Network is unreachable") return Netless::says_not_why;
  int const any = socket(AF_INET, SOCK_DGRAM, 0);
  ifreq loopback{};
  std::string("lo").copy(loopback.ifr_name, sizeof(loopback.ifr_name) - 1);
  loopback.ifr_flags = IFF_UP;
  if (ioctl(any, SIOCSIFFLAGS, &loopback) != 0) return Netless::cannot_try;
  ::close(any);
  bool const is_there = loop.run_until_done(until_standing(loop, out.link(), true));
  return is_there && out.link().last_error().empty() ? Netless::works : Netless::reaches_not;
}

TEST(UdpLink, WaitsForANetworkThatIsNotThereYet) {
  auto const child = fork();
  if (child == 0) _exit(static_cast<int>(open_before_there_is_a_network()));
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  if (static_cast<Netless>(WEXITSTATUS(status)) == Netless::cannot_try) GTEST_SKIP() << "no network of its own here";
  EXPECT_EQ(WEXITSTATUS(status), static_cast<int>(Netless::works));
}

TEST(UdpLink, RefusesABroadcastAddressAtOnce) {
  base::Loop loop;
  auto const link = open(loop, parse_url("udpout://255.255.255.255:14550").value());
  ASSERT_FALSE(link) << "no waiting makes that one right";
}

TEST(UdpLink, NamesThePortThatIsTaken) {
  base::Loop loop;
  auto const first = opened(loop, "udpin://127.0.0.1:0");
  auto const taken = open(loop, parse_url(first->name()).value());
  ASSERT_FALSE(taken);
  EXPECT_EQ(taken.error().kind, base::ErrorKind::io);
  EXPECT_NE(taken.error().message.find("port " + std::to_string(port_of(*first)) + " is already in use"),
            std::string::npos);
  EXPECT_NE(taken.error().hint.find("another port: udpin://127.0.0.1:"), std::string::npos);
}

TEST(UdpLink, RefusesAnAddressThatIsNotOurs) {
  base::Loop loop;
  auto const link = open(loop, {Transport::udp_in, "192.0.2.1", 14550});
  ASSERT_FALSE(link);
  EXPECT_NE(link.error().message.find("not an address of this machine"), std::string::npos);
}

TEST(SerialLink, TalksToATerminalLineAndWaitsForOneThatIsGone) {
  base::Loop loop(base::Loop::Pace{.speedup = 20.0});
  int const master = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
  ASSERT_GE(master, 0);
  ASSERT_EQ(grantpt(master), 0);
  ASSERT_EQ(unlockpt(master), 0);
  Talker serial(loop, opened(loop, std::string("serial://") + ptsname(master) + ":57600"));
  ASSERT_TRUE(loop.run_until_done(until_standing(loop, serial.link(), true)));

  ASSERT_EQ(write(master, "\xFD\n\r*", 4), 4);
  EXPECT_TRUE(loop.run_until_done(serial.hears("\xFD\n\r*"))) << "nothing is translated";
  EXPECT_TRUE(serial.say("out"));
  char buffer[8] = {};
  EXPECT_EQ(read(master, buffer, sizeof(buffer)), 3);

  close(master);
  ASSERT_TRUE(loop.run_until_done(until_standing(loop, serial.link(), false)));
  EXPECT_EQ(serial.link().state(), LinkState::opening);
  EXPECT_FALSE(serial.say("gone"));
}

/// A device that can be plugged in and out: the far end of a pseudo-terminal behind a link, as udev makes them.
class Plug {
 public:
  Plug() : place_(std::filesystem::temp_directory_path() / fmt::format("lapwing-plug-{}", getpid())) {}
  Plug(Plug const&) = delete;
  Plug& operator=(Plug const&) = delete;
  ~Plug() { pull(); }
  void plug_in() {
    master_ = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
    ASSERT_GE(master_, 0);
    ASSERT_EQ(grantpt(master_), 0);
    ASSERT_EQ(unlockpt(master_), 0);
    std::filesystem::create_symlink(ptsname(master_), place_);
  }
  void pull() {
    std::error_code ignored;
    std::filesystem::remove(place_, ignored);
    if (master_ >= 0) close(std::exchange(master_, -1));
  }
  [[nodiscard]] std::string url() const { return fmt::format("serial://{}:57600", place_.string()); }
  [[nodiscard]] int master() const { return master_; }

 private:
  std::filesystem::path place_;
  int master_ = -1;
};

TEST(SerialLink, ComesBackWithItsDevice) {
  base::Loop loop(base::Loop::Pace{.speedup = 20.0});
  Plug plug;
  Talker serial(loop, opened(loop, plug.url()));
  EXPECT_NE(serial.link().last_error().find("is it plugged in?"), std::string::npos) << serial.link().last_error();
  for (std::string const word : {"first", "second"}) {
    plug.plug_in();
    ASSERT_TRUE(loop.run_until_done(until_standing(loop, serial.link(), true))) << serial.link().last_error();
    ASSERT_EQ(write(plug.master(), word.data(), word.size()), static_cast<ssize_t>(word.size()));
    EXPECT_TRUE(loop.run_until_done(serial.hears(word)));
    plug.pull();
    ASSERT_TRUE(loop.run_until_done(until_standing(loop, serial.link(), false)));
    EXPECT_EQ(serial.link().counters().bytes_queued, 0u);
  }
}

TEST(SerialLink, NamesWhatIsWrongWithADevice) {
  base::Loop loop(base::Loop::Pace{.unpaced = true});
  Talker file(loop, opened(loop, "serial:///dev/null:57600"));
  EXPECT_EQ(file.link().last_error(), "/dev/null is no serial device");
}

TEST(SerialLink, RefusesABaudRateThatNoLineHas) {
  base::Loop loop;
  auto const link = open(loop, {Transport::serial, "/dev/ttyUSB0", 12345});
  ASSERT_FALSE(link);
  EXPECT_NE(link.error().hint.find("57600"), std::string::npos);
}

TEST(SerialLink, KeepsTryingADeviceThatIsNotThere) {
  base::Loop loop(base::Loop::Pace{.unpaced = true});
  Talker serial(loop, opened(loop, "serial:///dev/no-such-device:57600"));
  EXPECT_EQ(serial.link().state(), LinkState::opening);
  EXPECT_NE(serial.link().last_error().find("/dev/no-such-device"), std::string::npos);
}

TEST(PipeLink, KeepsClientsApartAndForgetsThoseThatLeft) {
  base::Loop loop(base::Loop::Pace{.unpaced = true});
  PipeHub hub(loop);
  Talker server(loop, hub.take_server());
  auto first = std::make_unique<Talker>(loop, hub.connect());
  Talker second(loop, hub.connect());
  EXPECT_TRUE(first->say("one"));
  ASSERT_TRUE(loop.run_until_done(server.hears("one")));
  auto const peer = server.from();
  EXPECT_TRUE(server.answer("hi"));
  ASSERT_TRUE(loop.run_until_done(first->hears("hi")));
  EXPECT_EQ(second.heard(), "");
  first.reset();
  EXPECT_FALSE(server.say("gone", peer));
}

TEST(ImpairedLink, LosesDelaysAndDuplicatesByItsSeed) {
  std::string heard[2];
  for (auto& all : heard) {
    base::Loop loop(base::Loop::Pace{.unpaced = true});
    auto pipe = make_pipe(loop);
    Talker b(loop, std::move(pipe.a));
    Talker a(loop, impair(loop, std::move(pipe.b), {.loss = 0.3, .duplication = 0.1, .delay = 200ms, .seed = 5}));
    for (int i = 0; i < 1000; ++i) EXPECT_TRUE(a.say(std::to_string(i) + " "));
    loop.run_until_done(pass(loop, 199ms));
    EXPECT_EQ(b.chunks(), 0);
    loop.run_until_done(pass(loop, 10ms));
    EXPECT_NEAR(b.chunks(), 1000 * 0.7 * 1.1, 60);
    all = b.heard();
  }
  EXPECT_EQ(heard[0], heard[1]);
}

TEST(ImpairedLink, ImpairsWhatArrivesToo) {
  base::Loop loop(base::Loop::Pace{.unpaced = true});
  auto pipe = make_pipe(loop);
  Talker server(loop, std::move(pipe.a));
  Talker client(loop, impair(loop, std::move(pipe.b), {.loss = 1.0}));
  EXPECT_TRUE(client.say("never arrives"));
  loop.run_until_done(pass(loop, 1s));
  EXPECT_EQ(server.chunks(), 0);
}

}  // namespace
}  // namespace lapwing::link
