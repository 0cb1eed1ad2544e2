#include <gtest/gtest.h>

#include "dolphin/testing/script_bench.hpp"

/// What expressions and statements mean, without vehicles.
namespace lapwing::dolphin {
namespace {

using testing::printed;

/// The printed value of an expression.
std::string value_of(std::string const& expression) {
  return printed("print(" + expression + ")");
}

TEST(Numbers, DivideExactly) {
  EXPECT_EQ(value_of("7/2"), "3.5");
  EXPECT_EQ(value_of("6/2"), "3");
  EXPECT_EQ(value_of("7.intdiv(2)"), "3");
  EXPECT_EQ(value_of("-7 % 3"), "-1");
  EXPECT_EQ(value_of("2 ** 10"), "1024");
}

TEST(Numbers, PrintShortAndWithoutNoise) {
  EXPECT_EQ(value_of("0.1 + 0.2"), "0.3");
  EXPECT_EQ(value_of("1500.0"), "1500.0");
  EXPECT_EQ(value_of("sqrt(2)"), "1.4142135623730951");
  EXPECT_EQ(value_of("1e20"), "1.0E20");
  EXPECT_EQ(value_of("-0.0000125"), "-0.0000125");
  EXPECT_EQ(value_of("0.001"), "0.001");
  EXPECT_EQ(value_of("NaN"), "NaN");
}

TEST(Numbers, CompareWithTolerance) {
  EXPECT_EQ(value_of("0.1 + 0.2 == 0.3"), "true");
  EXPECT_EQ(value_of("1 == 1.0"), "true");
  EXPECT_EQ(value_of("NaN < 1 || NaN >= 1 || NaN == NaN"), "false");
}

TEST(Numbers, OverflowIsAnError) {
  EXPECT_NE(value_of("9223372036854775807 + 1").find("ArithmeticException"), std::string::npos);
  EXPECT_NE(value_of("3037000500 * 3037000500").find("ArithmeticException"), std::string::npos);
  EXPECT_NE(value_of("1 / 0").find("division by zero"), std::string::npos);
}

TEST(Numbers, HaveUnits) {
  EXPECT_EQ(value_of("10.minutes + 30.seconds"), "630");
  EXPECT_EQ(value_of("1.5.km"), "1500.0");
  EXPECT_EQ(value_of("3.south"), "-3");
  EXPECT_EQ(value_of("50.percent"), "0.5");
}

TEST(Texts, InterpolateAndJoin) {
  EXPECT_EQ(printed("x = [y: 3]\nprint \"n=${1+1} $x.y\""), "n=2 3");
  EXPECT_EQ(value_of("'a' + 1 + null"), "a1null");
  EXPECT_EQ(value_of("'dolphin'.toUpperCase().contains('PH')"), "true");
  EXPECT_EQ(value_of("'a,b'.split(',')"), "[a, b]");
}

TEST(Collections, PrintAsTheyAreWritten) {
  EXPECT_EQ(value_of("[1, [2, 'x'], [k: null]]"), "[1, [2, x], [k:null]]");
  EXPECT_EQ(value_of("[:]"), "[:]");
  EXPECT_EQ(value_of("(1..3)"), "1..3");
  EXPECT_EQ(value_of("(1..3).collect { it * 2 }"), "[2, 4, 6]");
}

TEST(Numbers, HaveTheSmallestAndTheLargestOfAny) {
  EXPECT_EQ(value_of("[max(3, 1, 2), Math.min(3, 1, 2), max(7), min('b', 'a'), max(1, NaN, 2)]"), "[3, 1, 7, a, NaN]");
}

TEST(Collections, HaveMethodsWithClosures) {
  EXPECT_EQ(value_of("[3, 1, 2].sort()"), "[1, 2, 3]");
  EXPECT_EQ(value_of("['bb', 'a'].sort { it.length() }"), "[a, bb]");
  EXPECT_EQ(value_of("[3, 1, 2].sort { a, b -> b <=> a }"), "[3, 2, 1]");
  EXPECT_EQ(value_of("[1, 2, 3].inject(0) { a, b -> a + b }"), "6");
  EXPECT_EQ(value_of("[1, 2, 3].find { it > 1 }"), "2");
  EXPECT_EQ(value_of("[1, 2, 3].findAll { it != 2 }"), "[1, 3]");
  EXPECT_EQ(value_of("[1, 2, 3].any { it > 2 } && [1, 2].every { it > 0 }"), "true");
  EXPECT_EQ(value_of("[a: 1, b: 2].collect { k, v -> k + v }"), "[a1, b2]");
  EXPECT_EQ(value_of("[1, 2, 3].sum() + [4, 5].max() + [4, 5].min { -it }"), "16");
  EXPECT_EQ(printed("3.times { print it }\n1.upto(3) { print it }"), "012123");
}

TEST(Collections, ChangeInPlace) {
  EXPECT_EQ(printed("l = [1]\nl << 2\nl[2] = 3\nl[0] += 10\nl[1]++\nprint l"), "[11, 3, 3]");
  EXPECT_EQ(printed("m = [a: 1]\nm.b = 2\nm['c'] = 3\nm.a += 5\nprint m"), "[a:6, b:2, c:3]");
}

TEST(Scopes, AssignmentsWithoutDefAreGlobalEverywhere) {
  EXPECT_EQ(printed("def f() { g = 1 }\nf()\n[1].each { h = 2 }\nprint g + h"), "3");
  EXPECT_NE(printed("def f() { x }\ndef x = 1\nprint f()").find("x is not defined"), std::string::npos);
}

TEST(Scopes, ClosuresCaptureByReference) {
  EXPECT_EQ(printed("def n = 1\ndef c = { n }\nn = 5\nprint c()"), "5");
  EXPECT_EQ(
      printed("def counter() { def n = 0; return { ++n } }\ndef a = counter()\na()\nprint a()\nprint counter()()"),
      "21");
  EXPECT_EQ(printed("def all = []\nfor (i in 1..3) { all << { i } }\nprint all.collect { it() }"), "[1, 2, 3]");
}

TEST(Scopes, FunctionsAndVariablesHaveNamesOfTheirOwn) {
  EXPECT_EQ(printed("def size(x) { x * 2 }\nsize = 4\nprint size(size)"), "8");
}

TEST(Functions, TakeDefaultsAndReturnTheirLastValue) {
  EXPECT_EQ(printed("def f(a, b = a + 1) { a * b }\nprint f(2)\nprint ' '\nprint f(2, 10)"), "6 20");
  EXPECT_EQ(printed("def sign(x) { if (x < 0) { 'minus' } else { 'plus' } }\nprint sign(-1) + sign(1)"), "minusplus");
  EXPECT_EQ(printed("def f(a, b = { -> a }) { b() }\nprint f(7)"), "7");
}

TEST(Functions, OfOneNameDifferInTheNumberOfParameters) {
  EXPECT_EQ(printed("def f(a) { 'one' }\ndef f(a, b) { 'two' }\nprint f(1) + f(1, 2)"), "onetwo");
  EXPECT_EQ(printed("def f(a, b = 1) { 'one' }\ndef f(a, b, c) { 'three' }\nprint f(1) + f(1, 2, 3)"), "onethree");
}

TEST(Functions, HaveTheValueOfTheirLastTryOrSwitch) {
  EXPECT_EQ(printed("def f(x) { try { 10 / x } catch (e) { 'c' } finally { print 'f' } }\nprint f(0)\nprint f(5)"),
            "fcf2");
  EXPECT_EQ(
      printed("def f(x) { switch (x) { case 1: 'one'; break; case 2: if (x) { 'two' }; break; default: 'many' } }\n"
              "print f(1) + f(2) + f(3)"),
      "onetwomany");
  EXPECT_EQ(printed("def f() { while (false) { 1 } }\nprint f()"), "null");
}

TEST(Declarations, ConvertToTheirType) {
  EXPECT_EQ(printed("int n = 2.9\ndouble d = 2\nString s = 5\nString t = null\nprint \"$n $d ${s.size()} $t\""),
            "2 2.0 1 null");
  EXPECT_NE(printed("int n = 'x'").find("n is declared as int, this is text"), std::string::npos);
  EXPECT_EQ(printed("def a, b\nprint a\nb = 2\nprint b"), "null2");
}

TEST(Control, LoopsBreakAndContinue) {
  EXPECT_EQ(printed("for (i = 0; i < 10; i++) { if (i == 2) continue\n if (i == 5) break\n print i }"), "0134");
  EXPECT_EQ(printed("n = 3\nwhile (n) { print n--\n }"), "321");
  EXPECT_EQ(printed("for (e in [a: 1]) { print e.key + e.value }"), "a1");
}

TEST(Control, SwitchFallsThroughUnlessItBreaks) {
  std::string const choose =
      "def f(x) { switch (x) { case 1: print 'a'; case [2, 3]: print 'b'; break; default: print 'c' } }\n";
  EXPECT_EQ(printed(choose + "f(1); f(3); f(9)"), "abbc");
}

TEST(Exceptions, AreCaughtByType) {
  EXPECT_EQ(printed("try { throw new RuntimeException('oops') } catch (TaskError e) { print 'no' } catch (Exception e) "
                    "{ print e.message }"),
            "oops");
  EXPECT_EQ(printed("try { [[1, 2]][0].foo() } catch (e) { print e.message }"), "a list has no method foo");
}

TEST(Exceptions, HaveJavasFamilies) {
  std::string const caught =
      "try { throw new %s('x') } catch (RuntimeException e) { print 'runtime' } "
      "catch (Exception e) { print 'other' }";
  auto const by = [&](std::string const& type) {
    auto script = caught;
    return printed(script.replace(script.find("%s"), 2, type));
  };
  EXPECT_EQ(by("Exception"), "other");
  EXPECT_EQ(by("IOException"), "other");
  EXPECT_EQ(by("TaskError"), "other");
  EXPECT_EQ(by("NumberFormatException"), "runtime");
  EXPECT_EQ(by("MyOwnException"), "runtime");
  EXPECT_EQ(printed("try { 'a'.toInteger() } catch (IllegalArgumentException e) { print 'family' }"), "family");
}

TEST(Exceptions, FinallyRunsOnEveryWayOut) {
  EXPECT_EQ(printed("def f() { try { return 'r' } finally { print 'f' } }\nprint f()"), "fr");
  EXPECT_EQ(printed("for (i in 1..3) { try { if (i == 2) continue\n print i } finally { print 'f' } }"), "1ff3f");
  EXPECT_EQ(
      printed("try { try { throw new RuntimeException('x') } finally { print 'f' } } catch (e) { print e.message }"),
      "fx");
  EXPECT_EQ(printed("try { try { throw new RuntimeException('a') } catch (e) { throw new RuntimeException('b') } "
                    "finally { print 'f' } } "
                    "catch (e) { print e.message }"),
            "fb");
  EXPECT_EQ(printed("while (true) { try { try { break } finally { print 1 } } finally { print 2 } }\nprint 3"), "123");
}

TEST(Exceptions, HaltIsNotCaughtButFinallyRuns) {
  EXPECT_EQ(printed("try { halt 'enough' } catch (Throwable e) { print 'caught' } finally { print 'f' }"),
            "fexit 3 at 0.0: test.dolphin:1: Halting program ... enough\n");
}

TEST(Exceptions, NameTheLineOfTheScript) {
  EXPECT_EQ(printed("x = 1\n\n[1].each { it.foo }"),
            "exit 1 at 0.0: test.dolphin:3: MissingPropertyException: an integer has no property foo\n");
  EXPECT_EQ(printed("def f() {\n  assert 1 > 2\n}\nf()"), "exit 1 at 0.0: test.dolphin:2: AssertionError: 1 > 2\n");
}

TEST(Places, AreMovedExactlyInHeight) {
  EXPECT_EQ(printed("p = location(40, -8, 100)\nq = move p, { north 1.km; down 20 }\nprint q"),
            "(40.009006,-8.000000,80.000)");
  EXPECT_EQ(value_of("pos { lat 1; lon 2; hae 3 }"), "(1.000000,2.000000,3.000)");
  EXPECT_EQ(value_of("(location(41, -8) ^ 1.km).contains(location(41.001, -8))"), "true");
}

TEST(Ask, EvaluatesPureExpressionsAndReturnsOtherTextAsItIs) {
  testing::Bench bench;
  bench.transcript.answers = {"a*a+1", "hello world", "halt()", "min(3, a)"};
  EXPECT_EQ(bench.run("a = 5\nprintln ask('1?')\nprintln ask('2?')\nprintln ask('3?')\nprintln ask('4?')\n"
                      "try { ask '5?' } catch (e) { println e.message }"),
            "1?\n26\n2?\nhello world\n3?\nhalt()\n4?\n3\n5?\nask: end of input\nexit 0 at 0.0\n");
}

TEST(Ask, KnowsPureMethodsAndFunctions) {
  auto const answer = [](std::string const& typed) {
    testing::Bench bench;
    bench.transcript.answers = {typed};
    auto const text = bench.run("l = [3, 1]\nprint ask('')");
    return text.substr(1, text.rfind("exit 0") - 1);
  };
  EXPECT_EQ(answer("l.size() + Math.max(1, 2)"), "4");
  EXPECT_EQ(answer("10.minutes + 'ab'.length()"), "602");
  EXPECT_EQ(answer("'quoted'"), "quoted");
  EXPECT_EQ(answer("location(41, -8) ^ 2.km"), "area((41.000000,-8.000000,0.000) <> 2000.000000)");
  EXPECT_EQ(answer("[1, 2][0] > 0 ? 'yes' : 'no'"), "yes");
  // What has effects, is not known or fails is only text.
  for (auto const* text : {"l.add(4)", "l.clear()", "l << 1", "Math.random()", "halt('x')", "unknown + 1", "1 / 0",
                           "l = 5", "{ 1 }", "l.each { print 'x' }", "post a: 1", "", "1 +", "Math.sqrt()"}) {
    EXPECT_EQ(answer(text), text);
  }
}

}  // namespace
}  // namespace lapwing::dolphin
