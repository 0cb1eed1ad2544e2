#pragma once

#include <filesystem>
#include <string>

#include <opencv2/core.hpp>

#include "base/error.hpp"

namespace lapwing::video {

/// The content of a file of at most so many bytes. Errors: not_found, io: it cannot be read; invalid_input: it is
/// larger.
[[nodiscard]] base::Result<std::string> bytes_of(std::filesystem::path const& file, std::size_t most);
/// A picture as it is stored: BGR, 8 bits. Errors: as above, and what is no picture.
[[nodiscard]] base::Result<cv::Mat> picture_of(std::filesystem::path const& file);

}  // namespace lapwing::video
