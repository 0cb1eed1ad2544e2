#pragma once

#include <span>
#include <vector>

#include "sim/building/noise.hpp"
#include "sim/building/scene/faces.hpp"

namespace lapwing::sim::building {

/// People who stand, walk along a way, or wander wherever there is room. They stop before robots, doors and each other,
/// so whoever touches one has driven into them.
class People {
 public:
  People(std::span<PersonPlan const> plans, std::uint64_t seed);

  /// `around`: all that is solid; its posts are people and robots, this one's own told by its number.
  void step(double seconds, Surroundings const& around);
  /// Walks nowhere any more, or wherever it was sent. For tests: a person in the way.
  void put(std::size_t person, Pose const& pose);

  struct Person {
    Pose pose;
    double walked_m = 0.0;  ///< for the swing of the legs
    bool walks = false;
    double speed_m_s = 0.0;
    std::vector<Place> way = {};
    std::size_t next_on_way = 0;
    Place to = {};
    double waits_s = 0.0;
    Noise noise;
  };
  [[nodiscard]] std::span<Person const> all() const { return people_; }
  /// One post each.
  void add_posts(std::vector<Post>& into) const;

  static constexpr double radius_m = 0.22;

 private:
  void choose(Person& person, std::size_t number, Surroundings const& around);
  void walk(Person& person, std::size_t number, double seconds, Surroundings const& around);

  std::vector<Person> people_;
};

}  // namespace lapwing::sim::building
