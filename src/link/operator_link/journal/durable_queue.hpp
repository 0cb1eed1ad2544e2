#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace lapwing::link::operator_link {

/// What must not be lost on its way to one far end, in order, until that has taken it; and what of the far end's own
/// has been taken here. Numbers begin with one and have gaps only where a disk lost something.
class DurableQueue {
 public:
  struct Entry {
    std::uint64_t number = 0;
    std::string key;
    std::string text;
  };
  /// Of the far end's stream, the last that was taken here.
  struct Mark {
    std::uint64_t stream = 0;
    std::uint64_t number = 0;
    friend bool operator==(Mark const&, Mark const&) = default;
  };
  struct Events {
    std::function<void()> ready;                  ///< `ready()` has grown
    std::function<void(std::string what)> fault;  ///< for people: what the disk does not do
  };
  virtual ~DurableQueue() = default;

  virtual void listen(Events events) = 0;
  [[nodiscard]] virtual std::uint64_t stream() const = 0;
  /// The oldest that is not acknowledged; `next()` when there is none.
  [[nodiscard]] virtual std::uint64_t first() const = 0;
  /// The number that the next one will have.
  [[nodiscard]] virtual std::uint64_t next() const = 0;
  /// Those up to this number are kept as well as they will be, and may be sent.
  [[nodiscard]] virtual std::uint64_t ready() const = 0;
  /// What it takes, of memory or disk.
  [[nodiscard]] virtual std::size_t bytes() const = 0;
  [[nodiscard]] virtual std::size_t most_bytes() const = 0;
  /// Its number. When this returns, the end of the process cannot lose it any more. Error: refused (full), io (the disk
  /// is full or fails).
  [[nodiscard]] virtual base::Result<std::uint64_t> append(std::string_view key, std::string_view text) = 0;
  /// The first with at least this number; none when there is none. Error (io).
  [[nodiscard]] virtual base::Result<std::optional<Entry>> read(std::uint64_t number) = 0;
  /// All up to this number need not be kept any longer.
  virtual void acknowledge(std::uint64_t number) = 0;
  /// The far end has numbers that this disk has lost: those that come get others.
  virtual void skip_to(std::uint64_t number) = 0;
  virtual void note_taken(Mark mark) = 0;
  [[nodiscard]] virtual Mark taken() const = 0;
};

}  // namespace lapwing::link::operator_link
