// `lapwing station` with somebody who writes a grid of 4,000 by 4,000 cells into its map five times a second: grids
// cannot be written over HTTP. All else that lies on the map comes in as users bring it.
//
// usage: bench_map_station STORE LINK
//
// What it reads says what is written: `patch`, what a robot sees around it (a square of 24 m, nine tiles of 256 or so),
// `whole`, every cell, or `none`. It ends when there is nothing more to read.
#include <utility>  // before Asio: Boost 1.74 uses std::exchange without including it

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <istream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/streambuf.hpp>

#include "host/session/session.hpp"

namespace lapwing::bench {
namespace {

using namespace std::chrono_literals;

constexpr int side = 4'000;
constexpr double resolution_m = 0.05;

/// A floor with walls, as a robot's scans leave it; `turn` moves the noise, and everything with it.
map::OccupancyGrid grid_of(int turn) {
  constexpr double half_m = side * resolution_m / 2.0;
  map::OccupancyGrid grid(resolution_m, {geo::Point<geo::SiteFrame>(-half_m, -half_m), 0.0});
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      auto const noise = static_cast<unsigned>(x * 7919 + y * 104'729 + turn) % 97;
      bool const is_wall = (x + 40 * turn) % 400 < 6 || y % 300 < 6;
      grid.set({x, y}, map::Evidence::of_probability(is_wall ? 0.97 : 0.02 + 0.001 * noise));
    }
  return grid;
}

class Writer {
 public:
  explicit Writer(host::Session& session) : session_(session), input_(session.loop.io(), dup(STDIN_FILENO)) {}

  void listen() {
    boost::asio::async_read_until(input_, text_, '\n', [this](boost::system::error_code error, std::size_t) {
      if (error) return session_.loop.stop();
      std::istream(&text_) >> what_;
      text_.consume(text_.size());
      listen();
    });
  }

  base::Task<> write() {
    for (int turn = 0;; ++turn) {
      co_await session_.loop.sleep(200ms);
      if (what_ == "none") continue;
      auto const& grid = grids_[static_cast<std::size_t>(turn % 2)];
      auto const done = session_.live_map.put_tiles({"default", "", "floor"}, grid, tiles(turn),
                                                    {"robot 1", session_.loop.utc_now()});
      if (!done) std::fputs((done.error().message + '\n').c_str(), stderr);
    }
  }

 private:
  /// Those that change: all, or those around a robot that drives through the grid along its middle.
  std::vector<map::TileKey> tiles(int turn) const {
    std::vector<map::TileKey> changed;
    int const at_x = 300 + turn * 8 % (side - 600);
    constexpr int at_y = side / 2, reach = 240;
    auto const least = map::tile_of({at_x - reach, at_y - reach}), most = map::tile_of({at_x + reach, at_y + reach});
    for (auto const& [key, cells] : grids_[0].tiles()) {
      bool const is_near = key.x >= least.x && key.x <= most.x && key.y >= least.y && key.y <= most.y;
      if (what_ == "whole" || is_near) changed.push_back(key);
    }
    return changed;
  }

  host::Session& session_;
  std::vector<map::OccupancyGrid> grids_{grid_of(0), grid_of(1)};
  boost::asio::posix::stream_descriptor input_;
  boost::asio::streambuf text_;
  std::string what_ = "none";
};

int serve(std::string const& store, std::string const& link) {
  host::Session session(host::Session::Options{});
  host::MapContent content;
  content.site_name = "bench";
  content.home = geo::Wgs84::from_degrees(47.4, 8.5, 420.0);
  content.store = {.place = host::StoreSettings::Place::named, .address = store};
  host::WebAccess access;
  access.port = 0;
  if (auto opened = session.open_links({link}); !opened) return std::fputs(opened.error().message.c_str(), stderr), 1;
  if (auto opened = session.open_map(access, content); !opened)
    return std::fputs(opened.error().message.c_str(), stderr), 1;
  Writer writer(session);
  writer.listen();
  auto writing = writer.write();
  writing.start();
  session.loop.run();
  return 0;
}

}  // namespace
}  // namespace lapwing::bench

int main(int count, char** words) {
  if (count == 3) return lapwing::bench::serve(words[1], words[2]);
  std::fputs("usage: bench_map_station STORE LINK\n", stderr);
  return 2;
}
