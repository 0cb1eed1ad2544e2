#pragma once

#include <string>

#include "host/station/web_access.hpp"

namespace lapwing::apps {

struct StoreReplay {
  std::string address;  ///< of a store
  std::string session;  ///< its name or id; empty: the newest
  host::WebArguments web;
};

/// Serves the map with a session of a store to look back at, until Ctrl-C; gives the exit code.
[[nodiscard]] int replay_store(StoreReplay const& options);

}  // namespace lapwing::apps
