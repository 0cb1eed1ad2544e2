#pragma once

#include <memory>

#include "map/store/blobs/blobs.hpp"
#include "map/store/place/address.hpp"
#include "map/store/sql/database.hpp"

namespace lapwing::map {

/// A connection that only reads, and the pictures: what goes to a thread of its own.
struct Reader {
  std::unique_ptr<sql::Database> database;
  std::unique_ptr<blobs::Bytes> bytes;

  /// Of a place where a store is.
  [[nodiscard]] static base::Result<std::unique_ptr<Reader>> open(place::Address const& address) {
    auto database = place::open_database(address, sql::Access::read);
    if (!database) return std::unexpected(database.error());
    auto bytes = place::open_bytes(address, **database);
    return std::make_unique<Reader>(std::move(*database), std::move(bytes));
  }
};

}  // namespace lapwing::map
