#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "host/eyes/look_frame.hpp"

namespace lapwing::host {

/// What a request's `look` can name, and what answers it. What it throws becomes a refusal.
struct LookKind {
  std::string name;
  std::function<base::Result<LookFrame>(LookFrame& request)> answer;
};

/// Reads requests from standard input and answers each on standard output, one after the other, until its input ends.
/// Gives the program's exit code: of bad usage where what comes in is no request, or is cut off.
[[nodiscard]] int serve_looks(std::vector<LookKind> const& kinds);

}  // namespace lapwing::host
