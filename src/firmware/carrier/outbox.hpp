#pragma once

#include <array>
#include <cstddef>

#include "firmware/frames/records.hpp"

namespace lapwing::firmware {

/// What waits to be told to the host: a ring that forgets its oldest when it is full, since what is newer explains
/// more.
template <class T, std::size_t most>
class Ring {
 public:
  void push(T const& what) {
    items_[(first_ + size_) % most] = what;
    if (size_ < most)
      ++size_;
    else
      first_ = (first_ + 1) % most;
  }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  /// Precondition: not empty.
  [[nodiscard]] T const& front() const { return items_[first_]; }
  void pop() {
    first_ = (first_ + 1) % most;
    --size_;
  }

 private:
  std::array<T, most> items_{};
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

struct Outbox {
  Ring<Completed, 4> completed;
  Ring<Log, 16> logs;

  void log(Time now, LogCode code, std::int32_t value = 0) { logs.push({.time = now, .code = code, .value = value}); }
};

}  // namespace lapwing::firmware
