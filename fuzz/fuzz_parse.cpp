// Any bytes as a mission script: lexer, parser, checker and what they say about it.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "dolphin/ast_printer.hpp"
#include "dolphin/checker.hpp"
#include "dolphin/parser.hpp"
#include "tasks/mission_builder.hpp"

namespace {

using namespace lapwing;

std::vector<tasks::BuilderSpec> const& builders() {
  static std::vector<tasks::BuilderSpec> const specs = {tasks::mission_builder()};
  return specs;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  base::SourceFile const source("fuzz", std::string(data, data + size));
  base::Diagnostics diagnostics(source);
  auto const program = dolphin::parse(diagnostics);
  dolphin::check(program, builders(), diagnostics);
  auto const tree = dolphin::print_tree(program);
  auto const text = base::render(diagnostics);
  bool const speaks_of_errors = !diagnostics.has_errors() || !text.empty();
  return speaks_of_errors && tree.size() < SIZE_MAX ? 0 : -1;
}
