#include "dolphin/syntax/parser.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

#include "base/testing/cpu_time.hpp"
#include "dolphin/check/checker.hpp"
#include "dolphin/syntax/ast_printer.hpp"

namespace lapwing::dolphin {
namespace {

struct Read {
  std::string tree;
  std::string complaints;
  std::size_t errors;
};

Read read(std::string text) {
  base::SourceFile const source("t.dolphin", std::move(text));
  base::Diagnostics diagnostics(source);
  auto const program = parse(diagnostics);
  return {print_tree(program), render(diagnostics), diagnostics.error_count()};
}

/// The trees of statements that read without complaint, one a line.
std::string tree(std::string text) {
  auto const out = read(std::move(text));
  EXPECT_EQ(out.complaints, "");
  return out.tree.substr(0, out.tree.rfind('\n'));
}

TEST(Precedence, IsThatOfTheLanguage) {
  EXPECT_EQ(tree("x = a | b / {c} >> d"), "(= x (| a (>> (/ b {c}) d)))");
  EXPECT_EQ(tree("x = t1[v] >> t2[v] | t3[w]"), "(= x (| (>> (at t1 v) (at t2 v)) (at t3 w)))");
  EXPECT_EQ(tree("x = a - b - c"), "(= x (- (- a b) c))");
  EXPECT_EQ(tree("x = -2 ** 2"), "(= x (- (** 2 2)))");
  EXPECT_EQ(tree("x = 2 ** -1 * 3"), "(= x (* (** 2 (- 1)) 3))");
  EXPECT_EQ(tree("x = 2 ** 3 ** 2"), "(= x (** (** 2 3) 2))");
  EXPECT_EQ(tree("x = 2 ** -3 ** -a"), "(= x (** (** 2 (- 3)) (- a)))");
  EXPECT_EQ(tree("x = a =~ /b/ && c ==~ ~d"), "(= x (&& (=~ a /b/) (==~ c (~ d))))");
  EXPECT_EQ(tree("x = (int) a / b as int"), "(= x (as (/ (as a int) b) int))");
  EXPECT_EQ(tree("x = (int) -a\ny = (n) - a\nz = (int) (a)"), "(= x (as (- a) int))\n(= y (- n a))\n(= z (as a int))");
  EXPECT_EQ(tree("x = a*.b*.c(1)"), "(= x (call a*.b*.c 1))");
  EXPECT_EQ(tree("x = a || b && c | d ^ e & f == g < h >> i + j * k"),
            "(= x (|| a (&& b (| c (^ d (& e (== f (< g (>> h (+ i (* j k)))))))))))");
  EXPECT_EQ(tree("x = a ? b : c ? d : e"), "(= x (? a b (? c d e)))");
  EXPECT_EQ(tree("x = a ?: b"), "(= x (?: a b))");
  EXPECT_EQ(tree("x = !a.b && c"), "(= x (&& (! a.b) c))");
  EXPECT_EQ(tree("x = 1..n + 1"), "(= x (.. 1 (+ n 1)))");
  EXPECT_EQ(tree("x = a in b && c instanceof D"), "(= x (&& (in a b) (instanceof c D)))");
  EXPECT_EQ(tree("x = (location 38.4, -8.8) ^ 2.km"), "(= x (^ (call location 38.4 (- 8.8)) 2.km))");
  EXPECT_EQ(tree("x = a as int"), "(= x (as a int))");
}

TEST(Newlines, EndStatementsOnlyWhereTheyCan) {
  EXPECT_EQ(tree("a\nb"), "a\nb");
  EXPECT_EQ(tree("x = a >>\n b"), "(= x (>> a b))");
  EXPECT_EQ(tree("x = a\n  >> b\n  | c"), "(= x (| (>> a b) c))");
  EXPECT_EQ(tree("x = a\n-b"), "(= x a)\n(- b)");
  EXPECT_EQ(tree("x = a\n[b]"), "(= x a)\n[b]");
  EXPECT_EQ(tree("x = a\n(b)"), "(= x a)\nb");
  EXPECT_EQ(tree("x = a\n{ b }"), "(= x a)\n{b}");
  EXPECT_EQ(tree("x = a\n  .b()\n  ?.c"), "(= x (call a.b)?.c)");
  EXPECT_EQ(tree("x = (a\n+ b\n- c)"), "(= x (- (+ a b) c))");
  EXPECT_EQ(tree("f a\n , b"), "(call f a b)");
  EXPECT_EQ(tree("f a,\n b"), "(call f a b)");
  EXPECT_EQ(tree("x =\n 5"), "(= x 5)");
  EXPECT_EQ(tree("x = a \\\n + b"), "(= x (+ a b))");
  EXPECT_EQ(tree("[{ a\n b }]"), "[{a; b}]");
  EXPECT_EQ(tree("if (a)\n b\nelse\n c"), "(if a {b} {c})");
  EXPECT_EQ(tree("a; b ;; c"), "a\nb\nc");
  EXPECT_EQ(tree("x = a ? b\n : c"), "(= x (? a b c))");
}

TEST(Newlines, GoOnWithWordsOfAnOpenChain) {
  EXPECT_EQ(tree("execute v:\n waitFor { c }\n then t"), "(call execute v: (waitFor {c} t))");
  EXPECT_EQ(tree("x = until { c }\n run t >> u"), "(= x (until {c} (>> t u)))");
  EXPECT_EQ(tree("x = watch a >> b\n onError { c }"), "(= x (watch (>> a b) {c}))");
  EXPECT_EQ(tree("execute\n\n v1 :\n t,\n _:\n u"), "(call execute v1: t _: u)");
  EXPECT_EQ(tree("then = 1\nrun(then)"), "(= then 1)\n(call run then)");
}

TEST(CommandCalls, TakeWhatCannotBeAnOperand) {
  EXPECT_EQ(tree("message 'x'"), "(call message 'x')");
  EXPECT_EQ(tree("lon -8.6"), "(- lon 8.6)");
  EXPECT_EQ(tree("message [1, 2]"), "(at message [1, 2])");
  EXPECT_EQ(tree("move ((-50), (-50), 0)"), "(call move (- 50) (- 50) 0)");
  EXPECT_EQ(tree("v.each { it }"), "(call v.each {it})");
  EXPECT_EQ(tree("a.b.c 1, 2"), "(call a.b.c 1 2)");
  EXPECT_EQ(tree("f(a) { b } { c }"), "(call f a {b} {c})");
  EXPECT_EQ(tree("execute (uuv1:t1)"), "(call execute uuv1: t1)");
  EXPECT_EQ(tree("post 'a b': 1, default: 2"), "(call post a b: 1 default: 2)");
  EXPECT_EQ(tree("return f 1"), "(return (call f 1))");
  EXPECT_EQ(tree("imcPlan['s'] | imcPlan('t')"), "(| (call imcPlan 's') (call imcPlan 't'))");
  EXPECT_EQ(tree("x in y"), "(in x y)");
}

TEST(CommandCalls, OfVoidInstructionsTakeAWholeExpression) {
  EXPECT_EQ(read("execute (a | b) / {c}").tree, "(call execute (/ (| a b) {c}))\n");
  EXPECT_EQ(read("execute (a | b) / {c}").errors, 0U);
  EXPECT_EQ(tree("execute (a | b)"), "(call execute (| a b))");
  EXPECT_EQ(tree("f (a) / b"), "(/ (call f a) b)");
}

TEST(Chains, AreOneNodeInEverySpelling) {
  EXPECT_EQ(tree("x = waitFor({c}).then(t) >> u"), "(= x (>> (waitFor {c} t) u))");
  EXPECT_EQ(tree("x = a >> waitFor {c} then b | d"), "(= x (>> a (waitFor {c} (| b d))))");
  EXPECT_EQ(tree("x = during { 0.3 } run t"), "(= x (during {0.3} t))");
  EXPECT_EQ(tree("x = during 5.seconds run t"), "(= x (during 5.seconds t))");
  EXPECT_EQ(read("execute (a | b)[v]").tree, "(call execute (at (| a b) v))\n");
  EXPECT_EQ(read("message (1..5).sum()").tree, "(call message (call (.. 1 5).sum))\n");
  EXPECT_EQ(tree("execute during 5.seconds run t"), "(call execute (during 5.seconds t))");
  EXPECT_EQ(tree("execute during { 5 } run t >> u"), "(call execute (during {5} (>> t u)))");
  EXPECT_EQ(tree("execute v: during 5 run t, w: u"), "(call execute v: (during 5 t) w: u)");
  EXPECT_EQ(tree("x = watch(t).onError { e }"), "(= x (watch t {e}))");
  EXPECT_EQ(tree("when = 1; until = when + 1"), "(= when 1)\n(= until (+ when 1))");
  EXPECT_EQ(read("task 't' during 2.seconds").tree, "(during 2.seconds (call task 't'))\n");
  EXPECT_EQ(read("idle().during(3)").tree, "(during 3 (call idle))\n");
  EXPECT_EQ(read("x = waitFor {c} run t").tree, "(= x (waitFor {c} t))\n");
}

TEST(Statements, AreAllRead) {
  EXPECT_EQ(tree("def f(a, int b = 2) { a }"), "(def f(a, int b = 2) {a})");
  EXPECT_EQ(tree("def (p, q) = l\ndef x\nint k = 4\nString s"),
            "(def [p q] l)\n(def x nothing)\n(int k 4)\n(String s nothing)");
  EXPECT_EQ(tree("double f(x) { x }"), "(def f(x) {x})");
  EXPECT_EQ(tree("if (a) b else if (c) { d } else e"), "(if a {b} {(if c {d} {e})})");
  EXPECT_EQ(tree("while (a) { break; continue }"), "(while a {(break); (continue)})");
  EXPECT_EQ(tree("for (int i = 0; i < 3; i++) f i"), "(for (int i 0) (< i 3) (_++ i) {(call f i)})");
  EXPECT_EQ(tree("for (;;) { }"), "(for nothing nothing nothing {})");
  EXPECT_EQ(tree("for (String s : l) { s }"), "(for-in s l {s})");
  EXPECT_EQ(tree("switch (x) { case 1:\n a; break\n default: b }"), "(switch x (1 {a; (break)}) (default {b}))");
  EXPECT_EQ(tree("try { a } catch (A | B e) { b } finally { c }"), "(try {a} (catch A B e {b}) (finally {c}))");
  EXPECT_EQ(tree("assert a : 'm'\nthrow new E('x')"), "(assert a 'm')\n(throw (new E 'x'))");
  EXPECT_EQ(tree("x += 1; a.b -= 2; a[0] *= 3"), "(+= x 1)\n(-= a.b 2)\n(*= (at a 0) 3)");
  EXPECT_EQ(tree("{ x, y = 2 -> x }\n{ -> 1 }\n{ it }"), "{x, y = 2 -> x}\n{ -> 1}\n{it}");
  EXPECT_EQ(tree("[:]\n[]\n[a: 1, 'b': 2, (c): 3, 4: 5]"), "[:]\n[]\n['a': 1, 'b': 2, c: 3, 4: 5]");
  EXPECT_EQ(tree(R"("a${b}c $d.e")"), "(text 'a' b 'c ' d.e)");
  EXPECT_EQ(tree(R"('\u00e4\n' + '''x
y''')"),
            "(+ 'ä\\n' 'x\\ny')");
}

TEST(Commands, StandDirectlyInsideParentheses) {
  EXPECT_EQ(tree("message (poll 'x')"), "(call message (call poll 'x'))");
  EXPECT_EQ(tree("f(a, g 1, 2)"), "(call f a (call g 1 2))");
  EXPECT_EQ(tree("f(a.b 1)"), "(call f (call a.b 1))");
  EXPECT_EQ(tree("f(consume x: 1)"), "(call f (call consume x: 1))");
  EXPECT_EQ(tree("max(abs (x), 3)"), "(call max (call abs x) 3)");
  EXPECT_EQ(tree("f(a ? b : c)"), "(call f (? a b c))");
}

TEST(Statements, AssignWithEveryOperator) {
  EXPECT_EQ(tree("a %= 1; b **= 2; c <<= 3; d >>= 4; e &= 5; f ^= 6; g |= 7"),
            "(%= a 1)\n(**= b 2)\n(<<= c 3)\n(>>= d 4)\n(&= e 5)\n(^= f 6)\n(|= g 7)");
  EXPECT_EQ(tree("a || b; a | b; a >> b; a ** b"), "(|| a b)\n(| a b)\n(>> a b)\n(** a b)");
}

TEST(Statements, AssignToSeveralTargets) {
  EXPECT_EQ(tree("a = b.c = d[0] = 1"), "(= a = b.c = (at d 0) 1)");
  EXPECT_EQ(tree("(a, b) = [b, a]"), "(= [a, b] [b, a])");
  EXPECT_EQ(tree("do { a } while (b)\nc"), "(do {a} while b)\nc");
  EXPECT_EQ(tree("choose { when { a } then b\n otherwise c >> d }"),
            "(call choose {(when {a} b); (otherwise (>> c d))})");
}

TEST(Closures, TakeTheirArrowOnTheNextLine) {
  EXPECT_EQ(tree("{ x\n -> x }\n{ a,\n b -> a }"), "{x -> x}\n{a, b -> a}");
}

TEST(Recovery, ReportsEachMistakeOnceAndReadsOn) {
  auto const out = read("a = = 1\nb = (1 + ) * 2\nf(c + )\ng {\n h i j\n k = \n}\nl = 1\n");
  EXPECT_EQ(out.errors, 5U) << out.complaints;
  EXPECT_NE(out.tree.find("(= l 1)"), std::string::npos);
}

TEST(Recovery, KeepsOneForgottenBracketFromSpoilingTheRest) {
  auto const out = read("f(a\nb = 1\nwhile (true {\n c = 2\n}\nd = 3");
  EXPECT_EQ(out.errors, 2U) << out.complaints;
  EXPECT_EQ(out.tree, "(call f a)\n(= b 1)\n(while true {(= c 2)})\n(= d 3)\n");
}

TEST(Limits, EndDeepNestingWithADiagnostic) {
  auto const deep = [](std::string_view open, std::string_view close, int n) {
    std::string text = "x = ";
    for (int i = 0; i < n; ++i) text += open;
    text += '1';
    for (int i = 0; i < n; ++i) text += close;
    return text;
  };
  using Pair = std::pair<std::string_view, std::string_view>;
  for (auto const& [open, close] : std::vector<Pair>{{"(", ")"},
                                                     {"[", "]"},
                                                     {"{", "}"},
                                                     {"f(", ")"},
                                                     {"-", ""},
                                                     {"!", ""},
                                                     {"++", ""},
                                                     {"1 + ", ""},
                                                     {"a.", ""},
                                                     {"2 ** ", ""},
                                                     {"a ? b : ", ""},
                                                     {"a ?: ", ""},
                                                     {"waitFor {c} then ", ""},
                                                     {"[a: ", "]"},
                                                     {"\"${", "}\""},
                                                     {"{ if (a) ", "}"},
                                                     {"a[", "]"},
                                                     {"", "()"},
                                                     {"", ".b"},
                                                     {"", "{}"},
                                                     {"a >> ", ""},
                                                     {"", " as B"},
                                                     {"(", ""},
                                                     {"{", ""},
                                                     {"[", ""},
                                                     {"", ")"},
                                                     {"{ x -> ", "}"},
                                                     {"new A(", ")"}}) {
    auto const out = read(deep(open, close, 20'000));
    EXPECT_GE(out.errors, 1U) << open << close;
    EXPECT_EQ(read(deep(open, close, 15)).complaints.find("too deeply"), std::string::npos) << open << close;
  }
  EXPECT_GE(read([] {
              std::string text;
              for (int i = 0; i < 20'000; ++i) text += "if (a) b else ";
              return text + "c";
            }())
                .errors,
            1U);
}

/// Reads, checks and renders `size` bytes of repeated `piece`; the seconds that took.
double seconds_for(std::string_view piece, std::size_t size) {
  std::string text;
  while (text.size() < size) text += piece;
  base::SourceFile const source("big", std::move(text));
  base::Diagnostics diagnostics(source);
  auto const begin = base::cpu_time();
  auto const program = parse(diagnostics);
  check(program, {}, diagnostics);
  EXPECT_LT(render(diagnostics).size(), 200'000U) << piece;
  return std::chrono::duration<double>(base::cpu_time() - begin).count();
}

TEST(Limits, ReadTenMegabytes) {
  constexpr std::size_t size = std::size_t{10} << 20U;
  EXPECT_LT(seconds_for("message 'a long enough text of some words' + variable // and a comment behind it\n", size),
            30.0);
}

/// Four times the text may take four times the time; twenty tells a quadratic reader from one that was disturbed.
TEST(Limits, ReadHostileTextsInLinearTime) {
  for (std::string_view const piece :
       {"x = task('A') >> { battery(v) < 0.3 } / [1, 2]\n", "message \"a ${b + 1} $c.d\"\n", "f(((((1)))))\n",
        "undefinedName somethingElse, { y }\n", "'unclosed\n", "(", "}", "\"${", "a+", "{ x -> ", "/*"}) {
    auto const once = seconds_for(piece, 50'000);
    EXPECT_LT(seconds_for(piece, 200'000), 20.0 * once + 0.5) << piece;
  }
}

}  // namespace
}  // namespace lapwing::dolphin
