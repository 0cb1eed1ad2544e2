#include "vehicle/authority.hpp"

#include <gtest/gtest.h>

#include "base/async/loop.hpp"

namespace lapwing::vehicle {
namespace {

using namespace std::chrono_literals;

/// Two vehicles of which it does not matter what platform has them.
struct AuthorityTest : ::testing::Test {
  AuthorityTest() {
    registry.edit(copter).name = "copter 1";
    registry.edit(robot).name = "robot a1";
    authority.add_on_loss([this](VehicleId const& id, Commander const& to) { losses += id.text + " to " + to + "; "; });
  }
  Commander const& commander(VehicleId const& id) { return registry.find(id)->control.commander; }
  void wait(base::Duration time) {
    loop.run_until_done(
        [](base::Loop& on, base::Duration so_long) -> base::Task<> { co_await on.sleep(so_long); }(loop, time));
  }

  base::Loop loop{{.unpaced = true}};
  Registry registry{loop};
  Authority authority{loop, registry, {}};
  VehicleId const copter{"1"};
  VehicleId const robot{"a1"};
  std::string losses;
};

TEST_F(AuthorityTest, IsEachVehiclesOwn) {
  EXPECT_TRUE(authority.claim(copter, "anna"));
  EXPECT_TRUE(authority.claim(robot, "ben"));
  EXPECT_EQ(authority.claim(robot, "anna").error().message, "robot a1 is commanded by ben");
  EXPECT_EQ(commander(copter), "anna");
  EXPECT_EQ(commander(robot), "ben");
}

TEST_F(AuthorityTest, TellsEveryPlatformWhoLosesAVehicle) {
  authority.add_on_loss([this](VehicleId const&, Commander const&) { losses += "told, too"; });
  (void)authority.claim(robot, script_commander);
  authority.take(robot, "anna");
  authority.take(copter, "anna");
  EXPECT_EQ(losses, "a1 to anna; told, too") << "nobody had the copter";
}

TEST_F(AuthorityTest, KnowsNoVehicleThatIsNotInTheRegistry) {
  VehicleId const nobody{"9"};
  EXPECT_EQ(authority.claim(nobody, "anna").error().kind, base::ErrorKind::not_found);
  EXPECT_EQ(authority.request(nobody, "anna", 1s).error().message, "there is no vehicle 9");
  authority.take(nobody, "anna");
  authority.forget(nobody, "anna");
  EXPECT_FALSE(authority.yield(nobody, "anna"));
  EXPECT_FALSE(authority.keep(nobody, "anna"));
  EXPECT_EQ(registry.find(nobody), nullptr) << "asking makes none";
}

TEST_F(AuthorityTest, IsGrantedWhenNobodyAnswers) {
  (void)authority.claim(robot, "anna");
  EXPECT_TRUE(authority.request(robot, "ben", 10s));
  wait(9s);
  EXPECT_EQ(commander(robot), "anna");
  wait(2s);
  EXPECT_EQ(commander(robot), "ben");
  EXPECT_EQ(losses, "a1 to ben; ");
}

TEST_F(AuthorityTest, IsNobodysToClaimWhileItIsBarred) {
  authority.bar("emergency stop by anna: release it first");
  EXPECT_EQ(authority.claim(copter, "ben").error().message, "emergency stop by anna: release it first");
  authority.bar(std::nullopt);
  EXPECT_TRUE(authority.claim(copter, "ben"));
}

}  // namespace
}  // namespace lapwing::vehicle
