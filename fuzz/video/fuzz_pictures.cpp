// What a station reads from whatever answers at a drone's camera: HTTP, parts and pictures. An input is that answer,
// cut into pieces whose length its first byte says: the pieces must not matter.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "link/pictures/part_reader.hpp"
#include "require.hpp"

using namespace lapwing;
using link::pictures::PartReader;

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  if (size == 0) return 0;
  std::size_t const piece = 1U + data[0];
  std::string_view const stream(reinterpret_cast<char const*>(data) + 1, size - 1);
  PartReader whole;
  auto const at_once = whole.take(stream);
  PartReader cut;
  std::optional<link::pictures::Picture> newest;
  bool failed = false;
  for (std::size_t at = 0; at < stream.size() && !failed; at += piece) {
    auto const read = cut.take(stream.substr(at, piece));
    failed = !read;
    if (read && *read) newest = *read;
  }
  // A mistake behind a picture: in pieces the picture was handed out before.
  if (!at_once) return 0;
  fuzz::require(!failed && newest.has_value() == at_once->has_value());
  if (newest) fuzz::require(*newest->jpeg == *(*at_once)->jpeg && newest->taken == (*at_once)->taken);
  return 0;
}
