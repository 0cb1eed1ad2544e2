// docs/reference/language.md is made here: of the tables that the checker and the hover texts have (signatures.hpp), of
// what the parser does with operators, and of what examples give when they are run. To accept a new page:
// LAPWING_REFRESH_GOLDEN=1 dolphin_test --gtest_filter='*Reference*', and read the diff.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "autonomy/words/vocabulary.hpp"
#include "dolphin/services/describe.hpp"
#include "dolphin/services/vocabulary.hpp"
#include "dolphin/syntax/ast_printer.hpp"
#include "dolphin/syntax/limits.hpp"
#include "dolphin/syntax/parser.hpp"
#include "dolphin/testing/script_bench.hpp"
#include "missions/vocabulary.hpp"
#include "robot/words/vocabulary.hpp"

namespace lapwing::dolphin {
namespace {

namespace fs = std::filesystem;

fs::path const page = fs::path(LAPWING_SOURCE_DIR) / "docs/reference/language.md";
fs::path const words_by_hand = fs::path(LAPWING_SOURCE_DIR) / "tests/golden/reference";

std::string text_of(fs::path const& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

/// What no table knows is written by hand: tests/golden/reference/NAME.md.
std::string by_hand(std::string_view name) {
  auto const path = words_by_hand / fmt::format("{}.md", name);
  EXPECT_TRUE(fs::exists(path)) << path;
  return text_of(path);
}

std::string one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

/// In a cell of a table a bar is written with a backslash.
std::string cell(std::string_view text) {
  std::string out;
  for (char const c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

// ---- operators

/// All but `as` and `instanceof`, behind which stands a type.
constexpr std::array<std::string_view, 25> infix{"**",  "*",   "/",  "%", "+",  "-",  ">>", "<<", "..",
                                                 "..<", "<",   "<=", ">", ">=", "in", "==", "!=", "<=>",
                                                 "=~",  "==~", "&",  "^", "|",  "&&", "||"};

std::string tree_of(std::string const& script) {
  base::SourceFile const source("x", script);
  base::Diagnostics diagnostics(source);
  return print_tree(parse(diagnostics));
}

/// Whether `inner` takes its operands before `outer` does.
bool binds_tighter(std::string_view inner, std::string_view outer) {
  return tree_of(fmt::format("x = a {} b {} c", outer, inner)) ==
         tree_of(fmt::format("x = a {} (b {} c)", outer, inner));
}

/// How many operators bind tighter: those of one level agree.
std::map<std::size_t, std::vector<std::string_view>> levels() {
  std::map<std::size_t, std::vector<std::string_view>> out;
  for (auto const one : infix) {
    auto const tighter =
        std::ranges::count_if(infix, [&](auto other) { return other != one && binds_tighter(other, one); });
    out[static_cast<std::size_t>(tighter)].push_back(one);
  }
  return out;
}

std::string precedence() {
  std::string out = "1. `.` `?.` `()` `[ ]` `{ }` `++` `--` behind a value\n";
  int level = 1;
  for (auto const& [tighter, operators] : levels()) {
    bool const with_types = operators.front() == "<";
    out += fmt::format("{}. `{}`{}\n", ++level, fmt::join(operators, "` `"), with_types ? " `as` `instanceof`" : "");
    if (level == 2) out += fmt::format("{}. `!` `-` `+` in front of a value\n", ++level);
  }
  return out +
         fmt::format("{}. `?:`, `condition ? a : b`\n{}. `=` and `+=`, `-=`, `<<=` and so on\n", level + 1, level + 2);
}

constexpr std::array<std::string_view, 13> joined{"+", "-", "*", "/",  "%",  "**", ">>",
                                                  "|", "&", "^", "<<", "in", "[ ]"};
using Row = std::pair<std::string, std::vector<std::string>>;  ///< what it gives, and for which right operands

constexpr std::string_view samples = R"([
  number: 1, text: 'ab', truth: true, nothing: null, list: [1, 2], map: [a: 1], range: (0..1), closure: { true },
  position: location(41, -8), displacement: moveDistance { north 5 }, area: location(41, -8) ^ 50, set: pick {},
  task: idle(1)])";

/// For each left operand what the operator gives with which right one, found by trying.
std::map<std::string, std::vector<Row>> tried(std::string_view op) {
  auto const both = op == "[ ]" ? std::string("l[r]") : fmt::format("l {} r", op);
  auto const out =
      testing::printed(fmt::format("samples = {}\ndef apply(l, r) {{ {} }}\n"
                                   "samples.each {{ ln, l -> samples.each {{ rn, r ->\n"
                                   "  try {{ x = apply(l, r); println \"$ln $rn ${{x instanceof Map ? 'Map' : "
                                   "x.class.simpleName}}\" }} catch (Exception e) {{ }} }} }}\n",
                                   samples, both));
  std::map<std::string, std::vector<Row>> rows;
  std::istringstream lines(out);
  for (std::string left, right, gives; lines >> left >> right >> gives;) {
    auto& of_left = rows[left];
    auto found = std::ranges::find(of_left, gives, &Row::first);
    if (found == of_left.end()) found = of_left.insert(found, {gives, {}});
    found->second.push_back(right);
  }
  return rows;
}

std::string word_of_type(std::string const& type) {
  static std::map<std::string, std::string> const words{
      {"Integer", "a number"},      {"Double", "a number"}, {"String", "text"},
      {"Boolean", "true or false"}, {"List", "a list"},     {"Map", "a map"},
      {"Position", "a position"},   {"Area", "an area"},    {"VehicleSet", "a set of vehicles"},
      {"Task", "a task"},           {"Null", "the value"}};
  auto const found = words.find(type);
  return found == words.end() ? "?" + type : found->second;
}

/// "number, text"; "anything", or "anything but text" when it is shorter.
std::string kinds_text(std::vector<std::string> const& kinds) {
  static std::vector<std::string> const all{"area",     "closure", "displacement", "list", "map",  "nothing", "number",
                                            "position", "range",   "set",          "task", "text", "truth"};
  std::vector<std::string> missing;
  std::ranges::copy_if(all, std::back_inserter(missing),
                       [&](auto const& one) { return std::ranges::find(kinds, one) == kinds.end(); });
  if (missing.empty()) return "anything";
  if (missing.size() < kinds.size()) return fmt::format("anything but {}", fmt::join(missing, ", "));
  return fmt::format("{}", fmt::join(kinds, ", "));
}

std::string meaning(std::string_view op, std::string const& lefts) {
  static std::map<std::string, std::string, std::less<>> const meanings = [] {
    std::map<std::string, std::string, std::less<>> out;
    std::istringstream lines(by_hand("meanings"));
    for (std::string line; std::getline(lines, line);) {
      auto const colon = line.find(": ");
      if (colon != std::string::npos) out.emplace(line.substr(0, colon), line.substr(colon + 2));
    }
    return out;
  }();
  auto const key = fmt::format("{} {}", lefts, op);
  auto const found = meanings.find(key);
  EXPECT_NE(found, meanings.end()) << "tests/golden/reference/meanings.md says nothing about " << key;
  return found == meanings.end() ? "" : found->second;
}

std::string operator_table() {
  std::string out = "| left | | right | gives | meaning |\n|---|---|---|---|---|\n";
  for (auto const op : joined) {
    std::map<std::pair<std::string, std::vector<std::string>>, std::vector<std::string>> merged;
    std::vector<decltype(merged)::key_type> order;
    for (auto const& [left, rows] : tried(op)) {
      for (auto const& [gives, rights] : rows) {
        bool const is_element = op == "[ ]" && gives == "Integer";
        auto const key = std::pair(is_element ? "an element" : word_of_type(gives), rights);
        if (!merged.contains(key)) order.push_back(key);
        merged[key].push_back(left);
      }
    }
    for (auto const& key : order) {
      auto const lefts = kinds_text(merged[key]);
      out += fmt::format("| {} | `{}` | {} | {} | {} |\n", lefts, cell(op), kinds_text(key.second), key.first,
                         meaning(op, lefts));
    }
  }
  return out;
}

// ---- words

/// "a number in metres, may be left out", for each parameter, each once.
std::vector<std::string> parameters_of(InstructionSpec const& spec, BlockWords const* block, bool named) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < spec.signatures.size(); ++i) {
    for (std::size_t j = 0; j < spec.signatures[i].parameters.size(); ++j) {
      auto text = parameter_text(spec, block, i, j);
      if (named) text = fmt::format("- `{}`: {}\n", spec.signatures[i].parameters[j].name, text);
      if (std::ranges::find(out, text) == out.end()) out.push_back(std::move(text));
    }
  }
  return out;
}

std::string calls_of(InstructionSpec const& spec, BlockWords const* block) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < spec.signatures.size(); ++i) {
    auto text = fmt::format("`{}`", call_text(spec, block, i).text);
    if (std::ranges::find(out, text) == out.end()) out.push_back(std::move(text));
  }
  return fmt::format("{}", fmt::join(out, ", "));
}

