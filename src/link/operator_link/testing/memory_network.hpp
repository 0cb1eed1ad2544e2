#pragma once

#include <functional>
#include <limits>
#include <list>
#include <memory>
#include <random>
#include <string>

#include "link/operator_link/carrier/byte_stream.hpp"

namespace lapwing::link::operator_link::testing {

/// What becomes of the connections that are made from now on.
struct Weather {
  base::Duration delay{};             ///< of every piece, each way
  std::size_t largest_piece = 65536;  ///< what is written is cut into random pieces of at most so many bytes
  std::size_t dies_after = std::numeric_limits<std::size_t>::max();  ///< bytes, of both ways together
  bool tells_of_its_end = true;                                      ///< otherwise the ends find out by silence
  bool is_deaf = false;                                              ///< the server's end reads nothing
};

namespace internal {
struct Line;
}

/// A network in memory with one listener, for a loop without a pace. Connections can be cut at any byte.
class MemoryNetwork {
 public:
  MemoryNetwork(base::Loop& loop, std::uint64_t seed);
  MemoryNetwork(MemoryNetwork const&) = delete;
  MemoryNetwork& operator=(MemoryNetwork const&) = delete;
  ~MemoryNetwork();

  [[nodiscard]] std::unique_ptr<Listener> listener();
  [[nodiscard]] std::unique_ptr<Dialler> dialler();
  /// Asked for each connection; nothing: nobody is reached.
  std::function<std::optional<Weather>()> weather = [] { return Weather{}; };
  /// Ends all connections.
  void cut();
  [[nodiscard]] std::size_t connections() const { return connections_; }

 private:
  class Waits;
  class Dials;
  [[nodiscard]] std::unique_ptr<ByteStream> connect(Weather of_it);

  base::Loop& loop_;
  std::mt19937_64 random_;
  Listener::Accept accept_;
  std::list<std::shared_ptr<internal::Line>> lines_;  // alone hold them: nothing that is posted does
  std::size_t connections_ = 0;
};

}  // namespace lapwing::link::operator_link::testing
