#include <gtest/gtest.h>

#include <algorithm>

#include "dolphin/names/signatures.hpp"
#include "dolphin/testing/script_bench.hpp"

/// Methods and operators of texts, lists, maps, ranges, sets and numbers.
namespace lapwing::dolphin {
namespace {

using testing::printed;

std::string value_of(std::string const& expression) {
  return printed("print(" + expression + ")");
}

/// Whether the expression throws an exception of that type with that message.
void expect_fault(std::string const& expression, std::string const& fault) {
  EXPECT_NE(value_of(expression).find(fault), std::string::npos) << expression << " gives " << value_of(expression);
}

TEST(Text, CountsCodePoints) {
  EXPECT_EQ(value_of("'äöüß€🛩'.length()"), "6");
  EXPECT_EQ(value_of("'äöü'.size() + 'abc'.size()"), "6");
  EXPECT_EQ(value_of("'äöü'[1] + 'äöü'[-1] + 'äöü'[0..1] + 'äöü'[2, 0]"), "öüäöüä");
  EXPECT_EQ(value_of("'äöü'.substring(1) + 'äöü'.substring(1, 2)"), "öüö");
  EXPECT_EQ(value_of("'äöö'.indexOf('ö') * 10 + 'äöö'.lastIndexOf('ö')"), "12");
  EXPECT_EQ(value_of("'äöü'.reverse() + 'äöü'.take(2) + 'äöü'.drop(2) + 'ä'.padLeft(3, '-') + '|'"), "üöääöü--ä|");
  EXPECT_EQ(printed("for (c in 'äö') { print \"$c.\" }"), "ä.ö.");
  EXPECT_EQ(value_of("'äö'.toList()"), "[ä, ö]");
  expect_fault("'äö'[2]", "IndexOutOfBoundsException: index 2 is outside 0..<2");
  expect_fault("'äö'.substring(1, 3)", "IndexOutOfBoundsException: substring 1..<3 of a text of 2");
  expect_fault("'ab'.substring('a')", "substring takes an integer, not a text");
}

TEST(Text, ChangesCaseBeyondAscii) {
  EXPECT_EQ(value_of("'äöß Ж'.toUpperCase() + 'ÄÖ'.toLowerCase() + 'über'.capitalize()"), "ÄÖß ЖäöÜber");
  EXPECT_EQ(value_of("'Äa'.equalsIgnoreCase('äA')"), "true");
}

TEST(Text, IsTakenApart) {
  EXPECT_EQ(value_of("'a,b,,'.split(',')"), "[a, b]");
  EXPECT_EQ(value_of("' a  b '.tokenize()"), "[a, b]");
  EXPECT_EQ(value_of("'1, 2;3'.tokenize(',; ').collect { it.toInteger() }.sum()"), "6");
  EXPECT_EQ(value_of("'a b'.split()"), "[a, b]");
  EXPECT_EQ(value_of("'banana'.count('an')"), "2");
}

TEST(Text, HasOperators) {
  EXPECT_EQ(value_of("'ab' * 3 + ('abcb' - 'b') + 'a' * 0"), "abababacb");
  expect_fault("'a' * -1", "a text cannot be repeated -1 times");
  expect_fault("'a' * 99999999", "OutOfMemoryError");
  expect_fault("['a'][0] / 2", "a text has no operator / with an integer");
}

TEST(Text, IsReadAsNumber) {
  EXPECT_EQ(value_of("' 12 '.toInteger() + '0.5'.toDouble()"), "12.5");
  EXPECT_EQ(value_of("['1', '1.5', 'x', ''].collect { it.isNumber() }"), "[true, true, false, false]");
  expect_fault("'x'.toInteger()", "NumberFormatException: 'x' is no number");
  expect_fault("'1.5'.toInteger()", "NumberFormatException: '1.5' is no integer");
}

TEST(Text, IsFormatted) {
  EXPECT_EQ(
      value_of("String.format('%.2f m|%5d|%-4s|%03d|%x|%d%%|%+d|%e', 3.14159, 42, 'ä', 7, 255, 50, 1, 12345.678)"),
      "3.14 m|   42|ä   |007|ff|50%|+1|1.234568e+04");
  EXPECT_EQ(value_of("'%.1f %.2f %.0f %.3f'.format(-0.25, 0.005, 0.5, 9.9996)"), "-0.3 0.01 1 10.000");
  EXPECT_EQ(value_of("'%10.3e|%-12E|%g|%g|%.3g'.format(0.00012345, 12345.0, 0.0001, 1234567.0, 999.6)"),
            " 1.235e-04|1.234500E+04|0.000100000|1.23457e+06|1.00e+03");
  EXPECT_EQ(value_of("'%,d %,.2f %o %X %c %c %2$s %<s %S'.format(1234567, 1234.5, 8, 255, 'a', 66, 'ab')"),
            "1,234,567 1,234.50 10 FF a B 1234.5 1234.5 AB");
  EXPECT_EQ(value_of("'%+d|% d|%(d|%08.2f|%#x|%#o|%.2s|%b|%B'.format(5, 5, -5, -3.14159, 255, 8, 'abc', null, 1)"),
            "+5| 5|(5)|-0003.14|0xff|010|ab|false|TRUE");
  EXPECT_EQ(value_of("'%2000d'.format(1).size()"), "2000");
  EXPECT_EQ(value_of("'%s %s'.format([1, 2], null)"), "[1, 2] null");
  expect_fault("'%d'.format(1.5)", "%d cannot show a number");
  expect_fault("'%d'.format()", "format has too few values");
  expect_fault("'%q'.format(1)", "%q is no field of format: it knows %d");
  expect_fault("'%20000d'.format(1)", "%20000d is wider than 10000 characters");
  expect_fault("'%-d'.format(1)", "%-d has a - or 0 and no width");
  expect_fault("'%.2d'.format(1)", "%.2d takes no precision");
  expect_fault("'%tY'.format(1)", "%t is no field of format");
  expect_fault("'%3$s'.format(1)", "format has too few values for %3$s");
  expect_fault("'10 %'.format(1)", "% is no field of format: its letter is missing");
}

TEST(List, HasPlacesAndParts) {
  EXPECT_EQ(value_of("[1, 2, 3][0..1] + [1, 2, 3][1..-1] + [1, 2, 3][-1..-2] + [1, 2, 3][2, 0]"),
            "[1, 2, 2, 3, 3, 2, 3, 1]");
  EXPECT_EQ(value_of("[[1, 2, 3].take(2), [1, 2, 3].drop(1), [1, 2].take(9), [1, 2, 3].tail(), [1, 2, 3].init()]"),
            "[[1, 2], [2, 3], [1, 2], [2, 3], [1, 2]]");
  EXPECT_EQ(value_of("[1, 2, 3, 4, 5].collate(2)"), "[[1, 2], [3, 4], [5]]");
  EXPECT_EQ(value_of("[1, 2, 3].subList(1, 3)"), "[2, 3]");
  EXPECT_EQ(value_of("[1, [2, [3]]].flatten()"), "[1, 2, 3]");
  EXPECT_EQ(value_of("[[1, 2].first(), [1, 2].last(), [7, 8].indexOf(8), [7].indexOf(8), [1][5]]"),
            "[1, 2, 1, -1, null]");
  expect_fault("[].first()", "NoSuchElementException: the list is empty");
  expect_fault("[1].get(1)", "IndexOutOfBoundsException: index 1 is outside 0..<1");
  expect_fault("[1][-2]", "IndexOutOfBoundsException: index -2 is outside 0..<1");
  expect_fault("[1]['a']", "a text is no index of a list");
  expect_fault("[1].take('a')", "take takes an integer, not a text");
}

TEST(List, ChangesInPlace) {
  EXPECT_EQ(printed("l = [3, 1, 2]\nl.sort()\nprint l\nl.sort { a, b -> b <=> a }\nprint l"), "[1, 2, 3][3, 2, 1]");
  EXPECT_EQ(printed("l = [2, 1, 2]\nl.unique()\nl.add(0, 9)\nprint l"), "[9, 2, 1]");
  EXPECT_EQ(printed("l = [1]\nl[3] = 4\nprint l\nl.remove(0)\nl.removeElement(4)\nprint l"),
            "[1, null, null, 4][null, null]");
  EXPECT_EQ(printed("l = [1, 2, 3]\nl.removeAll([1, 3])\nl.addAll([5, 6])\nprint l.pop()\nprint l"), "6[2, 5]");
  EXPECT_NE(printed("l = []\nl[2000000] = 1").find("IndexOutOfBoundsException"), std::string::npos);
  expect_fault("[].pop()", "the list is empty");
}

TEST(List, HasOperators) {
  EXPECT_EQ(value_of("[1] + [2] + 3"), "[1, 2, 3]");
  EXPECT_EQ(value_of("[1, 2, 1, 3] - [1]"), "[2, 3]");
  EXPECT_EQ(value_of("[0] * 3"), "[0, 0, 0]");
  EXPECT_EQ(value_of("(1..3) + [4] - (2..3)"), "[1, 4]");
  EXPECT_EQ(value_of("[1, 2].intersect([2, 3]) + [[1].disjoint([2]), [1, 2].containsAll([2])]"), "[2, true, true]");
  expect_fault("[[1]][0] / 2", "a list has no operator / with an integer");
  expect_fault("[1] < [2]", "a list cannot be compared with a list");
}

TEST(Collections, FoldAndSearch) {
  EXPECT_EQ(value_of("[1, 2, 3].inject { a, b -> a * b + 1 }"), "10");
  EXPECT_EQ(value_of("[1, 2].inject(10) { a, b -> a - b }"), "7");
  EXPECT_EQ(value_of("['aaa', 'c', 'bb'].min { it.size() } + ['a', 'bb'].max { x, y -> x.size() <=> y.size() }"),
            "cbb");
  EXPECT_EQ(value_of("[b: 2, a: 1].sort()"), "[a:1, b:2]");
  EXPECT_EQ(value_of("[a: 1, b: 3].max { it.value }.key + [a: 1].containsValue(1)"), "btrue");
  EXPECT_EQ(value_of("[[1, 2], [3]].collectMany { it }"), "[1, 2, 3]");
  EXPECT_EQ(value_of("['x', 'y'].withIndex()"), "[[x, 0], [y, 1]]");
  EXPECT_EQ(printed("0.step(6, 2) { print it }\n[1, 2].reverseEach { print it }"), "02421");
  EXPECT_EQ(value_of("[].max() == null && [].sum() == null && [].inject { a, b -> a } == null"), "true");
}

TEST(VehicleSet, HasParts) {
  EXPECT_EQ(printed("v = pick { count 3 }\nprint \"${v[0..1]}${v.drop(2)}${v[2, 0]}${v.take(1)}${v.size()}\""),
            "{ a1 a2 }{ u1 }{ u1 a1 }{ a1 }3");
  EXPECT_NE(printed("v = pick {}\nprint v[1]").find("index 1 is outside 0..<1"), std::string::npos);
}

TEST(Number, IsRoundedAndDivided) {
  EXPECT_EQ(value_of("[2.5.round(), (-2.5).round(), 5.4321.round(2), 7.intdiv(2), 7.9.toInteger(), (-3).abs()]"),
            "[3, -2, 5.43, 3, 7, 3]");
  EXPECT_EQ(value_of("-9223372036854775808"), "-9223372036854775808");
  EXPECT_EQ(value_of("3.plus(4).multiply(2).mod(5).power(2)"), "16");
  expect_fault("NaN.round()", "ArithmeticException: NaN is no integer");
  expect_fault("1.5.intdiv(2)", "intdiv divides integers, not a number by an integer");
  expect_fault("1.foo()", "a whole number has no member foo");
}

// ---- the table of methods

struct Receiver {
  Kind kind;
  std::string_view value;
};
constexpr Receiver receivers[] = {{Kind::integer, "3"},
                                  {Kind::decimal, "2.5"},
                                  {Kind::text, "'abc'"},
                                  {Kind::list, "[1, 2]"},
                                  {Kind::map, "[a: 1]"},
                                  {Kind::position, "location(41, -8)"},
                                  {Kind::displacement, "moveDistance { north 5 }"},
                                  {Kind::area, "(location(41, -8) ^ 5)"},
                                  {Kind::vehicles, "(pick { })"},
                                  {Kind::task, "idle(1)"},
                                  {Kind::closure, "{ 1 }"},
                                  {Kind::boolean, "true"}};

/// Whether the engine knows a method of that name for the value, with some number of arguments of some kind.
bool has_method(std::string_view value, MethodSpec const& method) {
  auto const wanted = argument_count(method);
  for (auto count = wanted.least; count <= std::min<std::size_t>(wanted.most, wanted.least + 2); ++count) {
    for (auto const* argument : {"1", "'a'", "[1]", "[a: 1]", "{ 1 }", "location(41, -8)"}) {
      std::string arguments;
      for (std::size_t i = 0; i < count; ++i) arguments += i == 0 ? argument : ", 1";
      // Through a variable that the checker cannot follow, so that nothing is refused before it runs.
      auto const script = fmt::format(
          "values = [{}]\nvalues.each {{ v -> try {{ v.{}({}) }} "
          "catch (Exception e) {{ print(e.message) }} }}",
          value, method.name, arguments);
      if (!printed(script).contains("has no method")) return true;
      if (count == 0) break;
    }
  }
  return false;
}

/// What the checker lets pass is there when the script runs.
TEST(Methods, AreThoseOfTheTable) {
  for (auto const& method : methods()) {
    if (method.is_property) continue;
    for (auto const& receiver : receivers) {
      bool const is_said = std::ranges::any_of(methods(), [&](MethodSpec const& one) {
        return one.name == method.name && !one.is_property && one.receiver.meets(receiver.kind);
      });
      if (is_said) {
        EXPECT_TRUE(has_method(receiver.value, method)) << receiver.value << "." << method.name;
      }
    }
  }
}

/// By a function, or in the language itself; closures are called by the machine.
TEST(Methods, AreAllCarriedOut) {
  for (auto const& method : methods()) {
    EXPECT_FALSE(method.doc.empty()) << method.name;
    EXPECT_TRUE(method.call || (!method.is_property && !method.source.empty()) || method.name == "call") << method.name;
  }
}

TEST(Properties, AreThoseOfTheTable) {
  EXPECT_EQ(value_of("[location(41, -8, 90).height, (moveDistance { east 5 }).east, (location(41, -8) ^ 50).radius]"),
            "[90.0, 5.0, 50.0]");
  EXPECT_EQ(printed("v = pick {}\nprint v.id + v.name + v.type + v[0].connected + v[0].class.simpleName"),
            "[a1, a1, UAV, true, Vehicle]");
  EXPECT_EQ(value_of("[idle(1).name == idle(1).id, [].class.simpleName, [a: 1].class]"), "[true, List, null]");
  expect_fault("[location(41, -8)][0].radius", "a position has no property radius");
  expect_fault("[null][0].lat", "cannot read lat of null");
}

TEST(Patterns, AreFoundInTexts) {
  EXPECT_EQ(value_of("'uav7 ugv8' =~ /\\d/"), "[7, 8]");
  EXPECT_EQ(value_of("('uav7 ugv8' =~ /(u.v)(\\d)/)[1][2]"), "8");
  EXPECT_EQ(value_of("['uav7' ==~ /uav\\d/, 'xuav7' ==~ /uav\\d/, 'a.b' ==~ 'a.b', 'axb' ==~ ~'a.b']"),
            "[true, false, true, true]");
  EXPECT_EQ(value_of("'a1b22'.findAll(/\\d+/) + 'a1'.find(/x/) + 'a, b;c'.split(/[,;]\\s*/) + 'aXbX'.count(/X/)"),
            "[1, 22, null, a, b, c, 2]");
  EXPECT_EQ(value_of("'abc'.contains(/b./) && !'abc'.contains('b.') && 'a|b'.split('|').size() == 2"), "true");
  EXPECT_EQ(printed("if ('abc' =~ /x/) { print 'yes' } else { print 'no' }"), "no");
  EXPECT_EQ(printed("switch ('uav7') { case /ugv./: print 'g'; break; case ~'uav.': print 'a' }"), "a");
}

TEST(Patterns, ReplaceWithGroupsAndClosures) {
  EXPECT_EQ(value_of("'2026-11-22'.replaceAll(/(\\d+)-(\\d+)-(\\d+)/, '$3.$2.$1')"), "22.11.2026");
  EXPECT_EQ(value_of("'abc'.replaceAll(/x*/, '-') + 'aba'.replaceFirst(/a/, '\\\\$')"), "-a-b-c-$ba");
  EXPECT_EQ(value_of("'a1b2'.replaceAll(/\\d/) { it.toInteger() + 1 }"), "a2b3");
  EXPECT_EQ(value_of("'a1b2'.replaceAll(/(\\w)(\\d)/) { all, letter, digit -> digit + letter }"), "1a2b");
  expect_fault("'a'.replaceAll(/a/, '$1')", "the pattern has no group 1");
  expect_fault("'a' =~ ('(' + '')", "PatternSyntaxException: this is no pattern");
  expect_fault("[1][0] =~ /1/", "an integer has no operator =~");
}

/// What takes other engines longer than the world has been there.
TEST(Patterns, TakeLinearTime) {
  EXPECT_EQ(value_of("('a' * 100000) ==~ /(a+)+b/"), "false");
  EXPECT_EQ(value_of("(('a' * 50000) =~ /(a|aa)*c/).size()"), "0");
}

TEST(Truths, HaveOperatorsWithoutShortCut) {
  EXPECT_EQ(value_of("[true & false, true | false, true ^ true, ~5]"), "[false, true, false, -6]");
  expect_fault("true & [1][0]", "a boolean has no operator & with an integer");
}

TEST(Spread, CallsEachElement) {
  EXPECT_EQ(value_of("['a', null, 'b']*.toUpperCase()"), "[A, null, B]");
  EXPECT_EQ(value_of("[[n: 1], [n: 2]]*.n + (1..2)*.plus(1)"), "[1, 2, 2, 3]");
}

TEST(DeclaredTypes, TurnOrRefuseValues) {
  EXPECT_EQ(
      printed(
          "int n = 2.9\nn = 7.5\nString s = 5\nboolean b = 'x'\ndouble d = 1\nint zero\nprint \"$n $s $b $d $zero\""),
      "7 5 true 1.0 0");
  EXPECT_NE(printed("x = ['abc']\nint n = x[0]").find("ClassCastException: int n cannot hold a text"),
            std::string::npos);
  EXPECT_NE(printed("def f(int n) { n }\nf([1.5][0])").find("MissingMethodException: int n does not take a number"),
            std::string::npos);
  EXPECT_EQ(printed("def f(double d, String s) { \"$d $s\" }\nprint f(3, 'a')"), "3.0 a");
  EXPECT_EQ(printed("int n = 1\nc = { n = 2.5 }\nc()\nprint n"), "2");
}

TEST(ClassOfMaps, IsToldByGetClass) {
  EXPECT_EQ(value_of("[a: 1].getClass().simpleName + [class: 3].class"), "Map3");
}

}  // namespace
}  // namespace lapwing::dolphin