/// The fields of `pick` and others, one line each.
std::string fields_of(BlockWords const& block) {
  if (block.words.empty()) return "";
  std::string out = "\n| inside | takes | |\n|---|---|---|\n";
  for (auto const& word : block.words) {
    auto const takes = fmt::format("{}", fmt::join(parameters_of(word, &block, false), "; or "));
    out += fmt::format("| {} | {} | {} |\n", calls_of(word, &block), cell(takes), word.doc);
  }
  return out;
}

/// Examples are checked: nothing may be said about them.
void expect_to_check(InstructionSpec const& spec) {
  auto const source =
      std::make_shared<base::SourceFile const>(std::string(spec.name), std::string(spec.example) + "\n");
  base::Diagnostics diagnostics(*source);
  auto const vocabulary = missions::vocabulary();
  (void)load(source, vocabulary, diagnostics);
  EXPECT_EQ(render(diagnostics), "") << spec.name;
}

std::string entry_of(InstructionSpec const& spec, Vocabulary const& vocabulary) {
  std::string out = fmt::format("\n### {}\n\n{}. {}\n", spec.name, calls_of(spec, nullptr), spec.doc);
  bool const is_block = spec.block != BlockKind::none && spec.signatures.front().parameters.size() == 1;
  auto const parameters = parameters_of(spec, nullptr, true);
  if (!is_block && !parameters.empty()) out += fmt::format("\n{}", fmt::join(parameters, ""));
  if (auto const* block = vocabulary.block(spec.name)) out += fields_of(*block);
  bool const is_told = spec.result.is_none() || spec.result == Kinds(Kind::other);
  if (!is_told) out += fmt::format("\nGives {}.\n", kind_text({spec.result, spec.dimension}));
  if (spec.example.empty()) return out;
  expect_to_check(spec);
  return out + fmt::format("\n```dolphin\n{}\n```\n", spec.example);
}

