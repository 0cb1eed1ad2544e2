// Archives of map tiles, made here byte by byte as the specification has them, and damaged ones.
#include "map/basemaps/pmtiles.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <random>
#include <set>

namespace lapwing::map {
namespace {

void add_number(std::string& bytes, std::uint64_t value, int size) {
  for (int i = 0; i < size; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 0xff));
}

void add_varint(std::string& bytes, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) bytes.push_back(static_cast<char>(0x80 | (value & 0x7f)));
  bytes.push_back(static_cast<char>(value));
}

std::string packed(std::string const& bytes) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string out(bytes.size() + 128, '\0');
  auto input = bytes;
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  out.resize(out.size() - stream.avail_out);
  deflateEnd(&stream);
  return out;
}

struct Line {
  std::uint64_t id;
  std::uint64_t run;
  std::uint64_t length;
  std::uint64_t offset;
};

std::string directory(std::vector<Line> const& lines) {
  std::string bytes;
  add_varint(bytes, lines.size());
  std::uint64_t before = 0;
  for (auto const& line : lines) add_varint(bytes, line.id - std::exchange(before, line.id));
  for (auto const& line : lines) add_varint(bytes, line.run);
  for (auto const& line : lines) add_varint(bytes, line.length);
  for (auto const& line : lines) add_varint(bytes, line.offset + 1);
  return bytes;
}

struct Archive {
  std::string root;
  std::string leaves = {};
  std::string tiles = {};
  std::string metadata = R"({"name":"Yard","attribution":"us","vector_layers":[{"id":"earth"}]})";
  bool is_packed = false;

  [[nodiscard]] std::string bytes() const {
    auto const inner = [this](std::string const& part) { return is_packed ? packed(part) : part; };
    auto const root_part = inner(root);
    auto const words = inner(metadata);
    std::string all = "PMTiles\x03";
    std::uint64_t at = 127;
    for (auto const* part : {&root_part, &words, &leaves, &tiles}) {
      add_number(all, at, 8);
      add_number(all, part->size(), 8);
      at += part->size();
    }
    for (int i = 0; i < 3; ++i) add_number(all, 1, 8);
    all.push_back(1);
    all.push_back(is_packed ? 2 : 1);
    all.push_back(1);
    all.push_back(2);
    all.push_back(0);
    all.push_back(5);
    for (std::int32_t const degrees : {-10, -5, 10, 5})
      add_number(all, static_cast<std::uint32_t>(degrees * 10'000'000), 4);
    all.resize(127, '\0');
    return all + root_part + words + leaves + tiles;
  }
};

base::Result<std::shared_ptr<TileArchive const>> open(std::string bytes) {
  return open_pmtiles([bytes = std::move(bytes)](std::uint64_t offset, std::size_t length) {
    return offset < bytes.size() ? bytes.substr(offset, length) : std::string();
  });
}

TEST(PmTiles, CountsTilesByZoomAlongTheHilbertCurve) {
  // The specification's own examples.
  EXPECT_EQ(pmtiles_id({0, 0, 0}), 0U);
  EXPECT_EQ(pmtiles_id({1, 0, 0}), 1U);
  EXPECT_EQ(pmtiles_id({1, 0, 1}), 2U);
  EXPECT_EQ(pmtiles_id({1, 1, 1}), 3U);
  EXPECT_EQ(pmtiles_id({1, 1, 0}), 4U);
  EXPECT_EQ(pmtiles_id({2, 0, 0}), 5U);
  EXPECT_EQ(pmtiles_id({12, 3423, 1763}), 19078479U);
}

TEST(PmTiles, NeighboursOnTheCurveAreNeighboursOnTheGround) {
  std::vector<TileAddress> by_id(4096);
  std::set<std::uint64_t> ids;
  std::uint64_t const first = pmtiles_id({6, 0, 0});
  for (std::uint32_t x = 0; x < 64; ++x) {
    for (std::uint32_t y = 0; y < 64; ++y) {
      auto const id = pmtiles_id({6, x, y});
      ASSERT_TRUE(ids.insert(id).second);
      by_id.at(id - first) = {6, x, y};
    }
  }
  for (std::size_t i = 1; i < by_id.size(); ++i) {
    auto const dx = std::abs(static_cast<int>(by_id[i].x) - static_cast<int>(by_id[i - 1].x));
    auto const dy = std::abs(static_cast<int>(by_id[i].y) - static_cast<int>(by_id[i - 1].y));
    ASSERT_EQ(dx + dy, 1) << i;
  }
}

TEST(PmTiles, FindsTilesOfRunsAndOfLeaves) {
  for (bool const is_packed : {false, true}) {
    auto const leaf = directory({{5, 1, 4, 8}, {6, 1, 4, 12}});
    auto const leaf_bytes = is_packed ? packed(leaf) : leaf;
    Archive const made{.root = directory({{0, 1, 4, 0}, {1, 4, 4, 4}, {5, 0, leaf_bytes.size(), 0}}),
                       .leaves = leaf_bytes,
                       .tiles = "zeroone-fivesix-",
                       .is_packed = is_packed};
    auto const archive = open(made.bytes());
    ASSERT_TRUE(archive) << archive.error().message;
    EXPECT_EQ((*archive)->tile({0, 0, 0}).value(), "zero");
    EXPECT_EQ((*archive)->tile({1, 1, 1}).value(), "one-") << "one of a run";
    EXPECT_EQ((*archive)->tile({2, 0, 0}).value(), "five") << "in a leaf";
    EXPECT_EQ((*archive)->tile({2, 3, 3}).value(), std::nullopt);
    EXPECT_EQ((*archive)->tile({1, 2, 0}).value(), std::nullopt) << "no such address";
    EXPECT_EQ((*archive)->info().name, "Yard");
    EXPECT_EQ((*archive)->info().attribution, "us");
    EXPECT_EQ((*archive)->info().vector_layers, std::vector<std::string>({"earth"}));
    EXPECT_EQ((*archive)->info().media_type, "image/png");
    EXPECT_EQ((*archive)->info().bounds_deg[0], -10.0);
  }
}

TEST(PmTiles, DamagedArchivesAreErrorsAndNothingElse) {
  Archive const made{
      .root = directory({{0, 1, 4, 0}, {1, 0, 10, 0}}), .leaves = directory({{1, 1, 4, 0}}), .tiles = "zero"};
  auto const whole = made.bytes();
  EXPECT_FALSE(open(whole.substr(0, 100)));
  EXPECT_FALSE(open("PMTiles\x02" + whole.substr(8)));
  std::mt19937 random(1);
  for (int i = 0; i < 20'000; ++i) {
    auto bytes = whole;
    for (int n = 0; n < 3; ++n) bytes[random() % bytes.size()] = static_cast<char>(random());
    auto const archive = open(bytes);
    if (archive)
      (void)(*archive)->tile({2, static_cast<std::uint32_t>(random() % 4), static_cast<std::uint32_t>(random() % 4)});
  }
}

TEST(PmTiles, LeavesThatNameThemselvesEnd) {
  auto const loop = directory({{0, 0, 5, 0}});
  Archive const made{.root = loop, .leaves = loop};
  auto const archive = open(made.bytes());
  ASSERT_TRUE(archive);
  auto const tile = (*archive)->tile({0, 0, 0});
  ASSERT_FALSE(tile);
  EXPECT_NE(tile.error().message.find("too deep"), std::string::npos);
}

}  // namespace
}  // namespace lapwing::map
