#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/async/task.hpp"
#include "base/error.hpp"
#include "robot/views/camera_mount.hpp"

namespace lapwing::robot {

/// Something that somebody saw in a picture.
struct Seen {
  vision::Detection what;
  std::string crop = {};  ///< its part of the picture from the front, as a JPEG file; empty: none
};

/// What somebody saw in one picture.
struct Look {
  std::vector<Seen> found = {};
  bool is_sharp = true;  ///< enough to read what is written there; else it is taken again
};

/// One camera, and who looks at its pictures, wherever that is: heavy libraries stay out of a robot's process.
struct Eye {
  CameraMount mount = {};
  /// Takes a picture at the moment that it is awaited and looks at it for as long as that takes. Nothing: the camera
  /// gave none, or nobody looks at it now.
  std::function<base::Task<std::optional<Look>>()> look = {};
};

/// A picture as it is kept.
struct Photograph {
  std::string jpeg;
  std::string thumbnail;  ///< likewise, small
  int width_px = 0;
  int height_px = 0;
};

/// The camera that takes pictures when it is told to.
struct Photographer {
  CameraMount mount = {};
  /// Takes it at the moment that it is awaited. Errors: why there is none.
  std::function<base::Task<base::Result<Photograph>>()> take = {};
};

/// What a robot sees with.
struct Eyes {
  std::vector<Eye> for_tags = {};  ///< that look for name tags
  std::optional<Photographer> photographer = {};
  /// What is wrong with them, of watch/codes.hpp; nothing while they do not answer. Empty: nobody knows.
  std::function<std::optional<std::uint16_t>()> trouble = {};
  /// Keeps a JPEG file and says by which hash the map finds it. Errors: why it is not kept.
  std::function<base::Task<base::Result<std::string>>(std::string jpeg)> keep = {};
  /// Where no map is kept: writes a photograph into a file, from whose name whoever reads it sees what took it and
  /// when, and says its path. Empty: photographs are kept by `keep`. Errors: why it is not written.
  std::function<base::Task<base::Result<std::string>>(std::string name, std::string jpeg)> write_file = {};
};

}  // namespace lapwing::robot
