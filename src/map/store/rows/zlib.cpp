#include "map/store/rows/zlib.hpp"

#include <algorithm>

#include <zlib.h>

#include "base/assert.hpp"

namespace lapwing::map::rows {

namespace {

constexpr int quick = 1;

/// zlib does not change what it reads, but its interface is older than `const`.
Bytef* readable(std::string_view bytes) {
  return const_cast<Bytef*>(reinterpret_cast<Bytef const*>(bytes.data()));
}

}  // namespace

std::string deflated(std::string_view bytes) {
  auto size = compressBound(bytes.size());
  std::string stream(size, '\0');
  int const code = compress2(reinterpret_cast<Bytef*>(stream.data()), &size, readable(bytes), bytes.size(), quick);
  LAPWING_ASSERT(code == Z_OK);
  stream.resize(size);
  return stream;
}

std::optional<std::string> inflated(std::string_view stream, std::size_t most) {
  z_stream state = {};
  if (inflateInit(&state) != Z_OK) return std::nullopt;
  state.next_in = readable(stream);
  state.avail_in = static_cast<uInt>(stream.size());
  std::string bytes;
  int code = Z_OK;
  // In pieces: how much it will be stands nowhere, and a small stream may hold very much.
  constexpr std::size_t piece = 256 * 1024;
  while (code == Z_OK && bytes.size() <= most) {
    auto const filled = bytes.size();
    bytes.resize(filled + std::min(piece, most + 1 - filled));
    state.next_out = reinterpret_cast<Bytef*>(bytes.data() + filled);
    state.avail_out = static_cast<uInt>(bytes.size() - filled);
    code = inflate(&state, Z_NO_FLUSH);
    bytes.resize(bytes.size() - state.avail_out);
  }
  bool const is_whole = code == Z_STREAM_END && state.avail_in == 0 && bytes.size() <= most;
  inflateEnd(&state);
  if (!is_whole) return std::nullopt;
  return bytes;
}

}  // namespace lapwing::map::rows
