#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace lapwing::autonomy {

/// The folder of the drone's settings, by the few steps of which each can be the last before the power goes.
class Folder {
 public:
  Folder() = default;
  Folder(Folder const&) = delete;
  Folder& operator=(Folder const&) = delete;
  virtual ~Folder() = default;

  /// Nothing when there is none of that name. At most `most` bytes of it.
  [[nodiscard]] virtual base::Result<std::optional<std::string>> read(std::string const& name, std::size_t most) = 0;
  /// A new file in place of one of that name; its content is on the disk afterwards, its name not yet.
  [[nodiscard]] virtual base::Result<> write_through(std::string const& name, std::string_view content) = 0;
  /// Takes the place of one that has the new name.
  [[nodiscard]] virtual base::Result<> rename(std::string const& from, std::string const& to) = 0;
  /// All names are on the disk afterwards.
  [[nodiscard]] virtual base::Result<> sync_names() = 0;
};

/// One of the operating system's, made where there is none. Error (io): it cannot be made or opened.
[[nodiscard]] base::Result<std::unique_ptr<Folder>> open_folder(std::filesystem::path const& path);

}  // namespace lapwing::autonomy
