#pragma once

#include <algorithm>
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

  [[nodiscard]] base::Task<base::Result<>> load(map::LiveMap&) override { co_return base::Result<>(); }
  void follow(map::LiveMap&) override {}
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
  [[nodiscard]] Health health() const override { return {}; }

 private:
  std::map<std::string, Blob> blobs_;
};

}  // namespace lapwing::station::testing
