#include "scans/bag_log.hpp"

#include <unistd.h>
#include <zstd.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include <gtest/gtest.h>

#include "bus/messages/navigation.hpp"
#include "scans/testing/written_bag.hpp"

namespace lapwing::scans {
namespace {

using namespace std::chrono_literals;
using testing::WrittenBag;
namespace fs = std::filesystem;

bus::Header header(int ms, std::string frame) {
  return {.stamp = {.sec = ms / 1000, .nanosec = static_cast<std::uint32_t>(ms % 1000) * 1'000'000},
          .frame_id = std::move(frame)};
}

bus::LaserScan scan_at(int ms, std::string frame = "laser") {
  return {.header = header(ms, std::move(frame)),
          .angle_min = -1.0F,
          .angle_increment = 1.0F,
          .range_min = 0.1F,
          .range_max = 12.0F,
          .ranges = {1.0F, 2.0F, 3.0F},
          .intensities = {7.0F}};
}

bus::Odometry odometry_at(int ms, double x) {
  return {.header = header(ms, "odom"), .child_frame_id = "base_link", .pose = {.pose = {.position = {.x = x}}}};
}

bus::TFMessage frame_at(int ms, std::string parent, std::string child, double x, bus::Quaternion rotation = {}) {
  return {.transforms = {{.header = header(ms, std::move(parent)),
                          .child_frame_id = std::move(child),
                          .transform = {.translation = {.x = x}, .rotation = rotation}}}};
}

struct BagLogTest : ::testing::Test {
  BagLogTest() { fs::create_directories(folder); }
  ~BagLogTest() override { fs::remove_all(folder); }

  void write(std::string const& name, std::string const& text) const {
    std::ofstream(folder / name, std::ios::binary) << text;
  }
  [[nodiscard]] base::Result<BagLog> read(BagChoice const& choice = {}) const {
    write("bag.mcap", bag.mcap(Packing::zstd, 10));
    return read_bag(folder / "bag.mcap", choice);
  }
  [[nodiscard]] std::string fault(BagChoice const& choice = {}) const {
    auto const made = read(choice);
    return made ? "" : made.error().message;
  }
  /// Of a robot that drives ahead at 1 m/s: odometry five times a second, and its laser, half a metre ahead of it.
  void add_drive() {
    bag.add("/tf_static", 0ns, frame_at(0, "base_link", "laser", 0.5));
    for (int i = 0; i <= 10; ++i) bag.add("/odom", 0ns, odometry_at(200 * i, 0.2 * i));
    for (int i = 0; i < 5; ++i) bag.add("/scan", 0ns, scan_at(300 * i + 100));
  }

