#include "sim/file_transfer.hpp"

#include <gtest/gtest.h>

namespace lapwing::sim {
namespace {

constexpr mavlink::Address self{7, 1};

mavlink::Frame request(std::uint8_t opcode, std::uint16_t sequence = 0x01FF) {
  mavlink::Frame frame;
  frame.source = {255, 190};
  frame.message_id = 110;
  frame.payload[1] = 7;
  frame.payload[2] = 1;
  frame.payload[3] = static_cast<std::uint8_t>(sequence & 0xFFU);
  frame.payload[4] = static_cast<std::uint8_t>(sequence >> 8U);
  frame.payload[6] = opcode;
  return frame;
}

TEST(FileTransfer, HasNoFileToOpen) {
  auto const answer = file_transfer_answer(request(4), self);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->payload[1], 255);
  EXPECT_EQ(answer->payload[2], 190);
  EXPECT_EQ(answer->payload[3], 0x00) << "one more than was asked";
  EXPECT_EQ(answer->payload[4], 0x02);
  EXPECT_EQ(answer->payload[6], 129);
  EXPECT_EQ(answer->payload[7], 1);
  EXPECT_EQ(answer->payload[8], 4);
  EXPECT_EQ(answer->payload[15], 10);
  EXPECT_GT(mavlink::serialize(*answer).bytes().size(), 20u) << "the answer travels whole";
}

TEST(FileTransfer, RefusesWhatNeedsASessionAndWhatItDoesNotKnow) {
  EXPECT_EQ(file_transfer_answer(request(5), self)->payload[15], 4);
  EXPECT_EQ(file_transfer_answer(request(6), self)->payload[15], 1);
  EXPECT_EQ(file_transfer_answer(request(77), self)->payload[15], 7);
}

TEST(FileTransfer, IsAlwaysReset) {
  auto const answer = file_transfer_answer(request(2), self);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->payload[6], 128);
  EXPECT_EQ(answer->payload[7], 0);
}

TEST(FileTransfer, AnswersNeitherAnswersNorWhatIsForOthers) {
  EXPECT_FALSE(file_transfer_answer(request(128), self));
  EXPECT_FALSE(file_transfer_answer(request(129), self));
  EXPECT_FALSE(file_transfer_answer(request(4), {8, 1}));
  auto other = request(4);
  other.message_id = 0;
  EXPECT_FALSE(file_transfer_answer(other, self));
}

}  // namespace
}  // namespace lapwing::sim
