// What it costs to keep a map: features a second by the size of a transaction, what lies in a viewport among many, and
// the past. Prints JSON.
//
// usage: bench_store ADDRESS writes | viewports FEATURES | records FRAMES
//
// Measured below the loop, where the writer's and the reader's threads call the database.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <random>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "map/store/care/care.hpp"
#include "map/store/rows/shown_rows.hpp"
#include "map/store/rows/site_rows.hpp"
#include "map/store/write/writer.hpp"

namespace lapwing::bench {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;
using namespace lapwing::map;

constexpr double side_m = 10'000.0;
base::UtcTime const began = std::chrono::sys_days(std::chrono::year(2026) / 1 / 1);

/// By the wall's clock, which is the disk's, too, and of the processor alone, which other programs disturb less.
class Watch {
 public:
  [[nodiscard]] double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  [[nodiscard]] double cpu_seconds() const { return static_cast<double>(std::clock() - cpu_start_) / CLOCKS_PER_SEC; }

 private:
  Clock::time_point start_ = Clock::now();
  std::clock_t cpu_start_ = std::clock();
};

template <class T>
T or_die(base::Result<T> result) {
  if (result) {
    if constexpr (!std::is_void_v<T>)
      return std::move(*result);
    else
      return;
  }
  std::fputs((result.error().message + '\n').c_str(), stderr);
  std::exit(1);
}

class Features {
 public:
  Features() { sites_.emplace("site", geo::Site::make("site", geo::Wgs84::from_degrees(47.4, 8.5, 420.0)).value()); }

  [[nodiscard]] rows::Sites const& sites() const { return sites_; }
  /// Parking slots with all that is known of them, anywhere on a square of 10 km.
  write::Batch batch(std::size_t size) {
    write::Batch batch{.sites = sites_};
    if (number_ == 0) batch.changed_sites = {"site"};
    for (std::size_t i = 0; i < size; ++i) batch.features.push_back({.feature = next()});
    return batch;
  }
  double place() { return std::uniform_real_distribution<double>(-side_m / 2.0, side_m / 2.0)(random_); }

 private:
  Feature next() {
    double const x = place(), y = place();
    ++number_;
    return {.id = fmt::format("slot {}", number_),
            .site = "site",
            .floor = "0",
            .account = {"drone 1", began + std::chrono::milliseconds(number_)},
            .content = Slot{.outline = {{{{x, y}, {x + 2.5, y}, {x + 2.5, y + 5.0}, {x, y + 5.0}}}},
                            .state = SlotState::taken,
                            .taken_probability = 0.93,
                            .seen_at = began + std::chrono::milliseconds(number_),
                            .seen_by = "drone 1",
                            .name = fmt::format("{}", number_)}};
  }

