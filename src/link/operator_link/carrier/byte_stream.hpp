#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "base/async/task.hpp"
#include "base/error.hpp"
#include "link/byte_link.hpp"

namespace lapwing::link::operator_link {

/// One connection that carries bytes both ways, in order, until it ends; it does not come back. Destroying it closes
/// it; it must not be destroyed from within its own callbacks.
class ByteStream {
 public:
  struct Events {
    std::function<void(Bytes)> data;
    std::function<void()> drained;               ///< `backlog()` is zero again
    std::function<void(std::string why)> ended;  ///< once, and nothing after it
  };
  virtual ~ByteStream() = default;

  /// For people: the far end's address.
  [[nodiscard]] virtual std::string peer_name() const = 0;
  /// Call once; nothing is read before.
  virtual void start(Events events) = 0;
  /// Takes everything. Who looks at `backlog()` before keeps it bounded.
  virtual void write(Bytes bytes) = 0;
  /// Bytes that the operating system has not taken.
  [[nodiscard]] virtual std::size_t backlog() const = 0;
  /// While it is paused nothing is read, and the far end soon finds that it cannot write.
  virtual void pause(bool is_paused) = 0;
  /// What the operating system takes at once still goes out; nothing is told any more.
  virtual void close() = 0;
};

/// Waits for connections.
class Listener {
 public:
  using Accept = std::function<void(std::unique_ptr<ByteStream>)>;
  virtual ~Listener() = default;
  /// For people: the address that it waits on.
  [[nodiscard]] virtual std::string name() const = 0;
  [[nodiscard]] virtual std::uint16_t port() const = 0;
  /// Call once.
  virtual void start(Accept accept) = 0;
};

/// Makes connections to one place.
class Dialler {
 public:
  virtual ~Dialler() = default;
  [[nodiscard]] virtual std::string name() const = 0;
  /// Error (lost, timed_out): nobody is there now. Destroying the task gives up.
  [[nodiscard]] virtual base::Task<base::Result<std::unique_ptr<ByteStream>>> dial() = 0;
};

}  // namespace lapwing::link::operator_link
