#pragma once

#include <string>

#include "base/error.hpp"

namespace lapwing::host {

/// A secret that lies in a file of its own, which nobody but its owner can read (mode 0600).
struct SecretFile {
  std::string path;
  std::string what;  ///< for people: "token file"
  std::string hint;  ///< how to make one
};
/// Without the blanks around it; at most 64 KiB of text. Errors (invalid_input, not_found, io) never hold any of it.
[[nodiscard]] base::Result<std::string> read_secret(SecretFile const& file);

}  // namespace lapwing::host