  fs::path const folder = fs::temp_directory_path() / ("lapwing-bag-log-" + std::to_string(::getpid()));
  WrittenBag bag;
};

TEST_F(BagLogTest, IsTheSameOfBothStorages) {
  add_drive();
  bag.add("/camera", "sensor_msgs/msg/Image", 0ns, "a picture");
  bag.write_sqlite(folder / "bag.db3");
  auto const of_sqlite = read_bag(folder / "bag.db3", {});
  auto const of_mcap = read();
  ASSERT_TRUE(of_sqlite) << of_sqlite.error().message;
  ASSERT_TRUE(of_mcap) << of_mcap.error().message;
  for (auto const* made : {&*of_sqlite, &*of_mcap}) {
    EXPECT_EQ(made->scan_topic, "/scan");
    EXPECT_EQ(made->odometry, "/odom");
    EXPECT_TRUE(made->remarks.empty());
    EXPECT_TRUE(made->log.has_odometry);
    ASSERT_EQ(made->log.sensors.size(), 1U);
    EXPECT_EQ(made->log.sensors[0].bearings_rad, (std::vector<float>{-1.0F, 0.0F, 1.0F}));
    EXPECT_EQ(made->log.sensors[0].mount_m, Eigen::Vector2f(0.5F, 0.0F));
    ASSERT_EQ(made->log.scans.size(), 5U);
    EXPECT_EQ(made->log.scans[1].time, slam::LogTime(0.4));
    EXPECT_EQ(made->log.scans[1].ranges_m, (std::vector<float>{1.0F, 2.0F, 3.0F}));
    for (auto const& scan : made->log.scans)
      EXPECT_NEAR(scan.odometry.x, scan.time.count(), 1e-12) << "also between two moments of the odometry";
  }
}

TEST_F(BagLogTest, LaysTheBeamsOfATurningScannerWhereEachLookedFrom) {
  bag.add("/tf_static", 0ns, frame_at(0, "base_link", "laser", 0.5));
  for (int i = 0; i <= 10; ++i) bag.add("/odom", 0ns, odometry_at(200 * i, 0.2 * i));
  auto slow = scan_at(300);
  slow.time_increment = 0.1F;
  bag.add("/scan", 0ns, slow);
  auto const made = read();
  ASSERT_TRUE(made) << made.error().message;
  ASSERT_EQ(made->log.scans.size(), 1U);
  auto const& scan = made->log.scans[0];
  EXPECT_NEAR(scan.time.count(), 0.4, 1e-6) << "the middle of it";
  EXPECT_NEAR(scan.odometry.x, 0.4, 1e-6);
  auto const& bearings = bearings_of(scan, made->log.sensors[0]);
  EXPECT_NEAR(scan.ranges_m[0] * std::cos(bearings[0]), 1.0 * std::cos(1.0) - 0.1, 1e-4);
  EXPECT_NEAR(scan.ranges_m[2] * std::cos(bearings[2]), 3.0 * std::cos(1.0) + 0.1, 1e-4);
}

TEST_F(BagLogTest, TakesOdometryFromFramesWhereThereIsNoOther) {
  // The laser hangs upside down on a mast of the robot, and a wheel turns, of which nothing follows.
  bag.add("/tf_static", 0ns, frame_at(0, "base_link", "mast", 0.5));
  bag.add("/tf_static", 0ns, frame_at(0, "mast", "laser", 0.25, {.x = 1.0, .w = 0.0}));
  for (int i = 0; i <= 10; ++i) {
    bag.add("/tf", 0ns, frame_at(100 * i, "/odom", "/base_link", 0.1 * i));
    bag.add("/tf", 0ns, frame_at(100 * i, "base_link", "wheel", 0.0, {.z = std::sin(i), .w = std::cos(i)}));
  }
  bag.add("/scan", 0ns, scan_at(250));
  auto const made = read();
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->odometry, "/tf (odom to base_link)");
  ASSERT_EQ(made->log.scans.size(), 1U);
  EXPECT_NEAR(made->log.scans[0].odometry.x, 0.25, 1e-12);
  EXPECT_EQ(made->log.scans[0].ranges_m, (std::vector<float>{3.0F, 2.0F, 1.0F})) << "its right is the robot's left";
  EXPECT_EQ(made->log.sensors[0].mount_m, Eigen::Vector2f(0.75F, 0.0F));
}

TEST_F(BagLogTest, TakesFramesThatNeverMoveForFixedOnes) {
  for (int i = 0; i <= 10; ++i) {
    bag.add("/tf", 0ns, frame_at(100 * i, "base_link", "laser", 0.3));
    bag.add("/tf", 0ns, frame_at(100 * i, "odom", "base_link", 0.1 * i));
  }
  bag.add("/scan", 0ns, scan_at(250));
  bag.add("/scan", 0ns, scan_at(350));
  auto const made = read();
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->odometry, "/tf (odom to base_link)");
  EXPECT_EQ(made->log.sensors[0].mount_m, Eigen::Vector2f(0.3F, 0.0F));
}

TEST_F(BagLogTest, GoesWithoutOdometry) {
  bag.add("/scan", 5s, scan_at(0));
  bag.add("/scan", 6s, scan_at(0));
  auto const made = read();
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->odometry, "");
  EXPECT_FALSE(made->log.has_odometry);
  EXPECT_EQ(made->log.scans[1].time, slam::LogTime(6.0)) << "without a stamp, when it was recorded";
}

