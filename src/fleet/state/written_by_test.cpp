#include "fleet/state/written_by.hpp"

#include <string>

#include <gtest/gtest.h>

namespace lapwing::fleet {
namespace {

class Author;
using Page = WrittenBy<std::string, Author>;

class Author {
 public:
  static void write(Page& page, std::string text) { page.write(As<Author>()) = std::move(text); }
  template <class Part>
  static constexpr bool may_write = requires(Part& part) { part.write(As<Author>()); };
};

class Reader {
 public:
  template <class Part>
  static constexpr bool may_write = requires(Part& part) { part.write(As<Reader>()); };
  template <class Part, class Pass = As<Author>>
  static constexpr bool may_forge = requires(Part& part) { part.write(Pass()); };
  template <class Part>
  static constexpr bool may_assign = requires(Part& part) { *part = std::string(); };
};

TEST(WrittenBy, IsReadByEverybody) {
  Page page;
  Author::write(page, "words");
  EXPECT_EQ(*page, "words");
  EXPECT_EQ(page->size(), 5U);
}

TEST(WrittenBy, IsWrittenByItsWritersAlone) {
  EXPECT_TRUE(Author::may_write<Page>);
  EXPECT_FALSE(Reader::may_write<Page>);
  EXPECT_FALSE(Reader::may_forge<Page>) << "under another's name";
  EXPECT_FALSE(Reader::may_assign<Page>);
}

}  // namespace
}  // namespace lapwing::fleet
