#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "map/store/blobs/blobs.hpp"
#include "map/store/sql/database.hpp"

namespace lapwing::map::care {

struct Limits {
  std::optional<std::uint64_t> most_bytes = {};    ///< of the database and the pictures
  std::optional<std::chrono::hours> longest = {};  ///< of the past
};

/// Takes away a little of what is beyond the limits: the past, and, where that is not enough, pictures, the oldest
/// first. Little enough that who writes waits some ten milliseconds. True: there is more to take away.
[[nodiscard]] base::Result<bool> retain(sql::Database& database, blobs::Bytes& bytes, Limits const& limits,
                                        base::UtcTime now);
/// What counts against the limit: without what has been freed and not been given back to the disk yet.
[[nodiscard]] base::Result<std::uint64_t> bytes_in_use(sql::Database& database);

}  // namespace lapwing::map::care
