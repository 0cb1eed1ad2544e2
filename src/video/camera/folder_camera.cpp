#include "video/camera/folder_camera.hpp"

#include <fmt/format.h>

#include "video/files/file_bytes.hpp"

namespace lapwing::video {

base::Result<std::unique_ptr<Camera>> FolderCamera::open(CameraSettings const& settings) {
  auto const table = settings.folder / "poses.csv";
  auto const text = bytes_of(table, most_table_bytes);
  if (!text) return std::unexpected(text.error());
  auto pictures = pictures_of_table(*text);
  if (!pictures)
    return base::fail(pictures.error().kind, fmt::format("{}: {}", table.string(), pictures.error().message),
                      pictures.error().hint);
  return std::unique_ptr<Camera>(new FolderCamera(settings.folder, settings.lens, std::move(*pictures)));
}

base::Result<Frame> FolderCamera::take(Moment const&) {
  if (next_ == pictures_.size())
    return base::fail(base::ErrorKind::lost,
                      fmt::format("the pictures of {} have come to their end after {}", folder_.string(), next_));
  auto const& listed = pictures_[next_++];
  auto const file = folder_ / listed.file;
  auto picture = picture_of(file);
  if (!picture) return base::fail(base::ErrorKind::io, picture.error().message, picture.error().hint);
  if (picture->cols != lens_.width_px || picture->rows != lens_.height_px)
    return base::fail(base::ErrorKind::io,
                      fmt::format("{} has {} by {} pixels, and the camera's lens {} by {}", file.string(),
                                  picture->cols, picture->rows, lens_.width_px, lens_.height_px),
                      "set width and height, and what they change of the lens, to those of the pictures");
  return Frame{
      .picture = std::move(*picture), .taken = listed.at, .lens = lens_, .site_from_camera = listed.site_from_camera};
}

}  // namespace lapwing::video
