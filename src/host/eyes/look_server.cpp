#include "host/eyes/look_server.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <exception>
#include <string_view>
#include <utility>

#include "base/descriptor.hpp"
#include "host/exit_code.hpp"

namespace lapwing::host {

namespace {

LookFrame answer_to(LookFrame request, std::vector<LookKind> const& kinds) {
  auto const look = request.head.find("look");
  auto const kind = std::ranges::find_if(
      kinds, [&](LookKind const& one) { return look != request.head.end() && look->is_string() && *look == one.name; });
  if (kind == kinds.end()) return refusal("it is not known what to look for");
  try {
    auto answer = kind->answer(request);
    return answer ? *std::move(answer) : refusal(answer.error().message);
  } catch (std::exception const& error) {
    return refusal(error.what());
  }
}

/// False at the end of what comes in.
bool take_some(LookFrameReader& reader) {
  std::array<char, 65'536> piece{};
  for (;;) {
    auto const count = ::read(STDIN_FILENO, piece.data(), piece.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    reader.take(std::string_view(piece.data(), static_cast<std::size_t>(count)));
    return true;
  }
}

}  // namespace

int serve_looks(std::vector<LookKind> const& kinds) {
  base::Descriptor const out(::dup(STDOUT_FILENO));
  LookFrameReader reader;
  for (;;) {
    auto request = reader.next();
    if (!request) return refuse(request.error());
    if (*request) {
      if (!out.write_all(to_bytes(answer_to(**std::move(request), kinds)))) return exit_failed;
    } else if (!take_some(reader)) {
      return reader.is_empty() ? exit_done : exit_usage;
    }
  }
}

}  // namespace lapwing::host
