#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "map/store/blobs/blobs.hpp"
#include "map/store/place/address.hpp"
#include "map/store/write/batch.hpp"

namespace lapwing::map::write {

/// The one connection that writes a store, on whose thread all of this happens.
class Writer {
 public:
  /// Makes the store if there is none; brings an older one up to date. Errors as `Store::open`.
  [[nodiscard]] static base::Result<std::unique_ptr<Writer>> open(Store::Options const& options);

  /// Errors, beside the database's: io when the disk has less room left than it shall have.
  [[nodiscard]] base::Result<Written> write(Batch const& batch);
  [[nodiscard]] base::Result<Written> read_news();
  [[nodiscard]] base::Result<std::string> keep(Store::Blob const& blob, base::UtcTime now);
  /// A little of what is too old, or too much, goes. True: there is more to go.
  [[nodiscard]] base::Result<bool> retain(base::UtcTime now);
  /// Of the database and the pictures.
  [[nodiscard]] std::uint64_t bytes();
  /// What was in the store up to there is known.
  void has_seen(Revision revision) { seen_ = revision; }

 private:
  Writer(Store::Options options, place::Address address, std::optional<place::FolderLock> lock,
         std::unique_ptr<sql::Database> database);
  [[nodiscard]] base::Result<> room_for(std::uint64_t bytes) const;

  Store::Options options_;
  place::Address address_;
  std::optional<place::FolderLock> lock_;
  std::unique_ptr<sql::Database> database_;
  std::unique_ptr<blobs::Bytes> bytes_;
  Revision seen_ = 0;
};

}  // namespace lapwing::map::write
