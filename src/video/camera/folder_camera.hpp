#pragma once

#include <filesystem>
#include <vector>

#include "video/camera/camera.hpp"
#include "video/camera/pose_table.hpp"

namespace lapwing::video {

/// Pictures that were taken before, in the order of poses.csv beside them: one a call, whatever the moment.
class FolderCamera final : public Camera {
 public:
  /// Errors: not_found: no poses.csv; invalid_input: it is none.
  [[nodiscard]] static base::Result<std::unique_ptr<Camera>> open(CameraSettings const& settings);

  [[nodiscard]] base::Result<Frame> take(Moment const& moment) override;
  [[nodiscard]] geo::Lens const& lens() const override { return lens_; }

 private:
  FolderCamera(std::filesystem::path folder, geo::Lens const& lens, std::vector<ListedPicture> pictures)
      : folder_(std::move(folder)), lens_(lens), pictures_(std::move(pictures)) {}

  std::filesystem::path folder_;
  geo::Lens lens_;
  std::vector<ListedPicture> pictures_;
  std::size_t next_ = 0;
};

}  // namespace lapwing::video
