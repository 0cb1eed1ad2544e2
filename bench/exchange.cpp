// One exchange of Lapwing's with vehicle 1, for lossy.py: waits for it on a port, does what it is told, prints the
// seconds.
//
// usage: bench_exchange PORT command|parameter|upload
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "link/byte_link.hpp"
#include "link/url.hpp"
#include "mavlink/command.hpp"
#include "mavlink/mission_transfer.hpp"
#include "mavlink/param.hpp"

namespace lapwing::bench {
namespace {

using namespace std::chrono_literals;
using base::Result;
using base::Task;

constexpr mavlink::Address vehicle{1, 1};
constexpr std::size_t item_count = 20;

Task<bool> heard(mavlink::Connection& connection) {
  auto& loop = connection.loop();
  for (auto const deadline = loop.now() + 60s; loop.now() < deadline;) {
    if (connection.whereabouts(1)) co_return true;
    co_await loop.sleep(10ms);
  }
  co_return false;
}

Task<Result<>> upload(mavlink::Connection& connection) {
  auto const home = geo::Wgs84::from_degrees(41.178, -8.598, 110.0);
  std::vector<mavlink::MissionItem> items(item_count);
  for (std::size_t i = 0; i < item_count; ++i) {
    auto const place = geo::displaced(home, geo::Ned{10.0 * static_cast<double>(i), 0.0, 0.0});
    items[i].command = mavlink::MavCmd::nav_waypoint;
    items[i].place = {.lat_rad = place.lat_rad, .lon_rad = place.lon_rad, .z_m = place.alt_m};
  }
  co_return co_await mavlink::upload_mission(connection, vehicle, std::move(items), mavlink::MissionType::mission,
                                             {.tries = 12});
}

Task<Result<>> command(mavlink::Connection& connection) {
  // Five times a second, whatever state the vehicle is in.
  mavlink::Command const rate{mavlink::MavCmd::set_message_interval, {33.0F, 200'000.0F}};
  mavlink::CommandOptions const patient{.tries = 12, .ack_timeout = 1s, .expiry = 60s};
  co_return co_await mavlink::run_command(connection, vehicle, rate, patient);
}

Task<Result<>> parameter(mavlink::Connection& connection) {
  mavlink::ParamOptions const patient{.tries = 12, .reply_timeout = 1s};
  auto const changed = co_await mavlink::set_param(connection, vehicle, "RTL_ALT", 2500.0, patient);
  if (!changed) co_return std::unexpected(changed.error());
  co_return Result<>{};
}

int run(std::uint32_t port, std::string_view what) {
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
  auto const done = loop.run_until_done(what == "upload"    ? upload(connection)
                                        : what == "command" ? command(connection)
                                                            : parameter(connection));
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
  std::string_view const what = argc == 3 ? argv[2] : "";
  if (what != "command" && what != "parameter" && what != "upload") {
    std::fprintf(stderr, "usage: bench_exchange PORT command|parameter|upload\n");
    return 2;
  }
  return lapwing::bench::run(static_cast<std::uint32_t>(std::atoi(argv[1])), what);
}
