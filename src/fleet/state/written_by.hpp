#pragma once

#include <concepts>

namespace lapwing::fleet {

/// Who writes, by name: nobody but the class itself can make one.
template <class Writer>
class As {
  As() = default;
  friend Writer;
};

/// A part that everybody reads and only these classes write: another's `write(As<Other>())` does not compile.
template <class Part, class... Writers>
class WrittenBy {
 public:
  [[nodiscard]] Part const& operator*() const { return part_; }
  [[nodiscard]] Part const* operator->() const { return &part_; }

  template <class Writer>
    requires(std::same_as<Writer, Writers> || ...)
  [[nodiscard]] Part& write(As<Writer>) {
    return part_;
  }

 private:
  Part part_;
};

}  // namespace lapwing::fleet
