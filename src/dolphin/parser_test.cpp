#include "dolphin/parser.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "dolphin/ast_printer.hpp"

namespace lapwing::dolphin {
namespace {

struct Read {
  std::string tree;
  std::string complaints;
};

Read read(std::string text) {
  base::SourceFile const source("t.dolphin", std::move(text));
  base::Diagnostics diagnostics(source);
  auto const program = parse(diagnostics);
  return {print_tree(program), render(diagnostics)};
}

/// The tree of one statement that reads without complaint.
std::string tree(std::string text) {
  auto const [tree, complaints] = read(std::move(text));
  EXPECT_EQ(complaints, "");
  return tree.substr(0, tree.rfind('\n'));
}

TEST(Precedence, IsThatOfTheLanguage) {
  EXPECT_EQ(tree("x = a | b / {c} >> d"), "(= x (| a (>> (/ b {c}) d)))");
  EXPECT_EQ(tree("x = t1[v] >> t2[v] | t3[w]"), "(= x (| (>> (at t1 v) (at t2 v)) (at t3 w)))");
  EXPECT_EQ(tree("x = a - b - c"), "(= x (- (- a b) c))");
  EXPECT_EQ(tree("x = -2 ** 2"), "(= x (- (** 2 2)))");
  EXPECT_EQ(tree("x = 2 ** -1 * 3"), "(= x (* (** 2 (- 1)) 3))");
  EXPECT_EQ(tree("x = a || b && c | d ^ e & f == g < h >> i + j * k"),
            "(= x (|| a (&& b (| c (^ d (& e (== f (< g (>> h (+ i (* j k)))))))))))");
  EXPECT_EQ(tree("x = a ? b : c ? d : e"), "(= x (? a b (? c d e)))");
  EXPECT_EQ(tree("x = a ?: b"), "(= x (?: a b))");
  EXPECT_EQ(tree("x = !a.b && c"), "(= x (&& (! a.b) c))");
  EXPECT_EQ(tree("x = 1..n + 1"), "(= x (.. 1 (+ n 1)))");
  EXPECT_EQ(tree("x = a in b && c instanceof D"), "(= x (&& (in a b) (instanceof c D)))");
}

}  // namespace
}  // namespace lapwing::dolphin
