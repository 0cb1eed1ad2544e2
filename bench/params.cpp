// Every parameter of a vehicle with Lapwing's downloader, for run.py: waits for vehicle 1 on a port, prints the seconds
// and how many there were.
//
// usage: bench_params PORT
#include <cstdio>
#include <cstdlib>

#include "link/byte_link.hpp"
#include "link/url.hpp"
#include "mavlink/connection.hpp"
#include "mavlink/param_list.hpp"

namespace lapwing::bench {
namespace {

using namespace std::chrono_literals;

base::Task<bool> heard(mavlink::Connection& connection) {
  auto& loop = connection.loop();
  for (auto const deadline = loop.now() + 30s; loop.now() < deadline;) {
    if (connection.whereabouts(1)) co_return true;
    co_await loop.sleep(10ms);
  }
  co_return false;
}

int download(std::uint32_t port) {
  base::Loop loop;
  mavlink::Connection connection(loop, {}, {});
  auto link = link::open(loop, link::Url{link::Transport::udp_in, "127.0.0.1", port});
  if (!link) {
    std::fprintf(stderr, "%s\n", link.error().message.c_str());
    return 1;
  }
  connection.add_link(std::move(*link));
  if (!loop.run_until_done(heard(connection))) {
    std::fprintf(stderr, "no vehicle on port %u\n", port);
    return 1;
  }
  auto const started = loop.now();
  auto const list = loop.run_until_done(mavlink::download_params(connection, {1, 1}));
  if (!list) {
    std::fprintf(stderr, "%s\n", list.error().message.c_str());
    return 1;
  }
  std::printf("%.4f %zu\n", base::to_seconds(loop.now() - started), list->parameters.size());
  return 0;
}

}  // namespace
}  // namespace lapwing::bench

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: bench_params PORT\n");
    return 2;
  }
  return lapwing::bench::download(static_cast<std::uint32_t>(std::atoi(argv[1])));
}
