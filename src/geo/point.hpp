#pragma once

#include <Eigen/Core>

/// Places and shifts in a named frame of metres. A frame is an empty struct (`struct MapFrame {};`) that whoever has
/// the frame declares; numbers of different frames do not mix, which the compiler holds.
namespace lapwing::geo {

namespace detail {

/// What points and vectors have in common: the numbers along the axes.
template <int dim>
struct Coordinates {
  using Numbers = Eigen::Matrix<double, dim, 1>;
  Numbers v = Numbers::Zero();

  Coordinates() = default;
  explicit Coordinates(Numbers const& numbers) : v(numbers) {}
  Coordinates(double x, double y)
    requires(dim == 2)
      : v(x, y) {}
  Coordinates(double x, double y, double z)
    requires(dim == 3)
      : v(x, y, z) {}

  [[nodiscard]] double x() const { return v.x(); }
  [[nodiscard]] double y() const { return v.y(); }
  [[nodiscard]] double z() const
    requires(dim == 3)
  {
    return v.z();
  }
  [[nodiscard]] bool is_finite() const { return v.allFinite(); }
};

}  // namespace detail

/// A shift, or any other arrow, along the axes of a frame; metres unless its name says something else.
template <class Frame, int dim = 2>
struct Vector : detail::Coordinates<dim> {
  using Numbers = detail::Coordinates<dim>::Numbers;
  using detail::Coordinates<dim>::Coordinates;

  [[nodiscard]] double length() const { return this->v.norm(); }
  [[nodiscard]] double dot(Vector const& other) const { return this->v.dot(other.v); }
  /// Positive when `other` lies counterclockwise of this.
  [[nodiscard]] double cross(Vector const& other) const
    requires(dim == 2)
  {
    return this->x() * other.y() - this->y() * other.x();
  }

  friend Vector operator+(Vector const& a, Vector const& b) { return Vector(Numbers(a.v + b.v)); }
  friend Vector operator-(Vector const& a, Vector const& b) { return Vector(Numbers(a.v - b.v)); }
  friend Vector operator-(Vector const& a) { return Vector(Numbers(-a.v)); }
  friend Vector operator*(Vector const& a, double factor) { return Vector(Numbers(a.v * factor)); }
  friend Vector operator*(double factor, Vector const& a) { return a * factor; }
  friend bool operator==(Vector const& a, Vector const& b) { return a.v == b.v; }
};

/// A place in a frame, in metres from its origin.
template <class Frame, int dim = 2>
struct Point : detail::Coordinates<dim> {
  using Numbers = detail::Coordinates<dim>::Numbers;
  using detail::Coordinates<dim>::Coordinates;

  friend Vector<Frame, dim> operator-(Point const& to, Point const& from) {
    return Vector<Frame, dim>(Numbers(to.v - from.v));
  }
  friend Point operator+(Point const& place, Vector<Frame, dim> const& shift) {
    return Point(Numbers(place.v + shift.v));
  }
  friend Point operator-(Point const& place, Vector<Frame, dim> const& shift) {
    return Point(Numbers(place.v - shift.v));
  }
  friend bool operator==(Point const& a, Point const& b) { return a.v == b.v; }
};

template <class Frame>
using Point3 = Point<Frame, 3>;
template <class Frame>
using Vector3 = Vector<Frame, 3>;

/// In metres.
template <class Frame, int dim>
[[nodiscard]] double distance_m(Point<Frame, dim> const& a, Point<Frame, dim> const& b) {
  return (a - b).length();
}

}  // namespace lapwing::geo
