#pragma once

#include <algorithm>
#include <deque>

#include "link/operator_link/journal/durable_queue.hpp"

namespace lapwing::link::operator_link {

/// A queue that ends with the process: where no folder is given.
class MemoryQueue final : public DurableQueue {
 public:
  MemoryQueue(std::uint64_t stream, std::size_t most_bytes) : stream_(stream), most_bytes_(most_bytes) {}

  void listen(Events) override {}
  [[nodiscard]] std::uint64_t stream() const override { return stream_; }
  [[nodiscard]] std::uint64_t first() const override { return entries_.empty() ? next_ : entries_.front().number; }
  [[nodiscard]] std::uint64_t next() const override { return next_; }
  [[nodiscard]] std::uint64_t ready() const override { return next_ - 1; }
  [[nodiscard]] std::size_t bytes() const override { return bytes_; }
  [[nodiscard]] std::size_t most_bytes() const override { return most_bytes_; }
  [[nodiscard]] base::Result<std::uint64_t> append(std::string_view key, std::string_view text) override;
  [[nodiscard]] base::Result<std::optional<Entry>> read(std::uint64_t number) override;
  void acknowledge(std::uint64_t number) override;
  void skip_to(std::uint64_t number) override { next_ = std::max(next_, number); }
  void note_taken(Mark mark) override { taken_ = mark; }
  [[nodiscard]] Mark taken() const override { return taken_; }

 private:
  std::uint64_t stream_;
  std::size_t most_bytes_;
  std::deque<Entry> entries_;
  std::uint64_t next_ = 1;
  std::size_t bytes_ = 0;
  Mark taken_;
};

}  // namespace lapwing::link::operator_link
