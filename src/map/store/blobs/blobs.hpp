#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/time.hpp"
#include "map/store/sql/database.hpp"
#include "map/store/store.hpp"

/// Pictures by the hash of their bytes: what is kept twice is there once, and what is damaged shows.
namespace lapwing::map::blobs {

/// More in one piece is refused: it goes through memory.
inline constexpr std::size_t most_bytes = 256 * 1024 * 1024;

/// Where the bytes are. Of one thread at a time.
class Bytes {
 public:
  virtual ~Bytes() = default;
  /// On the disk when it returns, or, in a transaction, with its commit.
  [[nodiscard]] virtual base::Result<> write(std::string const& hash, std::string const& bytes) = 0;
  /// Errors: not_found; io.
  [[nodiscard]] virtual base::Result<std::string> read(std::string const& hash) = 0;
  virtual void remove(std::string const& hash) = 0;
  [[nodiscard]] virtual base::Result<std::vector<std::string>> all_hashes() = 0;
  /// What an interrupted write has left behind; how many.
  virtual std::size_t remove_leftovers() = 0;
};

/// Files in the folder: `ab/cdef...`, each written beside its place and moved there, so that a name always has all its
/// bytes behind it.
[[nodiscard]] std::unique_ptr<Bytes> in_folder(std::filesystem::path folder);
/// Rows of the table `blob_bytes`: several stations on several machines share them.
[[nodiscard]] std::unique_ptr<Bytes> in_table(sql::Database& database);

/// The bytes, then the row that tells of them, so that no row is without. Gives the hash. Error, invalid_input: too
/// many.
[[nodiscard]] base::Result<std::string> keep(sql::Database& database, Bytes& bytes, Store::Blob const& blob,
                                             base::UtcTime now);
/// Errors: not_found; io, also for bytes of another hash.
[[nodiscard]] base::Result<Store::Blob> read(sql::Database& database, Bytes& bytes, std::string const& hash);

}  // namespace lapwing::map::blobs
