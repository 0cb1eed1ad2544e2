// Any bytes as a mission script: the lexer, the parser, the printed tree, and what they complain about.
#include "dolphin/syntax/ast_printer.hpp"
#include "dolphin/syntax/lexer.hpp"
#include "dolphin/syntax/parser.hpp"
#include "scripts.hpp"

using namespace lapwing;

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  base::SourceFile const source("fuzz", fuzz::text_of(data, size));

  base::Diagnostics of_lexer(source);
  auto const stream = dolphin::lex(of_lexer);
  fuzz::require(!stream.tokens.empty() && stream.tokens.back().kind == dolphin::TokenKind::end_of_file);
  std::size_t at = 0;
  for (auto const& token : stream.tokens) {
    fuzz::require(token.span.begin >= at && token.span.end >= token.span.begin && token.span.end <= size);
    at = token.span.begin;
  }

  base::Diagnostics diagnostics(source);
  auto const program = dolphin::parse(diagnostics);
  fuzz::require(diagnostics.error_count() >= of_lexer.error_count());
  (void)dolphin::print_tree(program);
  fuzz::require_presentable(diagnostics);
  return 0;
}
