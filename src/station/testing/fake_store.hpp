#pragma once

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "map/store/store.hpp"

namespace lapwing::station::testing {

/// A store in memory that keeps what was shown, and bytes under names of its own.
class FakeStore final : public map::Store {
 public:
  std::vector<Shown> kept;
  std::vector<Session> known;
  map::LiveMap const* followed = nullptr;
  bool is_ready = true;
  std::size_t asked_for_grids = 0;
  std::size_t asked_for_shades = 0;

  [[nodiscard]] base::Task<base::Result<>> load(map::LiveMap&) override { co_return base::Result<>(); }
  void follow(map::LiveMap& map) override { followed = &map; }
  [[nodiscard]] base::Task<base::Result<>> flush() override { co_return base::Result<>(); }

  [[nodiscard]] base::Task<base::Result<std::string>> keep(std::string bytes, std::string media_type) override {
    auto name = std::to_string(blobs_.size() + 1);
    blobs_[name] = {std::move(bytes), std::move(media_type)};
    co_return name;
  }
  [[nodiscard]] base::Task<base::Result<Blob>> blob(std::string hash) override {
    auto const found = blobs_.find(hash);
    if (found == blobs_.end()) co_return base::fail(base::ErrorKind::not_found, "no such blob");
    co_return found->second;
  }

  void name_session(std::string, std::string) override {}
  void record(Shown shown) override { kept.push_back(std::move(shown)); }
  [[nodiscard]] base::Task<base::Result<std::vector<Session>>> sessions() override { co_return known; }
  [[nodiscard]] base::Task<base::Result<std::vector<Shown>>> state_at(std::string session, base::UtcTime at) override {
    std::map<std::string, std::vector<Shown>> feeds;
    for (auto const& shown : kept) {
      if (shown.session != session || shown.at > at) continue;
      if (shown.is_whole) feeds[shown.feed].clear();
      feeds[shown.feed].push_back(shown);
    }
    std::vector<Shown> all;
    for (auto const& [name, frames] : feeds) all.insert(all.end(), frames.begin(), frames.end());
    std::ranges::stable_sort(all, {}, &Shown::at);
    co_return all;
  }
  [[nodiscard]] base::Task<base::Result<std::vector<Shown>>> shown(std::string session, base::UtcTime from,
                                                                   base::UtcTime to, std::size_t most) override {
    std::vector<Shown> found;
    for (auto const& one : kept) {
      if (one.session != session || one.at < from || one.at >= to) continue;
      if (found.size() >= most && one.at != found.back().at) break;
      found.push_back(one);
    }
    co_return found;
  }
  [[nodiscard]] bool is_ready_to_record() const override { return is_ready; }
  /// Of the map that it was given.
  [[nodiscard]] base::Task<> record_grids(std::string session, base::UtcTime at) override {
    if (!followed) co_return;
    auto& moment = grids_[session][at];
    for (auto const& [key, record] : followed->grids()) {
      auto& grid = moment[key];
      grid.place = {record.grid.resolution_m(), record.grid.site_from_grid(), followed->site(key.site)->anchor()};
      for (auto const& [tile, cells] : record.grid.tiles()) {
        auto shades = std::make_shared<map::TileShades const>(map::shades_of(*cells));
        auto const alike = std::ranges::find_if(shades_, [&](auto const& one) { return *one.second == *shades; });
        auto const name = alike == shades_.end() ? std::to_string(shades_.size()) : alike->first;
        shades_.emplace(name, std::move(shades));
        grid.tiles[tile] = name;
      }
    }
  }
  [[nodiscard]] base::Task<base::Result<map::PastGrids>> grids_at(std::string session, base::UtcTime at) override {
    ++asked_for_grids;
    auto const& moments = grids_[session];
    auto const next = moments.upper_bound(at);
    co_return next == moments.begin() ? map::PastGrids() : std::prev(next)->second;
  }
  [[nodiscard]] base::Task<base::Result<map::PastShades>> shades(std::vector<std::string> names) override {
    asked_for_shades += names.size();
    map::PastShades found;
    for (auto const& name : names)
      if (auto const one = shades_.find(name); one != shades_.end()) found.insert(*one);
    co_return found;
  }
  [[nodiscard]] Health health() const override { return {}; }

 private:
  std::map<std::string, Blob> blobs_;
  std::map<std::string, std::map<base::UtcTime, map::PastGrids>> grids_;
  map::PastShades shades_;
};

}  // namespace lapwing::station::testing
