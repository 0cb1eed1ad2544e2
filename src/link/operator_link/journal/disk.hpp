#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/async/loop.hpp"
#include "base/error.hpp"
#include "link/byte_link.hpp"

namespace lapwing::link::operator_link {

/// Files of one folder, as far as a journal needs them.
class Disk {
 public:
  struct File {
    std::string name;
    std::uint64_t size = 0;
  };
  using Synced = std::function<void(base::Result<>)>;
  virtual ~Disk() = default;

  /// For people.
  [[nodiscard]] virtual std::string name() const = 0;
  [[nodiscard]] virtual base::Result<std::vector<File>> list() = 0;
  /// At most `most` bytes from `offset` on; fewer at its end.
  [[nodiscard]] virtual base::Result<std::vector<std::uint8_t>> read(std::string const& file, std::uint64_t offset,
                                                                     std::size_t most) = 0;
  /// All of it or nothing, at the file's end; makes the file. When this returns the operating system has it: the end of
  /// the process loses nothing. Error (io): says when the disk is full.
  [[nodiscard]] virtual base::Result<> append(std::string const& file, Bytes bytes) = 0;
  [[nodiscard]] virtual base::Result<> cut(std::string const& file, std::uint64_t size) = 0;
  [[nodiscard]] virtual base::Result<> remove(std::string const& file) = 0;
  /// Calls `done` on the loop once all that was appended before is on the disk itself: loss of power loses nothing.
  /// Not after the disk's end.
  virtual void sync(Synced done) = 0;
};

/// The folder of a file system, made if it is not there and held for this process alone; waits for the disk on a thread
/// of its own. Error (io, refused): not to be made, read or written, or another program has it.
[[nodiscard]] base::Result<std::unique_ptr<Disk>> open_folder(base::Loop& loop, std::filesystem::path const& path);

}  // namespace lapwing::link::operator_link
