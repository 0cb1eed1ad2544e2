#pragma once

#include <string>

#include "base/async/task.hpp"
#include "base/error.hpp"

namespace lapwing::map {

/// Where the pictures of the map are kept, by their hash (SHA-256, hex).
class PictureStore {
 public:
  virtual ~PictureStore() = default;

  struct Blob {
    std::string bytes;
    std::string media_type;
  };
  /// The hash, once the bytes are kept for good. Errors: refused where there is no room for them; io.
  [[nodiscard]] virtual base::Task<base::Result<std::string>> keep(std::string bytes, std::string media_type) = 0;
  /// Errors: not_found; io, also for bytes that are not what their hash says.
  [[nodiscard]] virtual base::Task<base::Result<Blob>> blob(std::string hash) = 0;
};

}  // namespace lapwing::map
