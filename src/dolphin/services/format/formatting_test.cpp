#include "dolphin/services/format/formatting.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "dolphin/syntax/ast_printer.hpp"
#include "dolphin/syntax/lexer.hpp"
#include "dolphin/syntax/parser.hpp"

namespace lapwing::dolphin {
namespace {

namespace fs = std::filesystem;

std::string formatted(std::string const& script) {
  base::SourceFile const source("test.dolphin", script);
  base::Diagnostics diagnostics(source);
  auto const out = format(diagnostics);
  return out ? *out : render(diagnostics);
}

std::string tree_of(std::string const& script) {
  base::SourceFile const source("test.dolphin", script);
  base::Diagnostics diagnostics(source);
  auto tree = print_tree(parse(diagnostics));
  return diagnostics.has_errors() ? render(diagnostics) : tree;
}

/// Kinds, line ends and words of all tokens; how a line ends inside a text does not count.
std::string tokens_of(std::string const& script) {
  base::SourceFile const source("test.dolphin", script);
  base::Diagnostics diagnostics(source);
  std::string out;
  for (auto const& token : lex(diagnostics).tokens) {
    if (token.kind == TokenKind::end_of_file) break;
    out += token.newline_before ? '\n' : ' ';
    std::ranges::copy_if(source.text(token.span), std::back_inserter(out), [](char c) { return c != '\r'; });
  }
  return out;
}

void expect_same_program(std::string const& script) {
  auto const once = formatted(script);
  EXPECT_EQ(tokens_of(once), tokens_of(script)) << once;
  EXPECT_EQ(tree_of(once), tree_of(script)) << once;
  EXPECT_EQ(formatted(once), once);
}

// ---- every script there is ----------------------------------------------------------------------

std::vector<fs::path> all_scripts() {
  fs::path const root = LAPWING_SOURCE_DIR;
  std::vector<fs::path> out;
  for (auto const* folder : {"examples", "tests/conformance", "tests/golden"}) {
    for (auto const& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.path().extension() == ".dolphin") out.push_back(entry.path());
    }
  }
  return out;
}

TEST(FormatCorpus, KeepsTokensAndTreeOfEveryScriptAndChangesNothingTheSecondTime) {
  std::size_t good = 0;
  for (auto const& path : all_scripts()) {
    SCOPED_TRACE(path.string());
    std::ifstream in(path, std::ios::binary);
    std::ostringstream content;
    content << in.rdbuf();
    base::SourceFile const source("test.dolphin", content.str());
    base::Diagnostics diagnostics(source);
    (void)parse(diagnostics);
    bool const parses = !diagnostics.has_errors();
    base::Diagnostics again(source);
    EXPECT_EQ(format(again).has_value(), parses);
    if (!parses) continue;
    expect_same_program(content.str());
    ++good;
  }
  EXPECT_GT(good, 60u);
}

// ---- blanks -------------------------------------------------------------------------------------

struct Case {
  std::string_view script;
  std::string_view expected;
};

TEST(Format, PutsBlanksRoundOperatorsAndBehindCommas) {
  for (auto const& [script, expected] : std::initializer_list<Case>{
           {"x=1+2*3", "x = 1 + 2 * 3"},
           {"x  =a>>b|c/{d}", "x = a >> b | c / { d }"},
           {"move 1 ,2,3", "move 1, 2, 3"},
           {"f( a , b )", "f(a, b)"},
           {"x=[ 1,2 ][ 0 ]", "x = [1, 2][0]"},
           {"x=[ : ]", "x = [:]"},
           {"x=a?b:c", "x = a ? b : c"},
           {"x=a?[k:1]:[ : ]", "x = a ? [k: 1] : [:]"},
           {"x=a?:b", "x = a ?: b"},
           {"x=1 .. 3", "x = 1..3"},
           {"x=10 . minutes", "x = 10.minutes"},
           {"x=a ?. b", "x = a?.b"},
           {"post x :1,y:2", "post x: 1, y: 2"},
           {"execute v : a,_ :b", "execute v: a, _: b"},
           {"x=- 1", "x = -1"},
           {"x=- -y", "x = - -y"},
           {"x=1- -y", "x = 1 - -y"},
           {"x=! !y", "x = !!y"},
           {"x ++", "x++"},
           {"++ x", "++x"},
           {"return-1", "return -1"},
           {"v = pick{count 2;type 'UAV'}", "v = pick { count 2; type 'UAV' }"},
           {"a=action{ }", "a = action {}"},
           {"l.each{x->message x}", "l.each { x -> message x }"},
           {"l.each({x,y->message x})", "l.each({ x, y -> message x })"},
           {"if(a){b()}else{c()}", "if (a) { b() } else { c() }"},
           {"for(i=0;i<3;i++){f(i)}", "for (i = 0; i < 3; i++) { f(i) }"},
           {"for(x in l){f(x)}", "for (x in l) { f(x) }"},
           {"for(x:l){f(x)}", "for (x : l) { f(x) }"},
           {"def f(a,b=2){a}", "def f(a, b = 2) { a }"},
           {"x=new  Foo( 1 )", "x = new Foo(1)"},
           {"message \"a ${ x+1 } b\"", "message \"a ${ x+1 } b\""},
           {"x = a.class-1", "x = a.class - 1"},
       }) {
    EXPECT_EQ(formatted(std::string(script)), std::string(expected) + "\n");
    expect_same_program(std::string(script));
  }
}

TEST(Format, KeepsTheBlanksThatDecideHowALineIsRead) {
  for (auto const* script : {
           "pos { lat 38.64; lon (-8.64) }\n",
           "mission { move (-5), 0, 0 }\n",
           "mission { move(-5, 0, 0) }\n",
           "message [1]\n",
           "message[1]\n",
           "execute (a | b) / { c }\n",
           "execute(a | b)\n",
           "a = b\n[1].each { it }\n",
           "a = b\n(c)\n",
           "a = b\n-c\n",
           "a = b \\\n    - c\n",
       }) {
    EXPECT_EQ(formatted(script), script);
    expect_same_program(script);
  }
}

// ---- lines --------------------------------------------------------------------------------------

TEST(Format, IndentsByBrackets) {
  EXPECT_EQ(formatted("m = mission {\n     name 'A'\n       home p\n     }\n"),
            "m = mission {\n  name 'A'\n  home p\n}\n");
  EXPECT_EQ(
      formatted("while (true) {\nv = pick {\ntype 'UAV'\n}\nif (v) {\nf({ x ->\ng(x)\n})\n}\n}\n"),
      "while (true) {\n  v = pick {\n    type 'UAV'\n  }\n  if (v) {\n    f({ x ->\n      g(x)\n    })\n  }\n}\n");
  EXPECT_EQ(formatted("x = [\na,\nb\n]\ny = f(a,\nb)\n"), "x = [\n  a,\n  b\n]\ny = f(a,\n  b)\n");
}

TEST(Format, IndentsBodiesWithoutBracesAndCases) {
  EXPECT_EQ(formatted("if (a)\nb()\nelse if (c)\nd()\nelse\nwhile (e)\nf()\n"),
            "if (a)\n  b()\nelse if (c)\n  d()\nelse\n  while (e)\n    f()\n");
  EXPECT_EQ(formatted("switch (x) {\ncase 1:\nf()\nbreak\ndefault:\ng()\n}\n"),
            "switch (x) {\n  case 1:\n    f()\n    break\n  default:\n    g()\n}\n");
  EXPECT_EQ(formatted("try {\nf()\n}\ncatch (e) {\ng()\n}\nfinally {\nh()\n}\n"),
            "try {\n  f()\n}\ncatch (e) {\n  g()\n}\nfinally {\n  h()\n}\n");
}

TEST(Format, IndentsTheFurtherLinesOfAStatement) {
  EXPECT_EQ(formatted("x = a >>\nb\n"), "x = a >>\n    b\n");
  EXPECT_EQ(formatted("x = waitFor { a }\nthen b\n"), "x = waitFor { a }\n    then b\n");
  EXPECT_EQ(formatted("execute\nv1:\nwaitFor { a }\nthen (b\n>> c),\nv2: d\ne()\n"),
            "execute\n    v1:\n      waitFor { a }\n        then (b\n          >> c),\n    v2: d\ne()\n");
}

TEST(Format, KeepsOneBlankLineBetweenStatementsAndNoneAtBrackets) {
  EXPECT_EQ(formatted("\n\n\na()\n\n\n\nb {\n\n  c()\n\n}\n\n\n"), "a()\n\nb {\n  c()\n}\n");
}

TEST(Format, KeepsComments) {
  EXPECT_EQ(formatted("#!/usr/bin/env lapwing\n//x  \na() //y\n  // z\nb {  // w\n/* in */ c()\n// last\n}\n// end"),
            "#!/usr/bin/env lapwing\n//x\na() //y\n// z\nb {  // w\n  /* in */ c()\n  // last\n}\n// end\n");
  EXPECT_EQ(formatted("f(/* a */ 1 /* b */, 2)\n"), "f(/* a */ 1 /* b */, 2)\n");
  expect_same_program("a = /* one\n  two */ b\nc()\n");
}

TEST(Format, MovesACommentOfSeveralLinesAsAWhole) {
  EXPECT_EQ(formatted("b {\n    /* one\n     * two\n   three */\n    c()\n}\n"),
            "b {\n  /* one\n   * two\n three */\n  c()\n}\n");
}

TEST(Format, AlignsCommentsThatWereAligned) {
  EXPECT_EQ(formatted("a=1      // one\nbcd=22   // two\n"), "a = 1      // one\nbcd = 22   // two\n");
  EXPECT_EQ(formatted("a=1 // one\nbcd=22   // two\n"), "a = 1 // one\nbcd = 22   // two\n");
  expect_same_program("a=1      // one\nbcd=22   // two\nx=1 // three\n\ny=2 // four\n");
}

TEST(Format, EndsLinesWithLineFeedsOnly) {
  EXPECT_EQ(formatted("a()\r\nb {\r\n  c()\r\n}"), "a()\nb {\n  c()\n}\n");
  EXPECT_EQ(formatted("x = '''a\r\n  b'''\r\n"), "x = '''a\n  b'''\n");
  EXPECT_EQ(formatted("\xEF\xBB\xBF"
                      "a()\r"),
            "a()\n");
  expect_same_program("/* a\r\n b */\r\nx = '''a\r\n  b'''\r\n");
}

TEST(Format, LeavesTheEmptyScriptEmpty) {
  EXPECT_EQ(formatted(""), "");
  EXPECT_EQ(formatted("\n \n"), "");
}

TEST(Format, RefusesAScriptThatDoesNotParse) {
  EXPECT_NE(formatted("x = (1\n").find("never closed"), std::string::npos);
}

TEST(Format, EndsQuicklyOnLongAndDeepScripts) {
  std::string script;
  for (int i = 0; i < 20'000; ++i) script += "if (a) { b(1 ,2) } // c\n";
  EXPECT_TRUE(formatted(script).starts_with("if (a) { b(1, 2) } // c\n"));
  auto const deep = "x = " + std::string(200, '[') + std::string(200, ']');
  EXPECT_EQ(formatted(deep), deep + "\n");
}

TEST(Format, KnowsPatternsCastsSpreadsAndDo) {
  EXPECT_EQ(formatted("x=a=~/b c/\ny=(int)2.5\nz=l*.n()\nw = ~ 'a'\n"),
            "x = a =~ /b c/\ny = (int) 2.5\nz = l*.n()\nw = ~'a'\n");
  EXPECT_EQ(formatted("do{a()}while(b)\n(c,d)=[d,c]\ne=f=1\n"), "do { a() } while (b)\n(c, d) = [d, c]\ne = f = 1\n");
  expect_same_program("execute choose {\nwhen { a } then b\notherwise c >> d }\n");
}

}  // namespace
}  // namespace lapwing::dolphin
