#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/async/notifier.hpp"
#include "base/async/scope.hpp"
#include "base/async/side_thread.hpp"
#include "base/log.hpp"
#include "bus/participant/bus.hpp"
#include "perceive/filming.hpp"
#include "perceive/health.hpp"
#include "perceive/live_view.hpp"
#include "perceive/lot_eye.hpp"
#include "perceive/surveyor.hpp"
#include "perceive/topics.hpp"
#include "video/camera/camera.hpp"

namespace lapwing::perceive {

struct PerceiveSettings {
  video::CameraSettings camera = {};
  SurveyOrder order = {};
  std::string vehicle = "drone";                             ///< whose account the map is
  std::filesystem::path folder = "survey";                   ///< of what was found
  base::Duration remembers = std::chrono::minutes(60);       ///< of what was seen before this process began
  double looks_a_s = 4.0;                                    ///< pictures that are looked at, at most
  std::optional<link::pictures::ServeSettings> stream = {};  ///< where people look; none: nowhere
  double shown_a_s = 10.0;                                   ///< pictures for them, while somebody looks
  std::string network = {};  ///< the content of models/cars.onnx; empty: vehicles by contrast
};

/// The process that sees, maps and plans: an algorithm manager that has pictures taken, looked at, put on the map and
/// thought about, each on a thread beside the loop, so that bus and life line go on meanwhile. What is newest counts: a
/// picture that comes before the one before was looked at or thought about takes its place.
class Perceive {
 public:
  /// `bus` outlives it. Errors: those of the bus, of the network's file, and of the folder. A camera that does not open
  /// is told and tried again.
  [[nodiscard]] static base::Result<std::unique_ptr<Perceive>> open(base::Loop& loop, bus::Bus& bus,
                                                                    PerceiveSettings settings, base::Logger log);
  Perceive(Perceive const&) = delete;
  Perceive& operator=(Perceive const&) = delete;

  /// Writes what was found, and calls `done`.
  void leave(std::function<void()> done);

 private:
  /// On the thread that thinks.
  struct Mind {
    std::optional<Surveyor> surveyor = {};
  };
  Perceive(base::Loop& loop, PerceiveSettings settings, base::Logger log);

  [[nodiscard]] Filming::Director director();
  [[nodiscard]] bool is_placed() const;
  base::Task<> see();
  base::Task<> look_at(video::Frame frame);
  base::Task<> show();
  base::Task<> show_findings(video::Frame frame);
  /// Waits for the pose after the picture, for a while.
  base::Task<std::optional<geo::CameraPlace>> place_of(video::Frame const& frame);
  base::Task<> think();
  /// Whether there is one.
  base::Task<bool> adapt_surveyor();
  void carry_out(Conclusion const& conclusion, base::UtcTime at);
  base::Task<> speak();
  base::Task<> report_health();
  base::Task<> keep();
  base::Task<> write_slots();
  base::Task<> write_memory();
  void tell_write_fault(std::string& told, base::Result<> const& written, std::string_view what);
  base::Task<> write_and_end(std::function<void()> done);
  [[nodiscard]] double ground_up_m() const;

  base::Loop& loop_;
  PerceiveSettings settings_;
  base::Logger log_;
  std::unique_ptr<Topics> topics_;
  SightRecord sight_;
  ThoughtRecord thought_;
  std::optional<explore::LotSight> newest_;  ///< that was not thought about yet
  base::Notifier seen_;
  std::optional<explore::SurveyGoal> goal_;
  std::optional<bool> sees_lot_;
  bool has_surveyor_ = false;
  bool has_new_slots_ = false;
  bool has_new_memory_ = false;
  base::TimePoint memory_due_{};
  std::string told_write_fault_;
  std::string told_memory_fault_;
  std::unique_ptr<LiveView> live_view_;         ///< null: nobody may look
  std::optional<explore::LotSight> seen_last_;  ///< drawn into what comes after it
  std::optional<Filming> film_;
  std::optional<base::SideThread<LotEye>> eye_;
  std::optional<base::SideThread<Mind>> mind_;
  base::Scope scope_;
};

}  // namespace lapwing::perceive
