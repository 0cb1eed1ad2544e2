#include "dolphin/names/prelude.hpp"

#include <fmt/format.h>

#include "dolphin/names/signatures.hpp"

namespace lapwing::dolphin {

namespace {

/// What several of them use, and `during`, which the compiler calls.
constexpr std::string_view common = R"(
def parameters(f) { return f instanceof Closure ? f.parameterCount() : 1 }
def smallest(items, f, sign) {
  def precedes = parameters(f) > 1 ? { a, b -> f(a, b) * sign < 0 } : null
  def best = null
  def key = null
  def isFirst = true
  for (x in items) {
    def other = precedes == null ? f(x) : null
    if (isFirst || (precedes == null ? (other <=> key) * sign < 0 : precedes(x, best))) {
      best = x
      key = other
    }
    isFirst = false
  }
  return best
}
def ordered(items, f) {
  def before = parameters(f) > 1 ? f : { a, b -> f(a) <=> f(b) }
  def from = items
  def n = from.size()
  def width = 1
  while (width < n) {
    def to = []
    def low = 0
    while (low < n) {
      def middle = smaller(low + width, n)
      def high = smaller(low + 2 * width, n)
      def i = low
      def j = middle
      while (i < middle || j < high) {
        if (j >= high || (i < middle && before(from[i], from[j]) <= 0)) { to << from[i++] } else { to << from[j++] }
      }
      low += 2 * width
    }
    from = to
    width *= 2
  }
  return from
}
def smaller(a, b) { a < b ? a : b }
def during(limit, t) {
  return duringSeconds(limit instanceof Closure ? limit() : limit, t)
}
)";

}  // namespace

std::string prelude() {
  std::string out(common);
  for (auto const& instruction : instructions()) out += fmt::format("{}\n", instruction.source);
  for (auto const& method : methods()) out += fmt::format("{}\n", method.source);
  return out;
}

}  // namespace lapwing::dolphin
