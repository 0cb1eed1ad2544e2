// Any bytes as a mission script: the checker with the commands of missions, on trees with and without mistakes.
#include "dolphin/check/checker.hpp"
#include "dolphin/syntax/parser.hpp"
#include "scripts.hpp"

using namespace lapwing;

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  base::SourceFile const source("fuzz", fuzz::text_of(data, size));
  base::Diagnostics diagnostics(source);
  auto const program = dolphin::parse(diagnostics);
  dolphin::check(program, fuzz::vocabulary(), diagnostics);
  fuzz::require_presentable(diagnostics);
  return 0;
}
