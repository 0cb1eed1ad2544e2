// The operator link on loopback, both ends in one process on one loop: confirmed round trips one after the other, and
// messages a second when the sender does not wait; in memory and kept in a folder. Beside them what the machine itself
// takes: the same text over a bare socket and back.
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "base/async/scope.hpp"
#include "link/operator_link/endpoints.hpp"

namespace {

using namespace lapwing;
using namespace lapwing::link::operator_link;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr std::size_t text_bytes = 200;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

void tell_round_trips(std::string const& name, std::vector<double>& times_s) {
  std::ranges::sort(times_s);
  auto const at = [&](double part) {
    return times_s[static_cast<std::size_t>(static_cast<double>(times_s.size() - 1) * part)] * 1e6;
  };
  fmt::print("{:34} round trip p50 {:7.1f} us, p99 {:7.1f} us\n", name, at(0.5), at(0.99));
}

struct Ends {
  base::Loop loop;
  std::unique_ptr<Server> server;
  std::unique_ptr<Client> client;
  std::uint64_t taken = 0;

  explicit Ends(std::filesystem::path const& folder) {
    ServeSettings to_serve{.port = 0, .server = {.end = {.name = "drone"}, .expected = {"station"}}};
    server = *serve(loop, std::move(to_serve),
                    {.arrived =
                         [this](PeerSession& session) {
                           while (session.take()) ++taken;
                         },
                     .event = {}});
    ConnectSettings to_connect{.port = server->port(), .client = {.end = {.name = "station"}}};
    to_connect.client.end.queues.folder = folder;
    client = *connect(loop, std::move(to_connect), {});
    auto& session = client->session();
    loop.run_until_done(session.changed().wait_for([&] { return session.is_connected(); }, 10s));
  }
};

void measure(std::string const& name, Kind kind, std::filesystem::path const& folder, int round_trips, int messages) {
  Ends ends(folder);
  auto& session = ends.client->session();
  std::string const text(text_bytes, 'x');
  std::vector<double> times_s;
  for (int i = 0; i < round_trips; ++i) {
    auto const begin = Clock::now();
    if (!ends.loop.run_until_done(session.deliver({.kind = kind, .text = text}, 10s))) return;
    times_s.push_back(seconds_since(begin));
  }
  tell_round_trips(name, times_s);
  auto const begin = Clock::now();
  auto const flood = [](Ends& of, PeerSession& to, Message message, int count) -> base::Task<int> {
    for (int i = 0; i < count;) {
      if (to.send(message))
        ++i;
      else
        co_await to.changed().wait();
    }
    auto drained = to.drained(message.kind, 100s);
    co_await drained;
    co_return static_cast<int>(of.taken);
  };
  ends.loop.run_until_done(flood(ends, session, {.kind = kind, .text = text}, messages));
  fmt::print("{:34} {:9.0f} messages/s\n", name, messages / seconds_since(begin));
}

/// A thread that sends back what it gets, over a socket pair: two system calls each way and two changes of thread.
void measure_bare(int round_trips) {
  int sockets[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM, 0, sockets) != 0) return;
  std::jthread const echo([socket = sockets[1]] {
    char buffer[text_bytes];
    for (ssize_t got = 0; (got = ::read(socket, buffer, sizeof(buffer))) > 0;)
      if (::write(socket, buffer, static_cast<std::size_t>(got)) != got) return;
  });
  std::string text(text_bytes, 'x');
  std::vector<double> times_s;
  for (int i = 0; i < round_trips; ++i) {
    auto const begin = Clock::now();
    if (::write(sockets[0], text.data(), text.size()) < 0) return;
    for (std::size_t got = 0; got < text.size();)
      got += static_cast<std::size_t>(std::max<ssize_t>(0, ::read(sockets[0], text.data(), text.size() - got)));
    times_s.push_back(seconds_since(begin));
  }
  ::close(sockets[0]);
  tell_round_trips("bare socket pair, two threads", times_s);
}

}  // namespace

int main() {
  measure_bare(20'000);
  measure("command, confirmed", Kind::command, {}, 5'000, 200'000);
  measure("durable, in memory", Kind::durable, {}, 5'000, 200'000);
  auto const folder = std::filesystem::temp_directory_path() / fmt::format("lapwing-bench-{}", ::getpid());
  measure("durable, in a folder (fsync)", Kind::durable, folder, 300, 100'000);
  std::filesystem::remove_all(folder);
  return 0;
}
