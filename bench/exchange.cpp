// One exchange of Lapwing's with vehicle 1, for run.py and lossy.py: waits for it on a port, does what it is told,
// prints the seconds that this took and how many things went over.
//
// usage: bench_exchange PORT command|parameter|parameters|upload [ITEMS]
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "link/byte_link.hpp"
#include "link/url.hpp"
#include "mavlink/exchange/command.hpp"
#include "mavlink/exchange/mission_transfer.hpp"
#include "mavlink/exchange/param.hpp"
#include "mavlink/exchange/param_list.hpp"

namespace lapwing::bench {
namespace {

using namespace std::chrono_literals;
using base::Result;
using base::Task;

constexpr mavlink::Address vehicle{1, 1};
constexpr std::size_t usual_items = 20;

Task<bool> heard(mavlink::Connection& connection) {
  auto& loop = connection.loop();
  for (auto const deadline = loop.now() + 60s; loop.now() < deadline;) {
    if (connection.whereabouts(1)) co_return true;
    co_await loop.sleep(10ms);
  }
  co_return false;
}

std::vector<mavlink::MissionItem> zigzag(std::size_t count) {
  auto const home = geo::Wgs84::from_degrees(41.178, -8.598, 110.0);
  std::vector<mavlink::MissionItem> items(count);
  for (std::size_t i = 0; i < count; ++i) {
    geo::Ned const offset{10.0 * static_cast<double>(i), i % 2 == 0 ? 0.0 : 50.0, 0.0};
    auto const place = geo::displaced(home, offset);
    items[i].command = mavlink::MavCmd::nav_waypoint;
    items[i].place = {.lat_rad = place.lat_rad, .lon_rad = place.lon_rad, .z_m = place.alt_m};
  }
  return items;
}

/// How many things went over.
using Count = Result<std::size_t>;

Task<Count> upload(mavlink::Connection& connection, std::size_t count) {
  mavlink::TransferOptions const options{.tries = 12, .restarts = 3};
  auto items = zigzag(count);
  auto const done =
      co_await mavlink::upload_mission(connection, vehicle, std::move(items), mavlink::MissionType::mission, options);
  if (!done) co_return std::unexpected(done.error());
  co_return count;
}

Task<Count> command(mavlink::Connection& connection) {
  // Five times a second, whatever state the vehicle is in.
  mavlink::Command const rate{mavlink::MavCmd::set_message_interval, {33.0F, 200'000.0F}};
  mavlink::CommandOptions const patient{.tries = 12, .ack_timeout = 1s, .expiry = 60s};
  auto const done = co_await mavlink::run_command(connection, vehicle, rate, patient);
  if (!done) co_return std::unexpected(done.error());
  co_return 1U;
}

Task<Count> parameter(mavlink::Connection& connection) {
  mavlink::ParamOptions const patient{.tries = 12, .reply_timeout = 1s};
  auto const changed = co_await mavlink::set_param(connection, vehicle, "RTL_ALT", 2500.0, patient);
  if (!changed) co_return std::unexpected(changed.error());
  co_return 1U;
}

Task<Count> parameters(mavlink::Connection& connection) {
  auto const list = co_await mavlink::download_params(connection, vehicle);
  if (!list) co_return std::unexpected(list.error());
  co_return list->parameters.size();
}

Task<Count> exchange(mavlink::Connection& connection, std::string_view what, std::size_t items) {
  if (what == "upload") return upload(connection, items);
  if (what == "parameters") return parameters(connection);
  return what == "command" ? command(connection) : parameter(connection);
}

int run(std::uint32_t port, std::string_view what, std::size_t items) {
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
  auto const done = loop.run_until_done(exchange(connection, what, items));
  if (!done) {
    std::fprintf(stderr, "%s\n", done.error().message.c_str());
    return 1;
  }
  std::printf("%.4f %zu\n", base::to_seconds(loop.now() - started), *done);
  return 0;
}

bool is_known(std::string_view what) {
  return what == "command" || what == "parameter" || what == "parameters" || what == "upload";
}

}  // namespace
}  // namespace lapwing::bench

int main(int argc, char** argv) {
  if (argc < 3 || argc > 4 || !lapwing::bench::is_known(argv[2])) {
    std::fprintf(stderr, "usage: bench_exchange PORT command|parameter|parameters|upload [ITEMS]\n");
    return 2;
  }
  auto const items = argc == 4 ? static_cast<std::size_t>(std::atoi(argv[3])) : lapwing::bench::usual_items;
  return lapwing::bench::run(static_cast<std::uint32_t>(std::atoi(argv[1])), argv[2], items);
}
