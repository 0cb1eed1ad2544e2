#include "dolphin/names/signatures.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>

#include "dolphin/builtin/natives.hpp"
#include "dolphin/check/inference.hpp"
#include "dolphin/machine/engine.hpp"
#include "missions/vocabulary.hpp"

namespace lapwing::dolphin {
namespace {

TEST(Signatures, NameEachInstructionOnceAndDocumentIt) {
  std::set<std::string_view> seen;
  for (auto const& one : instructions()) {
    EXPECT_TRUE(seen.insert(one.name).second) << one.name;
    EXPECT_FALSE(one.doc.empty()) << one.name;
    EXPECT_FALSE(one.signatures.empty()) << one.name;
  }
}

/// What the checker lets pass can be run: by its function, in the language itself, or by the machine, which opens
/// blocks.
TEST(Signatures, AreAllCarriedOut) {
  for (auto const& one : instructions()) {
    bool const is_block = one.block != BlockKind::none && one.name != "move";
    EXPECT_TRUE(one.call || one.start || !one.source.empty() || is_block) << one.name;
    EXPECT_EQ(find_native(one.name).has_value(), one.call || one.start) << one.name;
  }
}

/// Also those of functions of numbers, which the reference does not show.
TEST(Signatures, HaveExamplesThatCheck) {
  for (auto const& one : instructions()) {
    if (one.example.empty()) continue;
    auto const source =
        std::make_shared<base::SourceFile const>(std::string(one.name), std::string(one.example) + "\n");
    base::Diagnostics diagnostics(*source);
    EXPECT_TRUE(load(source, missions::vocabulary(), diagnostics)) << render(diagnostics);
  }
}

TEST(Signatures, HaveOptionalParametersLast) {
  auto const check = [](InstructionSpec const& spec) {
    for (auto const& signature : spec.signatures) {
      bool optional = false;
      for (auto const& parameter : signature.parameters) {
        EXPECT_TRUE(parameter.optional || !optional) << spec.name;
        optional = parameter.optional;
      }
    }
  };
  for (auto const& one : instructions()) check(one);
  for (auto const kind : {BlockKind::pick, BlockKind::position, BlockKind::displacement, BlockKind::handler}) {
    EXPECT_FALSE(block_words(kind).empty());
    for (auto const& one : block_words(kind)) check(one);
  }
}

TEST(Kinds, MeetAndDescribeThemselves) {
  EXPECT_TRUE(Kinds::number().meets(Kind::integer));
  EXPECT_FALSE(Kinds::number().meets(Kind::text));
  EXPECT_TRUE(Kinds(Kind::integer).within(Kinds::number()));
  EXPECT_FALSE(Kinds::number().within(Kind::integer));
  EXPECT_EQ(describe(Kinds::number()), "a number");
  EXPECT_EQ(describe(Kinds(Kind::task) | Kind::closure), "a task or a closure");
  EXPECT_EQ(describe(Kinds::any()), "any value");
}

TEST(Units, AreFoundByName) {
  ASSERT_NE(find_unit("km"), nullptr);
  EXPECT_DOUBLE_EQ(find_unit("km")->factor, 1000.0);
  EXPECT_EQ(find_unit("minutes")->dimension, Dimension::time);
  EXPECT_EQ(find_unit("parsecs"), nullptr);
}

}  // namespace
}  // namespace lapwing::dolphin
