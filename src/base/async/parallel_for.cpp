#include "base/async/parallel_for.hpp"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "base/assert.hpp"

namespace lapwing::base {

void parallel_for(unsigned threads, std::size_t count, std::function<void(std::size_t)> const& work) {
  LAPWING_ASSERT(threads > 0);
  std::atomic<std::size_t> next = 0;
  auto const serve = [&] {
    for (auto index = next.fetch_add(1); index < count; index = next.fetch_add(1)) work(index);
  };
  std::vector<std::jthread> helpers;
  auto const useful = std::min<std::size_t>(threads, count);
  for (std::size_t t = 1; t < useful; ++t) helpers.emplace_back(serve);
  serve();
}

}  // namespace lapwing::base
