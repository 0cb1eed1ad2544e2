#pragma once

#include <memory>
#include <vector>

#include "base/error.hpp"
#include "vision/signs/reader.hpp"

namespace lapwing::apps::detect {

/// Tesseract, and the recogniser where set-up has made it: without it blurred signs are read less often, which is said.
[[nodiscard]] base::Result<std::vector<std::unique_ptr<vision::LineReader>>> sign_readers();

}  // namespace lapwing::apps::detect
