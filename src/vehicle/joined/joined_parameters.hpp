#pragma once

#include <string>
#include <utility>
#include <vector>

#include "vehicle/parameters.hpp"

namespace lapwing::vehicle {

/// The parameters of the vehicles of several platforms: each is asked for those of its own. A vehicle whose id several
/// platforms have is refused. Thread-bound.
class JoinedParameters final : public VehicleParameters {
 public:
  JoinedParameters() = default;
  JoinedParameters(JoinedParameters const&) = delete;
  JoinedParameters& operator=(JoinedParameters const&) = delete;

  /// One more, before anything else is asked; it outlives this. `name` is what messages call the platform.
  void add(std::string name, VehicleParameters& parameters) { members_.push_back({std::move(name), &parameters}); }

  [[nodiscard]] bool has(VehicleId const& id) const override { return !owners(id).empty(); }
  [[nodiscard]] base::Task<base::Result<ParameterList>> all(VehicleId id, bool old_ones_do) override;
  [[nodiscard]] std::optional<ParameterProgress> progress(VehicleId const& id) const override;
  [[nodiscard]] base::Task<base::Result<std::string>> file(VehicleId id, bool old_ones_do) override;
  [[nodiscard]] base::Task<base::Result<Parameter>> read(VehicleId id, std::string name) override;
  [[nodiscard]] base::Task<base::Result<ParameterChange>> change(VehicleId id, std::string name, double value,
                                                                 Commander by) override;

 private:
  struct Member {
    std::string name;
    VehicleParameters* parameters;
  };
  [[nodiscard]] std::vector<Member const*> owners(VehicleId const& id) const;
  /// Errors: not_found, refused (a conflict).
  [[nodiscard]] base::Result<VehicleParameters*> owner(VehicleId const& id) const;

  std::vector<Member> members_;
};

}  // namespace lapwing::vehicle
