#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

#include "base/testing/temporary_folder.hpp"
#include "map/features/properties.hpp"
#include "map/store/blobs/blobs.hpp"
#include "map/store/rows/feature_rows.hpp"
#include "map/store/rows/site_rows.hpp"
#include "map/store/schema/migrate.hpp"
#include "map/store/schema/tables.hpp"
#include "map/store/sql/sqlite.hpp"
#include "map/store/testing/first_version.hpp"

namespace lapwing::map::schema {
namespace {

struct Schema : ::testing::Test {
  std::int64_t number(std::string const& query) const {
    return sql::as_integer(sql::value_of(*database, query).value()).value();
  }
  base::testing::TemporaryFolder folder;
  std::unique_ptr<sql::Database> database = sql::open_sqlite(folder.path() / "map.gpkg", sql::Access::write).value();
};

TEST_F(Schema, IsMadeOnceAndFoundAgain) {
  ASSERT_TRUE(prepare(*database, "a store"));
  EXPECT_TRUE(check(*database, "a store"));
  ASSERT_TRUE(prepare(*database, "a store"));
  EXPECT_EQ(number("SELECT count(*) FROM lapwing_revision"), 1);
}

TEST_F(Schema, MarksTheFileAsAGeoPackage) {
  ASSERT_TRUE(prepare(*database, "a store"));
  EXPECT_EQ(number("PRAGMA application_id"), 0x47504B47);
  EXPECT_EQ(number("PRAGMA user_version"), 10300);
  EXPECT_EQ(number("SELECT count(*) FROM gpkg_contents WHERE data_type = 'features'"), 6);
  EXPECT_EQ(number("SELECT count(*) FROM gpkg_extensions WHERE extension_name = 'gpkg_rtree_index'"), 6);
  auto const rows = sql::rows_of(*database, "PRAGMA foreign_key_check");
  EXPECT_TRUE(rows && rows->empty());
}

TEST_F(Schema, HasAColumnForEveryProperty) {
  for (auto const layer : all_layers)
    for (auto const& property : properties_of(layer))
      EXPECT_TRUE(std::ranges::any_of(layer_table(layer).columns,
                                      [&](auto const& column) { return column.name == property.name; }))
          << name_of(layer) << ' ' << property.name;
}

TEST_F(Schema, HasNoTwoColumnsOfOneName) {
  for (auto const* table : all_tables()) {
    std::set<std::string> names;
    for (auto const& column : table->columns)
      EXPECT_TRUE(names.insert(column.name).second) << table->name << '.' << column.name;
  }
}

TEST_F(Schema, IsWhatTheReferenceSays) {
  std::ifstream file(LAPWING_SOURCE_DIR "/docs/reference/store.md");
  std::string const page{std::istreambuf_iterator<char>(file), {}};
  for (auto const* one : all_tables()) {
    EXPECT_TRUE(page.contains("`" + one->name + "`")) << one->name;
    if (one->shape_column()) continue;  // the properties are described with the map
    auto const row = page.substr(page.find("\n| `" + one->name + "` |") + 1);
    for (auto const& column : one->columns)
      EXPECT_TRUE(row.substr(0, row.find('\n')).contains("`" + column.name + "`")) << one->name << '.' << column.name;
  }
}

TEST_F(Schema, TakesNothingThatIsNoStore) {
  ASSERT_TRUE(database->execute("CREATE TABLE cooking_recipes (name TEXT)"));
  auto const refused = prepare(*database, "recipes");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, base::ErrorKind::invalid_input);
  EXPECT_EQ(refused.error().message, "recipes: there is something else in it than a store");
  EXPECT_EQ(number("SELECT count(*) FROM sqlite_master"), 1);
}

TEST_F(Schema, LeavesTheStoreOfANewerProgramAlone) {
  ASSERT_TRUE(prepare(*database, "a store"));
  ASSERT_TRUE(database->change("UPDATE lapwing_store SET value = '99' WHERE name = 'schema_version'", {}));
  for (auto const& refused : {prepare(*database, "a store"), check(*database, "a store")}) {
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, base::ErrorKind::refused);
    EXPECT_EQ(refused.error().message, "a store: the store is of version 99, and this program knows up to 3");
  }
}

TEST_F(Schema, BringsAStoreOfTheFirstVersionUpWithAllThatIsInIt) {
  ASSERT_TRUE(database->execute(map::testing::first_version));
  EXPECT_EQ(check(*database, "a store").error().kind, base::ErrorKind::refused) << "who reads changes nothing";
  ASSERT_TRUE(prepare(*database, "a store"));
  EXPECT_TRUE(check(*database, "a store"));
  auto const sites = rows::read_sites(*database);
  ASSERT_TRUE(sites);
  auto const page = rows::read_page(*database, LayerKind::points_of_interest, *sites, 0, 10);
  ASSERT_TRUE(page);
  EXPECT_EQ(page->faults, std::vector<std::string>());
  ASSERT_EQ(page->features.size(), 1u);
  EXPECT_EQ(std::get<PointOfInterest>(page->features[0].content).name, "221");
  auto const media_type = sql::value_of(*database, "SELECT media_type FROM blobs");
  EXPECT_EQ(sql::as_text(*media_type), "image/jpeg");
  // And it goes on as one of today's.
  auto feature = page->features[0];
  feature.id = "another";
  feature.held_over = {{"name", feature.account}};
  EXPECT_TRUE(rows::write_features(*database, {{.feature = feature}}, *sites, 5));
}

TEST_F(Schema, IsBroughtUpWholeOrNotAtAll) {
  ASSERT_TRUE(database->execute(map::testing::first_version));
  // The last of the steps cannot be taken: what it would make is there.
  ASSERT_TRUE(
      database->execute("CREATE TABLE in_the_way (at_ns INTEGER); CREATE INDEX blobs_by_at_ns ON in_the_way (at_ns)"));
  EXPECT_FALSE(prepare(*database, "a store"));
  EXPECT_EQ(number("SELECT count(*) FROM pragma_table_info('blobs') WHERE name = 'media_type'"), 0);
  EXPECT_EQ(number("SELECT count(*) FROM lapwing_store WHERE value = '1'"), 1);
  ASSERT_TRUE(database->execute("DROP TABLE in_the_way"));
  EXPECT_TRUE(prepare(*database, "a store"));
}

}  // namespace
}  // namespace lapwing::map::schema
