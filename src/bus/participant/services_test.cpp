#include "bus/participant/services.hpp"

#include <chrono>
#include <optional>

#include <gtest/gtest.h>

#include "bus/messages/mavros_services.hpp"
#include "bus/participant/topics.hpp"
#include "bus/testing/own_domain.hpp"

namespace lapwing::bus {
namespace {

using namespace std::chrono_literals;
using Arming = mavros::CommandBool;

struct Services : ::testing::Test {
  bool comes_true(std::function<bool()> const& holds) {
    return loop.run_until_done([](base::Loop& on, std::function<bool()> wanted) -> base::Task<bool> {
      auto const deadline = on.now() + 10s;
      while (!wanted() && on.now() < deadline) co_await on.sleep(5ms);
      co_return wanted();
    }(loop, holds));
  }
  using Answers = std::vector<std::pair<std::int64_t, bool>>;
  static base::Result<ServiceClient<Arming>> client_on(Bus& bus, Answers& answers) {
    return ServiceClient<Arming>::open(
        bus, "/mavros/cmd/arming",
        [&](std::int64_t call, Arming::Response const& response) { answers.emplace_back(call, response.success); });
  }

  base::Loop loop;
  std::unique_ptr<Bus> one = Bus::open(loop, {.domain = testing::own_domain()}).value();
  std::unique_ptr<Bus> two = Bus::open(loop, {.domain = testing::own_domain()}).value();
};

TEST_F(Services, HaveTheTopicsThatRos2Makes) {
  EXPECT_EQ(dds_topic("/mavros/set_mode", Lane::request).value(), "rq/mavros/set_modeRequest");
  EXPECT_EQ(dds_topic("/mavros/set_mode", Lane::reply).value(), "rr/mavros/set_modeReply");
  EXPECT_EQ(dds_type(Description<mavros::SetMode::Request>::name), "mavros_msgs::srv::dds_::SetMode_Request_");
}

TEST_F(Services, AnswerWhoHasAskedAndNobodyElse) {
  auto const server = ServiceServer<Arming>::open(
      *one, "/mavros/cmd/arming", [](Call<Arming> call) { call.reply({.success = call.request.value}); });
  Answers first;
  Answers second;
  auto asks = client_on(*two, first);
  auto asks_too = client_on(*two, second);
  ASSERT_TRUE(server && asks && asks_too);
  ASSERT_TRUE(comes_true([&] { return asks->is_ready() && asks_too->is_ready(); }));
  auto const yes = asks->call({.value = true});
  auto const no = asks->call({.value = false});
  auto const other = asks_too->call({.value = true});
  ASSERT_TRUE(comes_true([&] { return first.size() == 2 && second.size() == 1; }));
  EXPECT_EQ(first, (Answers{{yes, true}, {no, false}}));
  EXPECT_EQ(second, (Answers{{other, true}}));
}

TEST_F(Services, MayAnswerLaterAndInAnotherOrder) {
  std::vector<Call<Arming>> waiting;
  auto server = ServiceServer<Arming>::open(*one, "/mavros/cmd/arming",
                                            [&](Call<Arming> call) { waiting.push_back(std::move(call)); });
  Answers answers;
  auto asks = client_on(*two, answers);
  ASSERT_TRUE(server && asks);
  ASSERT_TRUE(comes_true([&] { return asks->is_ready(); }));
  auto const first = asks->call({.value = true});
  auto const second = asks->call({.value = false});
  ASSERT_TRUE(comes_true([&] { return waiting.size() == 2; }));
  waiting[1].reply({.success = false});
  waiting[0].reply({.success = true});
  ASSERT_TRUE(comes_true([&] { return answers.size() == 2; }));
  EXPECT_EQ(answers, (Answers{{second, false}, {first, true}}));
  server = base::fail(base::ErrorKind::cancelled, "gone");
  waiting[0].reply({});  // nobody is there to say it
}

/// A client that names no reader of its replies, as the specification of DDS-RPC allows.
TEST_F(Services, AnswerARequestThatNamesNobodyToItsWriter) {
  auto const server =
      ServiceServer<Arming>::open(*one, "/mavros/cmd/arming", [](Call<Arming> call) { call.reply({.success = true}); });
  std::optional<SampleIdentity> related;
  auto const replies = two->read_from(
      "/mavros/cmd/arming", Description<Arming::Response>::name, Profile::standard,
      [&](Sample const& sample) { related = sample.related; }, Lane::reply);
  auto const requests =
      two->write_to("/mavros/cmd/arming", Description<Arming::Request>::name, Profile::standard, Lane::request);
  ASSERT_TRUE(server && replies && requests);
  ASSERT_TRUE(comes_true([&] { return (*requests)->readers() == 1 && (*replies)->writers() == 1; }));
  auto const asked = (*requests)->write_related(encode(Arming::Request{.value = true}), {});
  ASSERT_TRUE(comes_true([&] { return related.has_value(); }));
  EXPECT_EQ(*related, asked);
}

TEST_F(Services, SayWhenTheyWereAsked) {
  std::optional<base::UtcTime> asked;
  auto const server =
      ServiceServer<Arming>::open(*one, "/mavros/cmd/arming", [&](Call<Arming> const& call) { asked = call.asked; });
  Answers answers;
  auto asks = client_on(*two, answers);
  ASSERT_TRUE(server && asks);
  ASSERT_TRUE(comes_true([&] { return asks->is_ready(); }));
  auto const before = std::chrono::system_clock::now();
  (void)asks->call({});
  ASSERT_TRUE(comes_true([&] { return asked.has_value(); }));
  EXPECT_GE(*asked + 1ms, before);
  EXPECT_LE(*asked, std::chrono::system_clock::now());
}

TEST_F(Services, DoNotTakeWhatIsNoRequest) {
  int calls = 0;
  auto const server =
      ServiceServer<mavros::SetMode>::open(*one, "/mavros/set_mode", [&](Call<mavros::SetMode> const&) { ++calls; });
  auto const requests =
      two->write_to("/mavros/set_mode", Description<mavros::SetMode::Request>::name, Profile::standard, Lane::request);
  ASSERT_TRUE(server && requests);
  ASSERT_TRUE(comes_true([&] { return (*requests)->readers() == 1; }));
  (*requests)->write(std::string("\0\1\0\0\0\0\0\0\xff\xff\xff\x7f", 12));
  (*requests)->write(encode(mavros::SetMode::Request{.custom_mode = "GUIDED"}));
  ASSERT_TRUE(comes_true([&] { return calls > 0; }));
  EXPECT_EQ(calls, 1);
}

TEST_F(Services, AndTopicsMayShareAType) {
  ASSERT_TRUE(Publisher<String>::open(*one, "/a", Profile::standard));
  EXPECT_TRUE(Publisher<String>::open(*one, "/b", Profile::standard));
}

}  // namespace
}  // namespace lapwing::bus
