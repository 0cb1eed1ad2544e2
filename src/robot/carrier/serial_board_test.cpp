// The host's serial link and the board's program with a real terminal driver between them, in the wall's time.
#include <fcntl.h>
#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): posix_openpt is POSIX's, not C++'s
#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/async/loop.hpp"
#include "base/async/scope.hpp"
#include "firmware/program.hpp"
#include "firmware/testing/rig.hpp"
#include "link/byte_link.hpp"
#include "robot/carrier/carrier_client.hpp"

namespace lapwing::robot {
namespace {

using namespace std::chrono_literals;
using firmware::testing::office_robot;
using firmware::testing::WheelBody;

/// A microcontroller on a plug: the master side of a pseudo-terminal.
class PluggedBoard {
 public:
  explicit PluggedBoard(base::Loop& loop) : loop_(loop), started_(loop.now()), scope_(loop) {
    terminal_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (terminal_ < 0 || ::grantpt(terminal_) != 0 || ::unlockpt(terminal_) != 0) return;
    std::array<char, 128> name{};
    if (::ptsname_r(terminal_, name.data(), name.size()) == 0) device_ = name.data();
    scope_.spawn(run());
  }
  ~PluggedBoard() {
    if (terminal_ >= 0) ::close(terminal_);
  }
  PluggedBoard(PluggedBoard const&) = delete;
  PluggedBoard& operator=(PluggedBoard const&) = delete;

  [[nodiscard]] std::string const& device() const { return device_; }
  [[nodiscard]] WheelBody const& body() const { return body_; }

 private:
  base::Task<> run() {
    for (auto then = loop_.now();;) {
      co_await loop_.sleep(10ms);
      // The body lives in the loop's time, however late this turn came.
      for (; then + 10ms <= loop_.now(); then += 10ms) {
        read();
        body_.advance(10ms);
        program_.step(std::chrono::duration_cast<firmware::Time>(then + 10ms - started_));
      }
      write();
    }
  }
  void read() {
    std::array<std::uint8_t, 256> bytes{};
    auto const count = ::read(terminal_, bytes.data(), bytes.size());
    for (ssize_t i = 0; i < count; ++i) body_.to_board.push_back(bytes[static_cast<std::size_t>(i)]);
  }
  void write() {
    auto const bytes = std::exchange(body_.from_board, {});
    // What a driver does not take is lost, as on a wire that nobody reads.
    [[maybe_unused]] auto const taken = ::write(terminal_, bytes.data(), bytes.size());
  }

  base::Loop& loop_;
  base::TimePoint started_;
  int terminal_ = -1;
  std::string device_;
  WheelBody body_{office_robot(), {}};
  firmware::Program program_{body_, office_robot()};
  base::Scope scope_;
};

/// Where a robot's plug always is, whichever device is behind it: what udev makes of a serial number.
class Socket {
 public:
  Socket() : path_(std::filesystem::temp_directory_path() / fmt::format("lapwing-robot-{}", ::getpid())) {}
  ~Socket() { unplug(); }
  Socket(Socket const&) = delete;
  Socket& operator=(Socket const&) = delete;

  void plug(PluggedBoard const& board) { std::filesystem::create_symlink(board.device(), path_); }
  void unplug() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  [[nodiscard]] std::string url() const { return fmt::format("serial://{}:115200", path_.string()); }

 private:
  std::filesystem::path path_;
};

base::Task<> sleep(base::Loop& loop, base::Duration time) {
  co_await loop.sleep(time);
}

TEST(SerialBoard, IsDrivenKilledUnpluggedAndFoundAgainOverARealTerminal) {
  base::Loop loop(base::Loop::Pace{.speedup = 5});
  auto board = std::make_unique<PluggedBoard>(loop);
  if (board->device().empty()) GTEST_SKIP() << "this machine gives no pseudo-terminal";
  Socket socket;
  socket.plug(*board);
  auto const url = link::parse_url(socket.url());
  ASSERT_TRUE(url);
  auto const link = link::open(loop, *url);
  ASSERT_TRUE(link);
  CarrierClient client(loop, **link);
  int began_anew = 0;
  client.start({.here = [&](auto const&, bool anew) { began_anew += anew ? 1 : 0; },
                .away = {},
                .readings = {},
                .scan = {},
                .log = {}});

  auto const body = loop.run_until_done(client.description(10s));
  ASSERT_TRUE(body) << body.error().message << ": " << body.error().hint;
  EXPECT_EQ(body->sonar_count, 5);
  // Who joins a line in the middle of a frame throws that away, and nothing after it.
  auto damaged = client.status().frames.damaged;
  auto const drive = loop.run_until_done(client.carry_out(
      firmware::Drive{.number = 0, .speed_m_s = 0.16F, .by = firmware::Drive::By::heading, .turn = 0.2F}, 10s));
  EXPECT_TRUE(drive) << drive.error().message;
  EXPECT_GT(board->body().x_m(), 0.05F);

  client.kill();
  loop.run_until_done(sleep(loop, 1s));
  EXPECT_TRUE(client.status().is_killed);
  EXPECT_EQ(board->body().left_output(), 0.0F);

  EXPECT_EQ(client.status().frames.damaged, damaged);
  EXPECT_EQ(client.status().frames.missed, 0U);

  socket.unplug();
  board.reset();
  loop.run_until_done(sleep(loop, 3s));
  EXPECT_FALSE(client.status().is_here);
  EXPECT_NE(client.status().why_away.find("lapwing-robot"), std::string::npos) << client.status().why_away;
  EXPECT_FALSE(client.begin(firmware::Stop{}));

  board = std::make_unique<PluggedBoard>(loop);
  socket.plug(*board);
  ASSERT_TRUE(loop.run_until_done(client.description(10s)));
  loop.run_until_done(sleep(loop, 1s));
  EXPECT_EQ(began_anew, 1);
  damaged = client.status().frames.damaged;
  // Killed it stays, also for a board that was started anew.
  EXPECT_TRUE(client.status().is_killed);
  client.release();
  loop.run_until_done(sleep(loop, 1s));
  auto const turn = loop.run_until_done(client.carry_out(firmware::Turn{.number = 0, .heading_rad = 1}, 10s));
  EXPECT_TRUE(turn) << turn.error().message;
  EXPECT_NEAR(board->body().heading_rad(), 1, 0.0175F);
  EXPECT_EQ(client.status().frames.damaged, damaged);
}

}  // namespace
}  // namespace lapwing::robot
