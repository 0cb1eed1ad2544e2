#include "base/text/spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace lapwing::base {

namespace {

constexpr std::size_t max_candidates = 10'000;
constexpr std::size_t max_word_size = 100;

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t limit) {
  if (a == b) return 0;
  if (std::max(a.size(), b.size()) - std::min(a.size(), b.size()) > limit) return limit + 1;
  std::vector<std::size_t> two_ago(b.size() + 1);
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) before[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      bool const same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({before[j] + 1, row[j - 1] + 1, before[j - 1] + (same ? 0u : 1u)});
      bool const swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], two_ago[j - 2] + 1);
    }
    if (*std::ranges::min_element(row) > limit) return limit + 1;
    std::swap(two_ago, before);
    std::swap(before, row);
  }
  return std::min(std::max<std::size_t>(before[b.size()], 1), limit + 1);
}

std::optional<std::string> closest(std::string_view word, std::span<std::string_view const> candidates) {
  if (word.size() < 2 || word.size() > max_word_size) return std::nullopt;
  auto limit = std::max<std::size_t>(1, word.size() / 3);
  std::optional<std::string_view> best;
  for (auto const candidate : candidates.first(std::min(candidates.size(), max_candidates))) {
    auto const distance = edit_distance(word, candidate, limit);
    if (distance > limit || distance == 0) continue;
    if (distance < limit || !best || candidate < *best) best = candidate;
    limit = distance;
  }
  if (!best) return std::nullopt;
  return std::string(*best);
}

std::string did_you_mean(std::string_view word, std::span<std::string_view const> candidates) {
  auto const found = closest(word, candidates);
  return found ? fmt::format("did you mean {}?", *found) : std::string();
}

}  // namespace lapwing::base
