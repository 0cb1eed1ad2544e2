#include "dolphin/prelude.hpp"

namespace lapwing::dolphin {

std::string_view prelude() {
  return R"dolphin(
def each(items, f) {
  for (x in items) { f(x) }
  return items
}
def eachWithIndex(items, f) {
  def i = 0
  for (x in items) { f(x, i++) }
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
def inject(items, start, f) {
  def result = start
  for (x in items) { result = f(result, x) }
  return result
}
def sum(items, f = { it }) {
  def result = null
  for (x in items) { result = result == null ? f(x) : result + f(x) }
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
    if (!result.containsKey(key)) { result[key] = [] }
    result[key] << x
  }
  return result
}
def min(items, f = { it }) {
  def best = null
  def least = null
  for (x in items) {
    def key = f(x)
    if (least == null || key < least) {
      best = x
      least = key
    }
  }
  return best
}
def max(items, f = { it }) {
  def best = null
  def most = null
  for (x in items) {
    def key = f(x)
    if (most == null || key > most) {
      best = x
      most = key
    }
  }
  return best
}
def sort(items, f = { it }) {
  def before = f.parameterCount() > 1 ? f : { a, b -> f(a) <=> f(b) }
  def from = items.toList()
  def n = from.size()
  def width = 1
  while (width < n) {
    def to = []
    def low = 0
    while (low < n) {
      def middle = min([low + width, n])
      def high = min([low + 2 * width, n])
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
def during(limit, t) {
  return duringSeconds(limit instanceof Closure ? limit() : limit, t)
}
def poll(wanted) {
  if (!(wanted instanceof Map)) { return signalValues(wanted).size() > 0 }
  for (pair in wanted) {
    def test = pair.value
    def posted = signalValues(pair.key)
    if (test instanceof Closure ? !posted.any(test) : !(test in posted)) { return false }
  }
  return true
}
)dolphin";
}

}  // namespace lapwing::dolphin
