#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "perceive/memory/survey_memory.hpp"

namespace lapwing::perceive {

/// What a file gives to a process that was started anew.
struct Recalled {
  std::optional<SurveyMemory> memory = {};
  std::string words = {};  ///< for the log; empty when there was no file
  bool is_fault = false;
};

/// What was seen longer than `lasts` ago is left out, a survey that ended before that whole. A file that cannot be read
/// is put aside as `file` with `.unread`, since another one will be written in its place.
[[nodiscard]] Recalled recall(std::filesystem::path const& file, geo::Site const& site, base::UtcTime now,
                              base::Duration lasts);

}  // namespace lapwing::perceive
