#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "apps/verb.hpp"
#include "base/async/loop.hpp"
#include "host/vocabulary.hpp"
#include "lsp/message_reader.hpp"
#include "lsp/server.hpp"

namespace lapwing::apps {

namespace {

/// How long to wait for input, as poll(2) has it: not at all while there is work, without end while nothing is due.
int patience(lsp::Server const& server, base::TimePoint now) {
  if (server.has_work(now)) return 0;
  auto const due = server.next_due();
  return due ? static_cast<int>(std::chrono::ceil<std::chrono::milliseconds>(*due - now).count()) : -1;
}

bool has_input(int patience_ms) {
  pollfd standard_input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
  return ::poll(&standard_input, 1, patience_ms) > 0;
}

/// Waits for some bytes and hands their messages on. False at the end of the input.
bool read_some(lsp::MessageReader& reader, lsp::Server& server) {
  std::array<char, 65536> buffer;
  auto const count = ::read(STDIN_FILENO, buffer.data(), buffer.size());
  if (count < 0 && errno == EINTR) return true;
  if (count <= 0) return false;
  reader.feed({buffer.data(), static_cast<std::size_t>(count)});
  while (auto const message = reader.next()) {
    if (message->mistake.empty()) {
      server.receive(message->body);
    } else {
      server.receive_mistake(message->mistake);
    }
  }
  return true;
}

bool write_all(std::vector<std::string> const& messages) {
  for (auto const& one : messages) {
    auto const text = lsp::with_header(one);
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) return false;
  }
  return std::fflush(stdout) == 0;
}

/// What has arrived is taken in before each step, so that a cancellation overtakes the request that it is about.
int serve() {
  auto const vocabulary = host::vocabulary();
  lsp::Server server(vocabulary, LAPWING_VERSION);
  lsp::MessageReader reader;
  base::Loop const clock;
  bool is_open = true;
  while (!server.exit_code()) {
    while (is_open && has_input(patience(server, clock.now()))) is_open = read_some(reader, server);
    auto const now = clock.now();
    if (!is_open && !server.has_work(now)) return host::exit_failed;  // the editor is gone without a word
    if (server.has_work(now) && !write_all(server.work(now))) return host::exit_failed;
  }
  return *server.exit_code();
}

}  // namespace

void add_lsp(CLI::App& program, int& exit_code) {
  auto* verb = begin_verb(program, "lsp");
  verb->add_flag("--stdio")->description("Accepted for editors that say so; there is no other way");
  verb->callback([&exit_code] {
    if (::isatty(STDIN_FILENO) == 1) {
      fmt::print(stderr, "lapwing lsp is started by an editor (docs/guide/editors.md); end it with Ctrl-D\n");
    }
    exit_code = serve();
  });
}

}  // namespace lapwing::apps
