#include "dolphin/names/prelude.hpp"

#include "dolphin/names/signatures.hpp"

namespace lapwing::dolphin {

namespace {

constexpr std::string_view common = R"dolphin(
def each(items, f) {
  for (x in items) { f(x) }
  return items
}
def eachWithIndex(items, f) {
  def i = 0
  def splits = items instanceof Map && parameters(f) > 2
  for (x in items) { if (splits) { f(x.key, x.value, i++) } else { f(x, i++) } }
  return items
}
def collect(items, f) {
  def result = []
  for (x in items) { result << f(x) }
  return result
}
def collectEntries(items, f) {
  def result = [:]
  for (x in items) {
    def pair = f(x)
    if (pair instanceof Map) { result.putAll(pair) } else { result[pair[0]] = pair[1] }
  }
  return result
}
def find(items, f) {
  for (x in items) { if (f(x)) { return x } }
  return null
}
def findAll(items, f) {
  def result = items.emptyLike()
  for (x in items) { if (f(x)) { result = result.with(x) } }
  return result
}
def findIndexOf(items, f) {
  def i = 0
  for (x in items) {
    if (f(x)) { return i }
    i++
  }
  return -1
}
def any(items, f = { it }) {
  for (x in items) { if (f(x)) { return true } }
  return false
}
def every(items, f = { it }) {
  for (x in items) { if (!f(x)) { return false } }
  return true
}
def inject(items, start, f = null) {
  def fold = f == null ? start : f
  def result = f == null ? null : start
  def isFirst = f == null
  def splits = items instanceof Map && parameters(fold) > 2
  for (x in items) {
    result = isFirst ? x : splits ? fold(result, x.key, x.value) : fold(result, x)
    isFirst = false
  }
  return result
}
def sum(items, start = null, f = { it }) {
  def value = start instanceof Closure ? start : f
  def result = start instanceof Closure ? null : start
  for (x in items) { result = result == null ? value(x) : result + value(x) }
  return result
}
def takeWhile(items, f) {
  def result = items.emptyLike()
  for (x in items) {
    if (!f(x)) { return result }
    result = result.with(x)
  }
  return result
}
def dropWhile(items, f) {
  def result = items.emptyLike()
  def drops = true
  for (x in items) {
    drops = drops && f(x)
    if (!drops) { result = result.with(x) }
  }
  return result
}
def collectMany(items, f) {
  def result = []
  for (x in items) { result.addAll(f(x).toList()) }
  return result
}
def findResult(items, f) {
  for (x in items) {
    def found = f(x)
    if (found != null) { return found }
  }
  return null
}
def reverseEach(items, f) {
  for (x in items.toList().reverse()) { f(x) }
  return items
}
def withIndex(items) {
  def result = []
  def i = 0
  for (x in items) { result << [x, i++] }
  return result
}
def count(items, f) {
  def result = 0
  def counts = f instanceof Closure ? f : { it == f }
  for (x in items) { if (counts(x)) { result++ } }
  return result
}
def groupBy(items, f) {
  def result = [:]
  for (x in items) {
    def key = f(x)
    if (!result.containsKey(key)) { result[key] = items.emptyLike() }
    result[key] = result[key].with(x)
  }
  return result
}
def countBy(items, f) {
  def result = [:]
  for (x in items) {
    def key = f(x)
    result[key] = (result[key] ?: 0) + 1
  }
  return result
}
def toSet(items) { return items.toList().unique() }
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
def min(items, f = { it }) { return smallest(items, f, 1) }
def max(items, f = { it }) { return smallest(items, f, -1) }
def sort(items, how = null, f = null) {
  def changesItself = how != false && items instanceof List
  def by = how instanceof Boolean ? f : how
  if (items instanceof Map) {
    def sorted = [:]
    for (pair in ordered(items.toList(), by == null ? { it.key } : by)) { sorted[pair.key] = pair.value }
    return sorted
  }
  def result = ordered(items.toList(), by == null ? { it } : by)
  return changesItself ? items.become(result) : result
}
def toSorted(items, f = { it }) { return ordered(items.toList(), f) }
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
def times(n, f) {
  for (def i = 0; i < n; i++) { f(i) }
  return null
}
def upto(first, last, f) {
  for (def i = first; i <= last; i++) { f(i) }
  return null
}
def downto(first, last, f) {
  for (def i = first; i >= last; i--) { f(i) }
  return null
}
def step(first, last, by, f) {
  for (def i = first; by > 0 ? i < last : i > last; i += by) { f(i) }
  return null
}
def replaceAll(text, pattern, f) {
  def pieces = text.cutBy(pattern)
  for (def i = 1; i < pieces.size(); i += 2) { pieces[i] = f(pieces[i]) }
  return pieces.join('')
}
def eachMatch(text, pattern, f) {
  for (match in text =~ pattern) { f(match) }
  return text
}
def during(limit, t) {
  return duringSeconds(limit instanceof Closure ? limit() : limit, t)
}
)dolphin";

}  // namespace

std::string prelude() {
  std::string out(common);
  for (auto const& instruction : instructions()) out += instruction.source;
  return out;
}

}  // namespace lapwing::dolphin
