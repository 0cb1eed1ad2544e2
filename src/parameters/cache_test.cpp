#include "parameters/cache.hpp"

#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>

#include "base/testing/temporary_folder.hpp"

namespace lapwing::parameters {
namespace {

namespace fs = std::filesystem;
using enum mavlink::MavParamType;

struct CacheTest : ::testing::Test {
  base::testing::TemporaryFolder temporary;
  fs::path const folder = temporary.path();
  Identity const identity{.uid = "0a0b", .firmware = 0x04060000, .custom_version = "cafe"};
  CachedParameters const some{.parameters = {{"A", 1, int8}, {"B", 0.5, real32}},
                              .taken = base::UtcTime{std::chrono::seconds(1'700'000'000)}};
};

TEST_F(CacheTest, GivesBackWhatItWasGiven) {
  Cache const cache(folder / "deep/er");
  EXPECT_FALSE(cache.find(identity));
  auto with_hash = some;
  with_hash.hash = 0xDEADBEEF;
  ASSERT_TRUE(cache.store(identity, with_hash));
  auto const found = cache.find(identity);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->parameters, some.parameters);
  EXPECT_EQ(found->taken, some.taken);
  EXPECT_EQ(found->hash, 0xDEADBEEF);
  ASSERT_TRUE(cache.store(identity, some));
  EXPECT_FALSE(cache.find(identity)->hash) << "replaced as a whole";
}

TEST_F(CacheTest, GivesNothingToAnotherVehicleOrFirmware) {
  Cache const cache(folder);
  ASSERT_TRUE(cache.store(identity, some));
  auto other = identity;
  other.uid = "0a0c";
  EXPECT_FALSE(cache.find(other));
  other = identity;
  other.firmware = 0x04070000;
  EXPECT_FALSE(cache.find(other));
  other = identity;
  other.custom_version = "beef";
  EXPECT_FALSE(cache.find(other));
}

TEST_F(CacheTest, KeepsNothingOfAnAutopilotWithoutAnId) {
  Cache const cache(folder);
  ASSERT_TRUE(cache.store({}, some));
  EXPECT_TRUE(fs::is_empty(folder));
  EXPECT_FALSE(cache.find({}));
  EXPECT_TRUE(Cache().store(identity, some)) << "nor without a folder";
}

TEST_F(CacheTest, MistrustsAFileThatIsDamaged) {
  Cache const cache(folder);
  ASSERT_TRUE(cache.store(identity, some));
  auto const file = fs::directory_iterator(folder)->path();
  for (auto const* text : {"", "junk", "# Lapwing cache, taken (seconds since 1970): 5\nA,1\n",
                           "# Lapwing cache, taken (seconds since 1970): x\n1\t1\tA\t1\t9\n"}) {
    std::ofstream(file, std::ios::trunc) << text;
    EXPECT_FALSE(cache.find(identity)) << text;
  }
}

TEST_F(CacheTest, SaysThatItCannotWrite) {
  std::ofstream(folder / "file") << "in the way";
  auto const stored = Cache(folder / "file").store(identity, some);
  ASSERT_FALSE(stored);
  EXPECT_EQ(stored.error().kind, base::ErrorKind::io);
}

TEST(CacheFolder, IsWhereTheSystemKeepsCaches) {
  EXPECT_EQ(cache_folder("/c", "/home/me"), "/c/lapwing/parameters");
  EXPECT_EQ(cache_folder(nullptr, "/home/me"), "/home/me/.cache/lapwing/parameters");
  EXPECT_EQ(cache_folder("relative", "/home/me"), "/home/me/.cache/lapwing/parameters");
  EXPECT_EQ(cache_folder("", ""), "");
}

}  // namespace
}  // namespace lapwing::parameters