std::string all_instructions(Vocabulary const& vocabulary) {
  static std::map<std::string_view, std::string_view> const headings{{"pick", "Vehicles"},
                                                                     {"location", "Places"},
                                                                     {"message", "The program and its operator"},
                                                                     {"task", "Tasks and signals"},
                                                                     {"abs", "Functions of numbers"}};
  std::string out;
  bool short_ones = false;
  for (auto const& spec : instructions()) {
    if (auto const heading = headings.find(spec.name); heading != headings.end()) {
      // What platforms add is given to vehicles.
      for (auto const& added :
           spec.name == "location" ? vocabulary.instructions().added() : std::span<InstructionSpec const>())
        out += entry_of(added, vocabulary);
      out += fmt::format("\n## {}\n", heading->second);
      short_ones = spec.name == "abs";
      if (short_ones) out += "\nAll are also known with `Math.` in front.\n\n| | |\n|---|---|\n";
    }
    out += short_ones ? fmt::format("| {} | {} |\n", calls_of(spec, nullptr), spec.doc) : entry_of(spec, vocabulary);
  }
  return out;
}

std::string chains() {
  std::string out =
      "\n## Tasks with a condition\n\nThese are written in words; each is a value and may stand anywhere. What stands "
      "behind `then` and `run` goes as far as it can.\n\n| | |\n|---|---|\n";
  for (auto const& chain : chain_words()) out += fmt::format("| `{}` | {} |\n", chain.usage, chain.doc);
  out += "\nInside the braces of `onError`:\n\n| | |\n|---|---|\n";
  for (auto const& word : block_words(BlockKind::handler))
    out += fmt::format("| {} | {} |\n", calls_of(word, nullptr), word.doc);
  return out;
}

