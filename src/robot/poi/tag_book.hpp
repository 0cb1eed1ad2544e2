#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "robot/views/tag_place.hpp"

namespace lapwing::robot {

/// A name tag as it was seen once.
struct TagSight {
  TagPlace place;
  map::SitePoint from = {};  ///< where the camera was
  std::string name;          ///< the room's number; empty: none was read
  std::string kind;          ///< of the room: "office"; empty: none was read
  double score = 0.0;        ///< 0..1: how sure the reader is
  std::string crop = {};     ///< the tag from the front, as a JPEG file; empty: none
};

/// Keeps name tags apart while a robot drives about: the same one seen from elsewhere is merged, its place by
/// covariance, its text by vote. What was seen past an edge that the map has a little beside where it is, as a sign
/// across the corridor through an open door, seems to hang there; it is the one of that name to which all its lines of
/// sight lead on.
class TagBook {
 public:
  struct Entry {
    std::uint32_t number = 0;  ///< from 1, never given twice
    map::SitePoint position;
    Eigen::Matrix2d covariance_m2;
    double height_m = 0.0;
    double facing_rad = 0.0;
    int sights = 0;
    std::vector<map::SitePoint> seen_from;  ///< of each sight, while they are few
    std::map<std::string, double> names;    ///< scores of all sights that read so
    std::map<std::string, double> kinds;    ///< likewise
    std::string crop = {};                  ///< of the sight that was surest of what the tag is called
    double crop_score = 0.0;                ///< how sure that was
    std::string picture = {};               ///< where the crop is kept; whoever keeps it writes this

    /// What most sights with a number read; without any, the kind of room.
    [[nodiscard]] std::string name() const;
    /// Number and kind.
    [[nodiscard]] std::string text() const;
    /// That the name is right: its part of all votes, and half a one against it, so that a single sight is not sure.
    [[nodiscard]] double confidence() const;
  };

  /// Two that have turned out to be one.
  struct Joined {
    std::uint32_t gone = 0;
    std::uint32_t into = 0;
  };

  /// The one that it was, or a new one, until the next call.
  Entry const& take(TagSight const& sight);
  [[nodiscard]] std::vector<Entry> const& tags() const { return tags_; }  ///< by their numbers
  /// Until the next call; null: there is none with this number, or not any more.
  [[nodiscard]] Entry const* find(std::uint32_t number) const;
  /// The map has moved, and all of them with it. What was placed twice by two passages that the map did not lay upon
  /// each other before may come together now: then the older one takes in the other.
  std::vector<Joined> move(MapMove const& moved);
  /// Where the crop of one of them is kept.
  void keep_picture(std::uint32_t number, std::string picture);

 private:
  std::vector<Entry> tags_;
  std::uint32_t last_number_ = 0;
};

}  // namespace lapwing::robot
