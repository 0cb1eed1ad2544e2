#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "map/store/sql/database.hpp"
#include "map/store/store.hpp"

/// What viewers were shown, in chunks: the frames of one feed that were written with one batch.
namespace lapwing::map::rows {

/// In the order in which they came; `name` is that of the session.
[[nodiscard]] base::Result<> write_shown(sql::Database& database, std::vector<Store::Shown> const& frames);
[[nodiscard]] base::Result<> name_session(sql::Database& database, Store::Session const& session);

[[nodiscard]] base::Result<std::vector<Store::Session>> read_sessions(sql::Database& database);
/// As `Store::state_at` and `Store::shown`; of one feed, or (empty) of all.
[[nodiscard]] base::Result<std::vector<Store::Shown>> state_at(sql::Database& database, std::string const& session,
                                                               base::UtcTime at, std::string const& of_feed = {});
[[nodiscard]] base::Result<std::vector<Store::Shown>> shown_between(sql::Database& database, std::string const& session,
                                                                    base::UtcTime from, base::UtcTime to,
                                                                    std::size_t most);

/// Frames of one feed of one session as the content of a chunk. For each: 64 bits nanoseconds since 1970, 8 bits (1:
/// whole, 2: binary), 32 bits length, content; all little endian; the whole as a zlib stream.
[[nodiscard]] std::string packed(std::vector<Store::Shown const*> const& frames);
/// Nothing for what is no chunk.
[[nodiscard]] std::optional<std::vector<Store::Shown>> unpacked(std::string_view content, std::string const& session,
                                                                std::string const& feed);

}  // namespace lapwing::map::rows
