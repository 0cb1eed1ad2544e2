#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/async/notifier.hpp"
#include "base/async/scope.hpp"
#include "base/async/side_thread.hpp"
#include "base/log.hpp"
#include "video/camera/camera.hpp"

namespace lapwing::perceive {

/// How the camera has done.
struct FilmRecord {
  bool is_open = false;
  std::string fault = {};      ///< what went wrong last; empty once a picture came
  std::uint64_t pictures = 0;  ///< taken
  std::uint64_t failed = 0;    ///< that did not come
};

/// Has pictures taken, one after the other, on a thread of its own: whoever looks at one for long does not hold up the
/// next. A camera that does not open, or is gone, is told and tried again. Thread-bound to its loop, which outlives it.
class Filming {
 public:
  /// What it wants to know each time anew, on the loop.
  struct Director {
    /// Which camera; nothing while that is not known yet.
    std::function<std::optional<video::CameraSettings>()> camera;
    /// From where the next picture is; nothing while it cannot be taken.
    std::function<std::optional<video::Moment>()> moment;
    std::function<double()> pictures_a_s;
  };
  struct Shot {
    video::Frame frame;
    std::uint64_t number = 0;  ///< counts from 1
  };

  Filming(base::Loop& loop, Director director, base::Logger log);
  Filming(Filming const&) = delete;
  Filming& operator=(Filming const&) = delete;

  /// The newest picture, as soon as it is another one than `after`.
  [[nodiscard]] base::Task<Shot> next(std::uint64_t after);
  [[nodiscard]] FilmRecord const& record() const { return record_; }

 private:
  /// On the thread.
  struct Hand {
    std::unique_ptr<video::Camera> camera = {};
  };

  base::Task<> film();
  base::Task<> open_camera();
  base::Task<> take();
  void note_failure(base::Error const& error);

  base::Loop& loop_;
  Director director_;
  base::Logger log_;
  FilmRecord record_;
  base::TimePoint opened_at_{};
  std::optional<video::Frame> newest_;
  base::Notifier arrived_;
  base::SideThread<Hand> hand_;
  base::Scope scope_;
};

}  // namespace lapwing::perceive
