#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/async/loop.hpp"
#include "base/async/task.hpp"
#include "base/error.hpp"
#include "map/live/live_map.hpp"
#include "map/store/past_grid.hpp"
#include "map/store/picture_store.hpp"

namespace lapwing::map {

/// Where the map is kept: a folder (a GeoPackage, and pictures in files by their hash) or a PostGIS database, which
/// several stations share, pictures and all. docs/reference/store.md has what is kept, and how.
///
/// One connection writes, on a thread of its own; nothing here waits for the disk on the loop. What is told to be
/// accepted has been committed. A store that cannot take any more (disk full, database away) refuses before it accepts,
/// keeps what it has, tries again, and says both.
class Store : public PictureStore {
 public:
  struct Options {
    std::string address;                                ///< a folder, made if it is not there, or postgresql://...
    std::optional<std::uint64_t> most_bytes = {};       ///< the oldest history and pictures go first
    std::optional<std::chrono::hours> longest = {};     ///< history older than this goes
    std::uint64_t least_free_bytes = 64 * 1024 * 1024;  ///< on the disk: with less, writing is refused
  };

  /// Errors: io; refused for a store of a newer program, or one that another program writes; invalid_input for a file
  /// that is no store. Older ones are migrated, whole or not at all.
  [[nodiscard]] static base::Result<std::unique_ptr<Store>> open(base::Loop& loop, Options options);

  /// Everything that is kept of the map, into an empty one: for the start. What cannot be read is left out, and told by
  /// `health`.
  [[nodiscard]] virtual base::Task<base::Result<>> load(LiveMap& into) = 0;
  /// Writes the map's sites, and what changes in it from now on; and of a shared store puts into it what other stations
  /// write. Ends with the store, which the map outlives, and which writes what is left to be written.
  virtual void follow(LiveMap& map) = 0;
  /// All that has changed so far is committed, or the error says what is not.
  [[nodiscard]] virtual base::Task<base::Result<>> flush() = 0;

  /// One frame of what viewers were shown (`station::Feed`), with its time: the past is kept as it was seen.
  struct Shown {
    base::UtcTime at;
    std::string session;  ///< one run of a station
    std::string feed;
    bool is_whole = false;  ///< what was shown before does not count any more
    bool is_binary = false;
    std::string content;
  };
  /// Takes it at once and writes it with the next batch; frames are lost rather than that memory grows without bound,
  /// and the number of lost ones is told.
  virtual void record(Shown shown) = 0;
  /// False while more waits to be written than is well: who records leaves moments out then, rather than lose frames.
  [[nodiscard]] virtual bool is_ready_to_record() const = 0;
  /// Keeps how the grids of the map that it follows look now, of which only what has changed costs anything; `at` is
  /// not before that of the call before. Ends when that is ready to be written; one at a time.
  [[nodiscard]] virtual base::Task<> record_grids(std::string session, base::UtcTime at) = 0;
  /// For people; a session that has no name is called by its id.
  virtual void name_session(std::string id, std::string name) = 0;
  struct Session {
    std::string id;
    std::string name;
    base::UtcTime began;
    base::UtcTime ended;
  };
  [[nodiscard]] virtual base::Task<base::Result<std::vector<Session>>> sessions() = 0;
  /// What leads to the state of each feed at `at`: from its last whole before it on, in the order of time.
  [[nodiscard]] virtual base::Task<base::Result<std::vector<Shown>>> state_at(std::string session,
                                                                              base::UtcTime at) = 0;
  /// In [from, to), in the order of time: at most `most`, and then the rest of those that share the last one's time.
  [[nodiscard]] virtual base::Task<base::Result<std::vector<Shown>>> shown(std::string session, base::UtcTime from,
                                                                           base::UtcTime to, std::size_t most) = 0;
  /// The grids of a moment; how their tiles looked is asked for by name.
  [[nodiscard]] virtual base::Task<base::Result<PastGrids>> grids_at(std::string session, base::UtcTime at) = 0;
  /// Those of them that are kept still.
  [[nodiscard]] virtual base::Task<base::Result<PastShades>> shades(std::vector<std::string> names) = 0;

  struct Health {
    bool is_writing = true;
    std::string trouble = {};   ///< what is wrong and what to do about it; empty: nothing
    std::uint64_t bytes = 0;    ///< of the database and the pictures, some seconds ago
    std::uint64_t waiting = 0;  ///< changes that are not committed yet
    std::uint64_t lost_frames = 0;
  };
  [[nodiscard]] virtual Health health() const = 0;
};

}  // namespace lapwing::map