/// What every platform adds.
tasks::Vocabulary all_words() {
  auto words = missions::vocabulary();
  EXPECT_TRUE(tasks::join(words, robot::vocabulary()));
  EXPECT_TRUE(tasks::join(words, autonomy::vocabulary()));
  return words;
}

std::string block_commands(Vocabulary const& vocabulary, std::string_view name, std::string_view heading) {
  auto const& block = *vocabulary.block(name);
  std::string out = fmt::format("\n## {}\n\n`{} {{ ... }}`. {}\n\n{}", heading, name, block.builder->doc,
                                by_hand(std::string(name) + "s"));
  for (auto const& word : block.words) {
    out += fmt::format("\n### {} ({})\n\n{}. {}\n", word.name, name, calls_of(word, &block), word.doc);
    auto const parameters = parameters_of(word, &block, true);
    if (!parameters.empty()) out += fmt::format("\n{}", fmt::join(parameters, ""));
    auto const& types = block.builder->commands[static_cast<std::size_t>(&word - block.words.data())].vehicle_types;
    if (!types.empty()) out += fmt::format("\nOnly for {}.\n", fmt::join(types, " and "));
  }
  return out;
}

// ---- what stands behind a point

std::string owners(Kinds kinds) {
  if (kinds.is_any()) return "every value";
  static constexpr std::pair<Kinds, std::string_view> words[] = {
      {Kinds::number(), "number"},  {Kind::text, "text"},
      {Kind::list, "list"},         {Kind::map, "map"},
      {Kind::other, "range"},       {Kind::vehicles, "set of vehicles"},
      {Kind::position, "position"}, {Kind::displacement, "displacement"},
      {Kind::area, "area"},         {Kind::task, "task"},
      {Kind::closure, "closure"}};
  std::vector<std::string_view> out;
  for (auto const& [kind, word] : words) {
    if (kinds.meets(kind)) out.push_back(word);
  }
  return fmt::format("{}", fmt::join(out, ", "));
}

std::string shown_example(MethodSpec const& method) {
  if (method.example.empty()) return "";
  auto const value = testing::printed(fmt::format("println({})\n", method.example));
  EXPECT_EQ(value.find("exit"), std::string::npos) << method.name << ": " << value;
  return fmt::format("`{}` is `{}`", cell(method.example), cell(one_line(value)));
}

std::string methods_section(std::string_view heading, auto const& belongs) {
  std::string out = fmt::format("\n### {}\n\n| | of | gives | | example |\n|---|---|---|---|---|\n", heading);
  for (auto const& method : methods()) {
    if (!belongs(method.receiver)) continue;
    auto const call = method.is_property ? "" : fmt::format("({})", method.arguments);
    auto const doc = method.doc.substr(0, method.doc.size() - 1);
    out += fmt::format("| `.{}{}` | {} | {} | {} | {} |\n", method.name, call, owners(method.receiver),
                       describe(method.result), cell(doc), shown_example(method));
  }
  return out;
}

