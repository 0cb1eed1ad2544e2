#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "map/live/live_map.hpp"
#include "map/store/write/batch.hpp"

namespace lapwing::map::write {

/// A content of that layer with nothing in it: what stands in records of removed features.
[[nodiscard]] Content nothing_of(LayerKind layer);

/// Keys of what has changed, in the order in which it first did. What changes again meanwhile is written once.
template <class Key>
class Changed {
 public:
  void note(Key key, std::uint64_t number) {
    auto const [known, is_new] = numbers_.emplace(key, number);
    if (!is_new) {
      if (known->second <= number) return;
      auto const [first, last] = in_order_.equal_range(known->second);
      in_order_.erase(std::find_if(first, last, [&](auto const& entry) { return entry.second == key; }));
      known->second = number;
    }
    in_order_.emplace(number, std::move(key));
  }
  /// The oldest, at most so many.
  std::vector<std::pair<std::uint64_t, Key>> take(std::size_t most) {
    std::vector<std::pair<std::uint64_t, Key>> taken;
    while (!in_order_.empty() && taken.size() < most) {
      auto oldest = in_order_.extract(in_order_.begin());
      numbers_.erase(oldest.mapped());
      taken.emplace_back(oldest.key(), std::move(oldest.mapped()));
    }
    return taken;
  }
  [[nodiscard]] std::size_t size() const { return numbers_.size(); }
  [[nodiscard]] std::optional<std::uint64_t> oldest() const {
    return in_order_.empty() ? std::nullopt : std::optional(in_order_.begin()->first);
  }

 private:
  std::map<Key, std::uint64_t> numbers_;
  std::multimap<std::uint64_t, Key> in_order_;
};

/// What has changed on the map and is not committed yet. Of the map only names are kept, and what they stand for is
/// looked up when it is written: however long the disk is full, this grows no larger than the map.
class Pending {
 public:
  void note(MapChange const& change);
  void note(FeatureKey key) { features_.note(std::move(key), ++last_); }
  void note(GridKey const& grid, TileKey tile) { tiles_.note({grid, tile}, ++last_); }
  void name(Store::Session session);
  /// False when there is no room for it: it is lost.
  bool record(Store::Shown shown);
  /// How tiles of grids look, and which still look as they did; goes with the frames.
  void record(std::vector<past::PackedShades> shades, std::vector<std::string> listed, base::UtcTime at);
  /// Little enough waits.
  [[nodiscard]] bool is_ready_to_record() const;

  /// What can wait: the more comes together, the less there is to write.
  struct Slow {
    bool tiles;
    bool frames;
  };
  /// The next batch, with what the map says now. Until `committed` or `give_back` there is no other.
  [[nodiscard]] Batch take(LiveMap const* map, Slow with);
  /// But for these, which go on waiting as the changes that they were.
  void committed(PassedOver const& passed_over);
  /// It was not written. Frames come back if there is room.
  void give_back(Batch batch);

  [[nodiscard]] bool has_quick() const { return sites_.size() > 0 || features_.size() > 0 || session_; }
  [[nodiscard]] bool has_tiles() const { return tiles_.size() > 0; }
  [[nodiscard]] bool has_frames() const { return !frames_.empty() || !shades_.empty(); }
  [[nodiscard]] bool is_empty() const { return !has_quick() && !has_tiles() && !has_frames(); }
  /// So much that nothing is gained by waiting.
  [[nodiscard]] bool fills_a_batch() const;
  /// Changes that are not committed, those on their way among them.
  [[nodiscard]] std::size_t waiting() const;
  /// The number of the last change; and of the oldest that is not committed.
  [[nodiscard]] std::uint64_t last() const { return last_; }
  [[nodiscard]] std::optional<std::uint64_t> oldest() const;

 private:
  struct OnTheirWay {
    std::vector<std::pair<std::uint64_t, std::string>> sites;
    std::vector<std::pair<std::uint64_t, FeatureKey>> features;
    std::vector<std::pair<std::uint64_t, TileName>> tiles;
    std::optional<std::uint64_t> frames;
  };
  void take_features(Batch& batch, LiveMap const& map);
  void take_tiles(Batch& batch, LiveMap const& map);

  std::uint64_t last_ = 0;
  Changed<std::string> sites_;
  Changed<FeatureKey> features_;
  Changed<TileName> tiles_;
  std::optional<Store::Session> session_;
  std::vector<Store::Shown> frames_;
  std::size_t frame_bytes_ = 0;
  std::uint64_t first_frame_ = 0;  ///< the number of the oldest of them
  std::vector<past::PackedShades> shades_;
  std::vector<std::string> listed_shades_;
  base::UtcTime shades_at_;
  OnTheirWay way_;
};

}  // namespace lapwing::map::write
