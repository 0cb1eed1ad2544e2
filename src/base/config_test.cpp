#include "base/config.hpp"

#include <gtest/gtest.h>

namespace lapwing::base {
namespace {

struct Config {
  explicit Config(std::string text)
      : source("f.toml", std::move(text)), diagnostics(source), root(parse_config(source, diagnostics)) {}
  std::string complaints() const { return render(diagnostics); }

  SourceFile source;
  Diagnostics diagnostics;
  ConfigValue::Table root;
};

TEST(Config, ReadsEveryKindOfValue) {
  Config const config("a = 'text'\nb = 7\nc = true\nd = ['x', \"y\"]\n[e]\nf = 'inner'\n");
  Diagnostics diagnostics(config.source);
  ConfigReader reader(config.root, diagnostics);
  EXPECT_EQ(reader.text("a")->value, "text");
  EXPECT_EQ(reader.integer("b", 0, 10)->value, 7);
  EXPECT_TRUE(reader.flag("c")->value);
  auto const texts = reader.texts("d");
  ASSERT_EQ(texts->size(), 2U);
  EXPECT_EQ((*texts)[1].value, "y");
  auto inner = reader.table("e");
  ASSERT_TRUE(inner);
  EXPECT_EQ(inner->text("f")->value, "inner");
  inner->refuse_unknown();
  reader.refuse_unknown();
  EXPECT_EQ(render(diagnostics), "");
}

TEST(Config, ReadsPlacesAndListsOfThem) {
  Config config("at = [1, 2.5]\nline = [[0, 0], [1], [-1, 'x'], [3, 200], [4, 5]]\nflat = [1, 2]\nshort = 7\n");
  ConfigReader reader(config.root, config.diagnostics);
  EXPECT_EQ(reader.numbers("at", 2, -100, 100)->value, (std::vector<double>{1.0, 2.5}));
  EXPECT_FALSE(reader.numbers("nowhere", 2, -100, 100));
  auto const line = reader.number_lists("line", 2, -100, 100);
  ASSERT_EQ(line.size(), 2U);
  EXPECT_EQ(line[1].value, (std::vector<double>{4.0, 5.0}));
  EXPECT_TRUE(reader.number_lists("flat", 2, -100, 100).empty());
  EXPECT_FALSE(reader.numbers("short", 2, -100, 100));
  auto const records = to_records(config.diagnostics);
  ASSERT_EQ(records.size(), 6U);
  EXPECT_EQ(records[0].message, "line must have 2 numbers in brackets");
  EXPECT_EQ(records[1].message, "line must be numbers, not text");
  EXPECT_EQ(records[2].message, "every number of line must be from -100 to 100");
  EXPECT_EQ(records[2].begin, (LineColumn{2, 37}));
  EXPECT_EQ(records[3].message, "flat must have 2 numbers in brackets");
  EXPECT_EQ(records[5].message, "short must have 2 numbers in brackets");
}

TEST(Config, GivesNothingForWhatIsNotThere) {
  Config config("");
  ConfigReader reader(config.root, config.diagnostics);
  EXPECT_FALSE(reader.text("a"));
  EXPECT_FALSE(reader.integer("a", 0, 1));
  EXPECT_FALSE(reader.flag("a"));
  EXPECT_FALSE(reader.texts("a"));
  EXPECT_FALSE(reader.table("a"));
  EXPECT_EQ(config.complaints(), "");
}

TEST(Config, PointsAtUnknownKeysAndSuggests) {
  Config config("port = 1\nprot = 2\nzebra = 3\n");
  ConfigReader reader(config.root, config.diagnostics);
  (void)reader.integer("port", 0, 10);
  reader.refuse_unknown();
  EXPECT_EQ(config.complaints(),
            "f.toml:2:1: error: there is no setting prot [unknown-setting]\n"
            "    2 | prot = 2\n"
            "      | ^~~~ did you mean port?\n"
            "f.toml:3:1: error: there is no setting zebra [unknown-setting]\n"
            "    3 | zebra = 3\n"
            "      | ^~~~~ known here: port\n");
}

TEST(Config, PointsAtValuesOfTheWrongType) {
  Config config("a = 1\nb = 'x'\nc = 1.5\nd = [ 'x', 2 ]\ne = 1\nf = 2026-01-01\n");
  ConfigReader reader(config.root, config.diagnostics);
  EXPECT_FALSE(reader.text("a"));
  EXPECT_FALSE(reader.integer("b", 0, 1));
  EXPECT_FALSE(reader.flag("c"));
  EXPECT_EQ(reader.texts("d")->size(), 1U);
  EXPECT_FALSE(reader.table("e"));
  EXPECT_FALSE(reader.texts("f"));
  auto const records = to_records(config.diagnostics);
  ASSERT_EQ(records.size(), 6U);
  EXPECT_EQ(records[0].message, "a must be text, not a whole number");
  EXPECT_EQ(records[0].begin, (LineColumn{1, 5}));
  EXPECT_EQ(records[1].message, "b must be a whole number, not text");
  EXPECT_EQ(records[2].message, "c must be true or false, not a number");
  EXPECT_EQ(records[3].message, "every element of d must be text, not a whole number");
  EXPECT_EQ(records[3].begin, (LineColumn{4, 12}));
  EXPECT_EQ(records[4].message, "e must be a table: [e], not a whole number");
  EXPECT_EQ(records[5].message, "f must be an array of texts, not a date");
}

TEST(Config, PointsAtNumbersOutOfRange) {
  Config config("'ä' = 'ü'\nport = 70000");
  ConfigReader reader(config.root, config.diagnostics);
  (void)reader.text("ä");
  EXPECT_FALSE(reader.integer("port", 0, 65535));
  EXPECT_EQ(config.complaints(),
            "f.toml:2:8: error: port must be from 0 to 65535 [invalid-value]\n"
            "    2 | port = 70000\n"
            "      |        ^~~~~\n");
}

TEST(Config, RefusesAKeyWithAdvice) {
  Config config("'ä' = 1\ntoken = 's'\n");
  ConfigReader reader(config.root, config.diagnostics);
  (void)reader.integer("ä", 0, 1);
  reader.refuse("token", "use token_file");
  reader.refuse("absent", "no");
  reader.refuse_unknown();
  EXPECT_EQ(config.complaints(),
            "f.toml:2:1: error: token does not belong here [misplaced-setting]\n"
            "    2 | token = 's'\n"
            "      | ^~~~~ use token_file\n");
}

TEST(Config, TellsWhereAFileIsNoToml) {
  Config const config("a = 1\nb = = 2\n");
  EXPECT_TRUE(config.root.empty());
  auto const records = to_records(config.diagnostics);
  ASSERT_EQ(records.size(), 1U);
  EXPECT_EQ(records[0].begin.line, 2U);
  EXPECT_NE(records[0].message, "");
}

TEST(Config, TellsOfKeysThatBeginWithNoLetter) {
  for (auto const* text : {"[(k#y1]\nfleet = 3\n", "[[,rea]]\n", "[\x1a]\n", "a.(b = 1\n", "(a = 1\n"}) {
    Config const config(text);
    EXPECT_TRUE(config.diagnostics.has_errors()) << text;
    EXPECT_TRUE(config.root.empty()) << text;
  }
}

TEST(Config, RefusesAKeyThatStandsTwice) {
  Config const config("a = 1\na = 2\n");
  EXPECT_EQ(config.diagnostics.error_count(), 1U);
}

TEST(Config, TakesCharactersBeyondAsciiInQuotesAndCommentsOnly) {
  for (auto const* text : {R"(a = 'é' # ü)", R"("ö" = "\"ä")", "a = \"\"\"ein\n\"ä\"\"\"\"\nb = ''", "a = '''é'''",
                           "\xEF\xBB\xBF# with a byte order mark"}) {
    Config const config(text);
    EXPECT_EQ(config.complaints(), "") << text;
  }
  for (auto const* text : {"Ȩ = 1", "a = 1\nȨ", "a = '' Ȩ", "a = \"\"\"\"\"\"\nȨ = 2", "# é\nȨ", "a = 6b\"Ȩ"}) {
    Config const config(text);
    EXPECT_NE(config.complaints().find("not-toml"), std::string::npos) << text << config.complaints();
  }
}

TEST(Config, ReadsArraysOfTablesNumbersAndWholeNumbers) {
  Config config("[[link]]\nrate = 2\nids = [1, 2]\n[[link]]\nrate = 2.5\n[link.in]\non = true\n");
  ConfigReader reader(config.root, config.diagnostics);
  auto links = reader.tables("link");
  ASSERT_EQ(links.size(), 2U);
  EXPECT_EQ(links[0].value.number("rate", 0.0, 10.0)->value, 2.0);
  EXPECT_EQ(links[1].value.number("rate", 0.0, 10.0)->value, 2.5);
  auto const ids = links[0].value.integers("ids", 0, 255);
  ASSERT_EQ(ids.size(), 2U);
  EXPECT_EQ(ids[1].value, 2);
  EXPECT_TRUE(links[1].value.table("in")->flag("on")->value);
  EXPECT_TRUE(links[1].value.integers("ids", 0, 255).empty());
  EXPECT_TRUE(reader.tables("others").empty());
  reader.refuse_unknown();
  EXPECT_EQ(config.complaints(), "");
}

TEST(Config, ComplainsOfNumbersThatAreNone) {
  Config config("rate = 'fast'\nspeed = 11\nids = [1, 300, 'x']\nsystems = 1\n");
  ConfigReader reader(config.root, config.diagnostics);
  EXPECT_FALSE(reader.number("rate", 0.0, 10.0));
  EXPECT_FALSE(reader.number("speed", 0.0, 10.0));
  EXPECT_EQ(reader.integers("ids", 0, 255).size(), 1U);
  EXPECT_TRUE(reader.integers("systems", 0, 255).empty());
  auto const complaints = config.complaints();
  EXPECT_NE(complaints.find("rate must be a number, not text"), std::string::npos) << complaints;
  EXPECT_NE(complaints.find("speed must be from 0 to 10"), std::string::npos) << complaints;
  EXPECT_NE(complaints.find("f.toml:3:11: error: every element of ids must be a whole number from 0 to 255"),
            std::string::npos)
      << complaints;
  EXPECT_NE(complaints.find("systems must be an array of whole numbers, not a whole number"), std::string::npos)
      << complaints;
}

TEST(Config, ComplainsOfATableThatShouldBeMany) {
  Config config("[link]\na = 1\n");
  ConfigReader reader(config.root, config.diagnostics);
  EXPECT_TRUE(reader.tables("link").empty());
  EXPECT_NE(config.complaints().find("link must be written as [[link]], not a table"), std::string::npos)
      << config.complaints();
}

}  // namespace
}  // namespace lapwing::base