std::string all_methods() {
  auto const is_any = [](Kinds kinds) { return kinds.is_any(); };
  auto const of_many = [](Kinds kinds) {
    return !kinds.is_any() && (kinds.meets(Kind::list) || kinds.meets(Kind::map));
  };
  auto const of_text = [=](Kinds kinds) { return !kinds.is_any() && !of_many(kinds) && kinds.meets(Kind::text); };
  auto const of_number = [=](Kinds kinds) {
    return !kinds.is_any() && !of_many(kinds) && !of_text(kinds) && kinds.meets(Kinds::number());
  };
  auto const of_others = [=](Kinds kinds) {
    return !is_any(kinds) && !of_many(kinds) && !of_text(kinds) && !of_number(kinds);
  };
  return "\n## Methods and properties\n\n" + by_hand("methods") +
         methods_section("Lists, maps, ranges and sets", of_many) + methods_section("Texts", of_text) +
         methods_section("Numbers", of_number) + methods_section("Places, vehicles, tasks", of_others) +
         methods_section("Every value", is_any) + "\n" + by_hand("members");
}

// ---- the rest

std::string unit_table() {
  std::string out = "\n## Units\n\n" + by_hand("units") + "\n| | makes of 1 | |\n|---|---|---|\n";
  for (auto const& unit : units()) out += fmt::format("| `.{}` | {:.6g} | {} |\n", unit.name, unit.factor, unit.doc);
  return out;
}

std::string names(std::string_view heading, std::span<NameSpec const> table) {
  std::string out = fmt::format("\n## {}\n\n| | |\n|---|---|\n", heading);
  for (auto const& one : table) out += fmt::format("| `{}` | {} |\n", one.name, one.doc);
  return out;
}

std::string limits() {
  Limits const running;
  return fmt::format(
      "\n## Limits\n\nBeyond a limit there is a diagnostic or an exception, never a crash.\n\n| | |\n|---|---|\n"
      "| a script | {} MB, {} words |\n"
      "| brackets, blocks and operators within each other or behind each other | {} |\n"
      "| parts of a task; levels of a task | {}; {} |\n"
      "| all values | {} MB |\n"
      "| a text that is made while the script runs | {} MB |\n"
      "| a width in `String.format`, `padLeft`, `padRight` | 10000 |\n"
      "| calls within each other | {} |\n"
      "| signals that nobody has consumed | {} |\n"
      "| one test of a guard | {} steps of the interpreter |\n"
      "| computing without waiting for anything | {} steps |\n\n"
      "While a script computes, time goes on for everything else; each step takes {} ns of it, in simulated time too, "
      "so "
      "that `--timeout` ends it.\n",
      max_source_size >> 20U, max_token_count, ast::max_tree_height, tasks::max_task_size, tasks::max_task_depth,
      running.heap_bytes >> 20U, max_text_size >> 20U, running.call_depth, max_signals, running.guard_budget,
      running.busy_steps, std::chrono::nanoseconds(time_of_step).count());
}

std::string reference_text() {
  auto const added = all_words();
  Vocabulary const vocabulary(added);
  return by_hand("introduction") + "\n## Operators\n\n" + by_hand("precedence") + "\n" + precedence() + "\n" +
         by_hand("operators") + "\n" + operator_table() + unit_table() + all_instructions(vocabulary) + chains() +
         block_commands(vocabulary, "mission", "Missions") + block_commands(vocabulary, "drive", "Drives") +
         block_commands(vocabulary, "lot", "Lots") + all_methods() + names("Constants", constants()) +
         names("Types and exceptions", types()) + limits();
}

TEST(LanguageReference, HasTypesAmongComparisons) {
  EXPECT_EQ(tree_of("x = a >> b as c"), tree_of("x = (a >> b) as c"));
  EXPECT_EQ(tree_of("x = a == b as c"), tree_of("x = a == (b as c)"));
  EXPECT_EQ(tree_of("x = a < b instanceof c"), tree_of("x = (a < b) instanceof c"));
}

TEST(LanguageReference, IsMadeOfTheTablesAndOfWhatRunsShow) {
  auto const text = reference_text();
  auto const* const asked = std::getenv("LAPWING_REFRESH_GOLDEN");
  if (asked && std::string_view(asked) == "1") std::ofstream(page, std::ios::binary) << text;
  EXPECT_EQ(text, text_of(page)) << "refresh it with LAPWING_REFRESH_GOLDEN=1";
}

}  // namespace
}  // namespace lapwing::dolphin
