// Cartographer as a program: SCANS OUT. Its settings are those of cartographer.lua beside this file, upon its own.
#include <filesystem>

#include "absl/memory/memory.h"
#include "cartographer/common/configuration_file_resolver.h"
#include "cartographer/common/lua_parameter_dictionary.h"
#include "cartographer/mapping/map_builder.h"
#include "glog/logging.h"
#include "scans.hpp"

namespace {

namespace carto = cartographer;
using Builder = carto::mapping::TrajectoryBuilderInterface;
using carto::transform::Rigid3d;

Rigid3d rigid(lapwing::bench::PlanarPose const& pose) {
  return {Eigen::Vector3d(pose.x, pose.y, 0.0),
          Eigen::Quaterniond(Eigen::AngleAxisd(pose.yaw, Eigen::Vector3d::UnitZ()))};
}

/// Where each scan was taken in the frame of its own trajectory.
struct Local {
  carto::common::Time time;
  Rigid3d pose;
};

carto::sensor::TimedPointCloudData cloud_of(lapwing::bench::Scans const& all, lapwing::bench::Scan const& scan) {
  carto::sensor::TimedPointCloudData cloud;
  auto const offset = static_cast<float>(all.offset_m);
  cloud.origin = Eigen::Vector3f(offset, 0.0F, 0.0F);
  for (int k = 0; k < all.beams; ++k) {
    auto const range = static_cast<float>(scan.ranges[static_cast<std::size_t>(k)]);
    if (range >= static_cast<float>(all.nothing_m) || range < 0.05F) continue;
    auto const bearing = static_cast<float>(all.first_rad + all.step_rad * k);
    carto::sensor::TimedRangefinderPoint point;
    point.position = Eigen::Vector3f(offset + range * std::cos(bearing), range * std::sin(bearing), 0.0F);
    point.time = 0.0F;
    cloud.ranges.push_back(point);
  }
  return cloud;
}

}  // namespace

int main(int, char** words) {
  google::InitGoogleLogging(words[0]);
  FLAGS_logtostderr = true;
  FLAGS_minloglevel = 2;
  auto const all = lapwing::bench::read_scans(words[1]);
  std::string const here = LAPWING_PEERS_FOLDER;
  auto files = absl::make_unique<carto::common::ConfigurationFileResolver>(
      std::vector<std::string>{here, CARTOGRAPHER_SETTINGS});
  auto const code = files->GetFileContentOrDie("cartographer.lua");
  carto::common::LuaParameterDictionary settings(code, std::move(files));
  auto const map_options = carto::mapping::CreateMapBuilderOptions(settings.GetDictionary("map_builder").get());
  auto const way_options =
      carto::mapping::CreateTrajectoryBuilderOptions(settings.GetDictionary("trajectory_builder").get());
  auto mapper = carto::mapping::CreateMapBuilder(map_options);
  std::vector<Local> local;
  auto const id = mapper->AddTrajectoryBuilder(
      {{Builder::SensorId::SensorType::RANGE, "scan"}, {Builder::SensorId::SensorType::ODOMETRY, "odometry"}},
      way_options,
      [&](int, carto::common::Time time, Rigid3d pose, carto::sensor::RangeData,
          std::unique_ptr<Builder::InsertionResult const>) { local.push_back({time, pose}); });

  auto const begin = all.scans.front().time - 1.0;
  auto const moment = [&](double time) {
    return carto::common::FromUniversal(0) + carto::common::FromSeconds(time - begin);
  };
  auto* builder = mapper->GetTrajectoryBuilder(id);
  for (auto const& scan : all.scans) {
    builder->AddSensorData("odometry", carto::sensor::OdometryData{moment(scan.time), rigid(scan.odometry)});
    auto cloud = cloud_of(all, scan);
    cloud.time = moment(scan.time);
    if (!cloud.ranges.empty()) builder->AddSensorData("scan", cloud);
  }
  mapper->FinishTrajectory(id);
  mapper->pose_graph()->RunFinalOptimization();

  std::vector<std::pair<carto::common::Time, Rigid3d>> corrections;
  for (auto const& node : mapper->pose_graph()->GetTrajectoryNodes()) {
    auto const& data = *node.data.constant_data;
    corrections.emplace_back(data.time, node.data.global_pose * data.local_pose.inverse());
  }
  std::ofstream file(words[2]);
  file.precision(12);
  std::size_t k = 0;
  for (auto const& [time, pose] : local) {
    while (k + 1 < corrections.size() && corrections[k + 1].first <= time) ++k;
    auto const global = corrections[k].second * pose;
    file << begin + carto::common::ToSeconds(time - carto::common::FromUniversal(0)) << ' ' << global.translation().x()
         << ' ' << global.translation().y() << ' ' << carto::transform::GetYaw(global.rotation()) << '\n';
  }
  file.close();
  std::_Exit(0);
}
