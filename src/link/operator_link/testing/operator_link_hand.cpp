#include <charconv>
#include <cstdio>
#include <functional>
#include <iostream>
#include <string>
#include <string_view>
#include <thread>

#include <fmt/format.h>

#include "link/operator_link/endpoints.hpp"

/// An end of an operator link by itself, for tests with programs that are not ours and for tests that kill.
///
///   operator_link_hand serve|connect NAME PORT [json] [token=T] [queue=DIR] [queue_bytes=N] [cert=F key=F] [ca=F]
///   [keep]
///
/// It prints "listening PORT", "event KIND PEER TEXT", "got KIND NUMBER TEXT" for each message, which it takes at once
/// (with `keep` only on "take"), and does what its standard input says, one thing a line:
///
///   say durable TEXT · say command KEY LIFETIME_MS TEXT · say latest KEY TEXT: to everybody; "accepted", "refused WHY"
///   flood COUNT SIZE: so many durable messages "N xxx", each with "accepted N" once it is kept
///   take: one message of each far end · waiting: how many durable ones are not taken
namespace lapwing::link::operator_link {
namespace {

void say(std::string const& line) {
  std::puts(line.c_str());
  std::fflush(stdout);
}

std::uint64_t number(std::string_view text) {
  std::uint64_t value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::string_view word(std::string_view& line) {
  auto const end = std::min(line.find(' '), line.size());
  auto const first = line.substr(0, end);
  line.remove_prefix(std::min(end + 1, line.size()));
  return first;
}

struct Options {
  EndSettings end{};
  std::string certificate{}, key{}, authority{};
  bool keeps = false;
};

Options options_of(int count, char** words) {
  Options options;
  for (int i = 4; i < count; ++i) {
    std::string_view const option = words[i];
    auto const value = std::string(option.substr(std::min(option.find('=') + 1, option.size())));
    if (option == "json") options.end.mode = Mode::json;
    if (option == "keep") options.keeps = true;
    if (option.starts_with("token=")) options.end.token = value;
    if (option.starts_with("queue=")) options.end.queues.folder = value;
    if (option.starts_with("queue_bytes=")) options.end.queues.disk.bytes = number(value);
    if (option.starts_with("cert=")) options.certificate = value;
    if (option.starts_with("key=")) options.key = value;
    if (option.starts_with("ca=")) options.authority = value;
  }
  return options;
}

class Hand {
 public:
  Hand(base::Loop& loop, Options options) : loop_(loop), options_(std::move(options)) {}

  bool open(std::string_view how, std::uint16_t port) { return how == "serve" ? open_server(port) : open_client(port); }

  void obey(std::string_view line) {
    auto const verb = word(line);
    if (verb == "say") return say_to_all(line);
    if (verb == "take") return for_each([](PeerSession& session) { take_one(session); });
    if (verb == "waiting")
      return for_each([](PeerSession& session) { say(fmt::format("waiting {}", session.waiting(Kind::durable))); });
    if (verb != "flood") return say(fmt::format("unknown {}", verb));
    auto const count = number(word(line));
    auto const size = number(word(line));
    for (std::uint64_t i = 1; i <= count; ++i)
      for_each([&](PeerSession& session) { flood(session, fmt::format("{} {}", i, std::string(size, 'x'))); });
  }

 private:
  static void take_one(PeerSession& session) {
    auto const message = session.take();
    if (message) say(fmt::format("got {} {} {}", to_string(message->kind), message->number, message->text));
  }
  static void flood(PeerSession& session, std::string text) {
    auto const id = session.send({.text = std::move(text)});
    say(id ? fmt::format("accepted {}", id->number)
           : fmt::format("refused {} {}", id.error().message, id.error().hint));
  }
  static void told(Event const& event) {
    say(fmt::format("event {} {} {}", to_string(event.kind), event.peer, event.text));
  }

  bool open_server(std::uint16_t port) {
    ServeSettings settings{.port = port, .server = {.end = options_.end, .expected = {"station"}}};
    if (!options_.certificate.empty())
      settings.tls = TlsServerSettings{options_.certificate, options_.key, options_.authority};
    auto opened = serve(loop_, std::move(settings),
                        {.arrived = [this](PeerSession& session) { arrived(session); }, .event = told});
    if (!opened) return failed(opened.error());
    server_ = *std::move(opened);
    say(fmt::format("listening {}", server_->port()));
    return true;
  }
  bool open_client(std::uint16_t port) {
    ConnectSettings settings{.port = port, .client = {.end = options_.end}};
    settings.client.back_off = {.first = std::chrono::milliseconds(50), .most = std::chrono::milliseconds(500)};
    if (!options_.authority.empty())
      settings.tls = TlsClientSettings{options_.authority, "", options_.certificate, options_.key};
    auto opened =
        connect(loop_, std::move(settings), {.arrived = [this] { arrived(client_->session()); }, .event = told});
    if (!opened) return failed(opened.error());
    client_ = *std::move(opened);
    return true;
  }
  static bool failed(base::Error const& error) {
    say(fmt::format("failed {} {}", error.message, error.hint));
    return false;
  }

  void arrived(PeerSession& session) const {
    if (!options_.keeps) take_one(session);
  }
  void for_each(std::function<void(PeerSession&)> const& what) {
    if (client_) what(client_->session());
    if (!server_) return;
    for (auto* const session : server_->sessions()) what(*session);
  }
  void say_to_all(std::string_view line) {
    Message message;
    auto const kind = word(line);
    if (kind != "durable") {
      message.kind = kind == "command" ? Kind::command : Kind::latest;
      message.key = word(line);
    }
    if (kind == "command") message.lifetime = std::chrono::milliseconds(number(word(line)));
    message.text = line;
    for_each([&](PeerSession& session) {
      auto const id = session.send(message);
      say(id ? "accepted" : fmt::format("refused {}", id.error().message));
    });
  }

  base::Loop& loop_;
  Options options_;
  std::unique_ptr<Server> server_;
  std::unique_ptr<Client> client_;
};

int main_of(int count, char** words) {
  if (count < 4) {
    std::fputs("usage: operator_link_hand serve|connect NAME PORT [OPTION...]\n", stderr);
    return 2;
  }
  base::Loop loop;
  auto options = options_of(count, words);
  options.end.name = words[2];
  Hand hand(loop, std::move(options));
  if (!hand.open(words[1], static_cast<std::uint16_t>(number(words[3])))) return 1;
  // Ends with its standard input, so with the test that started it.
  std::jthread const reader([&] {
    for (std::string line; std::getline(std::cin, line);)
      loop.post_from_other_thread([&hand, line] { hand.obey(line); });
    loop.post_from_other_thread([&loop] { loop.stop(); });
  });
  loop.run();
  return 0;
}

}  // namespace
}  // namespace lapwing::link::operator_link

int main(int count, char** words) {
  return lapwing::link::operator_link::main_of(count, words);
}
