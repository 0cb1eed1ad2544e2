// One mission upload with Lapwing's uploader, for run.py: waits for vehicle 1 on a port, uploads N items, prints the
// seconds.
//
// usage: bench_upload PORT ITEMS
#include <cstdio>
#include <cstdlib>

#include "link/byte_link.hpp"
#include "link/url.hpp"
#include "mavlink/connection.hpp"
#include "mavlink/mission_transfer.hpp"

namespace lapwing::bench {
namespace {

using namespace std::chrono_literals;

std::vector<mavlink::MissionItem> zigzag(int count) {
  auto const home = geo::Wgs84::from_degrees(41.178, -8.598, 110.0);
  std::vector<mavlink::MissionItem> items(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    auto& item = items[static_cast<std::size_t>(i)];
    item.frame = mavlink::MavFrame::global;
    item.command = mavlink::MavCmd::nav_waypoint;
    auto const place = geo::displaced(home, geo::Ned{10.0 * i, i % 2 == 0 ? 0.0 : 50.0, 0.0});
    item.place = {.lat_rad = place.lat_rad, .lon_rad = place.lon_rad, .z_m = place.alt_m};
  }
  return items;
}

base::Task<bool> heard(mavlink::Connection& connection) {
  auto& loop = connection.loop();
  for (auto const deadline = loop.now() + 30s; loop.now() < deadline;) {
    if (connection.whereabouts(1)) co_return true;
    co_await loop.sleep(10ms);
  }
  co_return false;
}

int upload(std::uint32_t port, int count) {
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
  mavlink::TransferOptions options;
  options.restarts = 3;
  auto const done = loop.run_until_done(
      mavlink::upload_mission(connection, {1, 1}, zigzag(count), mavlink::MissionType::mission, options));
  if (!done) {
    std::fprintf(stderr, "%s\n", done.error().message.c_str());
    return 1;
  }
  std::printf("%.4f\n", base::to_seconds(loop.now() - started));
  return 0;
}

}  // namespace
}  // namespace lapwing::bench

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: bench_upload PORT ITEMS\n");
    return 2;
  }
  return lapwing::bench::upload(static_cast<std::uint32_t>(std::atoi(argv[1])), std::atoi(argv[2]));
}
