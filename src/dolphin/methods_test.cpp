#include <gtest/gtest.h>

#include "dolphin/testing.hpp"

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
  EXPECT_EQ(value_of("'%.1f'.format(-0.25)"), "-0.2");
  EXPECT_EQ(value_of("'%s %s'.format([1, 2], null)"), "[1, 2] null");
  expect_fault("'%d'.format(1.5)", "%d cannot show a number");
  expect_fault("'%d'.format()", "format has too few values");
  expect_fault("'%q'.format(1)", "format knows");
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
  expect_fault("1.foo()", "there is no unit foo");
}

}  // namespace
}  // namespace lapwing::dolphin
