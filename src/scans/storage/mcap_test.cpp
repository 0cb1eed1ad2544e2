#include "scans/storage/mcap.hpp"

#include <sstream>

#include <gtest/gtest.h>

#include "scans/storage/unpack.hpp"
#include "scans/testing/written_bag.hpp"

namespace lapwing::scans {
namespace {

using namespace std::chrono_literals;
using testing::WrittenBag;

/// Takes what is on /a and counts what it is told.
class Heard final : public BagListener {
 public:
  bool wants(BagTopic const& topic) override {
    asked.push_back(topic.name + " " + topic.type + " " + topic.encoding);
    return topic.name == "/a";
  }
  base::Result<> take(BagTopic const&, std::chrono::nanoseconds logged, std::string_view message) override {
    if (message == "stop") return base::fail(base::ErrorKind::cancelled, "stopped");
    messages.push_back(std::to_string(logged.count()) + " " + std::string(message));
    return {};
  }
  std::vector<std::string> asked;
  std::vector<std::string> messages;
};

constexpr std::size_t count = 20;

WrittenBag a_bag() {
  WrittenBag bag;
  for (std::size_t i = 0; i < count; ++i) {
    bag.add("/a", "std_msgs/msg/String", std::chrono::nanoseconds(i), "message " + std::to_string(i));
    bag.add("/b", "std_msgs/msg/String", 0ns, std::string(500, 'b'));
  }
  return bag;
}

base::Result<BagRemark> read(std::string const& bytes, Heard& heard) {
  std::istringstream file(bytes);
  return read_mcap(file, heard);
}

TEST(Mcap, IsReadHoweverItsChunksArePacked) {
  for (auto const packing : {Packing::none, Packing::lz4, Packing::zstd}) {
    for (std::size_t const a_chunk : {0, 1, 7, 100}) {
      Heard heard;
      auto const remark = read(a_bag().mcap(packing, a_chunk), heard);
      ASSERT_TRUE(remark) << remark.error().message;
      EXPECT_EQ(*remark, "");
      EXPECT_EQ(heard.asked, (std::vector<std::string>{"/a std_msgs/msg/String cdr", "/b std_msgs/msg/String cdr"}));
      ASSERT_EQ(heard.messages.size(), count);
      EXPECT_EQ(heard.messages[19], "19 message 19");
    }
  }
}

TEST(Mcap, ThatIsCutOffIsReadAsFarAsItGoes) {
  for (auto const packing : {Packing::none, Packing::lz4, Packing::zstd}) {
    auto const whole = a_bag().mcap(packing, 7);
    std::size_t before = 0;
    for (std::size_t size = 8; size < whole.size(); ++size) {
      Heard heard;
      auto const remark = read(whole.substr(0, size), heard);
      ASSERT_TRUE(remark) << remark.error().message;
      ASSERT_GE(heard.messages.size(), before) << "never less than of a shorter one";
      before = heard.messages.size();
      // The footer is what tells that the recording was closed.
      auto const is_closed = size >= whole.size() - 29 - WrittenBag::magic.size();
      ASSERT_EQ(remark->empty(), is_closed) << size << ": " << *remark;
    }
    EXPECT_EQ(before, count);
  }
}

TEST(Mcap, OfWhichAChunkIsCutOffGivesWhatIsInItsFirstHalf) {
  auto const whole = a_bag().mcap(Packing::none, 100);
  Heard heard;
  auto const remark = read(whole.substr(0, whole.size() / 2), heard);
  ASSERT_TRUE(remark);
  EXPECT_GT(heard.messages.size(), count / 3);
  EXPECT_LT(heard.messages.size(), count);
  EXPECT_TRUE(remark->starts_with("the file is cut off or damaged ")) << *remark;
}

TEST(Mcap, LeavesOutAChunkWhoseChecksumIsWrong) {
  std::string const channel = WrittenBag::record(4, WrittenBag::number(std::uint16_t{1}) +
                                                        WrittenBag::number(std::uint16_t{0}) + WrittenBag::text("/a") +
                                                        WrittenBag::text("cdr") + WrittenBag::number(std::uint32_t{0}));
  auto const message = [](std::string const& bytes) {
    return WrittenBag::record(5, WrittenBag::number(std::uint16_t{1}) + std::string(20, '\0') + bytes);
  };
  Heard heard;
  auto const remark =
      read(WrittenBag::magic + channel + WrittenBag::chunk(message("wrong"), Packing::zstd, 1) +
               WrittenBag::chunk(message("right"), Packing::zstd, 0) + WrittenBag::record(15, std::string(4, '\0')),
           heard);
  ASSERT_TRUE(remark) << remark.error().message;
  EXPECT_EQ(heard.messages, std::vector<std::string>{"0 right"});
  EXPECT_EQ(*remark, "1 chunks are damaged, and what could not be read of them was left out");
}

TEST(Mcap, IsRefusedBeyondItsLimits) {
  Heard heard;
  auto const claims =
      WrittenBag::record(6, std::string(16, '\0') + WrittenBag::number(std::uint64_t{1} << 40) + std::string(16, '\0'));
  EXPECT_EQ(read(WrittenBag::magic + claims, heard).error().message, "a chunk of 1048576 MB; the limit is 256");
  auto const strange = WrittenBag::record(6, std::string(28, '\0') + WrittenBag::text("rar") + std::string(8, '\0'));
  EXPECT_EQ(read(WrittenBag::magic + strange, heard).error().message,
            "chunks packed by \"rar\"; only lz4 and zstd can be read");
  std::string channels;
  for (std::size_t i = 0; i <= most_topics; ++i)
    channels += WrittenBag::record(4, WrittenBag::number(static_cast<std::uint16_t>(i)) + std::string(14, '\0'));
  EXPECT_EQ(read(WrittenBag::magic + channels, heard).error().message, "more than 10000 topics");
}

TEST(Mcap, UnpacksNoMoreThanAChunkSaysThatItHolds) {
  std::string const zeros(8'000'000, '\0');
  for (auto const packing : {Packing::lz4, Packing::zstd}) {
    auto const chunk = WrittenBag::chunk(zeros, packing, 0);
    auto const packed =
        chunk.substr(chunk.find(packing == Packing::lz4 ? "lz4" : "zstd") + (packing == Packing::lz4 ? 11 : 12));
    EXPECT_EQ(unpack(packing, packed, 100).size(), 100U);
    EXPECT_EQ(unpack(packing, packed, zeros.size() + 1), zeros);
  }
}

TEST(Mcap, IsNothingElse) {
  Heard heard;
  EXPECT_EQ(read("FLASER 1", heard).error().message, "it does not begin as an MCAP file does");
  EXPECT_FALSE(read("", heard));
}

TEST(Mcap, IsReadUntilTheListenerHasEnough) {
  WrittenBag bag;
  bag.add("/a", "t", 0ns, "stop");
  bag.add("/a", "t", 0ns, "on");
  Heard heard;
  auto const remark = read(bag.mcap(Packing::zstd, 1), heard);
  ASSERT_FALSE(remark);
  EXPECT_EQ(remark.error().message, "stopped");
  EXPECT_TRUE(heard.messages.empty());
}

}  // namespace
}  // namespace lapwing::scans
