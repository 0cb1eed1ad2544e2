// Karto (open_karto), as slam_toolbox has it, as a program: SCANS OUT. Settings of slam_toolbox's offline mode, and a
// solver by Ceres as there.
#include <array>
#include <cmath>
#include <map>

#include <ceres/ceres.h>
#include <open_karto/Mapper.h>

#include "scans.hpp"

namespace {

/// What is left of a link: the difference of two poses beside the measured one, whitened.
struct LinkError {
  karto::Pose2 measured;
  Eigen::Matrix3d whitening;

  template <typename T>
  bool operator()(T const* from, T const* to, T* left) const {
    using std::cos;
    using std::sin;
    T const x = to[0] - from[0];
    T const y = to[1] - from[1];
    T const turned = to[2] - from[2] - T(measured.GetHeading());
    T const round(2.0 * M_PI);
    Eigen::Matrix<T, 3, 1> error;
    error << cos(from[2]) * x + sin(from[2]) * y - T(measured.GetX()),
        -sin(from[2]) * x + cos(from[2]) * y - T(measured.GetY()),
        turned - round * ceres::floor((turned + T(M_PI)) / round);
    Eigen::Map<Eigen::Matrix<T, 3, 1>> weighted(left);
    weighted = whitening.cast<T>() * error;
    return true;
  }
};

class CeresSolver : public karto::ScanSolver {
 public:
  IdPoseVector const& GetCorrections() const override { return corrections_; }
  void Clear() override { corrections_.clear(); }

  void AddNode(karto::Vertex<karto::LocalizedRangeScan>* vertex) override {
    auto const pose = vertex->GetObject()->GetCorrectedPose();
    poses_[vertex->GetObject()->GetUniqueId()] = {pose.GetX(), pose.GetY(), pose.GetHeading()};
  }

  void AddConstraint(karto::Edge<karto::LocalizedRangeScan>* edge) override {
    auto* link = static_cast<karto::LinkInfo*>(edge->GetLabel());
    auto const inverse = link->GetCovariance().Inverse();
    Eigen::Matrix3d information;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        information(row, column) = inverse(std::min(row, column), std::max(row, column));
    auto* error = new LinkError{link->GetPoseDifference(), information.llt().matrixU()};
    problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<LinkError, 3, 3, 3>(error), nullptr,
                              poses_[edge->GetSource()->GetObject()->GetUniqueId()].data(),
                              poses_[edge->GetTarget()->GetObject()->GetUniqueId()].data());
  }

  void Compute() override {
    if (auto* first = poses_.begin()->second.data(); problem_.HasParameterBlock(first))
      problem_.SetParameterBlockConstant(first);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.function_tolerance = 1e-3;
    options.gradient_tolerance = 1e-6;
    options.parameter_tolerance = 1e-3;
    options.num_threads = 1;
    options.use_nonmonotonic_steps = true;
    options.min_relative_decrease = 1e-3;
    options.max_num_consecutive_invalid_steps = 3;
    options.max_consecutive_nonmonotonic_steps = 3;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    corrections_.clear();
    for (auto const& [id, pose] : poses_) corrections_.emplace_back(id, karto::Pose2(pose[0], pose[1], pose[2]));
  }

 private:
  std::map<int, std::array<double, 3>> poses_;
  ceres::Problem problem_;
  IdPoseVector corrections_;
};

void set_up(karto::Mapper& mapper) {
  mapper.setParamUseScanMatching(true);
  mapper.setParamUseScanBarycenter(true);
  mapper.setParamMinimumTimeInterval(3600);
  mapper.setParamMinimumTravelDistance(0.5);
  mapper.setParamMinimumTravelHeading(0.5);
  mapper.setParamScanBufferSize(10);
  mapper.setParamScanBufferMaximumScanDistance(10);
  mapper.setParamLinkMatchMinimumResponseFine(0.1);
  mapper.setParamLinkScanMaximumDistance(1.5);
  mapper.setParamLoopSearchMaximumDistance(3.0);
  mapper.setParamDoLoopClosing(true);
  mapper.setParamLoopMatchMinimumChainSize(10);
  mapper.setParamLoopMatchMaximumVarianceCoarse(3.0);
  mapper.setParamLoopMatchMinimumResponseCoarse(0.35);
  mapper.setParamLoopMatchMinimumResponseFine(0.45);
  mapper.setParamCorrelationSearchSpaceDimension(0.5);
  mapper.setParamCorrelationSearchSpaceResolution(0.01);
  mapper.setParamCorrelationSearchSpaceSmearDeviation(0.1);
  mapper.setParamLoopSearchSpaceDimension(8.0);
  mapper.setParamLoopSearchSpaceResolution(0.05);
  mapper.setParamLoopSearchSpaceSmearDeviation(0.03);
  mapper.setParamDistanceVariancePenalty(0.5 * 0.5);
  mapper.setParamAngleVariancePenalty(1.0 * 1.0);
  mapper.setParamFineSearchAngleOffset(0.00349);
  mapper.setParamCoarseSearchAngleOffset(0.349);
  mapper.setParamCoarseAngleResolution(0.0349);
  mapper.setParamMinimumAnglePenalty(0.9);
  mapper.setParamMinimumDistancePenalty(0.5);
  mapper.setParamUseResponseExpansion(true);
}

}  // namespace

int main(int, char** words) {
  using namespace lapwing::bench;
  auto const all = read_scans(words[1]);
  CeresSolver solver;
  karto::Mapper mapper;
  mapper.SetScanSolver(&solver);
  set_up(mapper);
  karto::Name const name("laser");
  auto* laser = karto::LaserRangeFinder::CreateLaserRangeFinder(karto::LaserRangeFinder_Custom, name);
  laser->SetOffsetPose(karto::Pose2(all.offset_m, 0, 0));
  laser->SetMinimumRange(0.05);
  laser->SetMaximumRange(81.0);
  laser->SetMinimumAngle(all.first_rad);
  laser->SetMaximumAngle(all.first_rad + all.step_rad * (all.beams - 1));
  laser->SetAngularResolution(all.step_rad);
  laser->SetRangeThreshold(20.0);
  karto::Dataset dataset;
  dataset.Add(laser);

  std::vector<std::pair<std::size_t, int>> taken;  // scans and the nodes that they became
  for (std::size_t k = 0; k < all.scans.size(); ++k) {
    auto const& scan = all.scans[k];
    auto ranges = scan.ranges;
    for (auto& range : ranges)
      if (range >= all.nothing_m) range = 1e3;
    auto* node = new karto::LocalizedRangeScan(name, ranges);
    karto::Pose2 const pose(scan.odometry.x, scan.odometry.y, scan.odometry.yaw);
    node->SetOdometricPose(pose);
    node->SetCorrectedPose(pose);
    node->SetTime(scan.time);
    if (mapper.Process(node)) {
      dataset.Add(node);
      taken.emplace_back(k, node->GetUniqueId());
    } else {
      delete node;
    }
  }
  solver.Compute();
  std::map<int, karto::Pose2> corrected;
  for (auto const& [id, pose] : solver.GetCorrections()) corrected[id] = pose;
  std::vector<Node> nodes;
  for (auto const& [scan, id] : taken) {
    auto const& pose = corrected.at(id);
    nodes.push_back({scan, {pose.GetX(), pose.GetY(), pose.GetHeading()}});
  }
  write_poses(words[2], all, nodes);
  std::_Exit(0);  // the mapper and the data set both own the scans
}
