#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "base/async/loop.hpp"
#include "base/error.hpp"
#include "link/pictures/picture.hpp"

namespace lapwing::link::pictures {

struct ServeSettings {
  std::string address = "127.0.0.1";
  std::uint16_t port = default_port;  ///< 0 picks a free one
  std::size_t most_viewers = 8;
  std::string token = {};  ///< what viewers say to be let in; empty: everybody who reaches the port is
};

/// Offers the newest picture of each view to whoever looks: any browser, or a PictureClient. A viewer that is slow
/// misses pictures: one is on its way to it and one waits, which the next one replaces. It keeps nobody waiting.
/// Thread-bound to its loop, which outlives it.
class PictureServer {
 public:
  /// Errors: invalid_input, other machines reach the address and there is no token; io, the port is taken, or the
  /// address is not this machine's.
  [[nodiscard]] static base::Result<std::unique_ptr<PictureServer>> open(base::Loop& loop,
                                                                         ServeSettings const& settings);
  ~PictureServer();
  PictureServer(PictureServer const&) = delete;
  PictureServer& operator=(PictureServer const&) = delete;

  [[nodiscard]] std::uint16_t port() const;
  /// Whether anybody looks at it: if not, nobody need encode it.
  [[nodiscard]] bool is_watched(View view) const;
  void offer(View view, Picture const& picture);

 private:
  class Core;
  explicit PictureServer(std::shared_ptr<Core> core);
  std::shared_ptr<Core> core_;  // shared with viewers, which end a turn later
};

}  // namespace lapwing::link::pictures
