#include <utility>  // before Asio: Boost 1.74 uses std::exchange without including it

#include "apps/console.hpp"

#include <sys/stat.h>
#include <unistd.h>
#include <cstdio>
#include <iostream>

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/streambuf.hpp>

#include "base/mailbox.hpp"

namespace lapwing::apps {

namespace {

namespace asio = boost::asio;

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
  Console(base::Loop& loop, base::Logger log) : input_(loop), log_(log.named(std::string(script_source))) {}

  void write(std::string_view text) override {
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fflush(stdout);
    line_ += text;
    for (std::size_t end; (end = line_.find('\n')) != std::string::npos; line_.erase(0, end + 1)) {
      log_.info(line_.substr(0, end));
    }
  }

  base::Task<base::Result<std::string>> ask(std::string prompt) override {
    write(prompt);
    co_return co_await input_.next();
  }

 private:
  InputLines input_;
  base::Logger log_;
  std::string line_;  ///< what has been printed without a line end yet
};

}  // namespace

std::unique_ptr<dolphin::Output> make_console(base::Loop& loop, base::Logger log) {
  return std::make_unique<Console>(loop, std::move(log));
}

}  // namespace lapwing::apps
