#include <utility>  // before Asio: Boost 1.74 uses std::exchange without including it

#include "host/session/console.hpp"

#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/streambuf.hpp>

#include "base/async/mailbox.hpp"
#include "base/async/scope.hpp"
#include "base/flood_gate.hpp"

namespace lapwing::host {

namespace {

namespace asio = boost::asio;

/// A script may print a long table, into a file, too; a loop that prints without end fills no disk.
constexpr base::FloodGate::Limits most_words{.burst = 100'000.0, .per_s = 200.0};
constexpr std::size_t line_bytes = 200;          ///< a longer text counts as several lines
constexpr std::size_t longest_line = 64 * 1024;  ///< kept for the log until its end comes
constexpr base::Duration quiet = std::chrono::seconds(2);

base::Error end_of_input() {
  return {base::ErrorKind::io, "ask: standard input has ended", "answer on standard input, one line a question"};
}

/// Lines of standard input without blocking the loop. A regular file cannot be waited for, and never makes one wait.
class InputLines {
 public:
  explicit InputLines(base::Loop& loop) : loop_(loop), answers_(loop, 1) {}

  base::Task<base::Result<std::string>> next() {
    struct stat about{};
    if (::fstat(STDIN_FILENO, &about) == 0 && S_ISREG(about.st_mode)) {
      std::string line;
      if (!std::getline(std::cin, line)) co_return std::unexpected(end_of_input());
      co_return line;
    }
    if (!input_) input_ = std::make_unique<asio::posix::stream_descriptor>(loop_.io(), ::dup(STDIN_FILENO));
    asio::async_read_until(*input_, buffer_, '\n', [this](boost::system::error_code error, std::size_t) {
      (void)answers_.post(!error || buffer_.size() > 0);
    });
    auto const arrived = co_await answers_.receive(std::chrono::hours(24 * 365));
    if (!arrived || !*arrived) co_return std::unexpected(end_of_input());
    std::istream stream(&buffer_);
    std::string line;
    std::getline(stream, line);
    co_return line;
  }

 private:
  base::Loop& loop_;
  base::Mailbox<bool> answers_;
  asio::streambuf buffer_{1 << 20};
  std::unique_ptr<asio::posix::stream_descriptor> input_;
};

class Console final : public dolphin::Output {
 public:
  Console(base::Loop& loop, base::Logger log)
      : loop_(loop), input_(loop), log_(log.named(std::string(script_source))), scope_(loop) {}
  ~Console() override { tell_what_was_left_out(); }
  Console(Console const&) = delete;
  Console& operator=(Console const&) = delete;

  void write(std::string_view text) override {
    auto const lines = std::max<std::ptrdiff_t>(1, std::ranges::count(text, '\n'));
    auto const size = std::max(static_cast<double>(lines), static_cast<double>(text.size()) / line_bytes);
    if (gate_.admit(std::chrono::system_clock::now(), size)) {
      tell_what_was_left_out();
      return put(text);
    }
    if (!std::exchange(is_watching_, true)) scope_.spawn(watch_for_quiet());
  }

  base::Task<base::Result<std::string>> ask(std::string prompt) override {
    write(prompt);
    co_return co_await input_.next();
  }

 private:
  void put(std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fflush(stdout);
    line_ += text;
    for (std::size_t end; (end = line_.find('\n')) != std::string::npos; line_.erase(0, end + 1)) {
      log_.info(line_.substr(0, end));
    }
    if (line_.size() > longest_line) log_.info(std::exchange(line_, {}));
  }

  void tell_what_was_left_out() {
    if (auto const lines = gate_.take_left_out(); lines > 0) put(base::left_out_text(lines) + '\n');
  }

  /// After a flood nothing may come any more that could say so.
  base::Task<void> watch_for_quiet() {
    co_await loop_.sleep(quiet);
    is_watching_ = false;
    tell_what_was_left_out();
  }

  base::Loop& loop_;
  InputLines input_;
  base::Logger log_;
  base::FloodGate gate_{most_words};
  std::string line_;  ///< what has been printed without a line end yet
  bool is_watching_ = false;
  base::Scope scope_;
};

}  // namespace

std::unique_ptr<dolphin::Output> make_console(base::Loop& loop, base::Logger log) {
  return std::make_unique<Console>(loop, std::move(log));
}

}  // namespace lapwing::host
