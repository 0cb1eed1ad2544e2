#pragma once

#include <memory>
#include <string>

#include "link/byte_link.hpp"

namespace lapwing::link {

namespace internal {
struct PipeBus;
}

/// Two ends in memory: what one sends, the other receives on a later turn of the loop. Works under an unpaced loop,
/// without sockets.
struct Pipe {
  std::unique_ptr<ByteLink> a;
  std::unique_ptr<ByteLink> b;
};
[[nodiscard]] Pipe make_pipe(base::Loop& loop);

/// The in-memory counterpart of udp in: one end that hears every client, each client a peer of its own.
class PipeHub {
 public:
  explicit PipeHub(base::Loop& loop);
  PipeHub(PipeHub const&) = delete;
  PipeHub& operator=(PipeHub const&) = delete;
  ~PipeHub();

  /// The hub's own end. Call once.
  [[nodiscard]] std::unique_ptr<ByteLink> take_server();
  /// A new client; destroying it disconnects it, a later one is another peer (as after a vehicle's reboot).
  [[nodiscard]] std::unique_ptr<ByteLink> connect();
  /// While it is cut nothing arrives at either end.
  void cut(bool is_cut);

 private:
  std::shared_ptr<internal::PipeBus> bus_;  // shared with the ends, any of which may go first
};

}  // namespace lapwing::link
