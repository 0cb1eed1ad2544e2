#include "link/operator_link/journal/memory_queue.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace lapwing::link::operator_link {

namespace {

/// What a message costs beside its text and key.
constexpr std::size_t overhead = 64;

std::size_t cost(std::string_view key, std::string_view text) {
  return key.size() + text.size() + overhead;
}

}  // namespace

base::Result<std::uint64_t> MemoryQueue::append(std::string_view key, std::string_view text) {
  if (bytes_ + cost(key, text) > most_bytes_)
    return base::fail(base::ErrorKind::refused,
                      fmt::format("{} bytes wait to be sent, which is all there is room for", bytes_),
                      "Say less until the far end is back, or keep the queue in a folder, where it may be longer.");
  entries_.push_back({next_, std::string(key), std::string(text)});
  bytes_ += cost(key, text);
  return next_++;
}

base::Result<std::optional<DurableQueue::Entry>> MemoryQueue::read(std::uint64_t number) {
  auto const found = std::ranges::lower_bound(entries_, number, {}, &Entry::number);
  if (found == entries_.end()) return std::optional<Entry>();
  return *found;
}

void MemoryQueue::acknowledge(std::uint64_t number) {
  while (!entries_.empty() && entries_.front().number <= number) {
    bytes_ -= cost(entries_.front().key, entries_.front().text);
    entries_.pop_front();
  }
}

}  // namespace lapwing::link::operator_link
