// The TextMate grammar of editors/vscode knows the words of the language: each list in it equals the table that the
// checker uses. To write the lists anew: LAPWING_REFRESH_GOLDEN=1 lsp_test --gtest_filter='Grammar*', and read the
// diff.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "autonomy/words/vocabulary.hpp"
#include "dolphin/services/vocabulary.hpp"
#include "dolphin/syntax/lexer.hpp"
#include "missions/vocabulary.hpp"
#include "robot/words/vocabulary.hpp"

namespace lapwing::lsp {
namespace {

using dolphin::BlockKind;
using Json = nlohmann::ordered_json;
using Words = std::set<std::string>;

std::string const path = std::string(LAPWING_SOURCE_DIR) + "/editors/vscode/syntaxes/dolphin.tmLanguage.json";

Words names_of(auto const& table, auto&& wanted) {
  Words out;
  for (auto const& one : table) {
    if (wanted(one)) out.emplace(one.name);
  }
  return out;
}
Words names_of(auto const& table) {
  return names_of(table, [](auto const&) { return true; });
}

Words reserved_words() {
  Words out;
  std::string const text =
      "as assert break case catch class continue def default do else enum finally for if import in instanceof "
      "interface "
      "new package return switch throw try while";
  base::SourceFile const source("words", text);
  base::Diagnostics diagnostics(source);
  for (auto const& token : dolphin::lex(diagnostics).tokens) {
    if (dolphin::is_reserved_word(token.kind)) out.emplace(source.text(token.span));
  }
  return out;
}

/// Where a list stands in the grammar, and what it must hold.
struct List {
  char const* pointer;
  Words words;
};

std::vector<List> lists() {
  tasks::Vocabulary added = missions::vocabulary();
  EXPECT_TRUE(tasks::join(added, robot::vocabulary()));
  EXPECT_TRUE(tasks::join(added, autonomy::vocabulary()));
  dolphin::Vocabulary const vocabulary(added);
  auto const is_block = [](auto const& one) { return one.block != BlockKind::none && one.name != "move"; };
  auto const is_plain = [&](auto const& one) { return !is_block(one); };
  Words commands;
  Words blocks = names_of(dolphin::instructions(), is_block);
  for (auto const& block : vocabulary.blocks()) {
    commands.merge(names_of(block.words));
    if (block.builder) blocks.emplace(block.name);
  }
  Words instructions = names_of(dolphin::instructions(), is_plain);
  instructions.merge(names_of(vocabulary.instructions().added()));
  Words chains = names_of(dolphin::chain_words());
  chains.merge(Words{"then", "run", "onError"});
  auto const is_property = [](dolphin::MethodSpec const& one) { return one.is_property; };
  auto const is_method = [](dolphin::MethodSpec const& one) { return !one.is_property; };
  return {
      {"/repository/members/patterns/0/match", names_of(dolphin::units())},
      {"/repository/members/patterns/1/match", names_of(dolphin::methods(), is_method)},
      {"/repository/members/patterns/2/match", names_of(dolphin::methods(), is_property)},
      {"/repository/keywords/match", reserved_words()},
      {"/repository/chains/match", chains},
      {"/repository/commands/patterns/0/match", commands},
      {"/repository/instructions/match", instructions},
      {"/repository/blocks/match", blocks},
      {"/repository/constants/patterns/1/match", names_of(dolphin::constants())},
      {"/repository/types/match", names_of(dolphin::types())},
  };
}

/// The last group of plain words in a pattern: (a|b|c).
std::pair<std::size_t, std::size_t> list_in(std::string const& pattern) {
  std::pair<std::size_t, std::size_t> out{};
  for (std::size_t open = pattern.find('('); open != std::string::npos; open = pattern.find('(', open + 1)) {
    auto const end =
        pattern.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_|", open + 1);
    if (end != std::string::npos && pattern[end] == ')') out = {open + 1, end};
  }
  return out;
}

TEST(Grammar, KnowsTheWordsOfTheLanguage) {
  std::ifstream in(path);
  auto grammar = Json::parse(in, nullptr, false);
  ASSERT_FALSE(grammar.is_discarded()) << path;
  auto const* const refreshes = std::getenv("LAPWING_REFRESH_GOLDEN");
  for (auto const& [pointer, words] : lists()) {
    auto const where = Json::json_pointer(pointer);
    ASSERT_TRUE(grammar.contains(where)) << pointer;
    auto pattern = grammar[where].get<std::string>();
    auto const [begin, end] = list_in(pattern);
    auto const expected = fmt::format("{}", fmt::join(words, "|"));
    ASSERT_GT(begin, 0u) << pointer;
    EXPECT_FALSE(words.empty()) << pointer;
    if (!refreshes) {
      EXPECT_EQ(pattern.substr(begin, end - begin), expected) << pointer;
    }
    grammar[where] = pattern.replace(begin, end - begin, expected);
  }
  if (refreshes) std::ofstream(path) << grammar.dump(2) << "\n";
}

}  // namespace
}  // namespace lapwing::lsp
