#pragma once

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/async/loop.hpp"
#include "link/operator_link/journal/disk.hpp"

namespace lapwing::link::operator_link::testing {

/// What is on a disk in memory: outlives the `Disk` that writes it, as files do the process.
struct Platter {
  std::map<std::string, std::vector<std::uint8_t>> files;
  std::map<std::string, std::vector<std::uint8_t>> synced;
  std::size_t room = std::numeric_limits<std::size_t>::max();
  std::size_t dies_after = std::numeric_limits<std::size_t>::max();  ///< bytes: what is written then is torn
  bool sync_fails = false;
  std::size_t syncs = 0;

  /// What the disk itself does not have is gone.
  void lose_power() { files = synced; }
};

class MemoryDisk final : public Disk {
 public:
  MemoryDisk(base::Loop& loop, Platter& platter) : loop_(loop), platter_(platter) {}

  [[nodiscard]] std::string name() const override { return "memory"; }
  base::Result<std::vector<File>> list() override {
    std::vector<File> files;
    for (auto const& [name, content] : platter_.files) files.push_back({name, content.size()});
    return files;
  }
  base::Result<std::vector<std::uint8_t>> read(std::string const& file, std::uint64_t offset,
                                               std::size_t most) override {
    auto const& content = platter_.files[file];
    auto const begin = std::min<std::size_t>(offset, content.size());
    auto const size = std::min(most, content.size() - begin);
    return std::vector<std::uint8_t>(content.begin() + static_cast<std::ptrdiff_t>(begin),
                                     content.begin() + static_cast<std::ptrdiff_t>(begin + size));
  }
  base::Result<> append(std::string const& file, Bytes bytes) override {
    std::size_t used = 0;
    for (auto const& [name, content] : platter_.files) used += content.size();
    if (used + bytes.size() > platter_.room)
      return base::fail(base::ErrorKind::io, "cannot write: No space left on device", "Make room on that disk.");
    auto const size = std::min(bytes.size(), platter_.dies_after);
    platter_.dies_after -= platter_.dies_after == std::numeric_limits<std::size_t>::max() ? 0 : size;
    platter_.files[file].insert(platter_.files[file].end(), bytes.begin(),
                                bytes.begin() + static_cast<std::ptrdiff_t>(size));
    return {};
  }
  base::Result<> cut(std::string const& file, std::uint64_t size) override {
    platter_.files[file].resize(static_cast<std::size_t>(size));
    return {};
  }
  base::Result<> remove(std::string const& file) override {
    platter_.files.erase(file);
    return {};
  }
  void sync(Synced done) override {
    ++platter_.syncs;
    loop_.post([this, done = std::move(done), alive = std::weak_ptr(alive_)] {
      if (alive.expired()) return;
      if (platter_.sync_fails) return done(base::fail(base::ErrorKind::io, "cannot write through: Input/output error"));
      platter_.synced = platter_.files;
      done({});
    });
  }

 private:
  base::Loop& loop_;
  Platter& platter_;
  std::shared_ptr<int> alive_ = std::make_shared<int>(0);
};

}  // namespace lapwing::link::operator_link::testing
