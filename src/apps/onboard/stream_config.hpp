#pragma once

#include <filesystem>
#include <optional>

#include "base/config.hpp"
#include "link/pictures/picture_server.hpp"

namespace lapwing::apps {

/// The table `[stream]`, which who offers the pictures reads and who hands them on.
struct StreamConfig {
  link::pictures::ServeSettings serve = {};  ///< without its token
  double pictures_a_s = 10.0;                ///< at most, while somebody looks
  std::filesystem::path token_file = {};     ///< empty: who looks needs no token
};

/// Nothing where there is no such table. Paths count from `beside`.
[[nodiscard]] std::optional<StreamConfig> read_stream(base::ConfigReader& root, std::filesystem::path const& beside);

/// The token's file, read. Errors: those of `read_secret`.
[[nodiscard]] base::Result<std::string> stream_token(std::filesystem::path const& file);

}  // namespace lapwing::apps
