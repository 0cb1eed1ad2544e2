#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/async/loop.hpp"
#include "map/store/care/care.hpp"
#include "map/store/store.hpp"

/// A hand for tests that kill programs and fill disks: writes a store and says what has been accepted, or looks whether
/// all of that is there.
///
///   store_hand write ADDRESS WRITER [LEAST_FREE_BYTES]   for ever: "accepted N" once the things 0..N-1 are kept,
///                                                         "refused MESSAGE" when they cannot be
///   store_hand check ADDRESS WRITER N                     0 when those are there and nothing is half; else says what
///   is not
namespace lapwing::map {
namespace {

using namespace std::chrono_literals;

constexpr int step = 20;

/// Everything about it follows from its number, so that half of one would show.
std::string picture_of(std::string const& writer, int number) {
  std::string bytes = fmt::format("{} {} ", writer, number);
  while (bytes.size() < 20'000)
    bytes += fmt::format("{:x} ", static_cast<std::uint64_t>(number) * 2654435761U + bytes.size());
  return bytes;
}

std::string id_of(std::string const& writer, int number) {
  return fmt::format("{} {}", writer, number);
}

PointOfInterest door(std::string const& writer, int number, std::string picture) {
  int const row = number / 100;
  return {.position = SitePoint(number % 100, row),
          .kind = "door",
          .name = fmt::format("{} {}", writer, number),
          .text = std::string(static_cast<std::size_t>(number % 500), 'x'),
          .picture = std::move(picture)};
}

Slot slot(int number) {
  double const x = number % 100, y = number / 100.0;
  return {.outline = {{{{x, y}, {x + 2.5, y}, {x + 2.5, y + 5.0}, {x, y + 5.0}}}},
          .state = static_cast<SlotState>(number % 3),
          .name = fmt::format("{}", number)};
}

void say(std::string const& line) {
  std::puts(line.c_str());
  std::fflush(stdout);
}

class Hand {
 public:
  Hand(base::Loop& loop, LiveMap& map, Store& store, std::string writer)
      : loop_(loop), map_(map), store_(store), writer_(std::move(writer)) {}

  base::Task<> write_always() {
    int number = 0;
    while (map_.find(LayerKind::slots, id_of(writer_, number)) &&
           map_.find(LayerKind::points_of_interest, id_of(writer_, number)))
      ++number;
    for (number = number / step * step;; number += step) {
      auto const picture = co_await accepted(number);
      for (int i = number; i < number + step; ++i) put(i, picture);
      store_.record({.at = loop_.utc_now(),
                     .session = writer_,
                     .feed = "count",
                     .is_whole = true,
                     .content = fmt::format("{}", number)});
      while (true) {
        auto const done = co_await store_.flush();
        if (done) break;
        say("refused " + done.error().message);
        co_await loop_.sleep(100ms);
      }
      say(fmt::format("accepted {}", number + step));
    }
  }

  /// What of the first `count` is missing.
  base::Task<int> missing(int count) {
    int missing = 0;
    for (int i = 0; i < count; ++i) {
      auto const* poi = map_.find(LayerKind::points_of_interest, id_of(writer_, i));
      auto const* place = map_.find(LayerKind::slots, id_of(writer_, i));
      bool const is_there =
          poi && place && std::get<Slot>(place->feature.content).name == fmt::format("{}", i) &&
          std::get<PointOfInterest>(poi->feature.content).text.size() == static_cast<std::size_t>(i % 500);
      if (!is_there || (i % step == 0 && !co_await has_picture(*poi, i))) ++missing;
    }
    co_return missing;
  }

 private:
  base::Task<std::string> accepted(int number) {
    while (true) {
      auto kept = co_await store_.keep(picture_of(writer_, number), "image/jpeg");
      if (kept) co_return *kept;
      say("refused " + kept.error().message);
      co_await loop_.sleep(100ms);
    }
  }
  void put(int i, std::string const& picture) {
    Account const account{writer_, loop_.utc_now()};
    std::vector<Feature> both;
    both.push_back({.id = id_of(writer_, i), .site = "site", .account = account, .content = door(writer_, i, picture)});
    both.push_back({.id = id_of(writer_, i), .site = "site", .account = account, .content = slot(i)});
    if (auto const done = map_.put_all(std::move(both)); !done) {
      say("broken " + done.error().message);
      std::exit(1);
    }
  }
  base::Task<bool> has_picture(FeatureRecord const& record, int i) {
    auto const blob = co_await store_.blob(std::get<PointOfInterest>(record.feature.content).picture);
    co_return blob && blob->bytes == picture_of(writer_, i);
  }

  base::Loop& loop_;
  LiveMap& map_;
  Store& store_;
  std::string writer_;
};

int fail(base::Error const& error) {
  say(fmt::format("broken {}; {}", error.message, error.hint));
  return 1;
}

int write(std::string const& address, std::string const& writer, std::uint64_t least_free_bytes) {
  base::Loop loop;
  LiveMap map;
  auto const store = Store::open(loop, {.address = address, .least_free_bytes = least_free_bytes});
  if (!store) return fail(store.error());
  if (auto const loaded = loop.run_until_done((*store)->load(map)); !loaded) return fail(loaded.error());
  (*store)->follow(map);
  map.put_site(geo::Site::make("site", geo::Wgs84::from_degrees(47.4, 8.5, 420.0)).value());
  Hand hand(loop, map, **store, writer);
  loop.run_until_done(hand.write_always());
  return 0;
}

int check(std::string const& address, std::string const& writer, int count) {
  auto const verdict = care::verify(address);
  if (!verdict) return fail(verdict.error());
  for (auto const& fault : verdict->faults) say("fault " + fault);
  base::Loop loop;
  LiveMap map;
  auto const store = Store::open(loop, {.address = address, .least_free_bytes = 0});
  if (!store) return fail(store.error());
  if (auto const loaded = loop.run_until_done((*store)->load(map)); !loaded) return fail(loaded.error());
  Hand hand(loop, map, **store, writer);
  auto const missing = loop.run_until_done(hand.missing(count));
  auto const trouble = (*store)->health().trouble;
  auto const past = loop.run_until_done((*store)->state_at(writer, loop.utc_now()));
  bool const has_past = count == 0 || (past && past->size() == 1 && std::stoi(past->front().content) >= count - step);
  say(fmt::format("{} of {} are missing; {} faults; past {}; {}", missing, count, verdict->faults.size(), has_past,
                  trouble));
  return missing == 0 && verdict->faults.empty() && has_past && trouble.empty() ? 0 : 1;
}

std::uint64_t number_in(std::string_view text) {
  std::uint64_t number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

}  // namespace
}  // namespace lapwing::map

int main(int count, char** words) {
  using namespace lapwing::map;
  std::string_view const verb = count > 3 ? words[1] : "";
  if (verb == "write") return write(words[2], words[3], count > 4 ? number_in(words[4]) : 0);
  if (verb == "check" && count > 4) return check(words[2], words[3], static_cast<int>(number_in(words[4])));
  std::fputs("usage: store_hand write ADDRESS WRITER [LEAST_FREE_BYTES] | check ADDRESS WRITER N\n", stderr);
  return 2;
}
