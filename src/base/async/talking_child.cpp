#include "base/async/talking_child.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "base/async/internal/spawn_child.hpp"
#include "base/text/printable.hpp"

namespace lapwing::base {

namespace {

constexpr std::size_t most_kept_bytes = 4096;

std::unexpected<Error> system_error(std::string_view what) {
  return fail(ErrorKind::io, fmt::format("{}: {}", what, std::strerror(errno)));
}

/// Milliseconds for poll(2), rounded up, so that it does not return just before.
int left_until(TalkingChild::Deadline deadline) {
  auto const left = std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now()).count();
  return static_cast<int>(std::clamp<std::int64_t>(left, 0, 1'000'000));
}

/// The end of a text, on one line.
std::string on_one_line(std::string_view text) {
  constexpr std::size_t longest = 300;
  std::string line;
  for (char const letter : text) {
    bool const is_space = letter == ' ' || letter == '\n' || letter == '\r' || letter == '\t';
    if (!is_space) {
      line += letter;
    } else if (!line.empty() && line.back() != ' ') {
      line += ' ';
    }
  }
  if (line.ends_with(' ')) line.pop_back();
  if (line.size() > longest) line.erase(0, line.size() - longest);
  return line;
}

}  // namespace

Result<std::unique_ptr<TalkingChild>> TalkingChild::start(ChildProgram const& program, int stop) {
  auto const name = program.program.filename().string();
  if (::access(program.program.c_str(), X_OK) != 0)
    return fail(ErrorKind::not_found, fmt::format("{} is not there", program.program.string()));
  // A socket and not two pipes: what is sent to one that has ended is an error there and no signal.
  std::array<int, 2> talk{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, talk.data()) != 0)
    return system_error("no way to another program");
  Descriptor ours(talk[0]);
  Descriptor const theirs(talk[1]);
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) return system_error("no pipe to another program");
  Descriptor errors(pipe[0]);
  Descriptor const their_errors(pipe[1]);
  pid_t pid = 0;
  internal::ChildFiles const files{.in = theirs.get(), .out = theirs.get(), .errors = their_errors.get()};
  if (int const error = internal::spawn_child(program, files, pid); error != 0)
    return fail(ErrorKind::io, fmt::format("{} does not start: {}", name, std::strerror(error)));
  return std::unique_ptr<TalkingChild>(new TalkingChild(name, pid, std::move(ours), std::move(errors), stop));
}

TalkingChild::~TalkingChild() {
  ::kill(-pid_, SIGKILL);
  (void)::waitpid(pid_, nullptr, 0);  // at once: nothing survives that signal
}

Result<> TalkingChild::send(std::string_view bytes, Deadline deadline) {
  while (!bytes.empty()) {
    if (auto may = wait_for(POLLOUT, deadline); !may) return may;
    auto const sent = ::send(talk_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (sent < 0) return ended();
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return {};
}

Result<std::size_t> TalkingChild::receive(std::span<char> into, Deadline deadline) {
  for (;;) {
    if (auto may = wait_for(POLLIN, deadline); !may) return std::unexpected(may.error());
    auto const count = ::recv(talk_.get(), into.data(), into.size(), MSG_DONTWAIT);
    if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (count <= 0) return ended();
    return static_cast<std::size_t>(count);
  }
}

Result<> TalkingChild::wait_for(short events, Deadline deadline) {
  for (;;) {
    std::array<pollfd, 3> files{{{.fd = talk_.get(), .events = events, .revents = 0},
                                 {.fd = stop_, .events = POLLIN, .revents = 0},
                                 {.fd = errors_are_open_ ? errors_.get() : -1, .events = POLLIN, .revents = 0}}};
    int const ready = ::poll(files.data(), files.size(), left_until(deadline));
    if (ready < 0 && errno != EINTR) return system_error("another program cannot be waited for");
    if (ready > 0) {
      if (files[1].revents != 0) return fail(ErrorKind::cancelled, fmt::format("nobody waits for {}", name_));
      if (files[2].revents != 0) errors_are_open_ = hear_errors();
      if (files[0].revents != 0) return {};
    }
    if (std::chrono::steady_clock::now() >= deadline)
      return fail(ErrorKind::timed_out, fmt::format("{} does not answer", name_));
  }
}

bool TalkingChild::hear_errors() {
  std::array<char, most_kept_bytes> piece{};
  auto const count = ::read(errors_.get(), piece.data(), piece.size());
  if (count <= 0) return count < 0 && errno == EINTR;
  last_words_.append(piece.data(), static_cast<std::size_t>(count));
  if (last_words_.size() > most_kept_bytes) last_words_.erase(0, last_words_.size() - most_kept_bytes);
  return true;
}

std::unexpected<Error> TalkingChild::ended() {
  // What it said before its end lies in the pipe, which whoever it has started may still hold open: no waiting here.
  pollfd file{.fd = errors_.get(), .events = POLLIN, .revents = 0};
  while (errors_are_open_ && ::poll(&file, 1, 0) > 0) errors_are_open_ = hear_errors();
  auto const said = on_one_line(last_words_);
  return fail(ErrorKind::lost, said.empty() ? fmt::format("{} has ended", name_)
                                            : fmt::format("{} has ended: {}", name_, printable(said)));
}

}  // namespace lapwing::base
