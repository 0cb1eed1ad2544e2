#include <fcntl.h>
#include <grp.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/async/notifier.hpp"
#include "base/async/scope.hpp"
#include "link/internal/links.hpp"
#include "link/internal/stream.hpp"

namespace lapwing::link::internal {

namespace {

using namespace std::chrono_literals;

base::Duration constexpr retry_period = 1s;

struct Baud {
  std::uint32_t rate;
  speed_t speed;
};
auto constexpr bauds = std::to_array<Baud>({{9600, B9600},
                                            {19200, B19200},
                                            {38400, B38400},
                                            {57600, B57600},
                                            {115200, B115200},
                                            {230400, B230400},
                                            {460800, B460800},
                                            {500000, B500000},
                                            {921600, B921600},
                                            {1000000, B1000000},
                                            {1500000, B1500000},
                                            {2000000, B2000000}});

std::optional<speed_t> speed_of(std::uint32_t rate) {
  for (auto const& baud : bauds)
    if (baud.rate == rate) return baud.speed;
  return std::nullopt;
}

/// 8 data bits, no parity, 1 stop bit, nothing translated.
bool make_raw(int descriptor, speed_t speed, bool flow_control) {
  termios settings{};
  if (tcgetattr(descriptor, &settings) != 0) return false;
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(CRTSCTS | CSTOPB);
  if (flow_control) settings.c_cflag |= CRTSCTS;
  settings.c_cc[VMIN] = 1;  // so that a read of nothing means hang-up
  settings.c_cc[VTIME] = 0;
  return cfsetspeed(&settings, speed) == 0 && tcsetattr(descriptor, TCSANOW, &settings) == 0;
}

/// What to do about it, as far as that can be told.
std::string why_not_open(std::string const& device, int system_error) {
  if (system_error == EACCES) {
    struct stat entry{};
    auto const* group = ::stat(device.c_str(), &entry) == 0 ? getgrgid(entry.st_gid) : nullptr;
    auto const name = group ? std::string(group->gr_name) : std::string("dialout");
    return fmt::format(
        "no permission for {}: this user is not in the group {} (sudo usermod -aG {} $USER, then log in again)", device,
        name, name);
  }
  if (system_error == EBUSY)
    return fmt::format("{}: another program has it open (ModemManager? another ground station?)", device);
  if (system_error == ENOTTY) return fmt::format("{} is no serial device", device);
  if (system_error == ENOENT) return fmt::format("{} is not there (yet): is it plugged in?", device);
  return fmt::format("{}: {}", device, std::strerror(system_error));
}

class SerialLink final : public ByteLink {
 public:
  SerialLink(base::Loop& loop, Url url, speed_t speed)
      : loop_(loop), url_(std::move(url)), speed_(speed), ended_(loop), scope_(loop) {}

  [[nodiscard]] std::string name() const override { return to_string(url_); }
  [[nodiscard]] std::string peer_name(Peer) const override { return url_.host; }
  [[nodiscard]] LinkState state() const override { return open_ ? LinkState::open : LinkState::opening; }
  [[nodiscard]] std::string last_error() const override { return open_ ? std::string() : last_error_; }
  [[nodiscard]] LinkCounters counters() const override { return counters_; }
  /// A byte takes ten bits: one to start, one to stop.
  [[nodiscard]] std::optional<double> bytes_per_s() const override { return url_.port_or_baud / 10.0; }
  [[nodiscard]] std::vector<Peer> standing_peers() const override {
    return open_ ? std::vector<Peer>{Peer{}} : std::vector<Peer>{};
  }
  void start(Receive receive) override {
    receive_ = std::move(receive);
    scope_.spawn(keep_open());
  }
  bool send(Peer, Bytes bytes, Urgency urgency) override {
    if (open_) return stream_->send(bytes, urgency);
    ++counters_.send_failures;
    return false;
  }

 private:
  base::Task<void> keep_open() {
    for (;;) {
      open_device();
      while (open_) co_await ended_.wait();
      stream_.reset();
      co_await loop_.sleep(retry_period);
    }
  }

  void open_device() {
    int const descriptor = ::open(url_.host.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    // For us alone: a second program on the line would take every other byte.
    if (descriptor < 0 || !make_raw(descriptor, speed_, url_.flow_control) || ioctl(descriptor, TIOCEXCL) != 0) {
      last_error_ = why_not_open(url_.host, errno);
      if (descriptor >= 0) ::close(descriptor);
      return;
    }
    open_ = true;
    stream_ = std::make_unique<Stream>(
        loop_, Stream::End{descriptor, bytes_per_s()}, counters_,
        [this](Bytes bytes) {
          receive_(Peer{}, bytes);
          tell_drained();
        },
        [this](std::string why) {
          last_error_ = fmt::format("{}: {}", url_.host, why);
          open_ = false;
          ended_.notify_all();
        });
  }

  base::Loop& loop_;
  Url url_;
  speed_t speed_;
  Receive receive_;
  LinkCounters counters_;
  std::unique_ptr<Stream> stream_;
  bool open_ = false;
  std::string last_error_;
  base::Notifier ended_;
  base::Scope scope_;
};

}  // namespace

base::Result<std::unique_ptr<ByteLink>> open_serial(base::Loop& loop, Url const& url) {
  auto const speed = speed_of(url.port_or_baud);
  if (speed) return std::make_unique<SerialLink>(loop, url, *speed);
  std::vector<std::uint32_t> rates;
  for (auto const& baud : bauds) rates.push_back(baud.rate);
  return base::fail(base::ErrorKind::invalid_input,
                    fmt::format("link {}: a serial line cannot run at {} baud", to_string(url), url.port_or_baud),
                    fmt::format("use one of {}", fmt::join(rates, ", ")));
}

}  // namespace lapwing::link::internal