  rows::Sites sites_;
  std::mt19937_64 random_{1};
  int number_ = 0;
};

void writes(std::string const& address) {
  auto const writer = or_die(write::Writer::open({.address = address}));
  Features features;
  for (auto const& [size, batches] : {std::pair(1, 1000), std::pair(100, 200), std::pair(1000, 50)}) {
    Watch const watch;
    for (int i = 0; i < batches; ++i) or_die(writer->write(features.batch(static_cast<std::size_t>(size))));
    fmt::print("{{\"transaction\": {}, \"features_a_second\": {:.0f}, \"cpu_us_each\": {:.1f}}}\n", size,
               size * batches / watch.seconds(), 1e6 * watch.cpu_seconds() / (size * batches));
  }
}

void viewports(std::string const& address, std::size_t count) {
  constexpr std::size_t size = 10'000;
  Features features;
  {
    auto const writer = or_die(write::Writer::open({.address = address}));
    Watch const watch;
    for (std::size_t i = 0; i < count; i += size) or_die(writer->write(features.batch(size)));
    fmt::print("{{\"features\": {}, \"written_in_s\": {:.1f}, \"cpu_s\": {:.1f}, \"bytes\": {}}}\n", count,
               watch.seconds(), watch.cpu_seconds(), writer->bytes());
  }
  auto const database = or_die(place::open_database(place::Address(address), sql::Access::read));
  auto const& site = features.sites().at("site");
  for (double const view_m : {50.0, 200.0, 1000.0}) {
    constexpr int times = 50;
    std::size_t found = 0;
    Watch const watch;
    for (int i = 0; i < times; ++i) {
      double const x = features.place(), y = features.place();
      auto const least = site.place_of(geo::Point3<geo::SiteFrame>(x, y, 0.0));
      auto const most = site.place_of(geo::Point3<geo::SiteFrame>(x + view_m, y + view_m, 0.0));
      rows::LonLatBox const box{least.lon_deg(), most.lon_deg(), least.lat_deg(), most.lat_deg()};
      found += or_die(rows::features_within(*database, LayerKind::slots, features.sites(), box, count)).size();
    }
    fmt::print(
        "{{\"viewport_m\": {}, \"features_each\": {}, \"milliseconds_each\": {:.2f}, \"cpu_ms_each\": {:.2f}}}\n",
        view_m, found / times, 1e3 * watch.seconds() / times, 1e3 * watch.cpu_seconds() / times);
  }
}

/// Of a vehicle, as a viewer is told of it.
std::string position(std::mt19937& random, std::size_t vehicle) {
  auto const any = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  return fmt::format(R"({{"type":"vehicle","id":"drone {}","latitude_deg":{:.7f},"longitude_deg":{:.7f},"up_m":{:.2f},)"
                     R"("heading_deg":{:.0f},"battery_percent":{:.0f}}})",
                     vehicle, any(47.40, 47.41), any(8.50, 8.51), any(0.0, 120.0), any(0.0, 360.0), any(20.0, 100.0));
}

void records(std::string const& address, std::size_t count) {
  // A second of 250 vehicles at 10 Hz, as one batch.
  constexpr std::size_t size = 2500;
  {
    auto const writer = or_die(write::Writer::open({.address = address}));
    std::mt19937 random(1);
    Watch const watch;
    for (std::size_t done = 0; done < count; done += size) {
      write::Batch batch;
      auto const second = began + std::chrono::seconds(done / size);
      for (std::size_t i = 0; i < size; ++i)
        batch.frames.push_back({.at = second + std::chrono::microseconds(400 * i),
                                .session = "bench",
                                .feed = "vehicles",
                                .is_whole = i == 0 && done / size % 10 == 0,
                                .content = position(random, i % 250)});
      or_die(writer->write(batch));
    }
    fmt::print("{{\"frames\": {}, \"written_in_s\": {:.1f}, \"cpu_s\": {:.1f}, \"bytes\": {}}}\n", count,
               watch.seconds(), watch.cpu_seconds(), writer->bytes());
  }
  auto const database = or_die(place::open_database(place::Address(address), sql::Access::read));
  auto const length = std::chrono::seconds(count / size);
  std::mt19937_64 random(2);
  constexpr int times = 20;
  std::size_t found = 0;
  Watch const watch;
  for (int i = 0; i < times; ++i) {
    auto const at = began + std::chrono::nanoseconds(
                                random() % static_cast<std::uint64_t>(std::chrono::nanoseconds(length).count()));
    found += or_die(rows::state_at(*database, "bench", at)).size();
  }
  fmt::print("{{\"state_at_frames_each\": {}, \"milliseconds_each\": {:.2f}, \"cpu_ms_each\": {:.2f}}}\n",
             found / times, 1e3 * watch.seconds() / times, 1e3 * watch.cpu_seconds() / times);
}

std::size_t number_in(char const* text) {
  return static_cast<std::size_t>(std::strtoull(text, nullptr, 10));
}

}  // namespace
}  // namespace lapwing::bench

int main(int count, char** words) {
  std::string_view const verb = count > 2 ? words[2] : "";
  if (verb == "writes") {
    lapwing::bench::writes(words[1]);
  } else if (verb == "viewports" && count > 3) {
    lapwing::bench::viewports(words[1], lapwing::bench::number_in(words[3]));
  } else if (verb == "records" && count > 3) {
    lapwing::bench::records(words[1], lapwing::bench::number_in(words[3]));
  } else {
    std::fputs("usage: bench_store ADDRESS writes | viewports FEATURES | records FRAMES\n", stderr);
    return 2;
  }
  return 0;
}
