#include <utility>  // before Asio: Boost 1.74 uses std::exchange without including it

#include "base/async/child_program.hpp"

#include <fcntl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>

#include "base/async/internal/spawn_child.hpp"
#include "base/async/notifier.hpp"

namespace lapwing::base {

namespace {

using boost::asio::posix::stream_descriptor;
using Code = boost::system::error_code;

constexpr std::size_t most_kept_bytes = 16 * 1024;

/// Both ends, closed with this unless they were given away.
struct Pipe {
  int read_end = -1;
  int write_end = -1;
  bool open() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return false;
    read_end = ends[0];
    write_end = ends[1];
    return true;
  }
  int give_read_end() { return std::exchange(read_end, -1); }
  Pipe() = default;
  Pipe(Pipe const&) = delete;
  Pipe& operator=(Pipe const&) = delete;
  ~Pipe() {
    if (read_end >= 0) ::close(read_end);
    if (write_end >= 0) ::close(write_end);
  }
};

Error system_error(std::string_view what) {
  return {.kind = ErrorKind::io, .message = fmt::format("{}: {}", what, std::strerror(errno))};
}

/// One that runs. Its end is waited for on a descriptor of the process, its output on two pipes.
class Running {
 public:
  Running(Loop& loop, pid_t pid, int process, int out, int errors, std::function<void(std::string_view)> heard)
      : pid_(pid),
        process_(loop.io(), process),
        out_{stream_descriptor(loop.io(), out)},
        errors_{stream_descriptor(loop.io(), errors)},
        deadline_(loop.io()),
        heard_(std::move(heard)),
        changed_(loop) {}
  Running(Running const&) = delete;
  Running& operator=(Running const&) = delete;
  ~Running() {
    if (!status_) end();
  }

  void start(std::chrono::seconds longest) {
    process_.async_wait(stream_descriptor::wait_read, guarded([this] { reap(0); }));
    if (longest.count() > 0) {
      deadline_.expires_after(longest);
      deadline_.async_wait(guarded([this] {
        is_late_ = true;
        ::kill(-pid_, SIGKILL);
      }));
    }
    read(out_, [this] { tell_lines(); });
    read(errors_, [this] {
      if (errors_.text.size() > most_kept_bytes) errors_.text.erase(0, errors_.text.size() - most_kept_bytes);
    });
  }

  [[nodiscard]] Task<> ended() {
    while (!status_ || out_.is_open || errors_.is_open) co_await changed_.wait();
  }
  [[nodiscard]] bool is_late() const { return is_late_; }
  /// Once it has ended.
  [[nodiscard]] ChildOutcome outcome() {
    constexpr int by_signal = 128;
    int const code = WIFEXITED(*status_) ? WEXITSTATUS(*status_) : by_signal + WTERMSIG(*status_);
    return {.exit_code = code, .errors = std::move(errors_.text)};
  }

 private:
  struct Output {
    stream_descriptor from;
    std::array<char, 4096> piece = {};
    std::string text = {};
    bool is_open = true;
  };

  /// What is called back after this has gone, or in vain, does nothing.
  [[nodiscard]] std::function<void(Code)> guarded(std::function<void()> function) const {
    return [function = std::move(function), alive = std::weak_ptr(alive_)](Code error) {
      if (!alive.expired() && !error) function();
    };
  }

  void read(Output& output, std::function<void()> take) {
    output.from.async_read_some(
        boost::asio::buffer(output.piece),
        [this, &output, take = std::move(take), alive = std::weak_ptr(alive_)](Code error, std::size_t count) mutable {
          if (alive.expired()) return;
          if (error) {
            output.is_open = false;
            changed_.notify_all();
            return;
          }
          output.text.append(output.piece.data(), count);
          take();
          read(output, std::move(take));
        });
  }

  void tell_lines() {
    for (auto end = out_.text.find('\n'); end != std::string::npos; end = out_.text.find('\n')) {
      auto const line = out_.text.substr(0, end);
      out_.text.erase(0, end + 1);
      if (heard_) heard_(line);
    }
    if (out_.text.size() > most_kept_bytes) out_.text.clear();
  }

  void reap(int options) {
    int status = 0;
    if (::waitpid(pid_, &status, options) != pid_) return;
    status_ = status;
    Code ignored;  // of one that does not fail, which would throw without it
    deadline_.cancel(ignored);
    changed_.notify_all();
  }

  void end() {
    ::kill(-pid_, SIGKILL);
    reap(0);  // at once: nothing survives that signal
  }

  pid_t pid_;
  stream_descriptor process_;
  Output out_;
  Output errors_;
  boost::asio::steady_timer deadline_;
  std::function<void(std::string_view)> heard_;
  std::optional<int> status_;
  bool is_late_ = false;
  Notifier changed_;
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
};

}  // namespace

Task<Result<ChildOutcome>> run_child(Loop& loop, ChildProgram child, std::function<void(std::string_view line)> heard) {
  if (::access(child.program.c_str(), X_OK) != 0)
    co_return fail(ErrorKind::not_found, fmt::format("{} is not there", child.program.string()));
  std::unique_ptr<Running> running;
  {
    Pipe out;
    Pipe errors;
    pid_t pid = 0;
    if (!out.open() || !errors.open()) co_return std::unexpected(system_error("no pipe to another program"));
    internal::ChildFiles const files{.out = out.write_end, .errors = errors.write_end};
    if (int const error = internal::spawn_child(child, files, pid); error != 0)
      co_return fail(ErrorKind::io, fmt::format("{} does not start: {}", child.program.string(), std::strerror(error)));
    auto const process = static_cast<int>(::syscall(SYS_pidfd_open, pid, 0));
    if (process < 0) {
      auto const error = system_error("a program that was started cannot be waited for");
      ::kill(-pid, SIGKILL);
      (void)::waitpid(pid, nullptr, 0);
      co_return std::unexpected(error);
    }
    running =
        std::make_unique<Running>(loop, pid, process, out.give_read_end(), errors.give_read_end(), std::move(heard));
  }
  running->start(child.longest);
  co_await running->ended();
  if (running->is_late())
    co_return fail(ErrorKind::timed_out,
                   fmt::format("{} took longer than {} s", child.program.filename().string(), child.longest.count()));
  co_return running->outcome();
}

}  // namespace lapwing::base
