#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "map/store/blobs/blobs.hpp"
#include "map/store/sql/sqlite.hpp"

/// Where a store is: a folder on this machine, or a database on a server.
namespace lapwing::map::place {

class Address {
 public:
  /// A folder, or "postgresql://user@host/database" (also "postgres://").
  explicit Address(std::string text);

  [[nodiscard]] bool is_server() const { return is_server_; }
  /// For people: without a password.
  [[nodiscard]] std::string name() const;
  [[nodiscard]] std::string const& text() const { return text_; }
  /// Preconditions of these: no server.
  [[nodiscard]] std::filesystem::path folder() const { return text_; }
  [[nodiscard]] std::filesystem::path database() const { return folder() / "map.gpkg"; }
  [[nodiscard]] std::filesystem::path pictures() const { return folder() / "blobs"; }

 private:
  std::string text_;
  bool is_server_;
};

/// One program writes a folder. The operating system takes the lock back however the program ends.
class FolderLock {
 public:
  /// Makes the folder if it is not there. Errors: refused, another program has it; io.
  [[nodiscard]] static base::Result<FolderLock> take(Address const& address);
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&&) = delete;
  ~FolderLock();

 private:
  explicit FolderLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

/// Its database, as it is: whether it holds a store is another question. To read, a folder must be there.
[[nodiscard]] base::Result<std::unique_ptr<sql::Database>> open_database(Address const& address, sql::Access access);
[[nodiscard]] std::unique_ptr<blobs::Bytes> open_bytes(Address const& address, sql::Database& database);

/// On the folder's disk; nothing for a server, which knows for itself.
[[nodiscard]] std::optional<std::uint64_t> free_bytes(Address const& address);

}  // namespace lapwing::map::place