TEST_F(BagLogTest, ListsTopicsToChooseFrom) {
  add_drive();
  bag.add("/front/scan", 0ns, scan_at(150));
  bag.add("/odom_filtered", 0ns, odometry_at(150, 7.0));
  EXPECT_EQ(fault(), "several topics of sensor_msgs/msg/LaserScan: /front/scan (1), /scan (5)");
  EXPECT_EQ(fault({.scan_topic = "front/scan"}),
            "several topics of nav_msgs/msg/Odometry: /odom (11), /odom_filtered (1)");
  auto const made = read({.scan_topic = "front/scan", .odometry_topic = "/odom_filtered"});
  ASSERT_TRUE(made) << made.error().message;
  ASSERT_EQ(made->log.scans.size(), 1U);
  EXPECT_EQ(made->log.scans[0].odometry.x, 7.0);
  auto const wrong = read({.scan_topic = "/scam"});
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().message, "no sensor_msgs/msg/LaserScan on /scam");
  EXPECT_EQ(wrong.error().hint, "it has /front/scan (1), /scan (5)");
  EXPECT_EQ(fault({.scan_topic = "/scan", .odometry_topic = "/tf"}), "/tf does not say how base_link moves");
}

TEST_F(BagLogTest, SaysWhatWasLeftOut) {
  for (int i = 10; i <= 20; ++i) bag.add("/odom", 0ns, odometry_at(100 * i, 0.0));
  bag.add("/scan", 0ns, scan_at(100));
  bag.add("/scan", 0ns, scan_at(1500));
  bag.add("/scan", "sensor_msgs/msg/LaserScan", 0ns, "not a scan");
  auto endless = scan_at(1600);
  endless.angle_increment = 0.0F;
  bag.add("/scan", 0ns, endless);
  auto const made = read();
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->log.scans.size(), 1U);
  EXPECT_EQ(made->remarks,
            (std::vector<std::string>{
                "no frames say where \"laser\" is on \"base_link\": it is taken for its middle, looking ahead",
                "1 scans left out that no laser sends", "1 scans left out before or after all odometry",
                "1 messages left out that are not whole"}));
}

TEST_F(BagLogTest, RefusesWhatHasNoScans) {
  bag.add("/points", "sensor_msgs/msg/PointCloud2", 0ns, "points");
  auto const none = read();
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message, "no sensor_msgs/msg/LaserScan in it");
  EXPECT_EQ(none.error().hint, "it has /points (sensor_msgs/msg/PointCloud2)");
  bag.add("/scan", "sensor_msgs/msg/LaserScan", 0ns, "a scan", "json");
  EXPECT_EQ(fault(), "/scan is encoded as \"json\", and only cdr is read");
}

TEST_F(BagLogTest, UnpacksMessagesThatArePackedEachByItself) {
  auto const plain = bus::encode(scan_at(100));
  std::string packed(ZSTD_compressBound(plain.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), plain.data(), plain.size(), 1));
  bag.add("/scan", "sensor_msgs/msg/LaserScan", 0ns, packed);
  auto const made = read();
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->log.scans.size(), 1U);
}

TEST_F(BagLogTest, ReadsAFolderOfSeveralFiles) {
  bag.add("/scan", 0ns, scan_at(200));
  write("a_1.mcap", bag.mcap(Packing::none, 10));
  EXPECT_EQ(read_bag(folder, {})->log.scans.size(), 1U) << "the only one, without metadata.yaml";
  bag.write_sqlite(folder / "a_0.db3");
  EXPECT_EQ(read_bag(folder, {}).error().message, "2 bags and no metadata.yaml that says which belong together");
  write("metadata.yaml",
        "rosbag2_bagfile_information:\n  version: 5\n  relative_file_paths:\n    - a_0.db3\n    - \"old/a_1.mcap\"\n"
        "  duration:\n    - nanoseconds\n");
  auto const both = read_bag(folder, {});
  ASSERT_TRUE(both) << both.error().message;
  EXPECT_EQ(both->log.scans.size(), 2U);
  fs::remove(folder / "a_0.db3");
  EXPECT_EQ(read_bag(folder, {}).error().message, "metadata.yaml names a_0.db3, which is not there");
}

TEST_F(BagLogTest, SaysHowToReadWhatItDoesNot) {
  write("old.bag", "#ROSBAG V2.0\n");
  write("packed.db3.zstd", "\x28\xb5\x2f\xfd");
  EXPECT_EQ(read_bag(folder / "old.bag", {}).error().message, "a bag of ROS 1");
  EXPECT_EQ(read_bag(folder / "packed.db3.zstd", {}).error().message, "packed as a whole");
  fs::create_directories(folder / "empty");
  EXPECT_EQ(read_bag(folder / "empty", {}).error().message,
            "a folder without a bag: no metadata.yaml, and no .db3 or .mcap");
}

}  // namespace
}  // namespace lapwing::scans
