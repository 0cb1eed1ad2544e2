#include "vehicle/joined/joined_parameters.hpp"

#include <gtest/gtest.h>

#include "base/async/loop.hpp"

namespace lapwing::vehicle {
namespace {

using base::Result;
using base::Task;

/// Every parameter of its one vehicle has the same value.
class SameParameters final : public VehicleParameters {
 public:
  SameParameters(std::string vehicle, double value) : vehicle_(std::move(vehicle)), value_(value) {}
  [[nodiscard]] bool has(VehicleId const& id) const override { return id.text == vehicle_ || id.text == "both"; }
  Task<Result<ParameterList>> all(VehicleId, bool) override {
    co_return ParameterList{.parameters = {{"P", value_, ""}}};
  }
  [[nodiscard]] std::optional<ParameterProgress> progress(VehicleId const&) const override {
    return ParameterProgress{static_cast<std::size_t>(value_), 10};
  }
  Task<Result<std::string>> file(VehicleId id, bool) override { co_return id.text + "'s file"; }
  Task<Result<Parameter>> read(VehicleId, std::string name) override { co_return Parameter{name, value_, ""}; }
  Task<Result<ParameterChange>> change(VehicleId, std::string name, double value, Commander) override {
    Parameter const before{name, value_, ""};
    value_ = value;
    co_return ParameterChange{before, {name, value_, ""}};
  }

 private:
  std::string vehicle_;
  double value_;
};

struct JoinedParametersTest : ::testing::Test {
  JoinedParametersTest() {
    all.add("MAVLink", drones);
    all.add("test", robots);
  }
  base::Loop loop{{.unpaced = true}};
  SameParameters drones{"1", 4.0};
  SameParameters robots{"a1", 7.0};
  JoinedParameters all;
};

TEST_F(JoinedParametersTest, AreThoseOfThePlatformThatHasTheVehicle) {
  EXPECT_EQ(loop.run_until_done(all.all({"1"}, false))->parameters[0].value, 4.0);
  EXPECT_EQ(loop.run_until_done(all.read({"a1"}, "P"))->value, 7.0);
  EXPECT_EQ(loop.run_until_done(all.file({"a1"}, true)).value(), "a1's file");
  EXPECT_EQ(all.progress({"1"})->done, 4u);
  EXPECT_EQ(loop.run_until_done(all.change({"a1"}, "P", 9.0, "anna"))->before.value, 7.0);
  EXPECT_EQ(loop.run_until_done(all.read({"a1"}, "P"))->value, 9.0);
  EXPECT_EQ(loop.run_until_done(all.read({"1"}, "P"))->value, 4.0) << "the other platform's stay";
}

TEST_F(JoinedParametersTest, OfAVehicleThatTwoPlatformsHaveAreRefused) {
  auto const changed = loop.run_until_done(all.change({"both"}, "P", 9.0, "anna"));
  ASSERT_FALSE(changed);
  EXPECT_EQ(changed.error().message, "conflict: MAVLink and test each have a vehicle both");
  EXPECT_FALSE(all.progress({"both"}));
  EXPECT_EQ(loop.run_until_done(all.read({"9"}, "P")).error().kind, base::ErrorKind::not_found);
}

}  // namespace
}  // namespace lapwing::vehicle
