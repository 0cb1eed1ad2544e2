#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "explore/lot/slots/known_slot.hpp"
#include "explore/lot/slots/picture_shift.hpp"

namespace lapwing::explore {

/// A picture that was laid onto the map as well as what it shows allowed.
struct PlacedSight {
  LotSight sight;                                      ///< as it lies, with what doubt of its place is left
  PictureShift shift = {};                             ///< from where its camera's pose had it
  Eigen::Vector4d expected = Eigen::Vector4d::Ones();  ///< of that shift, by the pose alone
};

/// Pictures and slots placed together, so that every slot lies where all pictures have it and none is farther from its
/// camera's pose than that is off: a planimetric block adjustment by independent models, each of which may move, turn
/// and stretch (van den Hout 1966, "Anblock"; Kraus, "Photogrammetry" vol. 1, on block adjustment). Linear least
/// squares with Huber's loss; the slots are eliminated (Schur complement) and the rest is solved by conjugate
/// gradients from the last solution on, which takes a few steps when one picture is new.
///
/// What a drone errs about its place now it errs a moment later, too: the shifts of one vehicle's pictures are a
/// process of Ornstein and Uhlenbeck (1930) with `errors_last` as its time, so that a hundred pictures of one place are
/// no hundred opinions about where that is.
///
/// Tie points of two pictures are slots of a kind that are seen in these two alone.
///
/// The oldest of more than `most_pictures` does not move any more.
class PictureBlock {
 public:
  static constexpr std::size_t most_pictures = 400;
  static constexpr base::Duration errors_last = std::chrono::seconds(3);

  /// Of the next picture, by which its finds name it.
  [[nodiscard]] std::size_t next_number() const { return first_ + pictures_.size(); }
  void add(PlacedSight const& placed);
  /// Moves the pictures to where the finds of these slots agree best, and the slots with them.
  void settle(std::span<KnownSlot> slots);
  /// Where a find lies now.
  [[nodiscard]] Corners placed(SlotFind const& find) const;
  /// Where the earlier picture has a tie point now; nothing where that picture was not added, or does not move any
  /// more.
  [[nodiscard]] std::optional<map::SitePoint> placed(TiePoint const& tie, std::string const& vehicle) const;

 private:
  /// A tie point with an earlier picture.
  struct HeldTie {
    std::optional<std::size_t> earlier;  ///< its number; nothing: it does not move any more
    map::SitePoint here;                 ///< where this picture lay when it came
    map::SitePoint there;                ///< where the earlier one lay when it came, or where it lies
    double weight = 0.0;                 ///< 1 / sigma^2 of each of the two
  };
  struct Picture {
    map::SitePoint told_below;                          ///< the ground below the camera, as its pose has it
    map::SitePoint below;                               ///< the same where it was put when it came
    Eigen::Vector4d came_by = Eigen::Vector4d::Zero();  ///< from the camera's pose to where it was put when it came
    Eigen::Vector4d expected = Eigen::Vector4d::Ones();
    std::string vehicle = {};
    base::UtcTime at = {};
    PictureShift moved = {};  ///< since it came
    std::vector<HeldTie> ties = {};

    /// Where it put, when it came, what its pose has at `place`.
    [[nodiscard]] map::SitePoint came_to(map::SitePoint const& place) const {
      return PictureShift{came_by}.of(place, told_below);
    }
    /// Where it has now what it had at `place` when it came.
    [[nodiscard]] map::SitePoint now_at(map::SitePoint const& place) const { return moved.of(place, below); }
  };
  /// What a picture's shift is expected to be by the one before of the same vehicle; by nothing where there is none.
  struct Expectation {
    std::optional<std::size_t> before;  ///< its place in `pictures_`
    double kept = 0.0;                  ///< share of the earlier shift that is expected to last
    Eigen::Vector4d stiffness;          ///< 1 / sigma^2 of the rest
  };
  struct Sheaf;
  struct Equations;
  [[nodiscard]] std::optional<std::size_t> number_of(std::string const& vehicle, base::UtcTime at) const;
  [[nodiscard]] Picture const& picture(std::size_t number) const { return pictures_[number - first_]; }
  [[nodiscard]] std::vector<HeldTie> held(std::span<TiePoint const> ties, std::string const& vehicle) const;
  [[nodiscard]] Sheaf sheaf_of(KnownSlot const& slot) const;
  [[nodiscard]] Sheaf sheaf_of(std::size_t number, HeldTie const& tie) const;
  [[nodiscard]] Equations equations(std::span<KnownSlot const> slots) const;
  [[nodiscard]] Expectation expectation(std::size_t picture) const;
  void expect_poses(Equations& all, std::vector<Eigen::Matrix4d>& blocks) const;
  void fix_oldest(std::span<KnownSlot> slots);

  std::deque<Picture> pictures_;
  std::size_t first_ = 0;  ///< number of the oldest
};

}  // namespace lapwing::explore
