#include <gtest/gtest.h>

#include "sim/testing/ground.hpp"

namespace lapwing::sim {
namespace {

using namespace std::chrono_literals;
using namespace mavlink;

SigningKey some_key() {
  SigningKey key{};
  key.fill(7);
  return key;
}

/// The station knows the key; the vehicle is heard whether it signs or not.
void listen_with_key(TestGround& ground) {
  auto ring = ring_of(some_key());
  ring.unsigned_frames.systems = {1};
  ground.gcs.set_keys(ring);
}

TEST(VehicleSigning, BeginsWithTheKeyThatItIsToldAndOutlastsARestart) {
  TestGround ground("copter");
  ground.boot();
  listen_with_key(ground);
  ground.run_for(2s);
  EXPECT_EQ(ground.gcs.signing()->key_of({1, 1}), "");
  ground.send(SetupSigning{.key = some_key(), .initial_timestamp = 1});
  ground.run_for(2s);
  EXPECT_EQ(ground.gcs.signing()->key_of({1, 1}), "key");
  ground.vehicle().reboot();
  ground.run_for(10s);
  EXPECT_EQ(ground.gcs.signing()->key_of({1, 1}), "key");
  EXPECT_EQ(ground.set_mode(copter_guided), MavResult::accepted) << "signed";
  ground.gcs.set_keys(std::nullopt);
  EXPECT_FALSE(ground.set_mode(copter_guided)) << "not signed";
}

TEST(VehicleSigning, EndsWithAKeyOfZeros) {
  TestGround ground("copter");
  ground.boot();
  listen_with_key(ground);
  ground.send(SetupSigning{.key = some_key(), .initial_timestamp = 1});
  ground.run_for(2s);
  ASSERT_EQ(ground.gcs.signing()->key_of({1, 1}), "key");
  ground.send(SetupSigning{});
  ground.run_for(2s);
  EXPECT_EQ(ground.gcs.signing()->key_of({1, 1}), "");
}

TEST(VehicleSigning, TakesNoKeyWhileItIsArmed) {
  TestGround ground("copter");
  ground.boot();
  listen_with_key(ground);
  ASSERT_EQ(ground.set_mode(copter_guided), MavResult::accepted);
  ASSERT_EQ(ground.arm(), MavResult::accepted);
  ground.send(SetupSigning{.key = some_key(), .initial_timestamp = 1});
  ground.run_for(2s);
  EXPECT_EQ(ground.gcs.signing()->key_of({1, 1}), "");
  EXPECT_EQ(ground.said("ERROR: Won't setup signing when armed"), 1);
}

TEST(VehicleSigning, HasAKeyOfItsOwn) {
  WorldOptions options;
  auto ring = ring_of(some_key());
  ring.keys["other"] = SigningKey{1};
  ring.vehicles[2] = {"other"};
  options.keys = ring;
  TestGround ground("copter:2", options);
  ground.gcs.set_keys(ring);
  ground.boot();
  EXPECT_EQ(ground.gcs.signing()->key_of({1, 1}), "key");
  EXPECT_EQ(ground.gcs.signing()->key_of({2, 1}), "other");
}

}  // namespace
}  // namespace lapwing::sim
