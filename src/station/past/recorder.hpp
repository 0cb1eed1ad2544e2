#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/async/loop.hpp"
#include "map/store/store.hpp"
#include "station/feeds/feed.hpp"

namespace lapwing::station {

/// Keeps what viewers are shown, as they are shown it, so that looking back needs no second way to draw anything.
///
/// It takes each feed as one more viewer would. What there is of grids besides their feed's news (which tiles changed)
/// is how these look, which the store packs; the two are kept together, so that who is told of news finds it. Now and
/// then a feed is kept whole: once what followed the last whole has grown to some times its size, which bounds both
/// what is kept and what must be read to come to any moment.
class Recorder {
 public:
  struct Options {
    std::string session;  ///< of this run of the station, by which it is found again
    /// A whole is kept anew when what followed it is this many times larger...
    double growth = 4.0;
    /// ...and after this time in any case, for what came before it is thrown away one day.
    std::chrono::minutes longest_without_whole{15};
  };

  /// The feeds and the store outlive the recorder.
  Recorder(base::Loop& loop, std::vector<Feed*> const& feeds, map::Store& store, Options options);

  /// Keeps what is new of every feed but that of grids; called as often as is worth keeping.
  void keep();
  /// Keeps what is new of grids, and how their tiles look. Ends when it is ready to be kept; one at a time.
  [[nodiscard]] base::Task<> keep_grids();

 private:
  struct Track {
    Feed* feed = nullptr;
    std::uint16_t id = 0;
    std::uint64_t revision = 0;   ///< that is kept
    std::size_t whole_bytes = 0;  ///< of the last whole
    std::size_t bytes_since = 0;  ///< that followed it
    base::TimePoint whole_at = {};
  };
  void keep(Track& track, base::TimePoint now, base::UtcTime utc);
  [[nodiscard]] base::UtcTime moment() const;
  [[nodiscard]] bool wants_whole(Track const& track, base::TimePoint now) const;

  base::Loop& loop_;
  map::Store& store_;
  Options options_;
  std::vector<Track> tracks_;
};

}  // namespace lapwing::station
