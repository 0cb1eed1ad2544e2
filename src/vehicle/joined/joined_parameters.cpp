#include "vehicle/joined/joined_parameters.hpp"

#include <fmt/format.h>

#include "vehicle/joined/shared_id.hpp"

namespace lapwing::vehicle {

using base::ErrorKind;
using base::fail;
using base::Result;
using base::Task;

namespace {

template <class T>
Task<Result<T>> failed(base::Error error) {
  co_return std::unexpected(std::move(error));
}

}  // namespace

std::vector<JoinedParameters::Member const*> JoinedParameters::owners(VehicleId const& id) const {
  std::vector<Member const*> found;
  for (auto const& member : members_)
    if (member.parameters->has(id)) found.push_back(&member);
  return found;
}

Result<VehicleParameters*> JoinedParameters::owner(VehicleId const& id) const {
  auto const found = owners(id);
  if (found.empty()) return fail(ErrorKind::not_found, fmt::format("there is no vehicle {}", id.text));
  if (found.size() > 1) return fail(ErrorKind::refused, shared_id(found, id));
  return found.front()->parameters;
}

Task<Result<ParameterList>> JoinedParameters::all(VehicleId id, bool old_ones_do) {
  auto const found = owner(id);
  return found ? (*found)->all(std::move(id), old_ones_do) : failed<ParameterList>(found.error());
}

std::optional<ParameterProgress> JoinedParameters::progress(VehicleId const& id) const {
  auto const found = owner(id);
  return found ? (*found)->progress(id) : std::nullopt;
}

Task<Result<std::string>> JoinedParameters::file(VehicleId id, bool old_ones_do) {
  auto const found = owner(id);
  return found ? (*found)->file(std::move(id), old_ones_do) : failed<std::string>(found.error());
}

Task<Result<Parameter>> JoinedParameters::read(VehicleId id, std::string name) {
  auto const found = owner(id);
  return found ? (*found)->read(std::move(id), std::move(name)) : failed<Parameter>(found.error());
}

Task<Result<ParameterChange>> JoinedParameters::change(VehicleId id, std::string name, double value, Commander by) {
  auto const found = owner(id);
  return found ? (*found)->change(std::move(id), std::move(name), value, std::move(by))
               : failed<ParameterChange>(found.error());
}

}  // namespace lapwing::vehicle
